//! Results on the waypoints of each plate, and on those between plates.

use super::motion::{ClosestApproach, Nearness, nearest};
use crate::run::PaperRun;
use crate::tracking::{IkOutcome, Step, tracking_errors};
use nalgebra::Vector3;
use platewash_bodies::coverage::{Coverage, CoverageError, coverage};
use platewash_kinematics::ik::IkCause;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::plate::Plate;
use serde::Serialize;

/// Cell size \[m\], fine enough that the proven error of a plate's coverage is about a tenth of a percent.
const CELL_M: f64 = 2e-4;

/// The tip counts as touching the plate up to this height above it \[m\].
const CONTACT_HEIGHT_M: f64 = 1e-3;

/// Results on one plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlateReport {
    /// Index of the plate.
    pub plate: usize,
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// True where it counts as washed: every waypoint solved, the sponge on the plate at each, nothing else too near, and enough
    /// surely covered (the lower bound).
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
    pub worst_unreached: Option<UnreachedWaypoint>,
    /// Nearest approach of the commanded motion.
    pub planned_clearance: Option<ClosestApproach>,
    /// Nearest approach of the executed motion.
    pub executed_clearance: Option<ClosestApproach>,
    /// Waypoints at which the executed sponge is on the plate: there is a tool body, and its tip is no higher than 1 mm above the
    /// surface and no deeper than the sponge.
    pub in_contact: usize,
    /// Covered share of the plate if the tip had followed the waypoints, seen from above, with the sponge touching along the
    /// whole path of the tip.
    pub ideal_coverage: Coverage,
    /// Covered share of the plate as executed, seen from above.
    pub executed_coverage: Coverage,
    /// Distance of the executed tip from the waypoints, root mean square \[m\].
    pub tracking_rms_m: f64,
    /// Distance of the executed tip from the waypoints, at most \[m\].
    pub tracking_max_m: f64,
}

/// Results on some waypoints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WaypointReport {
    /// Waypoints asked.
    pub waypoints: usize,
    /// Waypoints solved.
    pub reached: usize,
    /// The unreached waypoint that is farthest away.
    pub worst_unreached: Option<UnreachedWaypoint>,
    /// Distance of the executed tip from the path, root mean square \[m\].
    pub tracking_rms_m: f64,
    /// Distance of the executed tip from the path, at most \[m\].
    pub tracking_max_m: f64,
    /// Nearest approach of the commanded motion.
    pub planned_clearance: Option<ClosestApproach>,
    /// Nearest approach of the executed motion.
    pub executed_clearance: Option<ClosestApproach>,
}

/// A waypoint that was not reached.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct UnreachedWaypoint {
    /// Index of the waypoint on the plate, from 0; of one between plates, over all transits.
    pub waypoint: usize,
    /// Position of the waypoint \[m\].
    pub target_m: [f64; 3],
    /// Cause reported by the inverse kinematics.
    pub cause: IkCause,
    /// Distance of the tip of the best configuration from the waypoint \[m\].
    pub position_error_m: f64,
    /// Angle by which it is turned from the target \[rad\].
    pub orientation_error_rad: f64,
}

/// Every plate, in the order of washing.
pub(super) fn plates(run: &PaperRun, near: &[[Nearness; 2]]) -> Result<Vec<PlateReport>, CoverageError> {
    let segments = run.tool_path.segments.iter().enumerate();
    let washes = segments.filter(|(_, segment)| segment.kind == SegmentKind::Wash);
    let on = |index| steps(run, near, move |step| step.segment == index);
    washes
        .map(|(index, segment)| plate(run, &on(index), segment.plate))
        .collect()
}

/// The waypoints of all transits.
pub(super) fn transits(run: &PaperRun, near: &[[Nearness; 2]]) -> WaypointReport {
    let segments = &run.tool_path.segments;
    let between = |step: &Step| segments[step.segment].kind == SegmentKind::Transit;
    WaypointReport::new(&steps(run, near, between))
}

/// A step, and how near the arm comes there, commanded and executed.
type StepNearness<'a> = (&'a Step, &'a [Nearness; 2]);

fn steps<'a>(run: &'a PaperRun, near: &'a [[Nearness; 2]], are: impl Fn(&Step) -> bool) -> Vec<StepNearness<'a>> {
    run.steps.iter().zip(near).filter(|(step, _)| are(step)).collect()
}

impl WaypointReport {
    fn new(steps: &[StepNearness<'_>]) -> Self {
        let (tracking_rms_m, tracking_max_m) = tracking_errors(steps.iter().map(|(step, _)| *step));
        let closest = |k: usize| nearest(steps.iter().filter_map(|(_, near)| near[k].nearest.as_ref()));
        Self {
            waypoints: steps.len(),
            reached: steps.iter().filter(|(step, _)| step.is_reached()).count(),
            worst_unreached: worst_unreached(steps),
            tracking_rms_m,
            tracking_max_m,
            planned_clearance: closest(0),
            executed_clearance: closest(1),
        }
    }
}

fn worst_unreached(steps: &[StepNearness<'_>]) -> Option<UnreachedWaypoint> {
    let failed = steps
        .iter()
        .enumerate()
        .filter_map(|(waypoint, (step, _))| match step.outcome {
            IkOutcome::Solved { .. } => None,
            IkOutcome::Failed { cause } => Some(UnreachedWaypoint {
                waypoint,
                target_m: step.target.into(),
                cause,
                position_error_m: step.ik_position_error_m,
                orientation_error_rad: step.ik_orientation_error_rad,
            }),
        });
    failed.max_by(|a, b| a.position_error_m.total_cmp(&b.position_error_m))
}

fn plate(run: &PaperRun, steps: &[StepNearness<'_>], index: usize) -> Result<PlateReport, CoverageError> {
    let (plate, tool) = (run.job.layout.plates[index], &run.job.workcell.tool);
    let centre_m = plate.centre_xy();
    // In the plane of the plate: seen from above, an upright plate is a line.
    let swept = |of: fn(&Step) -> &Vector3<f64>| {
        let path: Vec<_> = steps
            .iter()
            .map(|(step, _)| plate.local(of(step)).xy().into())
            .collect();
        coverage(&path, [0.0; 2], plate.rim_m(), tool.sponge.radius_m, CELL_M)
    };
    let worst = |of: fn(&Step) -> f64| steps.iter().map(|(step, _)| of(step)).fold(0.0, f64::max);
    let executed_coverage = swept(|s| &s.executed_tip)?;
    let all = WaypointReport::new(steps);
    let in_contact = steps.iter().filter(|(step, _)| touches(run, &plate, step)).count();
    let clear = steps.iter().all(|(_, near)| near[1].too_near.is_empty());
    let covered = executed_coverage.lower >= run.job.requirements.coverage;
    Ok(PlateReport {
        plate: index,
        centre_m,
        washed: all.reached == all.waypoints && in_contact == all.waypoints && clear && covered,
        waypoints: all.waypoints,
        reached: all.reached,
        worst_ik_position_error_m: worst(|s| s.ik_position_error_m),
        worst_ik_orientation_error_rad: worst(|s| s.ik_orientation_error_rad),
        worst_unreached: all.worst_unreached,
        planned_clearance: all.planned_clearance,
        executed_clearance: all.executed_clearance,
        in_contact,
        ideal_coverage: swept(|s| &s.target)?,
        executed_coverage,
        tracking_rms_m: all.tracking_rms_m,
        tracking_max_m: all.tracking_max_m,
    })
}

/// Checks that the executed sponge is on the plate at a step.
fn touches(run: &PaperRun, plate: &Plate, step: &Step) -> bool {
    let tool = &run.job.workcell.tool;
    let height_m = plate.height_of(&step.executed_tip);
    tool.is_present() && (-tool.sponge.height_m..=CONTACT_HEIGHT_M).contains(&height_m)
}
