//! Work on four configurations at once, for any processor.

use crate::trig::MulAdd;
use std::ops::{Add, Div, Mul, Sub};

/// Configurations to a vector.
pub(crate) const LANES: usize = 4;

/// Four doubles; every operation is lane by lane, rounded as IEEE 754 says.
pub(crate) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Rounding of [`Vector::mul_add`].
    type Rounding: MulAdd;
    /// Builds a vector from its lanes.
    fn from_array(lanes: [f64; LANES]) -> Self;
    /// Returns the lanes.
    fn to_array(self) -> [f64; LANES];
    /// Returns `self · b + c`.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// Returns `self · b − c`.
    fn mul_sub(self, b: Self, c: Self) -> Self;
    /// Returns `c − self · b`.
    fn neg_mul_add(self, b: Self, c: Self) -> Self;
    /// Selects `yes` in lanes with `self > bound` (false for NaN), `no` elsewhere.
    fn if_above(self, bound: Self, yes: Self, no: Self) -> Self;

    /// Returns the same number in every lane.
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self::from_array([x; LANES])
    }
}

/// Work that is written once and compiled twice. `run` is `#[inline(always)]`, and so are all functions that it calls often, because a
/// function is compiled for the instructions of the one it is inlined into.
pub(crate) trait Kernel {
    /// Does the work.
    fn run<V: Vector>(self);
}
