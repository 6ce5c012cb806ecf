//! The certificate of a plan: what is proved about it, judged from the plan file and the arm's description alone.
//!
//! Nothing here knows how a plan came about: the wash paths are evaluated from their definition, the motion from its knots. What is
//! shared with a planner are definitions: forward kinematics, bodies, pairs and distances, limits, the wash path, the raster of
//! coverage. Every bound holds for the whole motion, not for samples; `docs/certificate.md` says how and on what assumptions.
//!
//! | concept | module |
//! | --- | --- |
//! | all requirements, in the order of the report | `prove` |
//! | a certificate that only a proof can make | `certified` |
//! | the job that is judged, with its limits and its bodies | `judged` |
//! | what the plan states | `plan_statements` |
//! | the motion: joints, tip, wrist | `motion` |
//! | clearance of every pair of bodies | `clearance` |
//! | the tip and the sponge on the plates: coverage, contact, load, contact speed, reach | `washing` |
//! | when the dose of places of a plate is proved, for display | `dose_times` |
//! | the motion that a robot's controller makes of a plan | `program` |
//! | a motion of an arm alone, by any planner | `arm_motion` |
//! | the certificate and its texts | `report` |

mod arm_motion;
mod certified;
mod clearance;
mod dose_times;
mod error;
mod judged_job;
mod motion;
mod plan_statements;
mod program;
mod prove;
mod report;
mod washing;

pub use crate::arm_motion::{ArmMotionProof, MotionRules, Timing, prove_arm_motion};
pub use crate::certified::{Certified, CertifyError, certify, certify_with};
pub use crate::clearance::moments::ClearanceRule;
pub use crate::clearance::pairs::{PairBound, PairRule};
pub use crate::dose_times::{DoseTimes, dose_times};
pub use crate::error::ProveError;
pub use crate::program::{ProgramLimits, ProgramProof, prove_program};
pub use crate::prove::{MotionProof, prove, prove_motion, prove_with};
pub use crate::report::certificate::{CERTIFICATE_FORMAT, Certificate, HashFinding, Verdict};
pub use crate::report::check::{Check, Discrepancy, Measure, Sense, Status, WorstCase};
pub use crate::report::explanation::Explanation;
pub use crate::report::headline::{paper_headline, planned_headline};
pub use crate::report::requirement::{Requirement, RequirementGroup, RequirementRow};
pub use crate::report::table::MeasureWords;
pub use crate::report::unit::Unit;
pub use crate::report::verdict_basis::VerdictBasis;
pub use crate::washing::holder_load::{HolderLoad, RingShares};
pub use crate::washing::plate_contact::{PlateContact, ProvedExtreme, ProvedShare};
pub use crate::washing::plate_coverage::{PlateCoverage, ReachedNeighbour};
pub use platewash_motion::differences::{Difference, differences};
