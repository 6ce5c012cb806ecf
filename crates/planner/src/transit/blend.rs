//! A quintic from one state of the joints to another: C² where it joins what comes before and after.

use crate::joint_path::PathState;
use platewash_kinematics::JointVector;

/// Quintic with given states at both ends of [0, length]; at `share` of it, in [0, 1].
///
/// In `s = u / length`, with `v = length · first` and `w = length² · second` (Hermite form; Farin, *Curves and Surfaces for
/// CAGD*, ch. 7): the value is `Σ H_k(s) · (q₀, v₀, w₀, w₁, v₁, q₁)`.
pub(super) fn quintic(from: &PathState, to: &PathState, length: f64, share: f64) -> JointVector {
    let s = share;
    let (s2, t) = (s * s, 1.0 - s);
    let (s3, t2) = (s2 * s, t * t);
    let t3 = t2 * t;
    let (v, w) = (length, length * length);
    from.q * (t3 * (1.0 + 3.0 * s + 6.0 * s2))
        + from.first * (v * t3 * s * (1.0 + 3.0 * s))
        + from.second * (w * t3 * s2 * 0.5)
        + to.second * (w * s3 * t2 * 0.5)
        - to.first * (v * s3 * t * (1.0 + 3.0 * t))
        + to.q * (s3 * (1.0 + 3.0 * t + 6.0 * t2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn joints() -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from)
    }

    fn states() -> impl Strategy<Value = PathState> {
        (joints(), joints(), joints()).prop_map(|(q, first, second)| PathState { q, first, second })
    }

    proptest! {
        #[test]
        fn the_ends_are_met_with_both_derivatives(a in states(), b in states(), length in 0.1..3.0f64) {
            let at = |u: f64| quintic(&a, &b, length, u / length);
            let h = 1e-4 * length;
            for (end, state, h) in [(0.0, a, h), (length, b, -h)] {
                let q: Vec<_> = (0..4).map(|k| at(end + h * f64::from(k))).collect();
                prop_assert!((q[0] - state.q).amax() < 1e-12);
                let first = (q[0] * -11.0 + q[1] * 18.0 - q[2] * 9.0 + q[3] * 2.0) / (6.0 * h);
                prop_assert!((first - state.first).amax() < 1e-6 * (1.0 + 1.0 / length));
                let second = (q[0] * 2.0 - q[1] * 5.0 + q[2] * 4.0 - q[3]) / (h * h);
                prop_assert!((second - state.second).amax() < 1e-2 * (1.0 + 1.0 / (length * length)), "{second}");
            }
        }
    }
}
