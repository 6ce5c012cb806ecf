//! The plate-washing job, from a scenario to a report.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`].

pub mod certificate;
pub mod clearance;
pub mod control;
pub mod coverage;
pub mod crossing;
pub mod csv;
pub mod cubic;
pub mod cycle;
mod error;
pub mod job;
pub mod joint_path;
pub mod layout;
pub mod order;
mod place;
pub mod plan;
pub mod posture;
pub mod random;
pub mod report;
pub mod reproduce;
pub mod robot;
pub mod scenario;
pub mod spiral;
pub mod stroke;
pub mod sweep;
pub mod timing;
pub mod tool_path;
pub mod tracking;
pub mod trajectory;
pub mod transition;
pub mod words;

pub(crate) use platewash_kinematics::trig;
