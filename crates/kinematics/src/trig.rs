//! Trigonometry for the whole project, in pure Rust.
//!
//! The C library's `sin` and `cos` differ between machines in the last bit, which is enough to make two
//! plans differ. Everything here goes through the `libm` crate (a Rust port of musl's library, errors below
//! 1 ulp), so that the same input gives the same bits everywhere. nalgebra is built with `libm-force` for
//! the same reason.

/// Sine and cosine of an angle \[rad\].
#[inline]
#[must_use]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// Sine of an angle \[rad\].
#[inline]
#[must_use]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// Cosine of an angle \[rad\].
#[inline]
#[must_use]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Angle of the vector (x, y) in (−π, π] \[rad\].
#[inline]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Angle in [0, π] with the given cosine \[rad\]; the argument is clamped to [−1, 1] against rounding.
#[inline]
#[must_use]
pub fn acos(cosine: f64) -> f64 {
    libm::acos(cosine.clamp(-1.0, 1.0))
}

/// Natural logarithm.
#[inline]
#[must_use]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pythagoras_holds_over_a_wide_range() {
        for k in -20_000..20_000 {
            let angle = f64::from(k) * 0.013;
            let (s, c) = sin_cos(angle);
            assert!((s * s + c * c - 1.0).abs() < 1e-15, "at {angle}");
            assert_eq!((s, c), (sin(angle), cos(angle)));
        }
    }

    #[test]
    fn arc_functions_invert_the_direct_ones() {
        for k in -3000..=3000 {
            let angle = f64::from(k) * 1e-3;
            let (s, c) = sin_cos(angle);
            assert!((atan2(s, c) - angle).abs() < 1e-15 * 8.0);
            assert!((acos(c) - angle.abs()).abs() < 1e-7);
        }
        assert_eq!(acos(1.0 + 1e-15), 0.0);
    }
}
