//! The inverse functions: one division, one short polynomial and a table of angles.

use crate::lanes::Vector;
use crate::trig::sin_cos::{SIGN, polynomial};
use std::f64::consts::{FRAC_PI_2, PI};

/// Bounds of the fast path: the larger of |x|, |y| at least the first, their sum at most the second, so that
/// nothing under- or overflows on the way (2⁻⁹⁰⁰ and 2¹⁰⁰⁰).
const SMALL: f64 = f64::from_bits((1023 - 900) << 52);
const LARGE: f64 = f64::from_bits((1023 + 1000) << 52);

/// Factors 2²⁰⁰ and 2⁻¹⁰⁰ that bring a pair outside these bounds back between them.
const UP: f64 = f64::from_bits((1023 + 200) << 52);
const DOWN: f64 = f64::from_bits((1023 - 100) << 52);

/// Tangents of the angles that the first octant is turned back by; five bits each, so that products with 48 bits are exact. The last three
/// only fill the table to a power of two.
const TANGENTS: [f64; 8] = [0.0, 3.0 / 16.0, 11.0 / 32.0, 9.0 / 16.0, 27.0 / 32.0, 0.0, 0.0, 0.0];

/// Ratios from which on the next entry of [`TANGENTS`] is used: the rest is a tangent of at most 1/8.
const STEPS: [f64; 4] = [0.125, 0.27, 0.45, 0.6953125];

/// β ± arctan of [`TANGENTS`] as a double and the rest, for the four octant pairs: 0 +, π/2 −, π −, π/2 +.
const ANGLES: [[(f64, f64); 8]; 4] = [
    [
        (0.0, 0.0),
        (0.18534794999569476, 4.180692268843079e-18),
        (0.3310960767041321, -7.952610375793799e-18),
        (0.5123894603107377, -2.5462781472855804e-17),
        (0.7008544078844502, -1.987626234335816e-17),
        NONE,
        NONE,
        NONE,
    ],
    [
        (FRAC_PI_2, 6.123233995736766e-17),
        (1.3854483767992019, 1.540496457266753e-18),
        (1.2397002500907646, -4.18373521293542e-17),
        (1.0584068664841588, 8.669512143022346e-17),
        (0.8699419189104465, -2.991370016178983e-17),
        NONE,
        NONE,
        NONE,
    ],
    [
        (PI, 1.2246467991473532e-16),
        (2.9562447035940984, 6.277283641463441e-17),
        (2.810496576885661, 1.939498781801346e-17),
        (2.6292031932790554, 1.4792746138759113e-16),
        (2.4407382457053433, -1.9072596512945349e-16),
        NONE,
        NONE,
        NONE,
    ],
    [
        (FRAC_PI_2, 6.123233995736766e-17),
        (1.7561442767905915, -1.0112042146756275e-16),
        (1.9018924034990288, -5.774257288094179e-17),
        (2.0831857871056343, 3.5769558484511857e-17),
        (2.271650734679347, -6.966622484850616e-17),
        NONE,
        NONE,
        NONE,
    ],
];
const NONE: (f64, f64) = (0.0, 0.0);

/// (arctan t − t)/t³ in powers of t²: minimax for the relative error of arctan t on |t| ≤ 1/8, 2⁻⁵⁸·⁹.
const ARCTAN: [f64; 6] = [
    -0.3333333333333257,
    0.19999999999048965,
    -0.1428571389067424,
    0.11111035615435179,
    -0.09083601564310187,
    0.07342698845541705,
];

/// Angle of the vector (x, y) in [−π, π] \[rad\].
///
/// Range: every pair of doubles, with the special cases of IEEE 754: the sign of the answer is that of `y`, zeros
/// included; `atan2(±0, x < 0 or −0)` = ±π; infinities count as equal in size; NaN in, NaN out. Same bits on every
/// machine.
///
/// Accuracy: at most 1.5 ulp (largest of 8·10⁷ random pairs: 1.48, at |y/x| just above 1/8; elsewhere 1.37).
///
/// Method: with a ≤ b the smaller and larger of |x|, |y| and c one of five tangents near a/b,
/// arctan(a/b) = arctan c + arctan((a − c b)/(b + c a)). The numerator is exact but for its last rounding, because
/// c has few bits and b is split; the argument left is at most 1/8 and takes an odd polynomial of degree 13 (own Remez
/// exchange, `tests/fixtures/trig.py coefficients`). arctan c and the octant's π/2 or π come together from a table in
/// twice the precision. The idea of the few exact tangents is that of fdlibm's `atan`.
#[inline]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let larger = if ax > ay { ax } else { ay };
    if larger >= SMALL && ax + ay <= LARGE {
        fast_atan2(y, x)
    } else {
        extraordinary(y, x)
    }
}

/// The fast path, without a branch.
#[inline(always)]
fn fast_atan2(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let a = if ax < ay { ax } else { ay };
    let b = if ax > ay { ax } else { ay };
    let (steep, backward) = (ay > ax, x.is_sign_negative());

    let step: usize = STEPS.iter().map(|s| usize::from(a > s * b)).sum();
    let c = TANGENTS[step & 7];
    let b_high = f64::from_bits(b.to_bits() & !0x3F);
    let tangent = ((a - c * b_high) - c * (b - b_high)) / (b + c * a);

    let turn = u64::from(steep ^ backward) << 63;
    let t = f64::from_bits(tangent.to_bits() ^ turn);
    let z = t * t;
    let bend = t * z * polynomial(&ARCTAN, z, z * z);
    let (high, low) = ANGLES[usize::from(steep) + 2 * usize::from(backward)][step & 7];
    let angle = high + (t + (bend + low));
    f64::from_bits(angle.to_bits() ^ (y.to_bits() & SIGN))
}

/// Angles of the vectors (x, y) lane by lane, with the bits of [`atan2`].
#[inline(always)]
pub(crate) fn atan2_vector<V: Vector>(y: V, x: V) -> V {
    let (zero, sign) = (V::splat(0.0), V::splat(-0.0));
    let (y_sign, x_sign) = (y.and(sign), x.and(sign));
    let (ax, ay) = (x.xor(x_sign), y.xor(y_sign));
    let larger = ax.if_above(ay, ax, ay);
    if !(V::splat(SMALL).at_most(larger).and((ax + ay).at_most(V::splat(LARGE)))).sign_bits() & 0b1111 != 0 {
        return one_by_one(y, x);
    }
    let a = ay.if_above(ax, ax, ay);
    let b = larger;
    // Eight angles in a row for each pair of octants.
    let steep = ay.if_above(ax, V::splat(8.0), zero);
    let (mut c, mut row) = (
        zero,
        steep + x_sign.if_sign_bit(V::splat(16.0 + WHOLE), V::splat(WHOLE)),
    );
    for k in 0..STEPS.len() {
        let from = V::splat(STEPS[k]) * b;
        c = a.if_above(from, V::splat(TANGENTS[k + 1]), c);
        row = row + a.if_above(from, V::splat(1.0), zero);
    }
    let b_high = b.and(V::splat(f64::from_bits(!0x3F)));
    let tangent = ((a - c * b_high) - c * (b - b_high)) / (b + c * a);

    let turn = ay.if_above(ax, sign, zero).xor(x_sign);
    let t = tangent.xor(turn);
    let z = t * t;
    let bend = t * z * polynomial(&ARCTAN, z, z * z);
    let [i, j, k, l] = row.to_array();
    let (i, j, k, l) = (angle_in(i), angle_in(j), angle_in(k), angle_in(l));
    let high = V::from_array([i.0, j.0, k.0, l.0]);
    let low = V::from_array([i.1, j.1, k.1, l.1]);
    (high + (t + (bend + low))).xor(y_sign)
}

/// Constant 2⁵²: the last bits of its sum with a small whole number are that number.
const WHOLE: f64 = f64::from_bits((1023 + 52) << 52);

/// Entry of [`ANGLES`], all rows in one, whose number is in the last bits.
#[inline(always)]
fn angle_in(row: f64) -> (f64, f64) {
    ANGLES.as_flattened()[(row.to_bits() & 31) as usize]
}

/// Slow path for lanes of which one at least is extraordinary.
#[cold]
fn one_by_one<V: Vector>(y: V, x: V) -> V {
    let ([a, b, c, d], [e, f, g, h]) = (y.to_array(), x.to_array());
    V::from_array([atan2(a, e), atan2(b, f), atan2(c, g), atan2(d, h)])
}

/// Slow path for a pair that is not finite, both zero, or so large or small that the fast path would over- or underflow.
#[cold]
#[inline(never)]
fn extraordinary(y: f64, x: f64) -> f64 {
    if x.is_nan() || y.is_nan() {
        return f64::NAN;
    }
    let unit = |v: f64, is: bool| if is { 1.0_f64.copysign(v) } else { 0.0_f64.copysign(v) };
    if x.is_infinite() || y.is_infinite() {
        return fast_atan2(unit(y, y.is_infinite()), unit(x, x.is_infinite()));
    }
    if x == 0.0 && y == 0.0 {
        return fast_atan2(y, unit(x, true));
    }
    // Powers of two: exact, or the smaller one is lost beside the larger anyway.
    let scale = if x.abs() + y.abs() > 1.0 { DOWN } else { UP };
    fast_atan2(y * scale, x * scale)
}
