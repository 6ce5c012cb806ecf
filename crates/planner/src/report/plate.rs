//! What happened on each plate.

use crate::clearance::{ClearanceModel, PairClearance};
use crate::coverage::{Coverage, CoverageError, CoverageSettings, coverage};
use crate::job::Job;
use crate::tool_path::SegmentKind;
use crate::tracking::{IkOutcome, Step};
use platewash_kinematics::JointVector;
use platewash_kinematics::ik::IkCause;
use serde::Serialize;

/// The nearest approach of two bodies, and when.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClosestApproach {
    /// When \[s\].
    pub t_s: f64,
    /// What and where.
    #[serde(flatten)]
    pub pair: PairClearance,
}

/// Nearest approaches at one step.
pub(super) struct StepApproach {
    pub planned: Option<ClosestApproach>,
    pub executed: Option<ClosestApproach>,
}

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

/// What happened on one plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlateReport {
    /// Index of the plate.
    pub plate: usize,
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// Whether it counts as washed: every waypoint solved, free of contact, and enough of it covered.
    pub washed: bool,
    /// Waypoints asked.
    pub waypoints: usize,
    /// Waypoints solved.
    pub reached: usize,
    /// Largest position error of the inverse kinematics \[m\].
    pub worst_ik_position_error_m: f64,
    /// Largest orientation error of the inverse kinematics \[rad\].
    pub worst_ik_orientation_error_rad: f64,
    /// The unreached waypoint that is farthest away.
    pub worst_unreached: Option<Unreached>,
    /// Nearest approach of the commanded motion.
    pub planned_clearance: Option<ClosestApproach>,
    /// Nearest approach of the executed motion.
    pub executed_clearance: Option<ClosestApproach>,
    /// Covered share of the plate had the tip followed the waypoints.
    pub ideal_coverage: Coverage,
    /// Covered share of the plate as executed.
    pub executed_coverage: Coverage,
    /// Distance of the executed tip from the waypoints, root mean square \[m\].
    pub tracking_rms_m: f64,
    /// The same, at most \[m\].
    pub tracking_max_m: f64,
}

/// Nearest approaches at every step, commanded and executed.
pub(super) fn approaches(job: &Job, clearance: &ClearanceModel) -> Vec<StepApproach> {
    let segments = &job.tool_path.segments;
    let at = |(k, step): (usize, &Step)| {
        // Washing, the sponge may touch its plate; on the way, the plate it leaves and the one it comes to.
        let here = segments[step.segment].plate;
        let from = step
            .segment
            .checked_sub(1)
            .map_or(here, |before| segments[before].plate);
        let working = match segments[step.segment].kind {
            SegmentKind::Wash => [here, here],
            SegmentKind::Transition => [from, here],
        };
        let approach = |q: &JointVector| {
            let pair = clearance.smallest(q, &working)?;
            let t_s = job.time_of(k);
            Some(ClosestApproach { t_s, pair })
        };
        StepApproach {
            planned: approach(&step.commanded),
            executed: approach(&step.executed),
        }
    };
    job.steps.iter().enumerate().map(at).collect()
}

/// The nearest of several approaches (the first of equals).
pub(super) fn nearest<'a>(approaches: impl Iterator<Item = &'a ClosestApproach>) -> Option<ClosestApproach> {
    approaches
        .min_by(|a, b| a.pair.distance_m.total_cmp(&b.pair.distance_m))
        .cloned()
}

/// Root mean square and maximum of the tracking error \[m\]; zeros without steps.
pub(super) fn tracking_errors<'a>(steps: impl Iterator<Item = &'a Step>) -> (f64, f64) {
    let (count, sum, most) = steps
        .map(Step::tracking_error_m)
        .fold((0.0, 0.0, 0.0_f64), |(n, sum, most), error| {
            (n + 1.0, sum + error * error, most.max(error))
        });
    (f64::sqrt(sum / f64::max(count, 1.0)), most)
}

/// Every plate, in the order of washing.
pub(super) fn plates(job: &Job, approaches: &[StepApproach]) -> Result<Vec<PlateReport>, CoverageError> {
    let washes = job
        .tool_path
        .segments
        .iter()
        .enumerate()
        .filter(|(_, s)| s.kind == SegmentKind::Wash);
    washes
        .map(|(segment, part)| plate(job, approaches, segment, part.plate))
        .collect()
}

fn plate(job: &Job, approaches: &[StepApproach], segment: usize, index: usize) -> Result<PlateReport, CoverageError> {
    let here = |step: &&Step| step.segment == segment;
    let steps: Vec<_> = job.steps.iter().filter(here).collect();
    let near = || {
        job.steps
            .iter()
            .zip(approaches)
            .filter(|(s, _)| s.segment == segment)
            .map(|(_, a)| a)
    };
    let plate = job.layout.plates[index];
    let centre_m = [plate.x_m, plate.y_m];
    let swept = |of: fn(&Step) -> [f64; 2]| {
        let path: Vec<_> = steps.iter().map(|s| of(s)).collect();
        let sponge = job.scenario.tool.sponge_radius_m;
        coverage(&path, centre_m, plate.radius_m, sponge, &CoverageSettings::default())
    };
    let worst = |of: fn(&Step) -> f64| steps.iter().map(|s| of(s)).fold(0.0, f64::max);
    let executed_coverage = swept(|s| [s.executed_tip.x, s.executed_tip.y])?;
    let executed_clearance = nearest(near().filter_map(|a| a.executed.as_ref()));
    let reached = steps.iter().filter(|s| s.reached()).count();
    let clear = executed_clearance
        .as_ref()
        .is_none_or(|c| is_clear(c.pair.distance_m, job.scenario.wash.clearance_m));
    let (tracking_rms_m, tracking_max_m) = tracking_errors(steps.iter().copied());
    Ok(PlateReport {
        plate: index,
        centre_m,
        washed: reached == steps.len() && clear && executed_coverage.fraction >= job.scenario.job.required_coverage,
        waypoints: steps.len(),
        reached,
        worst_ik_position_error_m: worst(|s| s.ik_position_error_m),
        worst_ik_orientation_error_rad: worst(|s| s.ik_orientation_error_rad),
        worst_unreached: worst_unreached(&steps),
        planned_clearance: nearest(near().filter_map(|a| a.planned.as_ref())),
        executed_clearance,
        ideal_coverage: swept(|s| [s.target.x, s.target.y])?,
        executed_coverage,
        tracking_rms_m,
        tracking_max_m,
    })
}

/// Whether a distance keeps the clearance asked for; at 0 only contact breaks it.
pub(super) fn is_clear(distance_m: f64, required_m: f64) -> bool {
    distance_m > 0.0 && distance_m >= required_m
}

fn worst_unreached(steps: &[&Step]) -> Option<Unreached> {
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
