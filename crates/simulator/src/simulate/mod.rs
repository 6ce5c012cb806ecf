//! A plan under a control law: the motion of the arm, and the resulting wash.
//!
//! [`simulate`] runs a plan sample by sample and gives an [`Execution`]; [`SimulationReport::new`] judges it. Both are pure:
//! equal plans, arms and settings give equal bytes.
//!
//! | concept | file |
//! | --- | --- |
//! | whether settings make sense; errors | `check.rs`, `error.rs` |
//! | how much work it may be | `amount.rs` |
//! | the loop of samples; about which configurations it must be stable | `run.rs` |
//! | segments of a plan in time | `schedule.rs` |
//! | the executed motion, sample by sample; it as CSV | `execution.rs`, `table.rs` |
//! | root mean square, 95 %, largest; errors of joints and tip; torques, work, power | `measures.rs` |
//! | the tool's mass against the arm's payload | `payload.rs` |
//! | swept share and verdict of a plate | `washing.rs` |
//! | force while washing, contact lost, shares of the face in contact | `pressing.rs` |
//! | all of it | `report.rs` |
//! | it as text; its numbers, rounded | `text.rs`, `rounding.rs` |
//! | many frequencies and dampings | `tune.rs` |

mod amount;
mod check;
mod error;
mod execution;
pub(crate) mod measures;
pub(crate) mod payload;
mod pressing;
mod report;
mod rounding;
mod run;
mod schedule;
mod table;
mod text;
mod tune;
mod washing;

pub use crate::simulate::amount::{MAX_SAMPLES, MAX_STEPS};
pub use crate::simulate::error::SimulationError;
pub use crate::simulate::execution::{Execution, Sample};
pub use crate::simulate::measures::{Effort, JointEffort, SegmentTracking, Spread, Tracking};
pub use crate::simulate::payload::{PayloadCheck, PayloadVerdict};
pub use crate::simulate::pressing::{
    ContactLoss, ExecutedContact, ForceAtHeight, ForceRange, HEIGHT_ERRORS_M, Pressing,
};
pub use crate::simulate::report::{SimulationReport, SimulationVerdict};
pub use crate::simulate::run::{simulate, simulate_watched, simulate_with};
pub use crate::simulate::table::{HEADER, table};
pub use crate::simulate::tune::{TuneOutcome, TuneRow, tune};
pub use crate::simulate::washing::{Cause, PlateOutcome, PlateVerdict};
