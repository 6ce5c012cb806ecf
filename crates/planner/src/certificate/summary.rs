//! The plan's own summary: what follows from the plan, and no more than is proved.

use super::promise::{Discrepancy, Promise, PromiseName};
use super::statements::fields;
use crate::plan::{PATH_TOLERANCE_M, Plan, PlanSegment, Summary};
use crate::scenario::Program;
use crate::tool_path::SegmentKind;
use platewash_kinematics::RobotModel;
use platewash_workcell::coverage::{CoverageSettings, coverage};
use platewash_workcell::stroke::Stroke;
use platewash_workcell::words::counted;

/// How far the polyline may leave the stroke \[m\].
const CHORD_M: f64 = 1e-4;

/// Edges of the smallest cells, the second where the first do not suffice \[m\].
const CELLS_M: [f64; 2] = [1e-3, 2.5e-4];

/// The summary that follows from a plan of a certified job: how many plates in what time, and how many of them the stroke sweeps to
/// the share required. The sponge counts as tilted as much as it may be or, where that is not enough, as much as it is at the
/// knots, and the tip as far from its stroke as it may be.
#[must_use]
pub fn summary(plan: &Plan, robot: &RobotModel) -> Summary {
    let duration_s = duration_s(plan);
    let plates = counted(plan.order.len(), "plate");
    Summary {
        headline: format!("{plates} in {duration_s:.2} s, from home to home"),
        plates_washed: swept(plan, robot),
        duration_s,
        waypoints_reached: [0, 0],
    }
}

/// Promises that the summary says what follows, and counts no plate as washed that is not among the `proved` ones. The paper's program
/// has words and waypoints of its own.
pub(super) fn promise(plan: &Plan, robot: &RobotModel, proved: usize) -> Promise {
    let expected = match plan.scenario.job.program {
        Program::Certified => summary(plan, robot),
        Program::Paper => Summary {
            duration_s: duration_s(plan),
            ..plan.summary.clone()
        },
    };
    let mut wrong = fields("summary", &plan.summary, &expected);
    let stated = plan.summary.plates_washed;
    if stated > proved {
        let most = format!("at most {proved}: no more are proved to be washed");
        wrong.push(Discrepancy::new("summary.plates_washed", stated, most));
    }
    Promise::stated(PromiseName::Summary, wrong)
}

fn duration_s(plan: &Plan) -> f64 {
    plan.knots.t_s.last().copied().unwrap_or(0.0)
}

/// Plates that the stroke sweeps to the share required.
fn swept(plan: &Plan, robot: &RobotModel) -> usize {
    let mut washes: Vec<_> = (plan.segments.iter())
        .filter(|s| s.kind == SegmentKind::Wash && s.plate < plan.plates.len())
        .collect();
    washes.sort_by_key(|s| s.plate);
    washes.dedup_by_key(|s| s.plate);
    if covers(plan, plan.scenario.tilt_max_rad()) {
        return washes.len();
    }
    let mut tilts: Vec<_> = washes.iter().map(|wash| tilt_at_knots(plan, robot, wash)).collect();
    tilts.sort_by(f64::total_cmp);
    // The less the sponge is tilted the more it sweeps.
    tilts.partition_point(|tilt| covers(plan, *tilt))
}

/// The stroke about the centre of a plate, from above.
fn path(plan: &Plan) -> Vec<[f64; 2]> {
    let stroke = plan.scenario.stroke();
    let points = stroke.parameters(CHORD_M).into_iter().map(|theta| stroke.at(theta));
    points.map(|point| point.position.into()).collect()
}

/// Whether a sponge that is never tilted by more than `tilt_rad` sweeps enough of a plate.
fn covers(plan: &Plan, tilt_rad: f64) -> bool {
    let (plate_m, required) = (plan.scenario.layout.plate_radius_m, plan.scenario.job.required_coverage);
    let sponge_m = plan.scenario.tool.sponge_radius_m * crate::trig::cos(tilt_rad) - PATH_TOLERANCE_M;
    if covers_whole(&plan.scenario.stroke(), sponge_m, plate_m) {
        return true;
    }
    let sponge_m = sponge_m - CHORD_M;
    let path = path(plan);
    let share = |cell_m: f64| {
        let settings = CoverageSettings {
            cell_m: cell_m.max(1e-4 * plate_m),
        };
        coverage(&path, [0.0, 0.0], plate_m, sponge_m, &settings).map_or(0.0, |share| share.lower)
    };
    sponge_m > 0.0 && CELLS_M.into_iter().any(|cell_m| share(cell_m) >= required)
}

/// Whether a disc of radius `sponge_m` along a stroke sweeps all of a plate: along each ray from the centre the windings are no more
/// than a pitch apart, from the centre to the ring, and beyond the ring it reaches to the rim.
fn covers_whole(stroke: &Stroke, sponge_m: f64, plate_m: f64) -> bool {
    stroke.closing_ring && 0.5 * stroke.pitch_m() <= sponge_m && stroke.radius_m + sponge_m >= plate_m
}

/// Largest angle of the tool from the plate's normal at the knots of a wash \[rad\].
fn tilt_at_knots(plan: &Plan, robot: &RobotModel, wash: &PlanSegment) -> f64 {
    let tip = platewash_workcell::tool::tip_frame(robot, &plan.scenario.tool);
    let during = |t: &f64| (wash.t_start_s..=wash.t_end_s).contains(t);
    let knots = plan.knots.t_s.iter().zip(&plan.knots.q_rad).filter(|(t, _)| during(t));
    let tilts = knots.map(|(_, q)| {
        let axis = robot.fk(q).rigid(&tip).rotation.column(2).into_owned();
        crate::trig::acos((-axis.z).clamp(-1.0, 1.0))
    });
    tilts.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whatever the closed form calls whole, the raster finds whole.
        #[test]
        fn a_stroke_that_covers_all_leaves_nothing_to_the_raster(
            turns in 0.5..6.0f64, radius_m in 0.03..0.2f64, spare in 1.0..1.2f64, rim in 0.3..1.0f64,
        ) {
            let stroke = Stroke { radius_m, turns, start_angle_rad: 0.0, closing_ring: true };
            let sponge_m = 0.5 * stroke.pitch_m() * spare;
            let plate_m = radius_m + rim * sponge_m;
            prop_assert!(covers_whole(&stroke, sponge_m, plate_m));
            let points: Vec<[f64; 2]> =
                stroke.parameters(1e-6).into_iter().map(|theta| stroke.at(theta).position.into()).collect();
            let share = coverage(&points, [0.0; 2], plate_m, sponge_m + 2e-6, &CoverageSettings { cell_m: 1e-3 }).unwrap();
            prop_assert!(share.upper > 1.0 - 1e-9, "{share:?}");
        }
    }
}
