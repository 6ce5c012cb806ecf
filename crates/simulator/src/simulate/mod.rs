//! A plan under a control law: the motion of the arm, and the resulting wash.
//!
//! [`simulate`] runs a plan sample by sample and gives an [`Execution`]; [`SimulationReport::new`] judges it. Both are pure:
//! equal plans, arms and settings give equal bytes.
//!
//! | concept | file |
//! | --- | --- |
//! | whether settings make sense | `error.rs` |
//! | how much work it may be; the loop of samples; about which configurations it must be stable; segments of a plan in time | `run.rs` |
//! | the executed motion, sample by sample; it as CSV | `execution.rs` |
//! | root mean square, 95 %, largest; errors of joints and tip; torques, work, power; the tool's mass against the arm's payload | `measures.rs` |
//! | swept share and verdict of a plate | `washing.rs` |
//! | force while washing, contact lost, shares of the face in contact | `pressing.rs` |
//! | all of it | `report.rs` |
//! | it as text | `text.rs` |
//! | many frequencies and dampings | `tune.rs` |

mod error;
mod execution;
pub(crate) mod measures;
mod pressing;
mod report;
mod run;
mod text;
mod tune;
mod washing;

pub use crate::simulate::error::SimulationError;
pub use crate::simulate::execution::{Execution, HEADER, Sample, table};
pub use crate::simulate::measures::{
    Effort, JointEffort, PayloadCheck, PayloadVerdict, SegmentTracking, Spread, Tracking,
};
pub use crate::simulate::pressing::{
    ContactLoss, ExecutedContact, ForceAtHeight, ForceRange, HEIGHT_ERRORS_M, Pressing,
};
pub use crate::simulate::report::{SimulationReport, SimulationVerdict};
pub use crate::simulate::run::{MAX_SAMPLES, MAX_STEPS, simulate, simulate_watched, simulate_with};
pub use crate::simulate::tune::{TuneOutcome, TuneRow, tune};
pub use crate::simulate::washing::{Cause, PlateOutcome, PlateVerdict};
