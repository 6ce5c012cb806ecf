//! Sine and cosine together: three-part reduction by π/2, then one polynomial each, without a branch.

use crate::lanes::{Number, Vector};

/// Largest |angle| \[rad\] of the fast path. Up to here a quadrant number has at most 16 bits, so that its products with [`HALF_PI_HIGH`]
/// and [`HALF_PI_MIDDLE`] (37 bits each) are exact.
const BOUND: f64 = 1e5;

/// Constant 1.5 · 2⁵²: adding it rounds to the nearest integer, which is then in the last bits of the sum.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

// π/2 = HIGH + MIDDLE + LOW + 2⁻¹³⁰·0.7.
const HALF_PI_HIGH: f64 = f64::from_bits(0x3FF9_21FB_5444_0000);
const HALF_PI_MIDDLE: f64 = f64::from_bits(0x3D86_8C23_4C4C_0000);
const HALF_PI_LOW: f64 = f64::from_bits(0x3B29_8A2E_0370_7345);

/// (sin r − r)/r³ in powers of r²: minimax for the relative error of sin r on |r| ≤ π/4, 2⁻⁵⁷·⁹.
const SIN: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.0001984126982935851,
    2.7557313538498483e-6,
    -2.5050734385276395e-8,
    1.5895432973634764e-10,
];

/// (cos r − 1 + r²/2)/r⁴ in powers of r²: minimax for the relative error of cos r on |r| ≤ π/4, 2⁻⁶³·⁹.
const COS: [f64; 6] = [
    0.041666666666666595,
    -0.0013888888888873342,
    2.4801587289002076e-5,
    -2.755731421703596e-7,
    2.0875705395290323e-9,
    -1.1358749181413677e-11,
];

/// The sign bit of a double.
pub(crate) const SIGN: u64 = 1 << 63;

/// Sine and cosine of an angle \[rad\].
///
/// Range: every double; NaN and ±∞ give (NaN, NaN). sin(−x) = −sin x and cos(−x) = cos x bit for bit, ±0 and
/// tiny angles come back as their own sine. Same bits on every machine.
///
/// Accuracy for |angle| ≤ 10⁵: at most 0.85 ulp for both (largest of 8·10⁷ random angles: 0.83; of those
/// below 10 rad: 0.80). Beyond it the
/// function is `libm::sincos`, below 1 ulp and slower.
///
/// Method: with n the integer nearest to 2x/π, r + t = x − n π/2 is formed from three parts of π/2 (W. J. Cody,
/// W. Waite, *Software Manual for the Elementary Functions*, 1980), r rounded and t its rounding error, to 2⁻⁶⁰
/// relative; sin and cos of r + t are odd and even polynomials of degree 13 and 14, and the last two bits of n
/// choose and sign the answers. The coefficients are this project's own: Remez exchange in 240-bit arithmetic,
/// rounded one after another (`tests/fixtures/trig.py coefficients`).
#[inline]
#[must_use]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() <= BOUND {
        one_lane(angle)
    } else {
        beyond_bound(angle)
    }
}

/// Sine of an angle \[rad\]: the first of [`sin_cos`], bit for bit.
#[inline]
#[must_use]
pub fn sin(angle: f64) -> f64 {
    sin_cos(angle).0
}

/// Cosine of an angle \[rad\]: the second of [`sin_cos`], bit for bit.
#[inline]
#[must_use]
pub fn cos(angle: f64) -> f64 {
    sin_cos(angle).1
}

/// Sines and cosines of `N` angles \[rad\], the formula of [`sin_cos`] in a form that the compiler turns into
/// vector instructions.
///
/// Each lane has the bits of [`sin_cos`]. A lane beyond the bound of the fast path, or not finite, is computed as [`sin_cos`] does.
#[inline(always)]
#[must_use]
pub fn sin_cos_lanes<const N: usize>(angles: &[f64; N]) -> ([f64; N], [f64; N]) {
    let (mut sines, mut cosines) = ([0.0; N], [0.0; N]);
    let mut inside = true;
    for ((&angle, s), c) in angles.iter().zip(&mut sines).zip(&mut cosines) {
        inside &= angle.abs() <= BOUND;
        (*s, *c) = one_lane(angle);
    }
    if !inside {
        recompute_lanes(angles, &mut sines, &mut cosines);
    }
    (sines, cosines)
}

/// Sines and cosines of the angles \[rad\] in a vector: the bits of [`sin_cos`], or within 2⁻⁵² of them where the vector fuses products and sums.
#[inline(always)]
pub(crate) fn sin_cos_vector<V: Vector>(angles: V) -> (V, V) {
    let sign_bit = V::splat(-0.0);
    let sign = angles.and(sign_bit);
    let positive = angles.xor(sign);
    let (sin, cos, quadrant) = first_quadrant(positive);

    // Quadrant q turns (sin, cos) by q·π/2.
    let (odd, upper) = (quadrant.shift_left::<63>(), quadrant.shift_left::<62>());
    let turned_sin = odd.if_sign_bit(cos, sin);
    let turned_cos = odd.if_sign_bit(sin, cos);
    let sines = turned_sin.xor(upper.xor(sign).and(sign_bit));
    let cosines = turned_cos.xor(upper.xor(odd).and(sign_bit));
    if positive.all_at_most(BOUND) {
        return (sines, cosines);
    }
    let (mut sines, mut cosines) = (sines.to_array(), cosines.to_array());
    recompute_lanes(&angles.to_array(), &mut sines, &mut cosines);
    (V::from_array(sines), V::from_array(cosines))
}

/// Sine and cosine of angle − n π/2, with n the nearest integer, and a number whose last bits are those of n. The angle is from 0 to
/// [`BOUND`]; elsewhere the answer is meaningless.
#[inline(always)]
fn first_quadrant<V: Number>(angle: V) -> (V, V, V) {
    let rounded = angle.mul_add(V::splat(std::f64::consts::FRAC_2_PI), V::splat(ROUNDER));
    let n = rounded - V::splat(ROUNDER);
    // r + tail = angle − n π/2 with |r| ≤ π/4 and |tail| at most half a unit in r's last place. Exact: both products fit, and the two
    // differences cancel or leave their error in `lost`.
    let first = n.mul_add(V::splat(-HALF_PI_HIGH), angle);
    let middle = V::splat(-HALF_PI_MIDDLE);
    let second = n.mul_add(middle, first);
    let lost = n.mul_add(middle, first - second);
    let low = n.mul_sub(V::splat(HALF_PI_LOW), lost);
    let r = second - low;
    let tail = (second - r) - low;

    let z = r * r;
    let z2 = z * z;
    // cos r = w + (what rounding took from w) + …, with w = 1 − r²/2.
    let half = V::splat(0.5) * z;
    let w = V::splat(1.0) - half;
    let rest = r.neg_mul_add(tail, (V::splat(1.0) - w) - half);
    let cos = w + z2.mul_add(polynomial(&COS, z, z2), rest);
    // The derivative of sin r is cos r ≈ w.
    let sin = r + (r * z).mul_add(polynomial(&SIN, z, z2), tail * w);
    (sin, cos, rounded)
}

/// Returns c₀ + c₁z + … + c₅z⁵, in pairs to shorten the chain of dependent operations (G. Estrin, 1960).
#[inline(always)]
pub(crate) fn polynomial<V: Number>(c: &[f64; 6], z: V, z2: V) -> V {
    let pair = |k: usize| z.mul_add(V::splat(c[k + 1]), V::splat(c[k]));
    z2.mul_add(z2.mul_add(pair(4), pair(2)), pair(0))
}

/// The fast path, for |angle| ≤ [`BOUND`]; elsewhere the answer is meaningless.
#[inline(always)]
fn one_lane(angle: f64) -> (f64, f64) {
    let sign = angle.to_bits() & SIGN;
    let (sin, cos, quadrant) = first_quadrant(angle.abs());

    // Quadrant q turns (sin, cos) by q·π/2.
    let (sin, cos, quadrant) = (sin.to_bits(), cos.to_bits(), quadrant.to_bits());
    // Masks instead of branches, and no check for overflow: either would keep the lanes from becoming vectors.
    let swap = (sin ^ cos) & 0_u64.wrapping_sub(quadrant & 1);
    let sin_sign = (quadrant << 62) & SIGN;
    let cos_sign = (quadrant.wrapping_add(1) << 62) & SIGN;
    (
        f64::from_bits(sin ^ swap ^ sin_sign ^ sign),
        f64::from_bits(cos ^ swap ^ cos_sign),
    )
}

/// Slow path: large angles by Payne and Hanek's method in the `libm` crate; NaN for angles that are not finite.
#[cold]
#[inline(never)]
fn beyond_bound(angle: f64) -> (f64, f64) {
    if angle.is_finite() {
        libm::sincos(angle)
    } else {
        (f64::NAN, f64::NAN)
    }
}

/// Replaces the lanes that the fast path cannot compute.
#[cold]
#[inline(never)]
fn recompute_lanes(angles: &[f64], sines: &mut [f64], cosines: &mut [f64]) {
    for ((&angle, s), c) in angles.iter().zip(sines).zip(cosines) {
        (*s, *c) = if angle.abs() <= BOUND {
            (*s, *c)
        } else {
            beyond_bound(angle)
        };
    }
}
