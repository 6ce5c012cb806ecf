//! Waypoints that the inverse kinematics did not solve.

use crate::tracking::{IkOutcome, Step};
use platewash_kinematics::ik::IkCause;
use serde::Serialize;

/// A waypoint that was not reached.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Unreached {
    /// Index of the waypoint on the plate, from 0.
    pub waypoint: usize,
    /// Where it is \[m\].
    pub target_m: [f64; 3],
    /// Why.
    pub cause: IkCause,
    /// How far the best configuration stays away \[m\].
    pub position_error_m: f64,
    /// How far it is turned \[rad\].
    pub orientation_error_rad: f64,
}

/// The unreached waypoint that is farthest away, of the steps of one segment.
pub(super) fn worst_unreached(steps: &[&Step]) -> Option<Unreached> {
    let failed = steps
        .iter()
        .enumerate()
        .filter_map(|(waypoint, step)| match step.outcome {
            IkOutcome::Solved { .. } => None,
            IkOutcome::Failed { cause } => Some(Unreached {
                waypoint,
                target_m: step.target.into(),
                cause,
                position_error_m: step.ik_position_error_m,
                orientation_error_rad: step.ik_orientation_error_rad,
            }),
        });
    failed.max_by(|a, b| a.position_error_m.total_cmp(&b.position_error_m))
}
