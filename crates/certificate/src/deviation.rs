//! How far the tip of one motion is from the tip of another at the same time.
//!
//! Over a stretch in which each motion is one cubic, the deviation e = p₁ − p₂ keeps ‖e‖ ≤ max(‖e(a)‖, ‖e(b)‖) + h²/8 (sup ‖p̈₁‖ + sup ‖p̈₂‖)
//! (`tip.rs`), which halving makes as tight as is needed.

use crate::bound_tracker::BoundTracker;
use crate::check::{Check, Unit};
use crate::piece::Piece;
use crate::requirement::Requirement;
use crate::schedule::Schedule;
use crate::tip::{Arm, Stretch};
use crate::tip_limits;

/// How far the bound may be above the greatest deviation found, as a part of the tolerance.
const RESOLUTION: f64 = 5e-3;

/// The same stretch of time in both motions.
struct Both<'a> {
    motion: Stretch<'a>,
    plan: Stretch<'a>,
}

impl Both<'_> {
    /// The deviation at both ends \[m\].
    fn ends_m(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.motion.ends[k].position - self.plan.ends[k].position).norm())
    }
}

/// How far the tip of a motion leaves that of a plan, for as long as both last, against a tolerance \[m\]. Segments are those of the motion.
pub(crate) fn check(
    arm: &Arm<'_>,
    (motion, schedule): (&[Piece], &Schedule),
    plan: &[Piece],
    tolerance_m: f64,
) -> Check {
    let mut tracker = BoundTracker::new(tolerance_m, RESOLUTION * tolerance_m);
    let stretches = common(arm, motion, plan);
    tracker.allow_for(stretches.len());
    for both in &stretches {
        for (k, deviation_m) in both.ends_m().into_iter().enumerate() {
            tracker.see(deviation_m, both.motion.times()[k], &both.motion.ends[k]);
        }
    }
    stretches.iter().for_each(|both| refine(arm, both, &mut tracker, 0));
    let worst = tip_limits::worst(&tracker, motion, Some(schedule));
    tip_limits::check(Requirement::PlanDeviation, &tracker, (tolerance_m, Unit::Metre), worst)
}

/// Stretches of time in which each of two motions is one cubic.
fn common<'a>(arm: &Arm<'_>, motion: &'a [Piece], plan: &'a [Piece]) -> Vec<Both<'a>> {
    let mut all = Vec::with_capacity(motion.len() + plan.len());
    let (mut i, mut j, mut from) = (0, 0, 0.0_f64);
    while let (Some(a), Some(b)) = (motion.get(i), plan.get(j)) {
        let ends = [a, b].map(|piece| piece.start_s + piece.length_s);
        let to = ends[0].min(ends[1]);
        // What rounding leaves between two ends that are one is no stretch.
        let within = |piece: &Piece| [from, to].map(|t| (t - piece.start_s).clamp(0.0, piece.length_s));
        if to > from {
            all.push(Both {
                motion: arm.part(a, within(a)),
                plan: arm.part(b, within(b)),
            });
        }
        from = from.max(to);
        i += usize::from(ends[0] <= to);
        j += usize::from(ends[1] <= to);
    }
    all
}

fn refine(arm: &Arm<'_>, both: &Both<'_>, tracker: &mut BoundTracker, depth: u32) {
    let [from, to] = both.ends_m();
    let greater = if from > to || from.is_nan() { from } else { to };
    let sag = |stretch: &Stretch<'_>| stretch.sag(arm.derivatives(stretch).second());
    let bound = greater + sag(&both.motion) + sag(&both.plan);
    if tracker.accepts(bound) || !tracker.may_split(depth) {
        return tracker.take(bound);
    }
    let halves = arm.halves(&both.motion).zip(arm.halves(&both.plan));
    let Some(([first, second], [plan_first, plan_second])) = halves else {
        return tracker.take(bound);
    };
    let halves = [(first, plan_first), (second, plan_second)].map(|(motion, plan)| Both { motion, plan });
    let [_, middle_m] = halves[0].ends_m();
    tracker.see(middle_m, halves[0].motion.times()[1], &halves[0].motion.ends[1]);
    halves.iter().for_each(|half| refine(arm, half, tracker, depth + 1));
}
