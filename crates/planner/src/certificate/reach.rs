//! How far the sponge reaches beyond the rims, and which plates are proved to be washed.

use super::neighbours;
use super::promise::{Measure, Promise, PromiseName, Sense, Status, Unit, Worst};
use super::statements::PLACE_M;
use super::sweep::PlateCoverage;
use crate::plan::{PATH_TOLERANCE_M, Plan, PlanLimits};

/// Fills in how far the sponge may reach beyond the rim of each plate, and what it may touch there. `deviation_m` is how far the tip is
/// from its stroke at most, where that is proved: with it the stroke's own radius bounds the reach as well.
pub(super) fn settle(plan: &Plan, coverage: &mut [PlateCoverage], deviation_m: Option<f64>) {
    for swept in coverage {
        let Some(plate) = plan.plates.get(swept.plate) else {
            continue;
        };
        let allowed_m = neighbours::allowed_beyond_rim_m(plan, plate);
        let along_stroke_m = deviation_m.map(|off| allowed_m - PATH_TOLERANCE_M + PLACE_M + off);
        swept.beyond_rim_allowed_m = allowed_m;
        swept.beyond_rim_m = [swept.beyond_rim_m, along_stroke_m]
            .into_iter()
            .flatten()
            .reduce(f64::min);
        swept.touches = neighbours::touched(plan, swept.plate, swept.beyond_rim_m.unwrap_or(f64::INFINITY));
    }
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
