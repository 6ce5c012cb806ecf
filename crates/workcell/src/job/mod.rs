//! A job: what is to be washed, in which workcell, and what the washing must keep. Resolved: every number is stated, there are no
//! defaults and no files left.

mod apart;
mod contact;
mod error;
mod from_base;
mod planner;
mod requirements;
mod terms;
mod wash_job;

pub use apart::PlateOverlap;
pub use contact::ContactRequirements;
pub use error::{End, JobError};
pub use planner::{OrderRule, PatternName, Planner, PlannerSettings, ReachBorders};
pub use requirements::{LINE_TOLERANCE_M, Limits, Overlap, PATH_TOLERANCE_M, Requirements, Treatment};
pub use terms::{JobTerms, MAX_SEED};
pub use wash_job::WashJob;
