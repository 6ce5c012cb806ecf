//! How far the sponge reaches beyond the rims, and which plates are proved to be washed.

use super::neighbours;
use super::piece::Piece;
use super::promise::{Measure, Promise, PromiseName, Sense, Status, Unit, Worst};
use super::schedule::{Schedule, Stage, is_at_plate};
use super::statements::PLACE_M;
use super::sweep::{PlateCoverage, Polyline, Wash};
use super::tip::Arm;
use super::tips::Tips;
use crate::plan::{PATH_TOLERANCE_M, Plan, PlanLimits};
use crate::tool_path::SegmentKind;
use platewash_workcell::layout::Plate;

/// How often a piece of an approach or a retreat is halved at most: pieces are long there.
const LINE_HALVINGS: u32 = 12;

/// What is proved of the tip, as far as the reach of the sponge depends on it.
pub(super) struct Proved<'a> {
    pub arm: &'a Arm<'a>,
    pub pieces: &'a [Piece],
    pub schedule: &'a Schedule,
    pub tips: &'a Tips,
    /// How far the tip is from its stroke at most, where that is proved and the strokes are those asked for \[m\].
    pub stroke_deviation_m: Option<f64>,
}

impl Proved<'_> {
    /// The stages at a plate, with their indices.
    fn stages_at(&self, plate: usize) -> impl Iterator<Item = (usize, &Stage)> {
        let stages = self.schedule.stages.iter().enumerate();
        stages.filter(move |(_, stage)| stage.plate == plate && is_at_plate(stage.kind))
    }
}

/// Fills in how far the sponge may reach beyond the rim of each plate, and what it may touch there.
pub(super) fn settle(plan: &Plan, washes: &mut [Wash], proved: &Proved<'_>) {
    let most_tilted = crate::trig::cos(plan.scenario.tilt_max_rad());
    let allowed_m = plan.scenario.wash.path_radius_m + PATH_TOLERANCE_M;
    for wash in washes {
        let Some(plate) = plan.plates.get(wash.swept.plate) else {
            continue;
        };
        let stages = proved.stages_at(wash.swept.plate);
        let cos_tilt = stages.fold(1.0, |least: f64, (i, _)| least.min(proved.tips.least_cosine_of(i)));
        let [tip_m, seen_m] = tip_m(plan, plate, wash, proved);
        let reach_m = neighbours::beyond_rim_m(plan, plate, tip_m, cos_tilt);
        let swept = &mut wash.swept;
        let index = swept.plate;
        let touched = |reach_m| neighbours::touched(plan, index, reach_m);
        swept.beyond_rim_allowed_m = neighbours::beyond_rim_m(plan, plate, allowed_m, cos_tilt.max(most_tilted));
        swept.beyond_rim_seen_m = neighbours::beyond_rim_m(plan, plate, seen_m, cos_tilt.max(most_tilted));
        swept.beyond_rim_m = Some(reach_m).filter(|reach_m| reach_m.is_finite());
        swept.touches = swept.beyond_rim_m.map_or_else(Vec::new, touched);
    }
}

/// What the tip is not farther from the centre of a plate, seen from above, in its wash and in all approaches to the plate and
/// retreats from it, and how far it was seen to be \[m\]; infinite where that is not bounded.
fn tip_m(plan: &Plan, plate: &Plate, wash: &Wash, proved: &Proved<'_>) -> [f64; 2] {
    let radius_m = plan.scenario.wash.path_radius_m;
    let along_stroke_m = (proved.stroke_deviation_m).map_or(f64::INFINITY, |off_m| radius_m + PLACE_M + off_m);
    let tips = proved.stages_at(wash.swept.plate).map(|(i, stage)| match stage.kind {
        // The wash of another entry.
        SegmentKind::Wash if i != wash.stage => [0.0; 2],
        SegmentKind::Wash => [wash.tip_m.min(along_stroke_m), wash.seen_m],
        _ => {
            let pieces = &proved.pieces[stage.pieces.clone()];
            let line = Polyline::new(proved.arm, pieces, plate, radius_m + PATH_TOLERANCE_M, LINE_HALVINGS);
            [line.within_m, line.seen_m]
        }
    });
    // NaN must not get lost.
    let greater = |most: f64, tip: f64| if tip.is_nan() { f64::INFINITY } else { most.max(tip) };
    tips.fold([0.0; 2], |[most, seen], [tip, there]| {
        [greater(most, tip), seen.max(there)]
    })
}

/// Promises that the sponge reaches no farther beyond any rim than the stroke and its own radius make it.
pub(super) fn promise(coverage: &[PlateCoverage]) -> Promise {
    let excess = |c: &PlateCoverage| c.beyond_rim_m.unwrap_or(f64::INFINITY) - c.beyond_rim_allowed_m;
    let Some(worst) = coverage.iter().max_by(|a, b| excess(a).total_cmp(&excess(b))) else {
        return Promise::not_judged(PromiseName::Reach);
    };
    let measure = Measure {
        bound: worst.beyond_rim_m,
        seen: Some(worst.beyond_rim_seen_m),
        limit: worst.beyond_rim_allowed_m,
        sense: Sense::AtMost,
        unit: Unit::Metre,
    };
    let place = Worst {
        plate: Some(worst.plate),
        ..Worst::default()
    };
    Promise::measured(PromiseName::Reach, measure, place)
}

/// Plates that are proved to be washed: swept to the share required, with the sponge on them.
pub(super) fn washed(coverage: &[PlateCoverage], limits: &PlanLimits, promises: &[Promise]) -> usize {
    let is_on = |p: &Promise| p.name == PromiseName::ContactHeight && p.status == Status::Pass;
    if !promises.iter().any(is_on) {
        return 0;
    }
    let enough = |c: &&PlateCoverage| super::coverage_measure(c, limits).keeps(c.at_least);
    let mut washed: Vec<_> = coverage.iter().filter(enough).map(|c| c.plate).collect();
    washed.sort_unstable();
    washed.dedup();
    washed.len()
}
