//! The certificate of a plan: what is proved about it, judged from the plan file and the arm's description alone.
//!
//! Nothing here knows how a plan came about: the wash paths are evaluated from their definition, the motion from its knots. What is
//! shared with a planner are definitions: forward kinematics, bodies, pairs and distances, limits, the wash path, the raster of
//! coverage. Every bound holds for the whole motion, not for samples; `docs/certificate.md` says how and on what assumptions.
//!
//! | concept | module |
//! | --- | --- |
//! | what is required, and what came of it | `requirement`, `check` |
//! | all of it, one after the other; as a proof that cannot be forged | `prove`, `certified` |
//! | the certificate; its first line, what is usual, as a table, what it rests on | `certificate`, `headline`, `usual`, `table`, `rests_on`, `plate_words`, `amounts` |
//! | the job that is judged, its limits, its bodies, its faces | `subject`, `limits`, `bodies`, `face` |
//! | what the plan states | `statements`, `wash_paths`, `schedule`, `home`, `apart`, `exclusions`, `dry_run` |
//! | the motion: cubics, groups of them | `piece`, `timeline` |
//! | joints | `joints` |
//! | the tip: derivatives, halving, speed, tilt, height | `tip`, `bound_tracker`, `tip_limits` |
//! | on a face that is no disc: how heights and normals change | `pass` |
//! | joint 5, that the wrist does not flip | `wrist` |
//! | the sponge where it comes down and leaves: what touches, how fast | `rim`, `contact` |
//! | pressed: moments and what is lost between them, how hard, which share of a plate | `instants`, `pressing`, `plate_contact` |
//! | the curves, following them, sweeping the plate | `curve`, `following`, `polyline`, `swept` |
//! | beyond the rim: what may be touched there, how far it is | `neighbours`, `reach` |
//! | clearance: one pair, all pairs; at a single moment, to look at | `clear`, `clearances`; `moments` |
//! | a motion that a controller makes of a plan; how far it leaves the plan | `program`, `deviation` |
//! | places, told in the world | `world` |

mod amounts;
mod apart;
mod bodies;
mod bound_tracker;
mod certificate;
mod certified;
mod check;
mod clear;
mod clearances;
mod contact;
mod curve;
mod deviation;
mod dry_run;
mod error;
mod exclusions;
mod face;
mod far;
mod following;
mod headline;
mod home;
mod instants;
mod joints;
mod limits;
mod moments;
mod neighbours;
mod pass;
mod piece;
mod plate_contact;
mod plate_words;
mod polyline;
mod pressing;
mod pressing_search;
mod program;
mod prove;
mod reach;
mod requirement;
mod rests_on;
mod rim;
mod schedule;
mod statements;
mod subject;
mod swept;
mod table;
#[cfg(test)]
mod tests;
mod timeline;
mod tip;
mod tip_limits;
mod turning_frame;
mod usual;
mod wash_paths;
mod world;
mod wrist;

pub use certificate::{CERTIFICATE_FORMAT, Certificate, HashFinding, Verdict};
pub use certified::{Certified, CertifyError, certify, certify_with};
pub use check::{Check, Discrepancy, Measure, Sense, Status, Unit, Worst};
pub use clearances::{PairBound, PairRule};
pub use error::ProveError;
pub use headline::{paper_headline, planned_headline};
pub use moments::ClearanceRule;
pub use neighbours::Touched;
pub use plate_contact::{PlateContact, ProvedExtreme, ProvedShare};
pub use platewash_workcell::differences::{Difference, differences};
pub use program::{ProgramLimits, ProgramProof, prove_program};
pub use prove::{MotionProof, prove, prove_motion, prove_with};
pub use requirement::Requirement;
pub use rests_on::RestsOn;
pub use swept::PlateCoverage;
pub use table::MeasureWords;
