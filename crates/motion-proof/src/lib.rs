//! Proof of the motion of an arm, of any planner: joint limits and clearance, at every moment and not at samples.
//!
#![doc = include_str!("../README.md")]
//!
//! # Where is what
//!
//! | concept | module |
//! | --- | --- |
//! | points in memory, and the motion through them | [`JointPoints`] (`points`), [`ExactTime`] (`time`) |
//! | trajectories in files: CSV, ROS messages | [`TrajectoryFile`] (`file`), `message` |
//! | obstacles of a planning scene of MoveIt | [`planning_scene`] |
//! | the judgement; the stop behind the last point | [`prove_motion`] (`prove`), `stop` |
//! | the report | [`MotionReport`] (`report`) |
//! | places in texts, errors of reading | [`Place`], [`ReadError`] (`place`) |

mod file;
#[doc(hidden)]
pub mod message;
mod place;
pub mod planning_scene;
mod points;
mod prove;
mod report;
mod stop;
mod time;

pub use crate::file::TrajectoryFile;
pub use crate::place::{Place, ReadError};
pub use crate::points::{Interpolation, JointPoints, PointMotion, PointsError};
pub use crate::prove::{judged_motion, prove_motion};
pub use crate::report::{JudgedRule, MotionMoment, MotionReport, MotionVerdict};
pub use crate::time::ExactTime;

// Other crates whose types the functions take, so that one dependency is enough.
pub use platewash_bodies as bodies;
pub use platewash_certificate::{ProveError, Requirement, Status};
pub use platewash_kinematics as kinematics;
pub use platewash_workcell as workcell;
pub use platewash_workcell::cancel::CancelToken;
