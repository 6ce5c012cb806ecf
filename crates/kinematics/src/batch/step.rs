//! The pose error and the damped step of four inverse-kinematics problems at once: the equations of [`crate::ik`],
//! lane by lane.

use crate::batch::forward::{Line, Tips, cross, dot, moment};
use crate::ik::dls::{DAMPING_GAIN, LEAST_DAMPING};
use crate::joints::AXES;
use crate::lanes::Vector;

/// Cosine of the error angle (0.5 rad) below which a lane is left to the scalar solver.
pub(crate) const LEAST_COSINE: f64 = 0.877_582_561_890_372_8;

/// Pose errors.
pub(crate) struct Errors<V> {
    /// Linear error `p* − p` \[m\], base axes.
    pub linear: [V; 3],
    /// Angular error `log(R* Rᵀ)` \[rad\], base axes; meaningless if `cosine` is below [`LEAST_COSINE`].
    pub angular: [V; 3],
    /// Squared linear error `‖p* − p‖²` \[m²\].
    pub position: V,
    /// Squared error angle \[rad²\].
    pub angle: V,
    /// Cosine of the error angle.
    pub cosine: V,
}

/// Computes the errors of `tips` against `targets`.
///
/// With v = sin θ · axis, the skew part of `R* Rᵀ = Σ r*_k r_kᵀ` over the columns, and t = tan(θ/2) = sin θ / (1 + cos θ), the
/// rotation vector is `v · 2 arctan(t) / (t (1 + cos θ))`.
#[inline(always)]
pub(crate) fn errors<V: Vector>(targets: &Tips<V>, tips: &Tips<V>) -> Errors<V> {
    let (x, y, z) = (
        cross(&tips.x, &targets.x),
        cross(&tips.y, &targets.y),
        cross(&tips.z, &targets.z),
    );
    let twice_sine = [x[0] + y[0] + z[0], x[1] + y[1] + z[1], x[2] + y[2] + z[2]];
    let trace = dot(&tips.x, &targets.x) + dot(&tips.y, &targets.y) + dot(&tips.z, &targets.z);
    let one = V::splat(1.0);
    // tr R = 1 + 2 cos θ, hence 2 (1 + cos θ) = tr R + 1.
    let inverse = one / (trace + one);
    let square = dot(&twice_sine, &twice_sine);
    let factor = (inverse + inverse) * arctan_over(square * (inverse * inverse));
    let (p, s) = (&tips.p, &targets.p);
    let linear = [s[0] - p[0], s[1] - p[1], s[2] - p[2]];
    Errors {
        linear,
        angular: [factor * twice_sine[0], factor * twice_sine[1], factor * twice_sine[2]],
        position: dot(&linear, &linear),
        angle: square * (factor * factor),
        cosine: (trace - one) * V::splat(0.5),
    }
}

/// Returns arctan(t)/t as a function of t², for |t| ≤ tan(0.25): `Σ (−t²)ᵏ/(2k + 1)`, cut where a term is below 1e-13.
#[inline(always)]
fn arctan_over<V: Vector>(square: V) -> V {
    let mut sum = V::splat(1.0 / 21.0);
    for odd in [19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        sum = square.neg_mul_add(sum, V::splat(1.0 / odd));
    }
    sum
}

/// Bounds on the steps of all lanes.
pub(crate) struct Bounds {
    /// Largest joint step \[rad\].
    pub step_rad: f64,
    /// Lower joint limits \[rad\].
    pub lower: [f64; AXES],
    /// Upper joint limits \[rad\].
    pub upper: [f64; AXES],
}

/// Computes the damped step `Δq = (JᵀJ + λI)⁻¹ Jᵀ e` \[rad\].
#[inline(always)]
pub(crate) fn damped_step<V: Vector>(p: &[V; 3], lines: &[Line<V>; AXES], e: &Errors<V>) -> [V; AXES] {
    let cost = e.position + e.angle;
    let lambda = larger(V::splat(DAMPING_GAIN) * cost, V::splat(LEAST_DAMPING));
    let zero = V::splat(0.0);
    let (mut normal, mut gradient, mut moments) = ([[zero; AXES]; AXES], [zero; AXES], [[zero; 3]; AXES]);
    for i in 0..AXES {
        moments[i] = moment(&lines[i], p);
        gradient[i] = dot(&moments[i], &e.linear) + dot(&lines[i].axis, &e.angular);
    }
    normal_row::<V, 0>(&mut normal, &moments, lines, lambda);
    normal_row::<V, 1>(&mut normal, &moments, lines, lambda);
    normal_row::<V, 2>(&mut normal, &moments, lines, lambda);
    normal_row::<V, 3>(&mut normal, &moments, lines, lambda);
    normal_row::<V, 4>(&mut normal, &moments, lines, lambda);
    normal_row::<V, 5>(&mut normal, &moments, lines, lambda);
    solve(normal, gradient)
}

/// Computes row I of the normal matrix up to its diagonal. The row is a constant, as are J below, so that the compiler unrolls the loops.
#[inline(always)]
fn normal_row<V: Vector, const I: usize>(
    normal: &mut [[V; AXES]; AXES],
    moments: &[[V; 3]; AXES],
    lines: &[Line<V>; AXES],
    lambda: V,
) {
    let (m, z) = (&moments[I], &lines[I].axis);
    for k in 0..I {
        normal[I][k] = dot(m, &moments[k]) + dot(z, &lines[k].axis);
    }
    normal[I][I] = dot(m, m) + (dot(z, z) + lambda);
}

/// Returns `q + Δq`, shortened to the step bound and clamped to the limits, and the number of steps in a row that a limit cut.
#[inline(always)]
pub(crate) fn moved<V: Vector>(bounds: &Bounds, mut q: [V; AXES], dq: &[V; AXES], clamped: V) -> ([V; AXES], V) {
    let (zero, one) = (V::splat(0.0), V::splat(1.0));
    let mut largest = zero;
    for d in dq {
        largest = larger(larger(*d, zero - *d), largest);
    }
    let bound = V::splat(bounds.step_rad);
    let gain = largest.if_above(bound, bound / largest, one);
    let mut streak = zero;
    for i in 0..AXES {
        let aim = q[i] + gain * dq[i];
        let (lower, upper) = (V::splat(bounds.lower[i]), V::splat(bounds.upper[i]));
        streak = lower.if_above(aim, one, aim.if_above(upper, one, streak));
        q[i] = lower.if_above(aim, lower, aim.if_above(upper, upper, aim));
    }
    (q, streak * (clamped + one))
}

/// Returns the larger one; the second if either is NaN.
#[inline(always)]
fn larger<V: Vector>(a: V, b: V) -> V {
    a.if_above(b, a, b)
}

/// Solves `A x = b` by LDLᵀ from A's lower triangle, as the scalar solver does it, but without its test of the pivots: an invalid step does
/// not lower the error, and the lane is then given up.
#[inline(always)]
fn solve<V: Vector>(mut a: [[V; AXES]; AXES], mut x: [V; AXES]) -> [V; AXES] {
    let mut inverse = x;
    eliminate::<V, 0>(&mut a, &mut x, &mut inverse);
    eliminate::<V, 1>(&mut a, &mut x, &mut inverse);
    eliminate::<V, 2>(&mut a, &mut x, &mut inverse);
    eliminate::<V, 3>(&mut a, &mut x, &mut inverse);
    eliminate::<V, 4>(&mut a, &mut x, &mut inverse);
    eliminate::<V, 5>(&mut a, &mut x, &mut inverse);
    substitute::<V, 5>(&a, &mut x, &inverse);
    substitute::<V, 4>(&a, &mut x, &inverse);
    substitute::<V, 3>(&a, &mut x, &inverse);
    substitute::<V, 2>(&a, &mut x, &inverse);
    substitute::<V, 1>(&a, &mut x, &inverse);
    substitute::<V, 0>(&a, &mut x, &inverse);
    x
}

/// Eliminates unknown J from the equations after it.
#[inline(always)]
fn eliminate<V: Vector, const J: usize>(a: &mut [[V; AXES]; AXES], x: &mut [V; AXES], inverse: &mut [V; AXES]) {
    inverse[J] = V::splat(1.0) / a[J][J];
    for i in J + 1..AXES {
        let scaled = a[i][J] * inverse[J];
        for k in J + 1..i + 1 {
            a[i][k] = scaled.neg_mul_add(a[k][J], a[i][k]);
        }
        x[i] = scaled.neg_mul_add(x[J], x[i]);
    }
}

/// Computes unknown J from those after it.
#[inline(always)]
fn substitute<V: Vector, const J: usize>(a: &[[V; AXES]; AXES], x: &mut [V; AXES], inverse: &[V; AXES]) {
    for i in J + 1..AXES {
        x[J] = a[i][J].neg_mul_add(x[i], x[J]);
    }
    x[J] = x[J] * inverse[J];
}
