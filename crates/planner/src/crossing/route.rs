//! Candidates of a crossing, and the choice among them.

use super::blend::{Contact, quintic};
use super::sampled;
use super::{Blocked, CrossingError, PaperArc, STEP_RAD, Terminal, TooNear};
use crate::joint_path::{Ends, JointPath, JointPathError};
use crate::timing::{self, MotionLimits, Slow, Timed};
use platewash_kinematics::{Axes, Frame, JointVector, RobotModel};
use rand_pcg::Pcg64;
use serde::Serialize;
use std::fmt;

/// Pace of the joints on a direct route \[rad of the fastest joint per metre of the parameter\], the candidates.
const PACES_RAD_M: [f64; 3] = [2.0, 3.5, 6.0];
/// How far a raised route goes towards the raised configuration, in steps.
const RAISES_RAD: [f64; 3] = [0.15, 0.35, 0.6];
/// Shortest way between two tops, in the parameter \[m\].
const SHORTEST_M: f64 = 0.02;

/// What the arm is doing at a configuration: decides which bodies may be near each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// On the line over a plate.
    Line {
        /// The plate.
        plate: usize,
    },
    /// Anywhere else.
    Free,
}

/// The arm and what surrounds it.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The arm.
    pub robot: &'a RobotModel,
    /// Its tip.
    pub tip: &'a Frame,
    /// Whether a configuration \[rad\] keeps its clearance.
    pub keeps_clear: &'a dyn Fn(&JointVector, Stage) -> bool,
    /// The bodies that are too near where it does not; only asked to say so.
    pub too_near: &'a dyn Fn(&JointVector, Stage) -> Option<TooNear>,
    /// Limits of the motion.
    pub limits: &'a MotionLimits,
    /// The paper's arc, where it is a candidate.
    pub arc: Option<&'a PaperArc<'a>>,
}

/// Which way a crossing takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Route {
    /// From top to top in the joints.
    Direct,
    /// The same over a raised configuration.
    Raised,
    /// Round the base as the paper does.
    Arc,
    /// Found by random trees.
    Sampled,
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direct => "direct, in the joints",
            Self::Raised => "raised, in the joints",
            Self::Arc => "the paper's arc",
            Self::Sampled => "sampled",
        })
    }
}

/// A crossing in time, from rest to rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Crossing {
    /// Its route.
    pub route: Route,
    /// The motion.
    pub timed: Timed,
    /// Parameters at which the free part begins and ends \[m\].
    pub free: [f64; 2],
}

/// Plans a crossing; `rng` is used by [`Route::Sampled`] only.
///
/// # Errors
/// [`CrossingError`].
pub fn plan(scene: &Scene<'_>, from: &Terminal, to: &Terminal, rng: &mut Pcg64) -> Result<Crossing, CrossingError> {
    for end in [from, to] {
        check_terminal(scene, end)?;
    }
    let mut search = Search {
        scene,
        ends: [from, to],
        best: None,
        blocked: None,
    };
    for way in direct(from, to) {
        search.consider(Route::Direct, &way)?;
    }
    if search.best.is_none() {
        for way in raised(scene.robot, from, to) {
            search.consider(Route::Raised, &way)?;
        }
    }
    if search.best.is_none()
        && let Some(way) = scene.arc.and_then(|arc| arc.way(from, to))
    {
        search.consider(Route::Arc, &way)?;
    }
    if let Some(best) = search.best {
        return Ok(best);
    }
    let found = sampled::way(scene, from.top(), to.top(), rng);
    if let Ok(way) = &found {
        search.consider(Route::Sampled, way)?;
    }
    let Search { best, blocked, .. } = search;
    best.ok_or_else(|| CrossingError::NoWay {
        from: from.plate(),
        to: to.plate(),
        nodes: found.err().unwrap_or(0),
        blocked: blocked.and_then(|q| what_blocks(scene, &q)).map(Box::new),
    })
}

/// What keeps the arm from a configuration \[rad\] of a free part.
fn what_blocks(scene: &Scene<'_>, q: &JointVector) -> Option<Blocked> {
    let too_near = || (scene.too_near)(q, Stage::Free).map(Blocked::TooNear);
    scene.robot.limits().violation(q).map(Blocked::Limit).or_else(too_near)
}

/// Configurations between two tops, both left out, with the parameter counted from the first top \[m\], and its
/// value at the second.
#[derive(Debug, Clone)]
pub(super) struct Way {
    pub u: Vec<f64>,
    pub q: Vec<JointVector>,
    pub length: f64,
}

/// Candidates between two ends, one after the other.
struct Search<'a> {
    scene: &'a Scene<'a>,
    ends: [&'a Terminal; 2],
    /// The fastest so far.
    best: Option<Crossing>,
    /// Where the first candidate that is not free ends \[rad\].
    blocked: Option<JointVector>,
}

impl Search<'_> {
    /// Times the way if it is free, and keeps it if it is the fastest so far.
    fn consider(&mut self, route: Route, way: &Way) -> Result<(), CrossingError> {
        let (scene, [from, to]) = (self.scene, self.ends);
        let path = whole(from, to, way)?;
        let free = [from.height_m(), from.height_m() + way.length];
        if let Some(q) = blocked(scene, &path, free) {
            self.blocked.get_or_insert(q);
            return Ok(());
        }
        let end = free[1] + to.height_m();
        let slow: Vec<_> = from.slow_from(0.0).into_iter().chain(to.slow_until(end)).collect();
        let mut timed = timing::time_optimal(&path, scene.robot, scene.tip, scene.limits)?;
        if slow.iter().any(|slow| is_too_fast(scene, &timed, slow)) {
            timed = timing::time_optimal_slowed(&path, scene.robot, scene.tip, scene.limits, &slow)?;
        }
        let faster = |best: &Crossing| timed.motion.duration_s() < best.timed.motion.duration_s();
        if self.best.as_ref().is_none_or(faster) {
            self.best = Some(Crossing { route, timed, free });
        }
        Ok(())
    }
}

/// Whether the tip is faster than it may be at a knot of a stretch that shall be slow.
fn is_too_fast(scene: &Scene<'_>, timed: &Timed, slow: &Slow) -> bool {
    let (positions, speeds) = (timed.motion.positions(), timed.motion.speeds());
    let tip_speed = |k: usize| {
        let jacobian = scene.robot.fk(&positions[k]).jacobian(scene.tip, Axes::Base);
        (jacobian.fixed_rows::<3>(0) * speeds[k]).norm()
    };
    let within = |k: &usize| (slow.u[0]..=slow.u[1]).contains(&timed.parameters[*k]);
    (0..positions.len()).filter(within).any(|k| tip_speed(k) > slow.most)
}

fn check_terminal(scene: &Scene<'_>, end: &Terminal) -> Result<(), CrossingError> {
    let (heights, configurations) = end.samples();
    let stage = |k: usize| match end.plate() {
        Some(plate) if k + 1 < heights.len() => Stage::Line { plate },
        _ => Stage::Free,
    };
    let blocked = (0..heights.len()).find(|&k| !(scene.keeps_clear)(&configurations[k], stage(k)));
    let Some(k) = blocked else {
        return Ok(());
    };
    let too_near = (scene.too_near)(&configurations[k], stage(k)).map(Box::new);
    Err(match end.plate() {
        None => CrossingError::Home { too_near },
        Some(plate) => CrossingError::Line {
            plate,
            height_m: heights[k],
            too_near,
        },
    })
}

/// Line, way and line as one spline.
pub(super) fn whole(from: &Terminal, to: &Terminal, way: &Way) -> Result<JointPath, JointPathError> {
    let ((up, out), (down, back)) = (from.samples(), to.samples());
    let (first, last) = (from.height_m(), from.height_m() + way.length);
    let end = last + to.height_m();
    let mut u: Vec<f64> = up.to_vec();
    u.extend(way.u.iter().map(|u| first + u));
    u.extend(down.iter().rev().map(|h| end - h));
    let mut q = out.to_vec();
    q.extend(&way.q);
    q.extend(back.iter().rev());
    let pace = (to.top() - from.top()) / way.length;
    let slopes = [from.slope_at_rest(pace), -to.slope_at_rest(-pace)];
    JointPath::through(u, q, Ends::Clamped(slopes))
}

/// The first configuration \[rad\] on the free part of a path at which the arm does not keep its limits or clearances.
fn blocked(scene: &Scene<'_>, path: &JointPath, [from, to]: [f64; 2]) -> Option<JointVector> {
    let limits = scene.robot.limits();
    let steps = |a: f64, b: f64| ((path.at(b).q - path.at(a).q).amax() / STEP_RAD).ceil().max(1.0);
    let knots = path.parameters();
    let within = |ends: &&[f64]| (from..to).contains(&((ends[0] + ends[1]) * 0.5));
    let spans = knots.windows(2).filter(within);
    let places = spans.flat_map(|ends| {
        let (a, b) = (ends[0], ends[1]);
        let count = steps(a, b);
        (1..=count as usize).map(move |k| a + (b - a) * (k as f64 / count))
    });
    let free = |q: &JointVector| limits.contain(q) && (scene.keeps_clear)(q, Stage::Free);
    places.map(|u| path.at(u).q).find(|q| !free(q))
}

/// Direct ways, one a pace.
fn direct(from: &Terminal, to: &Terminal) -> impl Iterator<Item = Way> {
    let (a, b) = (*from.top(), *to.top());
    let largest = (b - a).amax();
    PACES_RAD_M.into_iter().map(move |pace| {
        let length = (largest / pace).max(SHORTEST_M);
        let slope = (b - a) / length;
        blended(&from.leaving(slope), &to.leaving(-slope).reversed(), length)
    })
}

/// Ways over a configuration between the tops with joint 2 drawn back: the whole forearm rises.
fn raised(robot: &RobotModel, from: &Terminal, to: &Terminal) -> impl Iterator<Item = Way> {
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
        let over = Contact {
            q: middle,
            first: slope,
            second: JointVector::zeros(),
        };
        let mut way = blended(&from.leaving((middle - a) / first), &over, first);
        way.u.push(first);
        way.q.push(middle);
        let rest = blended(&over, &to.leaving((middle - b) / second).reversed(), second);
        way.u.extend(rest.u.iter().map(|u| first + u));
        way.q.extend(rest.q);
        way.length = first + second;
        way
    })
}

/// Samples of a quintic, both ends left out.
fn blended(from: &Contact, to: &Contact, length: f64) -> Way {
    let count = (((to.q - from.q).amax() / 0.05).ceil() as usize).clamp(12, 80);
    let shares = (1..count).map(|k| k as f64 / count as f64);
    Way {
        u: shares.clone().map(|s| s * length).collect(),
        q: shares.map(|s| quintic(from, to, length, s)).collect(),
        length,
    }
}
