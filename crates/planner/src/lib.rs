//! The plate-washing job, from a scenario to a report.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`].

pub mod certificate;
pub mod control;
pub mod crossing;
pub mod cubic;
pub mod cycle;
mod error;
pub mod job;
pub mod joint_path;
pub mod order;
mod place;
pub mod plan;
pub mod posture;
pub mod report;
pub mod reproduce;
pub mod robot;
pub mod scenario;
pub mod spiral;
pub mod sweep;
pub mod timing;
pub mod tool_path;
pub mod tracking;

pub(crate) use platewash_kinematics::trig;
