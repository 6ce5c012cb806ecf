//! Clearance of one pair of bodies over stretches of time: branch and bound, the least bound first.
//!
//! An interval of time and a pair of parts has a lower bound of its distance: from its middle by what the joints can displace, or
//! from its ends by what the parts can accelerate ([`platewash_workcell::clearance::motion`]). The interval with the least bound is
//! halved until that is good enough: the limit kept and the least distance found nearly reached.

use crate::timeline::{Interval, Timeline};
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::clearance::ITERATIVE_ERROR_M;
use platewash_workcell::clearance::motion::PartPair;
use std::collections::BinaryHeap;
use std::ops::Range;

/// How near to the least distance found a bound must come where it can \[m\]; below the error of the distances there is
/// no point.
const FLOOR_M: f64 = 15.0 * ITERATIVE_ERROR_M;

/// How near to the least distance found the bound of the nearest pair comes \[m\].
pub(crate) const FINE_M: f64 = 1e-4;

/// The same for the others, as a part of that distance.
const COARSE: f64 = 0.1;

/// Shortest interval that is halved \[s\].
const SHORTEST_S: f64 = 1e-7;

/// No direction is known.
const NO_NORMAL: [f64; 3] = [0.0; 3];

/// What a pair must keep and how exactly that is to be known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Goal {
    /// \[m\]
    pub limit_m: f64,
    /// A bound from here on is exact enough, and below is not \[m\]; by default as near as the pair's own distance asks.
    pub enough_m: Option<f64>,
    /// Intervals that may be looked at.
    pub budget: usize,
}

/// What was found about a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Found {
    /// The distance is never below this \[m\]; −∞ where nothing could be shown.
    pub at_least_m: f64,
    /// The least distance at a single moment \[m\]; +∞ before any was measured.
    pub seen_m: f64,
    /// That moment \[s\].
    pub time_s: f64,
    /// Half-way between the nearest points then \[m\].
    pub place_m: [f64; 3],
}

impl Goal {
    /// Whether a bound is good enough beside the least distance found.
    fn accepts(&self, bound: f64, seen: f64) -> bool {
        let broken = seen < self.limit_m - ITERATIVE_ERROR_M || seen <= 0.0;
        if broken {
            return bound >= seen - 10.0 * FINE_M;
        }
        let coarse = (seen - FINE_M).min(seen * (1.0 - COARSE));
        let near = self
            .enough_m
            .map_or(coarse, |enough| coarse.max(enough.min(seen - FINE_M)));
        bound >= near.max(self.limit_m.min(seen - FLOOR_M))
    }
}

/// An interval with its bound, ordered so that a heap yields the least bound first, and the earliest of equal ones.
struct Candidate {
    bound: f64,
    order: usize,
    part: usize,
    interval: Interval,
    /// From one part to the other, in the frame of the earlier one, as it is somewhere in the interval or near it.
    normal: [f64; 3],
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        other.bound.total_cmp(&self.bound).then(other.order.cmp(&self.order))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

/// A search over one pair of bodies.
pub(crate) struct Search<'a> {
    robot: &'a RobotModel,
    timeline: &'a Timeline<'a>,
    parts: &'a [PartPair<'a>],
    goal: Goal,
    cancel: &'a CancelToken,
    open: BinaryHeap<Candidate>,
    looked_at: usize,
    found: Found,
}

impl<'a> Search<'a> {
    /// Bounds the distance of a pair of bodies, given by its pairs of parts, during some pieces. Nothing is shown where the work is
    /// given up.
    pub fn run(
        (robot, cancel): (&'a RobotModel, &'a CancelToken),
        timeline: &'a Timeline<'a>,
        parts: &'a [PartPair<'a>],
        during: &[Range<usize>],
        goal: Goal,
    ) -> Found {
        let mut search = Self {
            robot,
            timeline,
            parts,
            goal,
            cancel,
            open: BinaryHeap::new(),
            looked_at: 0,
            found: Found {
                at_least_m: f64::INFINITY,
                seen_m: f64::INFINITY,
                time_s: 0.0,
                place_m: [0.0; 3],
            },
        };
        for interval in during.iter().flat_map(|pieces| timeline.cover(pieces)) {
            for part in 0..parts.len() {
                search.look(part, interval, f64::NEG_INFINITY, NO_NORMAL);
            }
        }
        search.settle();
        search.found
    }

    fn settle(&mut self) {
        while let Some(worst) = self.open.pop() {
            if self.cancel.is_cancelled() {
                self.found.at_least_m = f64::NEG_INFINITY;
                return;
            }
            self.found.at_least_m = worst.bound.min(self.found.seen_m);
            if self.goal.accepts(worst.bound, self.found.seen_m) || self.looked_at >= self.goal.budget {
                return;
            }
            let [from, to] = self.timeline.times(&worst.interval);
            let halves = if to - from > SHORTEST_S {
                self.timeline.halves(&worst.interval)
            } else {
                None
            };
            let Some(halves) = halves else { return };
            for half in halves {
                self.look(worst.part, half, worst.bound, worst.normal);
            }
        }
    }

    /// Bounds an interval, of which a bound and the direction of an interval around it are known already.
    fn look(&mut self, part: usize, interval: Interval, inherited: f64, normal: [f64; 3]) {
        self.looked_at += 1;
        let (bound, normal) = self.bound(part, &interval, normal);
        self.open.push(Candidate {
            bound: inherited.max(bound),
            order: self.looked_at,
            part,
            interval,
            normal,
        });
    }

    /// A lower bound over an interval, and the direction that led to it. The cheapest that is good enough: spheres around the
    /// parts, the direction known, the nearest points.
    fn bound(&mut self, part: usize, interval: &Interval, known: [f64; 3]) -> (f64, [f64; 3]) {
        let pair = &self.parts[part];
        let extent = self.timeline.extent(interval);
        let (time_s, q) = self.timeline.middle(interval);
        let poses = self.robot.fk(&q);
        let drift = extent.drift(&q);
        let levers = pair.levers(&poses, &drift);
        let fall = levers.dot(&drift);
        let far = pair.sphere_gap(&poses) - fall;
        if self.found.seen_m.is_finite() && self.goal.accepts(far, self.found.seen_m) {
            return (far, known);
        }
        let length_s = self.timeline.length_s(interval);
        let acceleration = pair.acceleration(&levers, &extent.speed, &extent.acceleration);
        let sag = 0.125 * length_s * length_s * acceleration;
        let ends = self.timeline.ends(interval);
        let along = |normal| {
            let [a, b] = ends.map(|q| pair.gap_along(normal, &self.robot.fk(&q)));
            a.min(b)
        };
        if known != NO_NORMAL {
            let gap = along(known);
            // Where the gap itself would do, shorter intervals will: no nearest points are needed.
            if self.goal.accepts(gap, self.found.seen_m) {
                return (gap - sag, known);
            }
        }
        let measured = pair.measure(&poses);
        if measured.distance_m < self.found.seen_m {
            self.found.seen_m = measured.distance_m;
            self.found.time_s = time_s;
            self.found.place_m = measured.place_m;
        }
        let displaced = measured.at_least_m - fall;
        let settled = measured.normal == NO_NORMAL || self.goal.accepts(displaced, self.found.seen_m);
        if settled || measured.distance_m - sag <= displaced {
            return (displaced, measured.normal);
        }
        (displaced.max(along(measured.normal) - sag), measured.normal)
    }
}
