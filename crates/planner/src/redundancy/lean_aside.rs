//! Leaning aside: the tool leans across the arm's plane where an obstacle blocks every tilt in it.

use crate::placed_arm::Hindrance;
use crate::redundancy::error::{DeadEnd, RedundancyError};
use crate::redundancy::task::Task;

/// Leans aside that are tried, as shares of the planned cone: the least first, as the rest is left for tilts in the arm's plane.
const SHARES: [f64; 3] = [0.35, 0.65, 1.0];

/// The leans to try \[rad\], to either side.
pub(crate) fn leans(task: &Task<'_>) -> impl Iterator<Item = f64> + use<> {
    let most_rad = task.planned_lean_rad();
    SHARES
        .into_iter()
        .flat_map(move |share| [share * most_rad, -share * most_rad])
}

/// Checks that an obstacle stands in the way at the contact points where a search ended.
pub(crate) fn obstacle_blocks(task: &Task<'_>, error: &RedundancyError) -> bool {
    let ends = match error {
        RedundancyError::NoTilt { ends, .. } => &ends[..],
        RedundancyError::Disconnected { end, .. } | RedundancyError::Between { end, .. } => std::slice::from_ref(end),
        _ => &[],
    };
    ends.iter().any(|end| obstacle_blocks_at(task, end))
}

/// Checks that an obstacle stands in the way of some tilt at a contact point.
pub(crate) fn obstacle_blocks_at(task: &Task<'_>, end: &DeadEnd) -> bool {
    let surroundings = task.placed.surroundings;
    end.reasons.iter().any(|reason| match &reason.least {
        Hindrance::Clearance { pair, .. } => [&pair.a, &pair.b]
            .into_iter()
            .any(|name| surroundings.is_obstacle(name)),
        _ => false,
    })
}
