//! What happened between plates.

use super::nearness::{ClosestApproach, StepApproach, nearest};
use super::unreached::{Unreached, worst_unreached};
use crate::run::PaperRun;
use crate::tracking::{Step, tracking_errors};
use platewash_workcell::trajectory::SegmentKind;
use serde::Serialize;

/// Waypoints and nearness of the transits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TransitReport {
    /// Waypoints asked.
    pub waypoints: usize,
    /// Waypoints solved.
    pub reached: usize,
    /// The unreached waypoint that is farthest away, counted over all transits.
    pub worst_unreached: Option<Unreached>,
    /// Distance of the executed tip from the path, root mean square \[m\].
    pub tracking_rms_m: f64,
    /// Distance of the executed tip from the path, at most \[m\].
    pub tracking_max_m: f64,
    /// Nearest approach of the commanded motion.
    pub planned_clearance: Option<ClosestApproach>,
    /// Nearest approach of the executed motion.
    pub executed_clearance: Option<ClosestApproach>,
}

pub(super) fn transits(run: &PaperRun, approaches: &[StepApproach]) -> TransitReport {
    let between = |step: &Step| run.tool_path.segments[step.segment].kind == SegmentKind::Transit;
    let steps: Vec<_> = run.steps.iter().filter(|s| between(s)).collect();
    let (tracking_rms_m, tracking_max_m) = tracking_errors(steps.iter().copied());
    let least = |of: fn(&StepApproach) -> Option<&ClosestApproach>| {
        nearest(
            run.steps
                .iter()
                .zip(approaches)
                .filter(|(s, _)| between(s))
                .filter_map(|(_, a)| of(a)),
        )
    };
    TransitReport {
        waypoints: steps.len(),
        reached: steps.iter().filter(|s| s.reached()).count(),
        worst_unreached: worst_unreached(&steps),
        tracking_rms_m,
        tracking_max_m,
        planned_clearance: least(|a| a.planned.nearest.as_ref()),
        executed_clearance: least(|a| a.executed.nearest.as_ref()),
    }
}
