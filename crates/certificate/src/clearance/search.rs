//! Clearance of one pair of bodies over stretches of time: branch and bound, the least bound first.
//!
//! Formulas (24.2) and (24.3) in `docs/certificate.md`.
//!
//! An interval of time and a pair of parts has a lower bound of its distance: from its middle by what the joints can displace, or
//! from its ends by what the parts can accelerate, and jump in speed ([`platewash_bodies::clearance::part_pair`]). The interval with the least bound is
//! halved until that is good enough: the limit kept and the least distance found nearly reached. A body of many parts is looked at as a
//! whole: from the shape that holds all of them, and where that is too near, part by part, the nearest first, until one is too near or all
//! others are far enough.

use crate::clearance::poses::ArmPoses;
use crate::motion::timeline::{Interval, Timeline};
use platewash_bodies::clearance::ITERATIVE_ERROR_M;
use platewash_bodies::clearance::part_pair::{Mover, PartDistance, PartPair, PartPairs};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::ranked::Ranked;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Gap between a bound and the least distance found below which refining stops \[m\]. It is well above the error of the distances.
const FLOOR_M: f64 = 15.0 * ITERATIVE_ERROR_M;

/// Gap allowed between the bound of the nearest pair and its least distance found \[m\].
pub(crate) const FINE_M: f64 = 1e-4;

/// Gap allowed for the other pairs, as a part of that distance.
const COARSE: f64 = 0.1;

/// Gap allowed for bodies of many parts, whose bounds take longer, as a part of that distance.
const COARSE_OF_MANY: f64 = 0.35;

/// Shortest interval that is halved \[s\].
const SHORTEST_S: f64 = 1e-7;

/// Clearance that a pair must keep, and the accuracy that is needed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Goal {
    /// Required clearance \[m\].
    pub limit_m: f64,
    /// Bound that is accurate enough, where a smaller one is not \[m\]; by default it follows from the pair's own distance.
    pub enough_m: Option<f64>,
    /// True if it is enough to know whether the pair meets.
    pub only_contact: bool,
    /// Number of intervals that may be examined.
    pub budget: usize,
}

/// Result for a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PairDistance {
    /// Lower bound on the distance \[m\]; −∞ where nothing could be shown.
    pub at_least_m: f64,
    /// Least distance found at a single moment \[m\]; +∞ before the first one.
    pub seen_m: f64,
    /// Time of that moment \[s\].
    pub time_s: f64,
    /// Midpoint between the nearest points at that moment \[m\].
    pub place_m: [f64; 3],
}

impl PairDistance {
    /// Returns the result of a pair that is never nearer than `at_least_m` \[m\] and was not examined further.
    pub fn with_bound(at_least_m: f64) -> Self {
        Self {
            at_least_m,
            seen_m: f64::INFINITY,
            time_s: 0.0,
            place_m: [0.0; 3],
        }
    }
}

impl Goal {
    /// Returns the least bound that is good enough beside the least distance found, with the allowed gap as a part `coarse` of that.
    fn needed(&self, seen: f64, coarse: f64) -> f64 {
        if self.only_contact {
            return if seen > 0.0 {
                FLOOR_M.min(0.5 * seen)
            } else {
                f64::NEG_INFINITY
            };
        }
        let broken = seen < self.limit_m - ITERATIVE_ERROR_M || seen <= 0.0;
        if broken {
            return seen - 10.0 * FINE_M;
        }
        let coarse = (seen - FINE_M).min(seen * (1.0 - coarse));
        let near = self
            .enough_m
            .map_or(coarse, |enough| coarse.max(enough.min(seen - FINE_M)));
        near.max(self.limit_m.min(seen - FLOOR_M))
    }
}

/// Interval that may hold a lesser distance than its bound allows.
struct Candidate {
    part: usize,
    interval: Interval,
    /// Direction from one part to the other, in the frame of the earlier one, at some moment in the interval or near it.
    normal: Option<[f64; 3]>,
}

/// Search over one pair of bodies.
pub(crate) struct Search<'a> {
    poses: &'a ArmPoses<'a>,
    timeline: &'a Timeline<'a>,
    parts: &'a PartPairs<'a>,
    goal: Goal,
    cancel: &'a CancelToken,
    /// Intervals by their bounds: the least first, and the earliest of equal ones.
    open: BinaryHeap<Reverse<Ranked<Candidate>>>,
    looked_at: usize,
    found: PairDistance,
}

/// Interval for two bodies, of which the fixed one has many parts that stand still.
struct Stay<'a> {
    /// Time of its middle \[s\], and the moving part there and at both ends.
    time_s: f64,
    mover: &'a Mover<'a>,
    ends: [Mover<'a>; 2],
    /// Greatest loss of distance compared with the middle, Σ ρ |Δq| of formula (24.2), and of a gap compared with both ends, A h²/8 + J h/4 of
    /// formula (24.3) \[m\].
    fall: f64,
    sag: f64,
}

/// Pairs of parts that are still to be examined.
struct Queue {
    /// Pairs that may be too near, by lower bounds on their distances in the middle of an interval \[m\]: the nearest first.
    open: BinaryHeap<Reverse<Ranked<()>>>,
    /// Least bound of those that are far enough, which need no order.
    far: f64,
}

impl Queue {
    fn new() -> Self {
        Self {
            open: BinaryHeap::new(),
            far: f64::INFINITY,
        }
    }

    /// Adds pairs by their spheres: those whose bound is not below `needed` are far enough.
    fn add<'a: 's, 's>(&mut self, parts: &PartPairs<'a>, within: Range<usize>, stay: &Stay<'s>, needed: f64) {
        for inner in within {
            let pair = parts.get(inner);
            let gap_m = pair.map_or(f64::INFINITY, |pair| pair.gap_to_sphere(&pair.mover_as(stay.mover)));
            if gap_m - stay.fall >= needed {
                self.far = self.far.min(gap_m - stay.fall);
            } else {
                self.open.push(Reverse(Ranked {
                    rank: gap_m,
                    order: inner,
                    value: (),
                }));
            }
        }
    }
}

impl<'a> Search<'a> {
    /// Bounds the distance of a pair of bodies, given by its pairs of parts, during the pieces. Nothing is shown where the work is
    /// cancelled.
    pub fn run(
        poses: &'a ArmPoses<'a>,
        cancel: &'a CancelToken,
        parts: &'a PartPairs<'a>,
        during: &[Range<usize>],
        goal: Goal,
    ) -> PairDistance {
        let timeline = poses.timeline();
        let mut search = Self {
            poses,
            timeline,
            parts,
            goal,
            cancel,
            open: BinaryHeap::new(),
            looked_at: 0,
            found: PairDistance::with_bound(f64::INFINITY),
        };
        for interval in during.iter().flat_map(|pieces| timeline.cover(pieces)) {
            for part in parts.outermost() {
                search.bound_interval(part, interval, f64::NEG_INFINITY, None);
            }
        }
        search.refine();
        search.found
    }

    fn refine(&mut self) {
        while let Some(Reverse(Ranked { rank, value: worst, .. })) = self.open.pop() {
            if self.cancel.is_cancelled() {
                self.found.at_least_m = f64::NEG_INFINITY;
                return;
            }
            self.found.at_least_m = rank.min(self.found.seen_m);
            if self.accepts(worst.part, rank) || self.looked_at >= self.goal.budget {
                return;
            }
            let [from, to] = self.timeline.times(&worst.interval);
            let halves = if to - from > SHORTEST_S {
                self.timeline.halves(&worst.interval)
            } else {
                None
            };
            let Some(halves) = halves else {
                return;
            };
            for half in halves {
                self.bound_interval(worst.part, half, rank, worst.normal);
            }
        }
    }

    /// True if a bound of a pair of parts is good enough.
    fn accepts(&self, part: usize, bound: f64) -> bool {
        bound >= self.needed(part)
    }

    /// Returns the least bound of a pair of parts that is good enough. It never grows, as the least distance found does not.
    fn needed(&self, part: usize) -> f64 {
        let is_of_many = !self.parts.within(part).is_empty();
        let coarse = if is_of_many { COARSE_OF_MANY } else { COARSE };
        self.goal.needed(self.found.seen_m, coarse)
    }

    /// Records a distance at a moment.
    fn see(&mut self, distance: &PartDistance, time_s: f64) {
        if distance.distance_m < self.found.seen_m {
            self.found.seen_m = distance.distance_m;
            self.found.time_s = time_s;
            self.found.place_m = distance.place_m;
        }
    }

    /// Bounds an interval. `inherited` and `normal` are the bound and the direction of an interval around it.
    fn bound_interval(&mut self, part: usize, interval: Interval, inherited: f64, normal: Option<[f64; 3]>) {
        self.looked_at += 1;
        let Some(pair) = self.parts.get(part) else { return };
        let (bound, normal) = self.bound(part, pair, &interval, normal);
        self.open.push(Reverse(Ranked {
            rank: inherited.max(bound),
            order: self.looked_at,
            value: Candidate { part, interval, normal },
        }));
    }

    /// Returns a lower bound on d over an interval \[m\], the greater one of formulas (24.2) and (24.3), and the direction n that led to it. Tries
    /// spheres around the parts, then `known`, the n of an interval around this one, then the nearest points, until a bound is good enough.
    fn bound(
        &mut self,
        part: usize,
        pair: &PartPair<'a>,
        interval: &Interval,
        known: Option<[f64; 3]>,
    ) -> (f64, Option<[f64; 3]>) {
        let extent = self.timeline.extent(interval);
        let (time_s, q) = self.timeline.middle(interval);
        let poses = self.poses.middle(interval, &q);
        let drift = extent.drift(&q);
        let mover = pair.mover(&poses);
        let levers = pair.levers(&mover, &drift);
        let fall = levers.dot(&drift);
        let far = pair.sphere_gap(&mover) - fall;
        if self.found.seen_m.is_finite() && self.accepts(part, far) {
            return (far, known);
        }
        let length_s = self.timeline.length_s(interval);
        let acceleration = pair.acceleration(&levers, &extent.speed, &extent.acceleration);
        let sag = 0.125 * length_s * length_s * acceleration + 0.25 * length_s * levers.dot(&extent.jumps);
        let ends = self.poses.ends(interval);
        let along = |normal| {
            let [a, b] = ends.each_ref().map(|poses| pair.gap_along(normal, poses));
            a.min(b)
        };
        // If the gap itself is enough, shorter intervals will be enough: no nearest points are needed.
        if let Some(gap) = known.map(along)
            && self.accepts(part, gap)
        {
            return (gap - sag, known);
        }
        let measured = pair.measure(&mover);
        if !self.parts.within(part).is_empty() {
            let whole = measured.at_least_m - fall;
            if self.accepts(part, whole) {
                return (whole, known);
            }
            // None of the parts is displaced or accelerated by more, so that it holds for all of them.
            let stay = Stay {
                time_s,
                mover: &mover,
                ends: ends.each_ref().map(|poses| pair.mover(poses)),
                fall,
                sag,
            };
            return (whole.max(self.survey(part, &stay)), known);
        }
        self.see(&measured, time_s);
        let displaced = measured.at_least_m - fall;
        let settled = self.accepts(part, displaced) || measured.distance_m - sag <= displaced;
        let aside = measured.normal.filter(|_| !settled).map(|normal| along(normal) - sag);
        (aside.map_or(displaced, |aside| displaced.max(aside)), measured.normal)
    }

    /// Returns a lower bound over an interval on the distance of the pairs of parts that a pair holds \[m\], formulas (24.2) and (24.3).
    /// `stay` has the terms that are subtracted, which hold for all of them. The nearest are examined first, until the rest is far enough
    /// or one is too near: each from the sphere around it, along the direction of the one before, then from its nearest points.
    fn survey<'s>(&mut self, part: usize, stay: &Stay<'s>) -> f64
    where
        'a: 's,
    {
        let parts = self.parts;
        let mut queue = Queue::new();
        queue.add(parts, parts.within(part), stay, self.needed(part));
        let mut bound = f64::INFINITY;
        let mut direction = None;
        while let Some(Reverse(Ranked {
            rank: gap_m,
            order: inner,
            ..
        })) = queue.open.pop()
        {
            if self.accepts(part, gap_m - stay.fall) {
                return bound.min(gap_m - stay.fall).min(queue.far);
            }
            let Some(pair) = parts.get(inner) else { continue };
            if !parts.within(inner).is_empty() {
                queue.add(parts, parts.within(inner), stay, self.needed(part));
                continue;
            }
            let along = |normal: [f64; 3]| {
                let [a, b] = (stay.ends.each_ref()).map(|end| pair.gap_along_in_base(normal, &pair.mover_as(end)));
                a.min(b) - stay.sag
            };
            if let Some(known) = direction.map(along)
                && self.accepts(part, known)
            {
                bound = bound.min(known);
                continue;
            }
            let measured = pair.measure(&pair.mover_as(stay.mover));
            self.see(&measured, stay.time_s);
            let mut found = measured.at_least_m - stay.fall;
            if let Some(normal) = measured.normal
                && !self.accepts(part, found)
            {
                let in_base = pair.in_base(normal, stay.mover.poses());
                direction = Some(in_base);
                found = found.max(along(in_base));
            }
            bound = bound.min(found);
            if !self.accepts(part, found) {
                // The others are no nearer than this one's sphere, and halves will tell.
                let next = queue.open.peek().map_or(f64::INFINITY, |next| next.0.rank - stay.fall);
                return bound.min(next).min(queue.far);
            }
        }
        bound.min(queue.far)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::piece::Piece;
    use platewash_bodies::clearance::ClearanceModel;
    use platewash_fixtures::{kitchen_plate, kitchen_tool, workcell};
    use platewash_kinematics::{JointVector, RobotModel};
    use platewash_motion::piecewise::MotionPiece;
    use proptest::prelude::*;

    const STEP_S: f64 = 0.008;

    /// Lines of [`STEP_S`] through some positions \[rad\].
    fn lines(q: &[JointVector]) -> Vec<Piece> {
        let time_s = |k: usize| k as f64 * STEP_S;
        let line = |k: usize| MotionPiece::line([time_s(k), time_s(k + 1)], [q[k], q[k + 1]]);
        (0..q.len() - 1).map(|k| Piece::from(&line(k))).collect()
    }

    fn vector(size: f64) -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-size..size).prop_map(JointVector::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        /// Checks that no bound is above the least distance sampled, for a slow motion of lines with an excursion whose speed jumps,
        /// anywhere in the tree of intervals. The distance that is enough is far below, so that few intervals are examined.
        #[test]
        fn no_bound_is_above_a_sample_where_speeds_jump(
            q in vector(0.6), drift in vector(2e-3), away in vector(0.4), rows in 2..70_usize, at in 0.0..1.0_f64, half in 1..9_usize,
        ) {
            let robot = RobotModel::irb120().unwrap();
            let model = ClearanceModel::new(&robot, &workcell(&robot, kitchen_tool()), &[kitchen_plate([0.3, 0.1])]).unwrap();
            let top = (at * rows as f64).floor();
            let position = |k: usize| {
                let share = 1.0 - (k as f64 - top).abs() / half as f64;
                q + drift * k as f64 + away * share.max(0.0)
            };
            let pieces = lines(&(0..=rows).map(position).collect::<Vec<_>>());
            let timeline = Timeline::new(&pieces);
            let cancel = CancelToken::new();
            let goal = Goal { limit_m: 0.0, enough_m: Some(1e-3), only_contact: false, budget: 4000 };
            let all = 0..pieces.len();
            for pair in 0..model.pair_count() {
                let parts = model.parts_of(pair);
                let found = Search::run(&ArmPoses::new(&robot, &timeline), &cancel, &parts, std::slice::from_ref(&all), goal);
                for piece in &pieces {
                    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                        let poses = robot.fk(&piece.position(share * piece.length_s));
                        for part in parts.parts() {
                            let sampled_m = part.measure(&part.mover(&poses)).distance_m;
                            prop_assert!(found.at_least_m <= sampled_m + ITERATIVE_ERROR_M, "{found:?} {sampled_m}");
                        }
                    }
                }
            }
        }
    }
}
