//! Leaning across the arm's plane, away from what stands beside the arm.
//!
//! A tilt in the arm's plane moves forearm and wrist towards axis 1 or away from it, along whatever stands beside them. Where that is in the
//! way of every such tilt, the tool leans across the plane besides, by as much all along the wash path; both together stay within the
//! path's cone.

use super::error::{DeadEnd, RedundancyError};
use super::task::Task;
use crate::scene::Hindrance;

/// How far it leans, as shares of the cone that is planned: the least first, as the rest is left for tilts in the arm's plane.
const SHARES: [f64; 3] = [0.35, 0.65, 1.0];

/// The leans to try \[rad\], to either side.
pub(super) fn leans(task: &Task<'_>) -> impl Iterator<Item = f64> + use<> {
    let most_rad = task.planned_lean_rad();
    SHARES
        .into_iter()
        .flat_map(move |share| [share * most_rad, -share * most_rad])
}

/// Whether an obstacle stands in the way where a search ended.
pub(super) fn may_help(task: &Task<'_>, error: &RedundancyError) -> bool {
    let ends = match error {
        RedundancyError::NoTilt { ends, .. } => &ends[..],
        RedundancyError::Disconnected { end, .. } | RedundancyError::Between { end, .. } => std::slice::from_ref(end),
        _ => &[],
    };
    ends.iter().any(|end| may_help_at(task, end))
}

/// Whether an obstacle stands in the way of some tilt at a contact point.
pub(super) fn may_help_at(task: &Task<'_>, end: &DeadEnd) -> bool {
    let surroundings = task.scene.surroundings;
    end.reasons.iter().any(|reason| match &reason.least {
        Hindrance::Clearance { pair, .. } => [&pair.a, &pair.b]
            .into_iter()
            .any(|name| surroundings.is_obstacle(name)),
        _ => false,
    })
}
