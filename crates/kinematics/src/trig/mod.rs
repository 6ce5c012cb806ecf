//! Trigonometry for the whole project, in pure Rust: the same bits on every machine, and fast.
//!
//! The C library's `sin` and `cos` differ between machines in the last bit, which is enough to make two plans differ;
//! and they are most of the cost of forward kinematics. Everything here is made of additions, multiplications,
//! divisions and square roots, each rounded on its own as IEEE 754 prescribes, so that the same input gives the same
//! bits everywhere. nalgebra is built with `libm-force` for the same reason.
//!
//! | function | file | error, measured | method |
//! | --- | --- | --- | --- |
//! | [`sin_cos`], [`sin`], [`cos`], [`sin_cos_lanes`] | `sin_cos.rs` | 0.83 ulp up to 10⁵ rad | Cody–Waite reduction, minimax polynomials |
//! | [`atan2`] | `atan2.rs` | 1.48 ulp | five tangents, one division, minimax polynomial |
//! | [`acos`], [`asin`] | `arc_sine.rs` | 1.25 ulp | square root, minimax polynomial |
//! | [`ln`] | here | below 1 ulp | the `libm` crate, a Rust port of musl's |
//!
//! One ulp is the gap between the doubles around the exact answer. The tests hold the module to these figures against
//! 400-digit references, and pin its bits.

mod arc_sine;
mod atan2;
mod sin_cos;

pub use crate::trig::arc_sine::{acos, asin};
pub use crate::trig::atan2::atan2;
pub(crate) use crate::trig::atan2::atan2_vector;
pub(crate) use crate::trig::sin_cos::sin_cos_vector;
pub use crate::trig::sin_cos::{cos, sin, sin_cos, sin_cos_lanes};

/// Natural logarithm: −∞ for 0, NaN for negative numbers and NaN. From the `libm` crate, below 1 ulp.
#[inline]
#[must_use]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}
