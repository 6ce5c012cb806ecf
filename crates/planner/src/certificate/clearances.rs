//! Clearance of every pair over the whole motion.
//!
//! Every pair keeps the scenario's clearance, always, but for the sponge and the plates. While it approaches, washes or leaves a
//! plate, the sponge may touch that plate, and over its rim a neighbour within reach: how far it reaches is a promise of its own. Of all
//! other plates it keeps clear, and at all other times of all.

use super::clear::{FINE_M, Found, Goal, Search};
use super::neighbours;
use super::promise::{Measure, Promise, PromiseName, Sense, Status, Unit, Worst};
use super::schedule::{Schedule, Stage, is_at_plate};
use super::timeline::Timeline;
use crate::plan::Plan;
use crate::tool_path::SegmentKind;
use platewash_kinematics::RobotModel;
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::clearance::motion::{PairKind, PartPair};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Intervals looked at over all pairs, at most, and what each pair may look at whatever their number.
const BUDGET: usize = 4_000_000;
const LEAST_BUDGET: usize = 2_000;
const MOST_BUDGET: usize = 400_000;

/// What a pair must keep, during some part of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PairRule {
    /// The scenario's clearance.
    Clearance,
    /// Nothing: the sponge and a plate, while it works on that plate or on one from which it is within reach.
    Exempt,
}

/// A pair of bodies under one rule.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairBound {
    /// Names of the bodies.
    pub pair: [String; 2],
    /// What they must keep.
    pub rule: PairRule,
    /// The plates on which the sponge works meanwhile, of a pair that is exempt.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub working_on: Vec<usize>,
    /// What came of it.
    pub status: Status,
    /// The distance is never below this \[m\], errors included.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least_m: Option<f64>,
    /// The least distance found at a single moment \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen_m: Option<f64>,
    /// That moment \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Half-way between the nearest points then, base frame \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place_m: Option<[f64; 3]>,
}

/// A pair, a rule and the pieces during which it holds; `None` where the segments do not say.
struct Task {
    pair: usize,
    rule: PairRule,
    during: Option<Vec<Range<usize>>>,
    working_on: Vec<usize>,
}

/// Judges every pair: one line for each rule that a pair is under.
pub(super) fn judge(
    plan: &Plan,
    robot: &RobotModel,
    model: &ClearanceModel,
    timeline: &Timeline<'_>,
    schedule: Option<&Schedule>,
) -> Vec<PairBound> {
    let limit_m = plan.scenario.wash.clearance_m;
    let tasks = tasks(plan, model, schedule);
    let budget = (BUDGET / tasks.len().max(1)).clamp(LEAST_BUDGET, MOST_BUDGET);
    let search = |task: &Task, parts: &[PartPair<'_>], enough_m: Option<f64>| {
        let during = task.during.as_deref().unwrap_or_default();
        Search::run(
            robot,
            timeline,
            parts,
            during,
            Goal {
                limit_m,
                enough_m,
                budget,
            },
        )
    };
    let judged = |task: &Task| task.rule != PairRule::Exempt && task.during.is_some();
    let mut found: Vec<Option<Found>> = tasks
        .par_iter()
        .map(|task| judged(task).then(|| search(task, &model.parts_of(task.pair), None)))
        .collect();
    // The pairs that might be the nearest one, once more and finely.
    let least = found.iter().flatten().map(|f| f.seen_m).fold(f64::INFINITY, f64::min);
    let enough_m = least - FINE_M;
    found.par_iter_mut().zip(&tasks).for_each(|(found, task)| {
        if found.is_some_and(|f| f.at_least_m < enough_m) && least > 0.0 {
            *found = Some(search(task, &model.parts_of(task.pair), Some(enough_m)));
        }
    });
    let names = model.pair_names();
    let lines = tasks.iter().zip(found);
    lines
        .map(|(task, found)| line(names[task.pair], task, found, limit_m))
        .collect()
}

fn line((a, b): (&str, &str), task: &Task, found: Option<Found>, limit_m: f64) -> PairBound {
    let measured = found.filter(|f| f.seen_m.is_finite());
    let status = match (task.rule, found) {
        (PairRule::Exempt, _) => Status::Pass,
        (_, None) => Status::NotProved,
        (PairRule::Clearance, Some(found)) => {
            Promise::measured(PromiseName::Clearance, measure(limit_m, &found), Worst::default()).status
        }
    };
    PairBound {
        pair: [a.to_owned(), b.to_owned()],
        rule: task.rule,
        working_on: task.working_on.clone(),
        status,
        at_least_m: found.map(|f| f.at_least_m).filter(|b| b.is_finite()),
        seen_m: measured.map(|f| f.seen_m),
        time_s: measured.map(|f| f.time_s),
        place_m: measured.map(|f| f.place_m),
    }
}

fn measure(limit_m: f64, found: &Found) -> Measure {
    Measure {
        bound: Some(found.at_least_m).filter(|b| *b > f64::NEG_INFINITY),
        seen: Some(found.seen_m).filter(|s| *s < f64::INFINITY),
        limit: limit_m,
        sense: if limit_m > 0.0 { Sense::AtLeast } else { Sense::Above },
        unit: Unit::Metre,
    }
}

/// The promise about all lines that ask for clearance: the least bound, and where the least distance was found.
pub(super) fn promise(limit_m: f64, lines: &[PairBound]) -> Promise {
    let lines: Vec<_> = lines.iter().filter(|l| l.rule == PairRule::Clearance).collect();
    let status = |status| lines.iter().any(|l| l.status == status);
    let least = |of: fn(&PairBound) -> Option<f64>| lines.iter().filter_map(|l| of(l)).min_by(f64::total_cmp);
    let worst = lines.iter().filter(|l| l.seen_m.is_some()).min_by(|a, b| {
        let key = |l: &PairBound| l.seen_m.unwrap_or(f64::INFINITY);
        key(a).total_cmp(&key(b))
    });
    let bounded = lines.iter().all(|l| l.at_least_m.is_some());
    Promise {
        name: PromiseName::Clearance,
        status: match (status(Status::Fail), status(Status::NotProved)) {
            (true, _) => Status::Fail,
            (_, true) => Status::NotProved,
            // Without collision geometry there is nothing to be clear of, and nothing is proved.
            _ if lines.is_empty() => Status::NotProved,
            _ => Status::Pass,
        },
        measure: (!lines.is_empty()).then(|| Measure {
            bound: least(|l| l.at_least_m).filter(|_| bounded),
            seen: least(|l| l.seen_m),
            limit: limit_m,
            sense: if limit_m > 0.0 { Sense::AtLeast } else { Sense::Above },
            unit: Unit::Metre,
        }),
        worst: worst.map_or_else(Worst::default, |l| Worst {
            time_s: l.time_s,
            place_m: l.place_m,
            pair: Some(l.pair.clone()),
            ..Worst::default()
        }),
        discrepancies: Vec::new(),
        more_discrepancies: 0,
    }
}

fn tasks(plan: &Plan, model: &ClearanceModel, schedule: Option<&Schedule>) -> Vec<Task> {
    let mut tasks = Vec::new();
    let whole = 0..plan.knots.t_s.len().saturating_sub(1);
    for pair in 0..model.pair_count() {
        let PairKind::SpongeAndPlate(plate) = model.pair_kind(pair) else {
            let during = Some(vec![whole.clone()]);
            tasks.push(Task {
                pair,
                rule: PairRule::Clearance,
                during,
                working_on: Vec::new(),
            });
            continue;
        };
        for rule in [PairRule::Clearance, PairRule::Exempt] {
            let rule_at = |stage: &Stage| rule_at(plan, stage, plate);
            let during = schedule.map(|schedule| phases(schedule, |stage| rule_at(stage) == rule));
            if during.as_ref().is_some_and(Vec::is_empty) {
                continue;
            }
            let stages = schedule.map_or(&[][..], |schedule| &schedule.stages);
            let washes = stages.iter().filter(|stage| stage.kind == SegmentKind::Wash);
            let exempt = washes.filter(|stage| rule == PairRule::Exempt && rule_at(stage) == rule);
            let working_on = exempt.map(|stage| stage.plate).collect();
            tasks.push(Task {
                pair,
                rule,
                during,
                working_on,
            });
        }
    }
    tasks
}

/// What the sponge must keep from a plate during a stage.
fn rule_at(plan: &Plan, stage: &Stage, plate: usize) -> PairRule {
    let may_touch = stage.plate == plate || neighbours::is_within_reach(plan, stage.plate, plate);
    if is_at_plate(stage.kind) && may_touch {
        PairRule::Exempt
    } else {
        PairRule::Clearance
    }
}

/// The pieces of some stages; neighbours joined.
fn phases(schedule: &Schedule, counts: impl Fn(&Stage) -> bool) -> Vec<Range<usize>> {
    let mut phases: Vec<Range<usize>> = Vec::new();
    for stage in schedule.stages.iter().filter(|stage| counts(stage)) {
        match phases.last_mut() {
            Some(last) if last.end == stage.pieces.start => last.end = stage.pieces.end,
            _ => phases.push(stage.pieces.clone()),
        }
    }
    phases
}
