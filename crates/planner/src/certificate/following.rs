//! The tip follows its curve: all of it, in order, and never farther away than the tolerance.
//!
//! To every moment belongs a parameter θ(t) that starts at 0, never falls and ends at the curve's end; between two moments a
//! and b it runs evenly. The deviation e(t) = p(t) − c(θ(t)) then keeps
//! ‖e‖ ≤ max(‖e(a)‖, ‖e(b)‖) + h²/8 · sup ‖p̈‖ + Δθ²/8 · sup ‖c″‖. Which θ is chosen at a moment (the nearest point's)
//! decides how tight this is, and nothing else.

use super::curve::Curve;
use super::piece::Piece;
use super::tip::{Arm, Moment, Stretch};
use super::watch::Watch;

/// A stretch with the curve's parameters at its ends.
#[derive(Debug, Clone, Copy)]
struct Leg<'a> {
    stretch: Stretch<'a>,
    theta: [f64; 2],
}

/// Bounds how far the tip leaves a curve during some pieces.
pub(super) fn follow(arm: &Arm<'_>, pieces: &[Piece], curve: &Curve, watch: &mut Watch) {
    let mut theta = Vec::with_capacity(pieces.len());
    let (mut last, end) = (0.0, curve.end());
    for (i, piece) in pieces.iter().enumerate() {
        let stretch = arm.stretch(piece);
        let next = if i + 1 == pieces.len() {
            end
        } else {
            curve.nearest(&stretch.ends[1].position, last, [last, end])
        };
        let leg = Leg {
            stretch,
            theta: [last, next],
        };
        for (k, time_s) in stretch.times().into_iter().enumerate() {
            watch.see(deviation(curve, &leg, k), time_s, &stretch.ends[k]);
        }
        theta.push(leg.theta);
        last = next;
    }
    for (piece, theta) in pieces.iter().zip(theta) {
        let stretch = arm.stretch(piece);
        refine(arm, curve, &Leg { stretch, theta }, watch, 0);
    }
}

fn refine(arm: &Arm<'_>, curve: &Curve, leg: &Leg<'_>, watch: &mut Watch, depth: u32) {
    let [from, to] = [0, 1].map(|k| deviation(curve, leg, k));
    let greater = if from > to || from.is_nan() { from } else { to };
    let advance = leg.theta[1] - leg.theta[0];
    let bend = 0.125 * advance * advance * curve.bend(leg.theta[1]);
    let bound = greater + leg.stretch.sag(arm.derivatives(&leg.stretch).second()) + bend;
    if watch.accepts(bound) || !watch.may_split(depth) {
        return watch.take(bound);
    }
    let Some([first, second]) = arm.halves(&leg.stretch) else {
        return watch.take(bound);
    };
    let there: Moment = first.ends[1];
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
    watch.see(deviation(curve, &halves[0], 1), first.times()[1], &there);
    for half in &halves {
        refine(arm, curve, half, watch, depth + 1);
    }
}

/// Deviation at an end of a leg \[m\].
fn deviation(curve: &Curve, leg: &Leg<'_>, end: usize) -> f64 {
    (leg.stretch.ends[end].position - curve.at(leg.theta[end])[0]).norm()
}
