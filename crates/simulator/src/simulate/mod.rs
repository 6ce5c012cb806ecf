//! A plan under a control law: what the arm does, and what of the wash is left.
//!
//! [`simulate`] runs a plan sample by sample and gives an [`Execution`]; [`SimulationReport::new`] judges it. Both are pure:
//! equal plans, arms and settings give equal bytes.
//!
//! | concept | file |
//! | --- | --- |
//! | whether settings make sense | `settings.rs` |
//! | how much work it may be | `work.rs` |
//! | the loop of samples | `run.rs` |
//! | about which configurations it must be stable | `footing.rs` |
//! | segments of a plan in time | `schedule.rs` |
//! | the executed motion, sample by sample | `execution.rs` |
//! | it as CSV | `csv.rs` |
//! | root mean square, 95 %, largest | `statistics.rs` |
//! | errors of joints and tip | `tracking.rs` |
//! | torques, work, power | `effort.rs` |
//! | contact, coverage and verdict of a plate | `washing.rs`, `contact.rs`, `cause.rs` |
//! | force while washing, contact lost | `pressing.rs` |
//! | the tool's mass against the arm's payload | `payload.rs` |
//! | all of it | `report.rs` |
//! | it as text | `text.rs` |
//! | many frequencies and dampings | `tune.rs` |

mod cause;
mod contact;
mod csv;
mod effort;
mod error;
mod execution;
mod footing;
mod payload;
mod pressing;
mod report;
mod run;
mod schedule;
mod settings;
mod statistics;
mod text;
mod tracking;
mod tune;
mod washing;
mod words;
mod work;

pub use cause::Cause;
pub use csv::{HEADER, table};
pub use effort::{Effort, JointEffort};
pub use error::SimulationError;
pub use execution::{Execution, Sample};
pub use payload::{PayloadCheck, PayloadVerdict};
pub use pressing::{ContactLost, ExecutedContact, ForceAtHeight, ForceRange, HEIGHT_ERRORS_M, Pressing};
pub use report::{SimulationReport, SimulationVerdict};
pub use run::{simulate, simulate_watched, simulate_with};
pub use statistics::Spread;
pub use tracking::{SegmentTracking, Tracking};
pub use tune::{TuneOutcome, TuneRow, tune};
pub use washing::{PlateOutcome, PlateVerdict};
pub use work::{MAX_SAMPLES, MAX_STEPS};
