//! What every analytic peer leaves to its user: limits, whole turns, and which of the solutions.

use platewash_kinematics::{AXES, JointLimits, JointVector};
use std::f64::consts::TAU;

/// Of the solutions within the limits, whole turns added, the one nearest to `start` (Euclidean over the joints) \[rad\].
pub fn nearest_within(
    limits: &JointLimits,
    solutions: impl IntoIterator<Item = [f64; AXES]>,
    start: &JointVector,
) -> Option<JointVector> {
    let within = solutions.into_iter().filter_map(|q| towards(limits, &q, start));
    within.min_by(|a, b| (a - start).norm_squared().total_cmp(&(b - start).norm_squared()))
}

/// The solution with every joint turned by whole turns towards `start`, as far as the limits allow.
fn towards(limits: &JointLimits, solution: &[f64; AXES], start: &JointVector) -> Option<JointVector> {
    let q = JointVector::from_fn(|i, _| {
        let nearest = solution[i] + TAU * ((start[i] - solution[i]) / TAU).round();
        if nearest > limits.upper[i] {
            nearest - TAU
        } else if nearest < limits.lower[i] {
            nearest + TAU
        } else {
            nearest
        }
    });
    limits.contain(&q).then_some(q)
}
