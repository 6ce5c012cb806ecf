//! The redundancy of washing: tilt and yaw of the tool, and the branch of the arm, at every contact point.
//!
//! # Goal
//!
//! A configuration for each contact point of a [`WashPath`](platewash_workcell::wash_path::WashPath), such that the tip is
//! exactly there, the tool within the path's cone about the normal, the joints within their limits, the bodies clear of each
//! other by the margin, and the joint path continuous, on one branch of the arm.
//!
//! # Freedom
//!
//! The sponge is round, so yaw is free: it is chosen such that joints 4 and 6 rest, which takes the least joint travel
//! ([`PlacedArm::tip_pose`](crate::placed_arm::PlacedArm::tip_pose)). Of the two directions in which the tool can tilt, the one in the arm's
//! own plane is the useful one, except for obstacles beside the arm.
//!
//! # Method
//!
//! 1. `TiltPolicy` (`placed_arm/tilt_policy.rs`): a tilt by the distance from axis 1 alone. It mostly suffices, and costs one pass over the
//!    points.
//! 2. `search`: the cheapest path through a graph of tilts along the wash path, near the policy where that is possible, smoothed
//!    by a B-spline (`samples`) as far as it stays possible.
//!
//! Before the second, a check of a few points of the last turn (`stuck`) shows if it can find anything at all.
//!
//! Where an obstacle stands in the way of both, they are tried again with the tool leaning across the arm's plane besides (`washing`).
//!
//! Each is tried on every branch of the arm, elbow up in front first; on arms without a closed form, on every branch that a
//! search finds ([`platewash_kinematics::ik::spread`]). Every answer has been checked for limits and steps at every contact
//! point, and for clearance at every one except those within 4 mm behind one with 8 mm to spare. Between the points nothing is
//! proved here. Where there is no answer, the error names contact points and their obstructions. That says nothing of other paths;
//! [`beyond_reach`] bounds the share of a face that no path sweeps.

pub mod beyond_reach;
pub mod error;
mod lean_aside;
mod lines;
pub mod places;
pub mod samples;
mod search;
pub mod stuck;
pub mod task;
#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;
pub mod washability;
mod washing;

pub use crate::redundancy::error::{DeadEnd, MOST_DEAD_ENDS, Reason, RedundancyError};
pub use crate::redundancy::places::{Chance, chance};
pub use crate::redundancy::stuck::is_blocked;
pub use crate::redundancy::task::Task;
pub use crate::redundancy::washing::{TiltChoice, Washing, washing};
