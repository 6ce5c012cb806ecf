//! Inverse cosine and sine: one polynomial on [0, 1/2] and a square root, without a branch.

use crate::trig::sin_cos::SIGN;
use crate::trig::sin_cos::polynomial;
use std::f64::consts::FRAC_PI_2;

/// (arcsin s − s)/s³ in powers of s², terms 0–5: minimax for the relative error of arcsin s on |s| ≤ 1/2, 2⁻⁵⁵·⁸.
const LOW: [f64; 6] = [
    0.16666666666665408,
    0.07500000000337143,
    0.04464285682821382,
    0.03038195914198531,
    0.022371757924531905,
    0.01735970672858693,
];

/// Terms 6–11.
const HIGH: [f64; 6] = [
    0.013885215519132837,
    0.01216934579113571,
    0.006527380604661385,
    0.019529938302516935,
    -0.016226962656186682,
    0.0319141942135886,
];

/// π/2 as a double, and the remainder.
const HALF_PI: (f64, f64) = (FRAC_PI_2, 6.123233995736766e-17);

/// arccos x = β + f·arcsin s, as (β, rest of β, f), indexed by (|x| > 1/2) and, in steps of two, (x < 0).
const COSINE: [(f64, f64, f64); 4] = [
    (HALF_PI.0, HALF_PI.1, -1.0),
    (0.0, 0.0, 2.0),
    (HALF_PI.0, HALF_PI.1, 1.0),
    (2.0 * HALF_PI.0, 2.0 * HALF_PI.1, -2.0),
];

/// arcsin |x| = β + f·arcsin s, as (β, rest of β, f), indexed by (|x| > 1/2).
const SINE: [(f64, f64, f64); 2] = [(0.0, 0.0, 1.0), (HALF_PI.0, HALF_PI.1, -2.0)];

/// Angle in [0, π] with the given cosine \[rad\]; the argument is clamped to [−1, 1] against rounding, NaN stays NaN.
///
/// Accuracy: at most 1.3 ulp (largest of 4·10⁷ random arguments: 1.25), near ±1 as well. Same bits on every machine.
///
/// Method: arcsin s = s + s³ P(s²) for s = |x| up to 1/2, beyond it arcsin |x| = π/2 − 2 arcsin √((1 − |x|)/2), where
/// 1 − |x| is exact. Coefficients by this project's Remez exchange (`tests/fixtures/trig.py coefficients`).
#[inline]
#[must_use]
pub fn acos(cosine: f64) -> f64 {
    if cosine.is_nan() {
        return f64::NAN;
    }
    let (large, s, bend) = first_third(cosine.abs());
    combine(COSINE[usize::from(large) + 2 * usize::from(cosine < 0.0)], s, bend)
}

/// Angle in [−π/2, π/2] with the given sine \[rad\]; the argument is clamped to [−1, 1] against rounding, NaN stays
/// NaN and ±0 is kept.
///
/// Accuracy: at most 1.3 ulp (largest of 4·10⁷ random arguments: 1.25), near ±1 as well. Method: see [`acos`].
#[inline]
#[must_use]
pub fn asin(sine: f64) -> f64 {
    if sine.is_nan() {
        return f64::NAN;
    }
    let (large, s, bend) = first_third(sine.abs());
    let angle = combine(SINE[usize::from(large)], s, bend);
    f64::from_bits(angle.to_bits() ^ (sine.to_bits() & SIGN))
}

/// Returns true for x > 1/2, the s ≤ 1/2 that stands for x, and arcsin s − s.
#[inline(always)]
fn first_third(x: f64) -> (bool, f64, f64) {
    let large = x > 0.5;
    let rest = 0.5 - 0.5 * x;
    let rest = if rest > 0.0 { rest } else { 0.0 };
    let z = if large { rest } else { x * x };
    let s = if large { rest.sqrt() } else { x };
    let z2 = z * z;
    let p = polynomial(&LOW, z, z2) + z2 * z2 * z2 * polynomial(&HIGH, z, z2);
    (large, s, s * (z * p))
}

/// Returns β + f (s + bend): the large terms first, with the rounding error of their sum (T. J. Dekker, 1971).
#[inline(always)]
fn combine((base, base_low, factor): (f64, f64, f64), s: f64, bend: f64) -> f64 {
    let turn = factor * s;
    let sum = base + turn;
    let lost = (base - sum) + turn;
    sum + (lost + (factor * bend + base_low))
}
