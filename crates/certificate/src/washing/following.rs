//! The tip follows its curve: all of it, in order, and never farther away than the tolerance.
//!
//! Requirements 22 and 23, formula (22.1) in `docs/certificate.md`.
//!
//! To every moment belongs a parameter θ(t) that starts at 0, never falls and ends at the end of the curve γ; between two moments t₀ and t₁
//! it runs evenly. The deviation e(t) = p(t) − γ(θ(t)) then keeps ‖e‖ ≤ max(‖e(t₀)‖, ‖e(t₁)‖) + h²/8 · sup ‖p̈‖ + Δθ²/8 · sup ‖γ″‖. Which θ
//! is chosen at a moment (the nearest point's; where these run back, half-way between the greatest so far and the least to come) decides
//! how tight this is, and nothing else.
//!
//! The curves that the tip must follow, by one parameter θ that never runs back.

use crate::judged_job::JudgedJob;
use crate::motion::bound_tracker::BoundTracker;
use crate::motion::piece::Piece;
use crate::motion::tip::{Arm, Stretch, TipPiece};
use crate::motion::tip_limits;
use crate::plan_statements::schedule::Schedule;
use crate::report::check::Check;
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::face::Face;
use nalgebra::Vector3;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::job::{LINE_TOLERANCE_M, PATH_TOLERANCE_M, Recovery};
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::{WashCurve, WashPath};

/// Gap allowed between the bound of a deviation and the worst deviation found, as a part of the tolerance.
const RESOLUTION: f64 = 0.02;

/// A stretch with the curve's parameters at its ends.
#[derive(Debug, Clone, Copy)]
struct Leg<'a> {
    stretch: Stretch<'a>,
    theta: [f64; 2],
}

/// Checks the deviation of the tip from the wash paths, and from the lines over their ends.
pub(crate) fn checks(
    arm: &Arm<'_>,
    judged: &JudgedJob<'_>,
    (pieces, along): (&[Piece], &[TipPiece<'_>]),
    schedule: Option<&Schedule>,
) -> [Check; 2] {
    let requirements = [Requirement::PathDeviation, Requirement::LineDeviation];
    let Some(schedule) = schedule else {
        return requirements.map(Check::not_judged);
    };
    let limits = [PATH_TOLERANCE_M, LINE_TOLERANCE_M];
    let mut trackers = limits.map(|limit| BoundTracker::new(limit, RESOLUTION * limit));
    let mut no_curve = [false; 2];
    for span in schedule.spans.iter().filter(|span| span.kind.is_at_plate()) {
        let which = usize::from(span.kind != SegmentKind::Wash);
        let plate = judged.plates().get(span.plate);
        let of_path = |plate| Curve::new(plate, judged.path_of(span.plate)?, span.kind);
        let curve = match judged.job.recovery.as_ref().and_then(Recovery::retreat) {
            Some(line) => plate
                .zip(along.get(span.pieces.start))
                .map(|(plate, first)| Curve::up_from(plate, first.stretch().ends[0].position, line.length_m)),
            None => plate.and_then(of_path),
        };
        match curve {
            Some(curve) => follow(arm, &along[span.pieces.clone()], &curve, &mut trackers[which]),
            None => no_curve[which] = true,
        }
    }
    std::array::from_fn(|i| {
        if no_curve[i] {
            return Check::not_judged(requirements[i]);
        }
        let worst = tip_limits::worst_case(&trackers[i], pieces, Some(schedule));
        tip_limits::check(requirements[i], &trackers[i], limits[i], Unit::Metre, worst)
    })
}

/// Bounds the deviation ‖e‖ of the tip from a curve γ during the pieces, formula (22.1).
fn follow(arm: &Arm<'_>, pieces: &[TipPiece<'_>], curve: &Curve<'_>, tracker: &mut BoundTracker) {
    tracker.allow_for(pieces.len());
    let theta = in_order(nearest(pieces, curve));
    let leg = |i: usize| Leg {
        stretch: pieces[i].stretch(),
        theta: [theta[i], theta[i + 1]],
    };
    for leg in (0..pieces.len()).map(leg) {
        for (k, time_s) in leg.stretch.times().into_iter().enumerate() {
            tracker.see(deviation(curve, &leg, k), time_s, leg.stretch.ends[k]);
        }
    }
    (0..pieces.len()).for_each(|i| refine(arm, curve, &leg(i), tracker, 0));
}

/// θ of the points nearest to the tip, at the first knot and behind every piece; where the curve begins and ends at the ends.
fn nearest(pieces: &[TipPiece<'_>], curve: &Curve<'_>) -> Vec<f64> {
    let mut theta = vec![0.0];
    for (i, piece) in pieces.iter().enumerate() {
        let there = piece.stretch().ends[1].position;
        theta.push(if i + 1 == pieces.len() {
            curve.end()
        } else {
            curve.nearest(&there, theta[i], [0.0, curve.end()])
        });
    }
    theta
}

/// The sequence that never falls and is nowhere farther from the given one than need be: half-way between the greatest value so far
/// and the least one to come. Where the tip runs back a little, half of that is its deviation, and not all of it.
fn in_order(mut values: Vec<f64>) -> Vec<f64> {
    let mut to_come = values.clone();
    for i in (1..to_come.len()).rev() {
        to_come[i - 1] = to_come[i - 1].min(to_come[i]);
    }
    let mut so_far = f64::NEG_INFINITY;
    for (value, to_come) in values.iter_mut().zip(to_come) {
        so_far = so_far.max(*value);
        *value = 0.5 * (so_far + to_come);
    }
    values
}

/// Bounds the deviation ‖e‖ over a leg by formula (22.1) and, where needed, over its halves. `curve` is γ.
fn refine(arm: &Arm<'_>, curve: &Curve<'_>, leg: &Leg<'_>, tracker: &mut BoundTracker, depth: u32) {
    let [from, to] = [0, 1].map(|k| deviation(curve, leg, k));
    let greater = if from > to || from.is_nan() { from } else { to };
    let advance = leg.theta[1] - leg.theta[0];
    let bend = 0.125 * advance * advance * curve.bend(leg.theta);
    let bound = greater + leg.stretch.sag(arm.derivatives(&leg.stretch).second()) + bend;
    if tracker.accepts(bound) || !tracker.may_split(depth) {
        return tracker.take(bound);
    }
    let Some(halves) = arm.halves(&leg.stretch) else {
        return tracker.take(bound);
    };
    let [first, second] = halves.both();
    let there = first.ends[1];
    let middle = curve.nearest(&there.position, 0.5 * (leg.theta[0] + leg.theta[1]), leg.theta);
    let halves = [
        Leg {
            stretch: first,
            theta: [leg.theta[0], middle],
        },
        Leg {
            stretch: second,
            theta: [middle, leg.theta[1]],
        },
    ];
    tracker.see(deviation(curve, &halves[0], 1), first.times()[1], there);
    for half in &halves {
        refine(arm, curve, half, tracker, depth + 1);
    }
}

/// Deviation ‖e‖ = ‖p − γ(θ)‖ at an end of a leg \[m\].
fn deviation(curve: &Curve<'_>, leg: &Leg<'_>, end: usize) -> f64 {
    (leg.stretch.ends[end].position - curve.at(leg.theta[end])[0]).norm()
}

/// Steps of Gauss–Newton that look for the nearest point; where they end matters for the bound, not for its validity.
const STEPS: usize = 12;

/// A curve, base frame, m.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Curve<'a> {
    /// Straight; θ is the length from `from` \[m\].
    Line {
        from: Vector3<f64>,
        along: Vector3<f64>,
        length: f64,
    },
    /// A wash curve on a face; θ is its own \[rad\].
    Wash { face: Face<'a>, curve: &'a WashCurve },
}

impl<'a> Curve<'a> {
    /// The curve that a wash path asks for while the tip is at its plate, in the direction of the motion; `None` for free motion.
    pub fn new(plate: &'a Plate, path: &'a WashPath, kind: SegmentKind) -> Option<Self> {
        let [start, end] = path.feet(plate);
        let (up, length) = (|foot: &Vector3<f64>| plate.normal_at(foot), path.lift_m);
        match kind {
            SegmentKind::Approach => {
                let up = up(&start);
                let (from, along) = (start + up * length, -up);
                Some(Self::Line { from, along, length })
            }
            SegmentKind::Wash => {
                let (face, curve) = (Face::new(plate), &path.curve);
                Some(Self::Wash { face, curve })
            }
            SegmentKind::Retreat => {
                let (from, along) = (end, up(&end));
                Some(Self::Line { from, along, length })
            }
            SegmentKind::Depart | SegmentKind::Transit | SegmentKind::Return => None,
        }
    }

    /// The line along the normal of a plate, from a place of the tip \[m\].
    fn up_from(plate: &Plate, from: Vector3<f64>, length: f64) -> Self {
        let along = plate.normal_at(&from);
        Self::Line { from, along, length }
    }

    /// The last θ; the first is 0.
    pub fn end(&self) -> f64 {
        match self {
            Self::Line { length, .. } => *length,
            Self::Wash { curve, .. } => curve.end(),
        }
    }

    /// Position and first derivative at θ.
    pub fn at(&self, theta: f64) -> [Vector3<f64>; 2] {
        match self {
            Self::Line { from, along, .. } => [from + along * theta, *along],
            Self::Wash { face, curve } => face.on(curve, theta),
        }
    }

    /// Upper bound on sup ‖γ″‖ of formula (22.1), the second derivative by θ between two θ: [`WashCurve::greatest_second`].
    pub fn bend(&self, between: [f64; 2]) -> f64 {
        match self {
            Self::Line { .. } => 0.0,
            Self::Wash { face, curve } => curve.greatest_second(face.surface(), between),
        }
    }

    /// θ of a point of the curve near `p`, from `least` to `most`, sought from `guess` on.
    pub fn nearest(&self, p: &Vector3<f64>, guess: f64, [least, most]: [f64; 2]) -> f64 {
        let most_step = match self {
            Self::Line { .. } => f64::INFINITY,
            Self::Wash { .. } => 0.5,
        };
        let mut theta = guess.clamp(least, most);
        for _ in 0..STEPS {
            let [there, first] = self.at(theta);
            let step = (p - there).dot(&first) / first.norm_squared();
            if !step.is_finite() {
                break;
            }
            let next = (theta + step.clamp(-most_step, most_step)).clamp(least, most);
            if (next - theta).abs() <= 1e-13 {
                return next;
            }
            theta = next;
        }
        theta
    }
}

#[cfg(test)]
mod tests {
    use super::in_order;
    use proptest::prelude::*;

    proptest! {
        /// If a later value is less than an earlier one, one of them must move by half the difference: no non-decreasing sequence is nearer
        /// than the greatest such half.
        #[test]
        fn sorting_moves_values_by_half_the_greatest_fall(values in prop::collection::vec(-3.0..3.0f64, 1..40)) {
            let ordered = in_order(values.clone());
            prop_assert!(ordered.is_sorted());
            let moved = values.iter().zip(&ordered).map(|(v, o)| (v - o).abs()).fold(0.0, f64::max);
            let falls = (0..values.len()).flat_map(|i| values[i..].iter().map(move |later| (i, later)));
            let fall = falls.map(|(i, later)| values[i] - later).fold(0.0, f64::max);
            prop_assert!((moved - 0.5 * fall).abs() < 1e-12, "{moved} {fall}");
        }

        #[test]
        fn sorted_values_stay_unchanged(mut values in prop::collection::vec(-3.0..3.0f64, 1..40)) {
            values.sort_unstable_by(f64::total_cmp);
            prop_assert_eq!(in_order(values.clone()), values);
        }
    }

    #[test]
    fn accepts_empty_input_and_nan() {
        assert!(in_order(Vec::new()).is_empty());
        assert_eq!(in_order(vec![0.0, f64::NAN, 1.0]).len(), 3);
    }
}
