//! Candidates of a transit, and the choice among them.

use crate::joint_path::{Ends, JointPath, JointPathError, PathState};
use crate::placed_arm::Stretch;
use crate::timing::{self, SlowStretch, TimedPath};
use crate::transit::error::{TransitError, TransitObstruction};
use crate::transit::lift_line::{self, LiftLine, quintic};
use crate::transit::rules::FreePath;
use crate::transit::rules::STEP_RAD;
use crate::transit::rules::TransitKind;
use crate::transit::rules::TransitRules;
use crate::transit::sampled;
use platewash_kinematics::{Axes, JointVector, RobotModel};
use rand_pcg::Pcg64;

/// Pace of the joints on a direct path \[rad of the fastest joint per metre of the parameter\], the candidates.
const PACES_RAD_M: [f64; 3] = [2.0, 3.5, 6.0];
/// Steps of a raised path towards the raised configuration \[rad\].
const RAISES_RAD: [f64; 3] = [0.15, 0.35, 0.6];
/// Ways from top to top that are sampled, where a smooth path along the first ones is not free.
const SAMPLED_WAYS: usize = 8;
/// Shortest path between two tops, in the parameter \[m\].
const SHORTEST_M: f64 = 0.02;

/// A transit in time, from rest to rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Transit {
    /// Kind of the transit.
    pub kind: TransitKind,
    /// The motion.
    pub timed: TimedPath,
    /// Parameters at which the free part begins and ends \[m\].
    pub free: [f64; 2],
}

/// Plans a transit; `rng` is used by [`TransitKind::Sampled`] only.
///
/// # Errors
/// [`TransitError`].
pub fn plan(
    rules: &TransitRules<'_>,
    from: &LiftLine,
    to: &LiftLine,
    rng: &mut Pcg64,
) -> Result<Transit, TransitError> {
    for end in [from, to] {
        check_line(rules, end)?;
    }
    let mut search = Search {
        rules,
        ends: [from, to],
        best: None,
        blocked: None,
    };
    for path in direct(from, to) {
        search.time_and_keep_fastest(TransitKind::Direct, &path)?;
    }
    if search.best.is_none() {
        for path in raised(rules.placed.robot, from, to) {
            search.time_and_keep_fastest(TransitKind::Raised, &path)?;
        }
    }
    if search.best.is_none()
        && let Some(path) = rules
            .arc
            .and_then(|over| lift_line::path(rules.placed, &over, from, to))
    {
        search.time_and_keep_fastest(TransitKind::Arc, &path)?;
    }
    let nodes = search.sampled(rng)?;
    let Search { best, blocked, .. } = search;
    best.ok_or_else(|| TransitError::NotFound {
        from: from.plate(),
        to: to.plate(),
        nodes,
        blocked: blocked.and_then(|q| obstruction_at(rules, &q)).map(Box::new),
    })
}

/// Returns the obstruction that keeps the arm from a configuration \[rad\] of a free part.
fn obstruction_at(rules: &TransitRules<'_>, q: &JointVector) -> Option<TransitObstruction> {
    let too_near = || rules.too_near(q, Stretch::Free).map(TransitObstruction::TooNear);
    rules
        .placed
        .robot
        .limits()
        .violation(q)
        .map(TransitObstruction::Limit)
        .or_else(too_near)
}

/// Candidates between two ends, one after the other.
struct Search<'a> {
    rules: &'a TransitRules<'a>,
    ends: [&'a LiftLine; 2],
    /// The fastest so far.
    best: Option<Transit>,
    /// Configuration at which the first candidate that is not free ends \[rad\].
    blocked: Option<JointVector>,
}

impl Search<'_> {
    /// Times the path if it is free, and keeps it if it is the fastest so far.
    fn time_and_keep_fastest(&mut self, kind: TransitKind, between: &FreePath) -> Result<(), TransitError> {
        let (rules, [from, to]) = (self.rules, self.ends);
        let placed = rules.placed;
        placed.check_cancelled()?;
        let path = join_with_lines(from, to, between)?;
        let free = [from.height_m(), from.height_m() + between.length];
        if let Some(q) = blocked(rules, &path, free) {
            self.blocked.get_or_insert(q);
            return Ok(());
        }
        let end = free[1] + to.height_m();
        let slow: Vec<_> = from.slow_from(0.0).into_iter().chain(to.slow_until(end)).collect();
        let mut timed = timing::time_optimal(&path, placed.robot, &placed.tip, rules.limits)?;
        if slow.iter().any(|slow| is_too_fast(rules, &timed, slow)) {
            timed = timing::time_optimal_slowed(&path, placed.robot, &placed.tip, rules.limits, &slow)?;
        }
        let faster = |best: &Transit| timed.motion.duration_s() < best.timed.motion.duration_s();
        if self.best.as_ref().is_none_or(faster) {
            self.best = Some(Transit { kind, timed, free });
        }
        Ok(())
    }
}

impl Search<'_> {
    /// Tries sampled paths until one is free; returns the number of configurations sampled. A smooth path may leave the free
    /// space where the lines that it follows do not: then it is laid closer to them, and at last along others.
    fn sampled(&mut self, rng: &mut Pcg64) -> Result<usize, TransitError> {
        let (mut nodes, [from, to]) = (0, self.ends);
        for _ in 0..SAMPLED_WAYS {
            if self.best.is_some() {
                break;
            }
            let lines = match sampled::lines(self.rules, from.top(), to.top(), rng)? {
                Ok(lines) => lines,
                Err(in_vain) => return Ok(nodes + in_vain),
            };
            nodes += lines.nodes;
            for spacing_rad in sampled::SPACINGS_RAD {
                if self.best.is_none() {
                    self.time_and_keep_fastest(TransitKind::Sampled, &lines.dense(spacing_rad))?;
                }
            }
        }
        Ok(nodes)
    }
}

/// Checks that the tip exceeds its speed limit at a knot of a stretch that must be slow.
fn is_too_fast(rules: &TransitRules<'_>, timed: &TimedPath, slow_stretches: &SlowStretch) -> bool {
    let (positions, speeds) = (timed.motion.positions(), timed.motion.speeds());
    let tip_speed = |k: usize| {
        let jacobian = rules
            .placed
            .robot
            .fk(&positions[k])
            .jacobian(&rules.placed.tip, Axes::Base);
        (jacobian.fixed_rows::<3>(0) * speeds[k]).norm()
    };
    let within = |k: &usize| (slow_stretches.u[0]..=slow_stretches.u[1]).contains(&timed.parameters[*k]);
    (0..positions.len())
        .filter(within)
        .any(|k| tip_speed(k) > slow_stretches.most)
}

fn check_line(rules: &TransitRules<'_>, end: &LiftLine) -> Result<(), TransitError> {
    let (heights, configurations) = end.samples();
    let stretch = |k: usize| match end.plate() {
        Some(plate) if k + 1 < heights.len() => Stretch::AtPlate(plate),
        _ => Stretch::Free,
    };
    let blocked = (0..heights.len()).find(|&k| !rules.is_clear(&configurations[k], stretch(k)));
    let Some(k) = blocked else {
        return Ok(());
    };
    let too_near = rules.too_near(&configurations[k], stretch(k)).map(Box::new);
    Err(match end.plate() {
        None => TransitError::Home { too_near },
        Some(plate) => TransitError::Line {
            plate,
            height_m: heights[k],
            too_near,
        },
    })
}

/// Line, free path and line as one spline.
fn join_with_lines(from: &LiftLine, to: &LiftLine, between: &FreePath) -> Result<JointPath, JointPathError> {
    let ((up, out), (down, back)) = (from.samples(), to.samples());
    let (first, last) = (from.height_m(), from.height_m() + between.length);
    let end = last + to.height_m();
    let mut u: Vec<f64> = up.to_vec();
    u.extend(between.u.iter().map(|u| first + u));
    u.extend(down.iter().rev().map(|h| end - h));
    let mut q = out.to_vec();
    q.extend(&between.q);
    q.extend(back.iter().rev());
    let pace = (to.top() - from.top()) / between.length;
    let slopes = [from.slope_at_rest(pace), -to.slope_at_rest(-pace)];
    JointPath::through(u, q, Ends::Clamped(slopes))
}

/// The first configuration \[rad\] on the free part of a path at which the arm does not keep its limits or clearances.
fn blocked(rules: &TransitRules<'_>, path: &JointPath, [from, to]: [f64; 2]) -> Option<JointVector> {
    let limits = rules.placed.robot.limits();
    let steps = |a: f64, b: f64| ((path.at(b).q - path.at(a).q).amax() / STEP_RAD).ceil().max(1.0);
    let knots = path.parameters();
    let within = |ends: &&[f64]| (from..to).contains(&((ends[0] + ends[1]) * 0.5));
    let spans = knots.windows(2).filter(within);
    let places = spans.flat_map(|ends| {
        let (a, b) = (ends[0], ends[1]);
        let count = steps(a, b);
        (1..=count as usize).map(move |k| a + (b - a) * (k as f64 / count))
    });
    let free = |q: &JointVector| limits.contain(q) && rules.is_clear(q, Stretch::Free);
    places.map(|u| path.at(u).q).find(|q| !free(q))
}

/// Direct paths, one a pace.
fn direct(from: &LiftLine, to: &LiftLine) -> impl Iterator<Item = FreePath> {
    let (a, b) = (*from.top(), *to.top());
    let largest = (b - a).amax();
    PACES_RAD_M.into_iter().map(move |pace| {
        let length = (largest / pace).max(SHORTEST_M);
        let slope = (b - a) / length;
        blended(&from.leaving(slope), &to.leaving(-slope).reversed(), length)
    })
}

/// Paths over a configuration between the tops with joint 2 drawn back: the whole forearm rises.
fn raised(robot: &RobotModel, from: &LiftLine, to: &LiftLine) -> impl Iterator<Item = FreePath> {
    let (a, b) = (*from.top(), *to.top());
    let limits = robot.limits().clone();
    let choices = PACES_RAD_M
        .into_iter()
        .flat_map(|pace| RAISES_RAD.map(move |raise| (pace, raise)));
    choices.map(move |(pace, raise)| {
        let mut middle = (a + b) * 0.5;
        middle[1] -= raise;
        let middle = limits.clamp(&middle);
        let lengths = [(middle - a), (b - middle)].map(|d| (d.amax() / pace).max(SHORTEST_M));
        let [first, second] = lengths;
        let slope = (b - a) / (first + second);
        let over = PathState {
            q: middle,
            first: slope,
            second: JointVector::zeros(),
        };
        let mut path = blended(&from.leaving((middle - a) / first), &over, first);
        path.u.push(first);
        path.q.push(middle);
        let rest = blended(&over, &to.leaving((middle - b) / second).reversed(), second);
        path.u.extend(rest.u.iter().map(|u| first + u));
        path.q.extend(rest.q);
        path.length = first + second;
        path
    })
}

/// Samples of a quintic, both ends left out.
fn blended(from: &PathState, to: &PathState, length: f64) -> FreePath {
    let count = (((to.q - from.q).amax() / 0.05).ceil() as usize).clamp(12, 80);
    let shares = (1..count).map(|k| k as f64 / count as f64);
    FreePath {
        u: shares.clone().map(|s| s * length).collect(),
        q: shares.map(|s| quintic(from, to, length, s)).collect(),
        length,
    }
}
