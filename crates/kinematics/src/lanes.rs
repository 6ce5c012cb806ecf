//! Four lanes in a register: the only `unsafe` of this crate.
//!
//! A kernel is written once, over [`Vector`], and compiled for [`PortableVector`] and for AVX2, the latter within a function that has these
//! instructions enabled. [`run`] and [`run_exact`] enter the one that the processor has.

#![allow(unsafe_code)]

use std::ops::{Add, Div, Mul, Sub};

/// Numbers in a vector.
pub(crate) const LANES: usize = 4;

/// One double or a vector of them. A product and a sum are rounded one after the other, with the same bits on every machine: Rust never
/// contracts the two into one instruction. [`run`] alone has a vector that rounds once.
pub(crate) trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Returns the same number in every lane.
    fn splat(x: f64) -> Self;

    /// Returns `self · b + c`.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    /// Returns `self · b − c`.
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self * b - c
    }

    /// Returns `c − self · b`.
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
}

impl Number for f64 {
    #[inline(always)]
    fn splat(x: f64) -> Self {
        x
    }
}

/// Four doubles; every operation is lane by lane, rounded as IEEE 754 says.
pub(crate) trait Vector: Number + Div<Output = Self> {
    /// Builds a vector from its lanes.
    fn from_array(lanes: [f64; LANES]) -> Self;
    /// Returns the lanes.
    fn to_array(self) -> [f64; LANES];
    /// Returns the bits that both have.
    fn and(self, other: Self) -> Self;
    /// Returns the bits that one of the two has.
    fn xor(self, other: Self) -> Self;
    /// Shifts the bits of every lane to the left.
    fn shift_left<const BY: i32>(self) -> Self;
    /// Selects `yes` in lanes whose sign bit is set, `no` elsewhere.
    fn if_sign_bit(self, yes: Self, no: Self) -> Self;
    /// Returns vector i of lane i of each.
    fn transposed(four: [Self; LANES]) -> [Self; LANES];
    /// Square root, lane by lane.
    fn sqrt(self) -> Self;
    /// Returns the lanes without their fractions; they must fit an `i32`. The sign of zero is lost.
    fn truncated(self) -> Self;
    /// Returns all bits in lanes with `self <= bound` (false for NaN), none elsewhere.
    fn at_most(self, bound: Self) -> Self;
    /// Returns the sign bits, that of lane 0 last.
    fn sign_bits(self) -> u8;
    /// Selects `yes` in lanes with `self > bound` (false for NaN), `no` elsewhere.
    fn if_above(self, bound: Self, yes: Self, no: Self) -> Self;

    /// True if every lane is at most `bound`; false with NaN in a lane.
    #[inline(always)]
    fn all_at_most(self, bound: f64) -> bool {
        self.at_most(Self::splat(bound)).sign_bits() == (1 << LANES) - 1
    }
}

/// Work that is written once and compiled twice. `run` is `#[inline(always)]`, and so are all functions that it calls often, because a
/// function is compiled for the instructions of the one it is inlined into.
pub(crate) trait Kernel {
    /// Result of the work.
    type Output;
    /// Does the work.
    fn run<V: Vector>(self) -> Self::Output;
}

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
pub(crate) fn run<K: Kernel>(path: Backend, kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if path.is_vectorised() {
        // SAFETY: calling a function with `target_feature(enable = "avx2,fma")` needs a processor that has both;
        // `is_vectorised` is true only where `is_x86_feature_detected!` found both. The body is safe code.
        return unsafe { avx2::run(kernel) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = path;
    kernel.run::<PortableVector>()
}

/// Runs the kernel on the fastest instructions that round every operation on its own: the bits are the same on every machine.
#[inline]
pub(crate) fn run_exact<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: calling a function with `target_feature(enable = "avx2")` needs a processor that has it, and it was just found.
        return unsafe { avx2::run_exact(kernel) };
    }
    kernel.run::<PortableVector>()
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

impl PortableVector {
    #[inline(always)]
    fn bitwise(mut self, other: Self, operator: impl Fn(u64, u64) -> u64) -> Self {
        for l in 0..LANES {
            self.0[l] = f64::from_bits(operator(self.0[l].to_bits(), other.0[l].to_bits()));
        }
        self
    }
}

impl Number for PortableVector {
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; LANES])
    }
}

impl Vector for PortableVector {
    #[inline(always)]
    fn from_array(lanes: [f64; LANES]) -> Self {
        Self(lanes)
    }

    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.bitwise(other, |a, b| a & b)
    }

    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        self.bitwise(other, |a, b| a ^ b)
    }

    #[inline(always)]
    fn shift_left<const BY: i32>(self) -> Self {
        Self(self.0.map(|x| f64::from_bits(x.to_bits() << BY)))
    }

    #[inline(always)]
    fn if_sign_bit(self, yes: Self, no: Self) -> Self {
        // Masks instead of branches: they become vector instructions.
        let mask = Self(self.0.map(|x| f64::from_bits(0_u64.wrapping_sub(x.to_bits() >> 63))));
        no.xor(yes.xor(no).and(mask))
    }

    #[inline(always)]
    fn transposed([a, b, c, d]: [Self; LANES]) -> [Self; LANES] {
        let lane = |l: usize| Self([a.0[l], b.0[l], c.0[l], d.0[l]]);
        [lane(0), lane(1), lane(2), lane(3)]
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn truncated(self) -> Self {
        Self(self.0.map(|x| f64::from(x as i32)))
    }

    #[inline(always)]
    fn at_most(mut self, bound: Self) -> Self {
        for l in 0..LANES {
            self.0[l] = f64::from_bits(0_u64.wrapping_sub(u64::from(self.0[l] <= bound.0[l])));
        }
        self
    }

    #[inline(always)]
    fn sign_bits(self) -> u8 {
        let bit = |l: usize| u8::from(self.0[l].is_sign_negative()) << l;
        bit(0) | bit(1) | bit(2) | bit(3)
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
    use crate::lanes::{Kernel, LANES, Number, Vector};
    use std::arch::x86_64::{
        __m256d, _CMP_GT_OQ, _CMP_LE_OQ, _mm256_add_pd, _mm256_and_pd, _mm256_blendv_pd, _mm256_castpd_si256,
        _mm256_castsi256_pd, _mm256_cmp_pd, _mm256_cvtepi32_pd, _mm256_cvttpd_epi32, _mm256_div_pd, _mm256_fmadd_pd,
        _mm256_fmsub_pd, _mm256_fnmadd_pd, _mm256_movemask_pd, _mm256_mul_pd, _mm256_permute2f128_pd,
        _mm256_slli_epi64, _mm256_sqrt_pd, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd, _mm256_xor_pd,
    };
    use std::mem::transmute;
    use std::ops::{Add, Div, Mul, Sub};

    /// The only place where [`Avx2`] with fused rounding is named, hence the only one where its FMA instructions are used.
    #[target_feature(enable = "avx2,fma")]
    pub fn run<K: Kernel>(kernel: K) -> K::Output {
        kernel.run::<Avx2<true>>()
    }

    /// The only place where [`Avx2`] with separate rounding is named.
    #[target_feature(enable = "avx2")]
    pub fn run_exact<K: Kernel>(kernel: K) -> K::Output {
        kernel.run::<Avx2<false>>()
    }

    /// Four doubles in a register of AVX, whose products and sums are `FUSED` or rounded one after the other. Private: there is none except within [`run`], which only runs where the
    /// processor has AVX2 and FMA, and [`run_exact`], where it has AVX2. This is what every `unsafe` below that calls an instruction relies
    /// on.
    #[derive(Clone, Copy)]
    struct Avx2<const FUSED: bool>(__m256d);

    /// An operator that is one instruction.
    macro_rules! instruction {
        ($trait:ident, $name:ident, $intrinsic:ident) => {
            impl<const FUSED: bool> $trait for Avx2<FUSED> {
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

    impl<const FUSED: bool> Number for Avx2<FUSED> {
        #[inline(always)]
        fn splat(x: f64) -> Self {
            Self::from_array([x; LANES])
        }

        #[inline(always)]
        fn mul_add(self, b: Self, c: Self) -> Self {
            match FUSED {
                // SAFETY: needs FMA only; this rounding is named in `run` alone.
                true => Self(unsafe { _mm256_fmadd_pd(self.0, b.0, c.0) }),
                false => self * b + c,
            }
        }

        #[inline(always)]
        fn mul_sub(self, b: Self, c: Self) -> Self {
            match FUSED {
                // SAFETY: needs FMA only; this rounding is named in `run` alone.
                true => Self(unsafe { _mm256_fmsub_pd(self.0, b.0, c.0) }),
                false => self * b - c,
            }
        }

        #[inline(always)]
        fn neg_mul_add(self, b: Self, c: Self) -> Self {
            match FUSED {
                // SAFETY: needs FMA only; this rounding is named in `run` alone.
                true => Self(unsafe { _mm256_fnmadd_pd(self.0, b.0, c.0) }),
                false => c - self * b,
            }
        }
    }

    impl<const FUSED: bool> Vector for Avx2<FUSED> {
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
        fn and(self, other: Self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            Self(unsafe { _mm256_and_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn xor(self, other: Self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            Self(unsafe { _mm256_xor_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn shift_left<const BY: i32>(self) -> Self {
            // SAFETY: needs AVX2 only, see `Avx2`; the casts keep the bits.
            let shifted = unsafe { _mm256_castsi256_pd(_mm256_slli_epi64::<BY>(_mm256_castpd_si256(self.0))) };
            Self(shifted)
        }

        #[inline(always)]
        fn if_sign_bit(self, yes: Self, no: Self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            Self(unsafe { _mm256_blendv_pd(no.0, yes.0, self.0) })
        }

        #[inline(always)]
        fn transposed([a, b, c, d]: [Self; LANES]) -> [Self; LANES] {
            // SAFETY: needs AVX only, see `Avx2`.
            let halves = unsafe {
                let (low, high) = (_mm256_unpacklo_pd(a.0, b.0), _mm256_unpackhi_pd(a.0, b.0));
                let (low_2, high_2) = (_mm256_unpacklo_pd(c.0, d.0), _mm256_unpackhi_pd(c.0, d.0));
                [
                    _mm256_permute2f128_pd::<0x20>(low, low_2),
                    _mm256_permute2f128_pd::<0x20>(high, high_2),
                    _mm256_permute2f128_pd::<0x31>(low, low_2),
                    _mm256_permute2f128_pd::<0x31>(high, high_2),
                ]
            };
            halves.map(Self)
        }

        #[inline(always)]
        fn sqrt(self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            Self(unsafe { _mm256_sqrt_pd(self.0) })
        }

        #[inline(always)]
        fn truncated(self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            Self(unsafe { _mm256_cvtepi32_pd(_mm256_cvttpd_epi32(self.0)) })
        }

        #[inline(always)]
        fn at_most(self, bound: Self) -> Self {
            // SAFETY: needs AVX only, see `Avx2`.
            Self(unsafe { _mm256_cmp_pd::<_CMP_LE_OQ>(self.0, bound.0) })
        }

        #[inline(always)]
        fn sign_bits(self) -> u8 {
            // SAFETY: needs AVX only, see `Avx2`.
            unsafe { _mm256_movemask_pd(self.0) as u8 }
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::trig::{atan2, atan2_vector, sin_cos, sin_cos_vector};
    use proptest::prelude::*;

    /// Returns the results on every processor's instructions and on the fastest of this one.
    pub(crate) fn portable_and_exact<K: Kernel + Clone>(kernel: &K) -> [K::Output; 2] {
        [kernel.clone().run::<PortableVector>(), run_exact(kernel.clone())]
    }

    #[derive(Clone)]
    struct Trigonometry([f64; LANES], [f64; LANES]);

    impl Kernel for Trigonometry {
        type Output = [[f64; LANES]; 3];

        #[inline(always)]
        fn run<V: Vector>(self) -> Self::Output {
            let (a, b) = (V::from_array(self.0), V::from_array(self.1));
            let (sin, cos) = sin_cos_vector(a);
            [sin.to_array(), cos.to_array(), atan2_vector(a, b).to_array()]
        }
    }

    fn bits(x: f64) -> u64 {
        if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
    }

    proptest! {
        #[test]
        fn lanes_have_the_bits_of_single_numbers(
            a in prop::array::uniform4(prop_oneof![-10.0..10.0f64, -3e5..3e5f64, any::<f64>(), Just(0.0), Just(-0.0)]),
            b in prop::array::uniform4(prop_oneof![-10.0..10.0f64, any::<f64>(), Just(0.0), Just(-0.0)]),
        ) {
            for [sin, cos, angle] in portable_and_exact(&Trigonometry(a, b)) {
                for l in 0..LANES {
                    let (s, c) = sin_cos(a[l]);
                    let expected = [s, c, atan2(a[l], b[l])].map(bits);
                    prop_assert_eq!([sin[l], cos[l], angle[l]].map(bits), expected);
                }
            }
            let [sin, cos, _] = run(Backend::Detected, Trigonometry(a, b));
            for l in (0..LANES).filter(|l| a[*l].abs() <= 1e5) {
                let (s, c) = sin_cos(a[l]);
                prop_assert!((sin[l] - s).abs() <= 2.3e-16 && (cos[l] - c).abs() <= 2.3e-16);
            }
        }
    }
}
