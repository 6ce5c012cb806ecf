//! A motion against the limits, and the distances of the arm from itself and from the bodies around it.

use crate::run::PaperRun;
use crate::tracking::Step;
use platewash_bodies::clearance::{ClearanceModel, PairClearance, is_clear};
use platewash_kinematics::JointVector;
use platewash_motion::trajectory::{SegmentExtremes, SegmentKind, Trajectory};
use platewash_workcell::cancel::{CancelToken, Cancelled};
use serde::Serialize;
use std::collections::BTreeMap;

/// Limit that a violation breaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ViolationKind {
    /// A joint's position limit \[rad\].
    Position,
    /// A joint's speed limit \[rad/s\].
    Speed,
    /// A joint's acceleration limit \[rad/s²\], which is an assumption.
    Acceleration,
    /// The clearance asked for \[m\].
    Clearance,
}

/// A stretch of time during which a limit is broken.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Violation {
    /// Kind of the limit that is broken.
    pub kind: ViolationKind,
    /// Joint or bodies at fault: `joint_1` …, or the two bodies.
    pub who: String,
    /// Start \[s\].
    pub t_start_s: f64,
    /// End \[s\].
    pub t_end_s: f64,
    /// The worst value in it, in the unit of the kind.
    pub worst: f64,
    /// The limit.
    pub limit: f64,
}

/// The nearest approach of two bodies, and when.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClosestApproach {
    /// Time in the run \[s\].
    pub t_s: f64,
    /// The pair, its distance and its place.
    #[serde(flatten)]
    pub pair: PairClearance,
}

/// A motion against the limits. Speeds and accelerations are the exact extremes of the cubics through the waypoints
/// (speeds at the waypoints are central differences).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MotionReport {
    /// Largest speed of each joint as a share of its limit.
    pub speed_share: JointVector,
    /// Largest acceleration of each joint as a share of its (assumed) limit.
    pub acceleration_share: JointVector,
    /// Nearest approach of two bodies.
    pub clearance: Option<ClosestApproach>,
    /// Every violation, by kind, joint and time.
    pub violations: Vec<Violation>,
}

impl MotionReport {
    pub(super) fn new<'a>(
        run: &PaperRun,
        motion: &Trajectory,
        near: impl Iterator<Item = &'a Nearness> + Clone,
    ) -> Self {
        type Extreme = fn(&SegmentExtremes) -> &JointVector;
        let limits = run.job.arm.limits();
        let accelerations = JointVector::from(run.job.limits.joint_acceleration_rad_s2);
        let extremes: Vec<_> = motion.extremes().collect();
        // A limit is broken above it (1) or below it (−1).
        let sides: [(ViolationKind, f64, &JointVector, Extreme); 4] = [
            (ViolationKind::Position, -1.0, &limits.lower, |s| &s.position[0]),
            (ViolationKind::Position, 1.0, &limits.upper, |s| &s.position[1]),
            (ViolationKind::Speed, 1.0, &limits.velocity, |s| &s.speed),
            (ViolationKind::Acceleration, 1.0, &accelerations, |s| &s.acceleration),
        ];
        let mut violations = Vec::new();
        for (joint, named) in run.job.arm.joints().iter().enumerate() {
            for (kind, side, limit, of) in sides {
                let limit = limit[joint];
                // A break within rounding of the limit is none.
                let is_broken = |s: &&SegmentExtremes| side * (of(s)[joint] - limit) > 1e-9 * limit.abs();
                let broken = extremes.iter().filter(is_broken).map(|s| Violation {
                    kind,
                    who: named.name.clone(),
                    t_start_s: s.span_s[0],
                    t_end_s: s.span_s[1],
                    worst: of(s)[joint],
                    limit,
                });
                violations.extend(merged(broken, 0.0));
            }
        }
        violations.extend(too_near(near.clone().flat_map(|step| &step.too_near), run));
        let largest = |of: Extreme| extremes.iter().fold(JointVector::zeros(), |most, s| most.sup(of(s)));
        Self {
            speed_share: largest(|s| &s.speed).component_div(&limits.velocity),
            acceleration_share: largest(|s| &s.acceleration).component_div(&accelerations),
            clearance: nearest(near.filter_map(|step| step.nearest.as_ref())),
            violations,
        }
    }
}

/// Consecutive steps in which the same pair comes too near, pair by pair.
fn too_near<'a>(approaches: impl Iterator<Item = &'a ClosestApproach>, run: &PaperRun) -> Vec<Violation> {
    let mut by_pair: BTreeMap<String, Vec<Violation>> = BTreeMap::new();
    for ClosestApproach { t_s, pair } in approaches {
        let who = format!("{} – {}", pair.a, pair.b);
        by_pair.entry(who.clone()).or_default().push(Violation {
            kind: ViolationKind::Clearance,
            who,
            t_start_s: *t_s,
            t_end_s: *t_s,
            worst: pair.distance_m,
            limit: run.job.requirements.clearance_m,
        });
    }
    let gap_s = 1.5 * run.job.simulation.control.dt_s;
    by_pair
        .into_values()
        .flat_map(|all| merged(all.into_iter(), gap_s))
        .collect()
}

/// Violations of one limit in the order of time, those merged between which there is no more than a gap \[s\].
fn merged(violations: impl Iterator<Item = Violation>, gap_s: f64) -> Vec<Violation> {
    let excess = |violation: &Violation| (violation.worst - violation.limit).abs();
    let mut all: Vec<Violation> = Vec::new();
    for next in violations {
        match all.last_mut().filter(|open| next.t_start_s - open.t_end_s <= gap_s) {
            Some(open) => {
                open.t_end_s = next.t_end_s;
                if excess(&next) > excess(open) {
                    open.worst = next.worst;
                }
            }
            None => all.push(next),
        }
    }
    all
}

/// Distances of the arm at one step.
pub(super) struct Nearness {
    /// The nearest pair.
    pub nearest: Option<ClosestApproach>,
    /// All pairs that keep too little clearance.
    pub too_near: Vec<ClosestApproach>,
}

/// Distances of the arm at every step, commanded and executed.
pub(super) fn nearnesses(
    run: &PaperRun,
    clearance: &ClearanceModel,
    cancel: &CancelToken,
) -> Result<Vec<[Nearness; 2]>, Cancelled> {
    let at = |(k, step): (usize, &Step)| {
        cancel.check()?;
        let working = worked_on(run, k);
        Ok([step.commanded, step.executed].map(|q| nearness(clearance, &q, &working, run, k)))
    };
    run.steps.iter().enumerate().map(at).collect()
}

fn nearness(clearance: &ClearanceModel, q: &JointVector, working: &[usize], run: &PaperRun, step: usize) -> Nearness {
    let required_m = run.job.requirements.clearance_m;
    let timed = |pair| ClosestApproach {
        t_s: run.time_of(step),
        pair,
    };
    let nearest = clearance.smallest(q, working);
    // Nearly all configurations keep their distance; only the others are checked pair by pair.
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
fn worked_on(run: &PaperRun, step: usize) -> [usize; 1] {
    let segments = &run.tool_path.segments;
    let index = run.steps[step].segment;
    let segment = &segments[index];
    let first_half = || {
        let before: usize = segments[..index].iter().map(|s| s.waypoints.len()).sum();
        2 * (step - before) < segment.waypoints.len()
    };
    match (segment.kind, index.checked_sub(1)) {
        (SegmentKind::Transit, Some(left)) if first_half() => [segments[left].plate],
        _ => [segment.plate],
    }
}

/// The nearest of several approaches (the first of equals).
pub(super) fn nearest<'a>(approaches: impl Iterator<Item = &'a ClosestApproach>) -> Option<ClosestApproach> {
    approaches
        .min_by(|a, b| a.pair.distance_m.total_cmp(&b.pair.distance_m))
        .cloned()
}
