//! A motion against the limits.

use super::nearness::{ClosestApproach, Nearness, nearest};
use crate::run::PaperRun;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::trajectory::{SegmentExtremes, Trajectory};
use serde::Serialize;
use std::collections::BTreeMap;

/// What a violation breaks.
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
    /// What is broken.
    pub kind: ViolationKind,
    /// Who: `joint_1` …, or the two bodies.
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

/// Which side of a limit is forbidden.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Above,
    Below,
}

/// Merges consecutive spans of the same violation.
struct Merger {
    kind: ViolationKind,
    who: String,
    side: Side,
    limit: f64,
    found: Vec<Violation>,
}

impl MotionReport {
    pub(super) fn new<'a>(
        run: &PaperRun,
        motion: &Trajectory,
        nearness: impl Iterator<Item = &'a Nearness> + Clone,
    ) -> Self {
        let limits = run.job.arm.limits();
        let accelerations = JointVector::from(run.job.limits.joint_acceleration_rad_s2);
        let extremes: Vec<_> = motion.extremes().collect();
        let largest = |of: fn(&SegmentExtremes) -> &JointVector| {
            extremes
                .iter()
                .fold(JointVector::zeros(), |most, segment| most.sup(of(segment)))
        };
        let mut violations = Vec::new();
        for joint in 0..AXES {
            let who = || run.job.arm.joints()[joint].name.clone();
            let mut note = |kind, side, limit: f64, of: &dyn Fn(&SegmentExtremes) -> f64| {
                let mut merger = Merger::new(kind, who(), side, limit);
                extremes
                    .iter()
                    .for_each(|segment| merger.note(segment.span_s, of(segment)));
                violations.extend(merger.found);
            };
            note(ViolationKind::Position, Side::Below, limits.lower[joint], &|s| {
                s.position[0][joint]
            });
            note(ViolationKind::Position, Side::Above, limits.upper[joint], &|s| {
                s.position[1][joint]
            });
            note(ViolationKind::Speed, Side::Above, limits.velocity[joint], &|s| {
                s.speed[joint]
            });
            note(ViolationKind::Acceleration, Side::Above, accelerations[joint], &|s| {
                s.acceleration[joint]
            });
        }
        violations.extend(clearance_violations(nearness.clone().flat_map(|n| &n.too_near), run));
        Self {
            speed_share: largest(|s| &s.speed).component_div(&limits.velocity),
            acceleration_share: largest(|s| &s.acceleration).component_div(&accelerations),
            clearance: nearest(nearness.filter_map(|n| n.nearest.as_ref())),
            violations,
        }
    }
}

/// Consecutive steps in which the same pair comes too near, pair by pair.
fn clearance_violations<'a>(approaches: impl Iterator<Item = &'a ClosestApproach>, run: &PaperRun) -> Vec<Violation> {
    let (limit, dt) = (run.job.requirements.clearance_m, run.job.simulation.control.dt_s);
    let mut by_pair: BTreeMap<String, Vec<Violation>> = BTreeMap::new();
    for approach in approaches {
        let who = format!("{} – {}", approach.pair.a, approach.pair.b);
        let found = by_pair.entry(who.clone()).or_default();
        match found.last_mut().filter(|open| approach.t_s - open.t_end_s < 1.5 * dt) {
            Some(open) => {
                open.t_end_s = approach.t_s;
                open.worst = open.worst.min(approach.pair.distance_m);
            }
            None => found.push(Violation {
                kind: ViolationKind::Clearance,
                who,
                t_start_s: approach.t_s,
                t_end_s: approach.t_s,
                worst: approach.pair.distance_m,
                limit,
            }),
        }
    }
    by_pair.into_values().flatten().collect()
}

impl Merger {
    fn new(kind: ViolationKind, who: String, side: Side, limit: f64) -> Self {
        Self {
            kind,
            who,
            side,
            limit,
            found: Vec::new(),
        }
    }

    /// How far a value is on the forbidden side of the limit.
    fn excess(&self, value: f64) -> f64 {
        match self.side {
            Side::Above => value - self.limit,
            Side::Below => self.limit - value,
        }
    }

    /// Notes a span with its extreme value; a break within rounding of the limit is none.
    fn note(&mut self, [start, end]: [f64; 2], value: f64) {
        if self.excess(value) <= 1e-9 * self.limit.abs() {
            return;
        }
        let follows = self.found.last().filter(|open| open.t_end_s == start);
        let worse = follows.is_none_or(|open| self.excess(value) > self.excess(open.worst));
        if follows.is_none() {
            self.found.push(Violation {
                kind: self.kind,
                who: self.who.clone(),
                t_start_s: start,
                t_end_s: end,
                worst: value,
                limit: self.limit,
            });
        }
        if let Some(open) = self.found.last_mut() {
            open.t_end_s = end;
            if worse {
                open.worst = value;
            }
        }
    }
}
