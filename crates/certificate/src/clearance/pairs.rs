//! Clearance of every pair over the whole motion.
//!
//! Requirement 24, formulas (24.1) to (24.3) in `docs/certificate.md`.
//!
//! Every pair keeps the job's clearance at all times, except the sponge and the plates. While it approaches, washes or leaves a plate, the
//! sponge may touch that plate, and over its rim a neighbour within reach; the reach has a requirement of its own. It keeps clear of all
//! other plates, and of all plates at all other times. Pairs that only the job excludes are judged, too, and waived where they do not keep
//! clear.

use crate::clearance::far::far;
use crate::clearance::poses::ArmPoses;
use crate::clearance::search::{FINE_M, Goal, PairDistance, Search};
use crate::judged_job::JudgedJob;
use crate::motion::timeline::Timeline;
use crate::plan_statements::schedule::{Schedule, Span};
use crate::report::check::{Check, Measure, Sense, Status, WorstCase};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::reach;
use platewash_bodies::clearance::part_pair::{PairKind, PartPairs};
use platewash_bodies::clearance::{ClearanceModel, StillPair};
use platewash_kinematics::RobotModel;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::cancel::{CancelToken, Cancelled};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Intervals examined over all pairs at most, and below the least and the greatest number for each pair.
const BUDGET: usize = 4_000_000;
const LEAST_BUDGET: usize = 2_000;
const MOST_BUDGET: usize = 400_000;

/// Distance from which on a pair counts as far, as a multiple of the least distance among the others, and at least \[m\].
const FAR: f64 = 2.0;
const FAR_M: f64 = 0.02;

/// Rule that a pair is under during a part of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PairRule {
    /// The pair keeps the required clearance.
    Clearance,
    /// The pair should keep the required clearance, but the job waives it: the job excludes the pair, and neither the arm nor its SRDF
    /// does.
    Waived,
    /// The pair keeps a part of the required clearance, as the job states for it: [`PairBound::required_m`].
    Reduced,
    /// The pair may touch: the sponge and a plate, while it works on that plate or on one from which it is within reach.
    Touching,
}

/// Pair of bodies under one rule, with its bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairBound {
    /// Names of the bodies.
    pub pair: [String; 2],
    /// Rule of the pair.
    pub rule: PairRule,
    /// Plates on which the sponge works meanwhile, for a pair that may touch.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub working_on: Vec<usize>,
    /// Clearance required of a pair that keeps less than the others \[m\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub required_m: Option<f64>,
    /// Result of the check.
    pub status: Status,
    /// Lower bound on the distance, errors included \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least_m: Option<f64>,
    /// Least distance found at a single moment \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen_m: Option<f64>,
    /// Time of that moment \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Midpoint between the nearest points at that moment, world frame \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place_m: Option<[f64; 3]>,
}

/// Pair with a rule and the pieces during which it holds; `None` where the segments do not state them.
struct Task {
    pair: usize,
    rule: PairRule,
    during: Option<Vec<Range<usize>>>,
    working_on: Vec<usize>,
}

/// Judges every pair, with one line for each rule that a pair is under. The `waived` pairs, by index, are only reported. Pairs whose
/// distance no joint changes have a line where they break their rule, or are nearer than all others.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn judge(
    judged: &JudgedJob<'_>,
    model: &ClearanceModel,
    waived: &[usize],
    timeline: &Timeline<'_>,
    schedule: Option<&Schedule>,
    cancel: &CancelToken,
) -> Result<Vec<PairBound>, Cancelled> {
    let tasks = tasks(judged, model, waived, timeline, schedule);
    let limit_m = judged.job.requirements.clearance_m;
    let mut lines = judge_tasks(judged.robot, limit_m, model, &tasks, timeline, cancel)?;
    add_still(limit_m, model, &mut lines);
    Ok(lines)
}

/// Adds the lines of pairs whose distance no joint changes, if they break their rule or are nearer than all others.
pub(crate) fn add_still(limit_m: f64, model: &ClearanceModel, lines: &mut Vec<PairBound>) {
    let must = lines.iter().filter(|line| line.rule == PairRule::Clearance);
    let least = must.filter_map(|line| line.seen_m).fold(f64::INFINITY, f64::min);
    let keeps_more = |line: &PairBound| line.status.is_kept() && line.seen_m.is_some_and(|seen_m| seen_m > least);
    lines.extend(judge_still(limit_m, model).into_iter().filter(|line| !keeps_more(line)));
}

/// Judges every pair of a motion at which nothing may touch, but for those whose distance no joint changes: one line for each pair.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn judge_all(
    robot: &RobotModel,
    limit_m: f64,
    model: &ClearanceModel,
    timeline: &Timeline<'_>,
    cancel: &CancelToken,
) -> Result<Vec<PairBound>, Cancelled> {
    let all: Vec<_> = (0..model.pair_count()).collect();
    judge_some(robot, limit_m, model, &all, timeline, cancel)
}

/// Judges some pairs of a motion, by index, as [`judge_all`] does.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn judge_some(
    robot: &RobotModel,
    limit_m: f64,
    model: &ClearanceModel,
    some: &[usize],
    timeline: &Timeline<'_>,
    cancel: &CancelToken,
) -> Result<Vec<PairBound>, Cancelled> {
    let whole = 0..timeline.count();
    let task = |pair: &usize| Task {
        pair: *pair,
        rule: usual_rule(model, *pair),
        during: Some(vec![whole.clone()]),
        working_on: Vec::new(),
    };
    let tasks: Vec<_> = some.iter().map(task).collect();
    judge_tasks(robot, limit_m, model, &tasks, timeline, cancel)
}

/// Finds those of some pairs, by index, that are in contact at a moment of a motion, and apart in a configuration; each with its first such
/// moment that was found \[s\]. A pair that is not found may still meet.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn meeting(
    robot: &RobotModel,
    model: &ClearanceModel,
    some: &[usize],
    timeline: &Timeline<'_>,
    cancel: &CancelToken,
) -> Result<Vec<([String; 2], f64)>, Cancelled> {
    let (poses, whole) = (ArmPoses::new(robot, timeline), 0..timeline.count());
    let goal = Goal {
        limit_m: 0.0,
        enough_m: None,
        only_contact: true,
        budget: LEAST_BUDGET,
    };
    let meets = |pair: &usize| {
        let found = Search::run(
            &poses,
            cancel,
            &model.parts_of(*pair),
            std::slice::from_ref(&whole),
            goal,
        );
        Some((*pair, found)).filter(|(pair, found)| found.seen_m <= 0.0 && !model.touches_in_samples(*pair))
    };
    let found: Vec<_> = some.par_iter().map(meets).collect();
    cancel.check()?;
    let names = model.pair_names();
    let named = |(pair, found): (usize, PairDistance)| {
        let (a, b) = names[pair];
        ([a.to_owned(), b.to_owned()], found.time_s)
    };
    Ok(found.into_iter().flatten().map(named).collect())
}

/// Judges the pairs whose distance no joint changes.
pub(crate) fn judge_still(limit_m: f64, model: &ClearanceModel) -> Vec<PairBound> {
    let of_pair = |StillPair { pair, at_least_m, .. }: &StillPair| {
        let found = PairDistance {
            seen_m: pair.distance_m,
            place_m: pair.place_m,
            ..PairDistance::with_bound(*at_least_m)
        };
        let rule = rule_of(pair.reduced_by_m);
        line(
            (&pair.a, &pair.b),
            (rule, &[]),
            Some(found),
            limit_m - pair.reduced_by_m,
        )
    };
    let all = model.still_pairs();
    // What stands in front of the flange is nearer than others by intent.
    let counts = all
        .iter()
        .filter(|still| !still.only_contact || !still.is_clear(limit_m));
    counts.map(of_pair).collect()
}

fn judge_tasks(
    robot: &RobotModel,
    limit_m: f64,
    model: &ClearanceModel,
    tasks: &[Task],
    timeline: &Timeline<'_>,
    cancel: &CancelToken,
) -> Result<Vec<PairBound>, Cancelled> {
    let budget = (BUDGET / tasks.len().max(1)).clamp(LEAST_BUDGET, MOST_BUDGET);
    let poses = ArmPoses::new(robot, timeline);
    let limit_of = |task: &Task| limit_m - model.reduced_by_m_of(task.pair);
    let search = |task: &Task, parts: &PartPairs<'_>, enough_m: Option<f64>| {
        let during = task.during.as_deref().unwrap_or_default();
        let goal = Goal {
            limit_m: limit_of(task),
            enough_m,
            only_contact: false,
            budget,
        };
        Search::run(&poses, cancel, parts, during, goal)
    };
    let judged = |task: &Task| task.rule != PairRule::Touching && task.during.is_some();
    let searched = |task: &Task| judged(task).then(|| search(task, &model.parts_of(task.pair), None));
    let beside = |task: &Task| task.rule == PairRule::Clearance && model.is_beside_obstacle(task.pair);
    let mut found: Vec<Option<PairDistance>> = tasks
        .par_iter()
        .map(|task| if beside(task) { None } else { searched(task) })
        .collect();
    let beside_obstacles: Vec<_> = tasks.iter().filter(|task| beside(task)).map(|task| task.pair).collect();
    let needed_m = far_from_m(limit_m, least_seen(&found, tasks));
    let far = far(&poses, cancel, model, &beside_obstacles, needed_m);
    found
        .par_iter_mut()
        .zip(tasks)
        .filter(|(_, task)| beside(task))
        .for_each(|(found, task)| {
            *found = match far.get(&task.pair) {
                Some(at_least_m) => Some(PairDistance::with_bound(*at_least_m)),
                None => searched(task),
            };
        });
    // The pairs that might be the nearest one, and those of reduced clearance, once more and finely.
    let least = least_seen(&found, tasks);
    found.par_iter_mut().zip(tasks).for_each(|(found, task)| {
        let least = match (task.rule, &found) {
            (PairRule::Reduced, Some(found)) => found.seen_m,
            _ => least,
        };
        let enough_m = least - FINE_M;
        if found.is_some_and(|f| f.at_least_m < enough_m) && least > 0.0 {
            let parts = model.parts_of(task.pair);
            // For bodies of many parts the limit is enough: a fine bound takes long.
            if !parts.is_of_many() {
                *found = Some(search(task, &parts, Some(enough_m)));
            }
        }
    });
    cancel.check()?;
    let names = model.pair_names();
    let lines = tasks.iter().zip(found);
    Ok(lines
        .map(|(task, found)| {
            let rule = (task.rule, &task.working_on[..]);
            line(names[task.pair], rule, found, limit_of(task))
        })
        .collect())
}

/// Rule of a pair that the job does not waive.
fn usual_rule(model: &ClearanceModel, pair: usize) -> PairRule {
    rule_of(model.reduced_by_m_of(pair))
}

fn rule_of(reduced_by_m: f64) -> PairRule {
    match reduced_by_m {
        0.0 => PairRule::Clearance,
        _ => PairRule::Reduced,
    }
}

/// Distance from which on a pair counts as far \[m\]: obstacles that are never as near as the nearest of the other pairs need no closer
/// bound.
fn far_from_m(limit_m: f64, nearest_m: f64) -> f64 {
    let nearest_m = if nearest_m.is_finite() {
        nearest_m.max(limit_m)
    } else {
        limit_m
    };
    FAR * nearest_m.max(FAR_M)
}

/// Least distance found at a single moment over the pairs that must keep clear \[m\].
fn least_seen(found: &[Option<PairDistance>], tasks: &[Task]) -> f64 {
    let must = found
        .iter()
        .zip(tasks)
        .filter(|(_, task)| task.rule == PairRule::Clearance);
    let seen = must.filter_map(|(found, _)| *found).map(|f| f.seen_m);
    seen.fold(f64::INFINITY, f64::min)
}

fn line(
    (a, b): (&str, &str),
    (rule, working_on): (PairRule, &[usize]),
    found: Option<PairDistance>,
    limit_m: f64,
) -> PairBound {
    let measured = found.filter(|f| f.seen_m.is_finite());
    let judged = |found: PairDistance| {
        let at_least_m = Some(found.at_least_m).filter(|b| *b > f64::NEG_INFINITY);
        let seen_m = Some(found.seen_m).filter(|s| *s < f64::INFINITY);
        let measure = measure(limit_m, [at_least_m, seen_m]);
        Check::measured(Requirement::Clearance, measure, WorstCase::default())
    };
    let status = match (rule, found.map_or(Status::NotProved, |found| judged(found).status)) {
        (PairRule::Touching, _) => Status::Proved,
        (PairRule::Waived, Status::Violated | Status::NotProved) => Status::Waived,
        (_, status) => status,
    };
    PairBound {
        pair: [a.to_owned(), b.to_owned()],
        rule,
        working_on: working_on.to_vec(),
        required_m: (rule == PairRule::Reduced).then_some(limit_m),
        status,
        at_least_m: found.map(|f| f.at_least_m).filter(|b| b.is_finite()),
        seen_m: measured.map(|f| f.seen_m),
        time_s: measured.map(|f| f.time_s),
        place_m: measured.map(|f| f.place_m),
    }
}

/// Measure of a distance \[m\], from its bound and the least one seen; where nothing is required a contact breaks it.
fn measure(limit_m: f64, bounds: [Option<f64>; 2]) -> Measure {
    let sense = if limit_m > 0.0 { Sense::AtLeast } else { Sense::Above };
    Measure::new(sense, limit_m, Unit::Metre, bounds)
}

/// Checks the clearance over all lines that require it, with the least bound and the position of the least distance found; and, where there
/// are such pairs, the reduced clearances, with those of the pair that has the least to spare.
pub(crate) fn checks(limit_m: f64, lines: &[PairBound]) -> impl Iterator<Item = Check> {
    let of = |rule| lines.iter().filter(|line| line.rule == rule).collect::<Vec<_>>();
    let spare = |line: &&&PairBound| line.at_least_m.unwrap_or(f64::NEG_INFINITY) - line.required_m.unwrap_or(limit_m);
    let reduced = of(PairRule::Reduced);
    let scarcest = reduced.iter().min_by(|a, b| spare(a).total_cmp(&spare(b)));
    let reduced = scarcest.map(|line| Check {
        status: status(&reduced),
        ..check(
            Requirement::ReducedClearance,
            line.required_m.unwrap_or(limit_m),
            &[*line],
        )
    });
    // A pair that the job waives and that keeps clear all the same is like any other.
    let is_kept = |line: &&PairBound| line.rule == PairRule::Waived && line.status == Status::Proved;
    let keeping = lines
        .iter()
        .filter(|line| line.rule == PairRule::Clearance || is_kept(line));
    let keeping: Vec<_> = keeping.collect();
    std::iter::once(check(Requirement::Clearance, limit_m, &keeping)).chain(reduced)
}

/// Status of a requirement over its lines. Without collision geometry there is nothing to be clear of, and nothing is proved.
fn status(lines: &[&PairBound]) -> Status {
    let has = |status| lines.iter().any(|line| line.status == status);
    match (has(Status::Violated), has(Status::NotProved)) {
        (true, _) => Status::Violated,
        (_, true) => Status::NotProved,
        _ if lines.is_empty() => Status::NotProved,
        _ => Status::Proved,
    }
}

fn check(requirement: Requirement, limit_m: f64, lines: &[&PairBound]) -> Check {
    let least = |of: fn(&PairBound) -> Option<f64>| lines.iter().filter_map(|l| of(l)).min_by(f64::total_cmp);
    let worst = lines.iter().filter(|l| l.seen_m.is_some()).min_by(|a, b| {
        let key = |l: &PairBound| l.seen_m.unwrap_or(f64::INFINITY);
        key(a).total_cmp(&key(b))
    });
    let bounded = lines.iter().all(|l| l.at_least_m.is_some());
    let bounds = || [least(|l| l.at_least_m).filter(|_| bounded), least(|l| l.seen_m)];
    Check {
        status: status(lines),
        measure: (!lines.is_empty()).then(|| measure(limit_m, bounds())),
        worst: worst.map_or_else(WorstCase::default, |l| WorstCase {
            time_s: l.time_s,
            place_m: l.place_m,
            pair: Some(l.pair.clone()),
            ..WorstCase::default()
        }),
        ..Check::not_judged(requirement)
    }
}

/// Returns the rules of each pair, and when they hold. The schedule states when the sponge works on which plate; without one that is unknown.
fn tasks(
    judged: &JudgedJob<'_>,
    model: &ClearanceModel,
    waived: &[usize],
    timeline: &Timeline<'_>,
    schedule: Option<&Schedule>,
) -> Vec<Task> {
    let mut tasks = Vec::new();
    let whole = 0..timeline.count();
    for pair in 0..model.pair_count() {
        let keeps = if waived.contains(&pair) {
            PairRule::Waived
        } else {
            usual_rule(model, pair)
        };
        let mut add = |rule, during, working_on| {
            tasks.push(Task {
                pair,
                rule,
                during,
                working_on,
            });
        };
        let (schedule, plate) = match (schedule, model.pair_kind(pair)) {
            (_, PairKind::Other) => {
                add(keeps, Some(vec![whole.clone()]), Vec::new());
                continue;
            }
            (None, PairKind::SpongeAndPlate(_)) => {
                add(keeps, None, Vec::new());
                add(PairRule::Touching, None, Vec::new());
                continue;
            }
            (Some(schedule), PairKind::SpongeAndPlate(plate)) => (schedule, plate),
        };
        let touches = |span: &Span| may_touch(judged, span.kind, span.plate, plate);
        let clear = joined(schedule, |span| !touches(span));
        if !clear.is_empty() {
            add(keeps, Some(clear), Vec::new());
        }
        let touching = joined(schedule, touches);
        if !touching.is_empty() {
            let washes = schedule.spans.iter().filter(|span| span.kind == SegmentKind::Wash);
            let working_on = washes.filter(|span| touches(span)).map(|span| span.plate);
            add(PairRule::Touching, Some(touching), working_on.collect());
        }
    }
    tasks
}

/// True if the sponge may touch `plate` during a segment of this kind at the plate `on`.
pub(crate) fn may_touch(judged: &JudgedJob<'_>, kind: SegmentKind, on: usize, plate: usize) -> bool {
    kind.is_at_plate() && (on == plate || reach::is_within_reach(judged, on, plate))
}

/// Returns the piece ranges of some spans, with neighbours joined.
fn joined(schedule: &Schedule, counts: impl Fn(&Span) -> bool) -> Vec<Range<usize>> {
    let mut all: Vec<Range<usize>> = Vec::new();
    for span in schedule.spans.iter().filter(|span| counts(span)) {
        match all.last_mut() {
            Some(last) if last.end == span.pieces.start => last.end = span.pieces.end,
            _ => all.push(span.pieces.clone()),
        }
    }
    all
}
