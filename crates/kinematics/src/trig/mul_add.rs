//! a·b + c with one rounding or two: the only difference between the portable and the vector kernels.

/// Rounding of a·b + c. A kernel that is generic over this is written once; it gives the portable bits with [`SeparateMulAdd`] and the fastest
/// code with [`FusedMulAdd`].
pub trait MulAdd {
    /// Returns a·b + c.
    fn mul_add(a: f64, b: f64, c: f64) -> f64;
}

/// Rounds the product, then the sum: the same bits on every machine and at every optimisation level, because Rust never contracts the two
/// into one instruction.
#[derive(Debug, Clone, Copy)]
pub struct SeparateMulAdd;

/// Rounds once. Meant for functions with `#[target_feature(enable = "avx2,fma")]`, where it is one
/// instruction; elsewhere it calls the C library's `fma`, with the same bits but slowly.
#[derive(Debug, Clone, Copy)]
pub struct FusedMulAdd;

impl MulAdd for SeparateMulAdd {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }
}

impl MulAdd for FusedMulAdd {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }
}

/// Returns c₀ + c₁z + … + c₅z⁵, in pairs to shorten the chain of dependent operations (G. Estrin, 1960).
#[inline(always)]
pub(crate) fn polynomial<M: MulAdd>(c: &[f64; 6], z: f64, z2: f64) -> f64 {
    let pair = |k: usize| M::mul_add(z, c[k + 1], c[k]);
    M::mul_add(z2, M::mul_add(z2, pair(4), pair(2)), pair(0))
}
