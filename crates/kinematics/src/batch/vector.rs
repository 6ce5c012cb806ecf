//! Four lanes in a register, on two paths: the only `unsafe` of this crate.
//!
//! A kernel is written once, over [`Vector`], and compiled twice: for [`Avx2`] within a function that has these
//! instructions enabled, and for [`PortableVector`] without. `run` enters the one that the processor has.

#![allow(unsafe_code)]

use crate::batch::kernel::{Kernel, LANES, Vector};
use crate::trig::SeparateMulAdd;
use std::ops::{Add, Div, Mul, Sub};

/// Instructions that a batch runs on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Backend {
    /// AVX2 and FMA if the processor has them, found at run time; otherwise the portable instructions. Products and sums are fused, so that
    /// the last bits differ from the portable ones.
    #[default]
    Detected,
    /// The instructions every processor of the target has: slower, and the same bits on every machine.
    Portable,
}

impl Backend {
    /// True if a batch with this setting runs on AVX2 and FMA on this machine.
    #[must_use]
    pub fn is_vectorised(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        let found = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        #[cfg(not(target_arch = "x86_64"))]
        let found = false;
        self == Self::Detected && found
    }
}

/// Runs the kernel on the given instructions.
pub(crate) fn run<K: Kernel>(path: Backend, kernel: K) {
    #[cfg(target_arch = "x86_64")]
    if path.is_vectorised() {
        // SAFETY: calling a function with `target_feature(enable = "avx2,fma")` needs a processor that has both;
        // `is_vectorised` is true only where `is_x86_feature_detected!` found both. The body is safe code.
        unsafe { avx2::run(kernel) };
        return;
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = path;
    kernel.run::<PortableVector>();
}

/// Four doubles on any processor.
#[derive(Clone, Copy)]
struct PortableVector([f64; LANES]);

/// An operator, lane by lane.
macro_rules! portable {
    ($trait:ident, $name:ident, $operator:tt) => {
        impl $trait for PortableVector {
            type Output = Self;
            #[inline(always)]
            fn $name(mut self, other: Self) -> Self {
                for l in 0..LANES {
                    self.0[l] $operator other.0[l];
                }
                self
            }
        }
    };
}
portable!(Add, add, +=);
portable!(Sub, sub, -=);
portable!(Mul, mul, *=);
portable!(Div, div, /=);

impl Vector for PortableVector {
    type Rounding = SeparateMulAdd;

    #[inline(always)]
    fn from_array(lanes: [f64; LANES]) -> Self {
        Self(lanes)
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self * b - c
    }

    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }

    #[inline(always)]
    fn if_above(self, bound: Self, yes: Self, mut no: Self) -> Self {
        for l in 0..LANES {
            no.0[l] = if self.0[l] > bound.0[l] { yes.0[l] } else { no.0[l] };
        }
        no
    }
}

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use crate::batch::kernel::{Kernel, LANES, Vector};
    use crate::trig::FusedMulAdd;
    use std::arch::x86_64::{
        __m256d, _CMP_GT_OQ, _mm256_add_pd, _mm256_blendv_pd, _mm256_cmp_pd, _mm256_div_pd, _mm256_fmadd_pd,
        _mm256_fmsub_pd, _mm256_fnmadd_pd, _mm256_mul_pd, _mm256_sub_pd,
    };
    use std::mem::transmute;
    use std::ops::{Add, Div, Mul, Sub};

    /// The only place where [`Avx2`] is named outside of its own operations, hence the only one where it is used.
    #[target_feature(enable = "avx2,fma")]
    pub fn run<K: Kernel>(kernel: K) {
        kernel.run::<Avx2>();
    }

    /// Four doubles in a register of AVX. Private: there is none except within [`run`], which only runs where the
    /// processor has AVX2 and FMA. This is what every `unsafe` below that calls an instruction relies on.
    #[derive(Clone, Copy)]
    struct Avx2(__m256d);

    /// An operator that is one instruction.
    macro_rules! instruction {
        ($trait:ident, $name:ident, $intrinsic:ident) => {
            impl $trait for Avx2 {
                type Output = Self;
                #[inline(always)]
                fn $name(self, other: Self) -> Self {
                    // SAFETY: needs AVX only, see `Avx2`; no pointer, no other precondition.
                    Self(unsafe { $intrinsic(self.0, other.0) })
                }
            }
        };
    }
    instruction!(Add, add, _mm256_add_pd);
    instruction!(Sub, sub, _mm256_sub_pd);
    instruction!(Mul, mul, _mm256_mul_pd);
    instruction!(Div, div, _mm256_div_pd);

    impl Vector for Avx2 {
        type Rounding = FusedMulAdd;

        #[inline(always)]
        fn from_array(lanes: [f64; LANES]) -> Self {
            // SAFETY: both are 32 bytes without padding, and every bit pattern is valid for both.
            Self(unsafe { transmute::<[f64; LANES], __m256d>(lanes) })
        }

        #[inline(always)]
        fn to_array(self) -> [f64; LANES] {
            // SAFETY: as above, the other way round.
            unsafe { transmute::<__m256d, [f64; LANES]>(self.0) }
        }

        #[inline(always)]
        fn mul_add(self, b: Self, c: Self) -> Self {
            // SAFETY: needs FMA only, see `Avx2`.
            Self(unsafe { _mm256_fmadd_pd(self.0, b.0, c.0) })
        }

        #[inline(always)]
        fn mul_sub(self, b: Self, c: Self) -> Self {
            // SAFETY: needs FMA only, see `Avx2`.
            Self(unsafe { _mm256_fmsub_pd(self.0, b.0, c.0) })
        }

        #[inline(always)]
        fn neg_mul_add(self, b: Self, c: Self) -> Self {
            // SAFETY: needs FMA only, see `Avx2`.
            Self(unsafe { _mm256_fnmadd_pd(self.0, b.0, c.0) })
        }

        #[inline(always)]
        fn if_above(self, bound: Self, yes: Self, no: Self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            let above = unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, bound.0) };
            // SAFETY: the same.
            Self(unsafe { _mm256_blendv_pd(no.0, yes.0, above) })
        }
    }
}
