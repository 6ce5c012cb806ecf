//! What happened on each plate.

use super::nearness::{ClosestApproach, StepApproach, nearest};
use super::unreached::{Unreached, worst_unreached};
use crate::run::PaperRun;
use crate::tracking::{Step, tracking_errors};
use platewash_workcell::coverage::{Coverage, CoverageError, CoverageSettings, coverage};
use platewash_workcell::plate::Plate;
use platewash_workcell::trajectory::SegmentKind;
use serde::Serialize;

/// Fine enough that the proven error of a plate's coverage is about a tenth of a percent.
const RASTER: CoverageSettings = CoverageSettings { cell_m: 2e-4 };

/// The tip counts as touching the plate up to this height above it \[m\].
const CONTACT_HEIGHT_M: f64 = 1e-3;

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
    /// Distance of the executed tip from the waypoints, at most \[m\].
    pub tracking_max_m: f64,
}

/// Every plate, in the order of washing.
pub(super) fn plates(run: &PaperRun, approaches: &[StepApproach]) -> Result<Vec<PlateReport>, CoverageError> {
    let washes = run
        .tool_path
        .segments
        .iter()
        .enumerate()
        .filter(|(_, s)| s.kind == SegmentKind::Wash);
    washes
        .map(|(segment, part)| plate(run, approaches, segment, part.plate))
        .collect()
}

fn plate(
    run: &PaperRun,
    approaches: &[StepApproach],
    segment: usize,
    index: usize,
) -> Result<PlateReport, CoverageError> {
    let here = |step: &&Step| step.segment == segment;
    let steps: Vec<_> = run.steps.iter().filter(here).collect();
    let near = || {
        run.steps
            .iter()
            .zip(approaches)
            .filter(|(s, _)| s.segment == segment)
            .map(|(_, a)| a)
    };
    let plate = run.job.layout.plates[index];
    let centre_m = plate.centre_xy();
    let swept = |of: fn(&Step) -> [f64; 2]| {
        let path: Vec<_> = steps.iter().map(|s| of(s)).collect();
        let sponge = run.job.workcell.tool.sponge.radius_m;
        coverage(&path, centre_m, plate.rim_m(), sponge, &RASTER)
    };
    let worst = |of: fn(&Step) -> f64| steps.iter().map(|s| of(s)).fold(0.0, f64::max);
    let executed_coverage = swept(|s| [s.executed_tip.x, s.executed_tip.y])?;
    let reached = steps.iter().filter(|s| s.reached()).count();
    let in_contact = steps.iter().filter(|s| touches(run, &plate, s)).count();
    let clear = near().all(|a| a.executed.too_near.is_empty());
    let covered = executed_coverage.lower >= run.job.requirements.coverage;
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
fn touches(run: &PaperRun, plate: &Plate, step: &Step) -> bool {
    let tool = &run.job.workcell.tool;
    let height = step.executed_tip.z - plate.centre().z;
    tool.is_present() && (-tool.sponge.height_m..=CONTACT_HEIGHT_M).contains(&height)
}
