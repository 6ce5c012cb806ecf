//! What happened on each plate.

use crate::job::Job;
use crate::tool_path::SegmentKind;
use crate::tracking::{IkOutcome, Step};
use platewash_kinematics::JointVector;
use platewash_kinematics::ik::IkCause;
use platewash_workcell::clearance::{ClearanceModel, PairClearance, is_clear};
use platewash_workcell::coverage::{Coverage, CoverageError, CoverageSettings, coverage};
use platewash_workcell::layout::Plate;
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

/// How near the arm comes at one step.
pub(super) struct Nearness {
    /// The nearest pair.
    pub nearest: Option<ClosestApproach>,
    /// All pairs that keep too little clearance.
    pub too_near: Vec<ClosestApproach>,
}

/// The same for what was commanded and what was done.
pub(super) struct StepApproach {
    pub planned: Nearness,
    pub executed: Nearness,
}

/// Fine enough that the proven error of a plate's coverage is about a tenth of a percent.
const RASTER: CoverageSettings = CoverageSettings { cell_m: 2e-4 };

/// The tip counts as touching the plate up to this height above it \[m\].
const CONTACT_HEIGHT_M: f64 = 1e-3;

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
    /// Whether it counts as washed: every waypoint solved, the sponge on the plate at each, nothing else too near, and
    /// enough surely covered (the lower bound).
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
    /// Waypoints at which the executed sponge is on the plate: there is a tool body, and its tip is no higher than 1 mm above the
    /// surface and no deeper than the sponge.
    pub in_contact: usize,
    /// Covered share of the plate had the tip followed the waypoints, seen from above: as if the sponge touched wherever the
    /// tip passes.
    pub ideal_coverage: Coverage,
    /// Covered share of the plate as executed, seen from above.
    pub executed_coverage: Coverage,
    /// Distance of the executed tip from the waypoints, root mean square \[m\].
    pub tracking_rms_m: f64,
    /// The same, at most \[m\].
    pub tracking_max_m: f64,
}

/// How near the arm comes at every step, commanded and executed.
pub(super) fn approaches(job: &Job, clearance: &ClearanceModel) -> Vec<StepApproach> {
    let at = |(k, step): (usize, &Step)| {
        let working = worked_on(job, k);
        let nearness = |q| nearness(clearance, q, &working, job, k);
        StepApproach {
            planned: nearness(&step.commanded),
            executed: nearness(&step.executed),
        }
    };
    job.steps.iter().enumerate().map(at).collect()
}

fn nearness(clearance: &ClearanceModel, q: &JointVector, working: &[usize], job: &Job, step: usize) -> Nearness {
    let required_m = job.scenario.wash.clearance_m;
    let timed = |pair| ClosestApproach {
        t_s: job.time_of(step),
        pair,
    };
    let nearest = clearance.smallest(q, working);
    // Nearly all configurations keep their distance; only the others are looked at pair by pair.
    let too_near = match &nearest {
        Some(pair) if !is_clear(pair.distance_m, required_m) => clearance.too_near(q, working, required_m),
        _ => Vec::new(),
    };
    Nearness {
        nearest: nearest.map(timed),
        too_near: too_near.into_iter().map(timed).collect(),
    }
}

/// The plate that the sponge may touch at a step: the one it washes; on the way, the one it leaves for the first half and
/// the one it comes to for the second.
fn worked_on(job: &Job, step: usize) -> [usize; 1] {
    let segments = &job.tool_path.segments;
    let index = job.steps[step].segment;
    let segment = &segments[index];
    let first_half = || {
        let before: usize = segments[..index].iter().map(|s| s.waypoints.len()).sum();
        2 * (step - before) < segment.waypoints.len()
    };
    match (segment.kind, index.checked_sub(1)) {
        (SegmentKind::Transition, Some(left)) if first_half() => [segments[left].plate],
        _ => [segment.plate],
    }
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
        coverage(&path, centre_m, plate.radius_m, sponge, &RASTER)
    };
    let worst = |of: fn(&Step) -> f64| steps.iter().map(|s| of(s)).fold(0.0, f64::max);
    let executed_coverage = swept(|s| [s.executed_tip.x, s.executed_tip.y])?;
    let reached = steps.iter().filter(|s| s.reached()).count();
    let in_contact = steps.iter().filter(|s| touches(job, &plate, s)).count();
    let clear = near().all(|a| a.executed.too_near.is_empty());
    let covered = executed_coverage.lower >= job.scenario.job.required_coverage;
    let (tracking_rms_m, tracking_max_m) = tracking_errors(steps.iter().copied());
    Ok(PlateReport {
        plate: index,
        centre_m,
        washed: reached == steps.len() && in_contact == steps.len() && clear && covered,
        waypoints: steps.len(),
        reached,
        worst_ik_position_error_m: worst(|s| s.ik_position_error_m),
        worst_ik_orientation_error_rad: worst(|s| s.ik_orientation_error_rad),
        worst_unreached: worst_unreached(&steps),
        planned_clearance: nearest(near().filter_map(|a| a.planned.nearest.as_ref())),
        executed_clearance: nearest(near().filter_map(|a| a.executed.nearest.as_ref())),
        in_contact,
        ideal_coverage: swept(|s| [s.target.x, s.target.y])?,
        executed_coverage,
        tracking_rms_m,
        tracking_max_m,
    })
}

/// Whether the executed sponge is on the plate at a step.
fn touches(job: &Job, plate: &Plate, step: &Step) -> bool {
    let tool = &job.scenario.tool;
    let height = step.executed_tip.z - plate.z_m;
    tool.length_m > 0.0 && (-tool.sponge_height_m..=CONTACT_HEIGHT_M).contains(&height)
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
