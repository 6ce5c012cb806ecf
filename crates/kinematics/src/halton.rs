//! Halton's sequence (J. H. Halton, Numer. Math. 2, 1960): points spread evenly over a cube, the same on every machine.

use crate::joints::AXES;

/// The first six primes, a base a joint.
const BASES: [u32; AXES] = [2, 3, 5, 7, 11, 13];

/// Point `k` in the unit cube, a coordinate a joint; from `k` = 1 on every coordinate is in (0, 1).
#[must_use]
pub fn point(k: u32) -> [f64; AXES] {
    BASES.map(|base| radical_inverse(k, base))
}

/// The digits of `k` mirrored at the radix point, in \[0, 1).
fn radical_inverse(mut k: u32, base: u32) -> f64 {
    let (mut value, mut place) = (0.0, 1.0);
    while k > 0 {
        place /= f64::from(base);
        value += f64::from(k % base) * place;
        k /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radical_inverse_mirrors_the_digits() {
        assert_eq!([1, 2, 3, 4].map(|k| radical_inverse(k, 2)), [0.5, 0.25, 0.75, 0.125]);
        assert!((radical_inverse(5, 3) - (2.0 / 3.0 + 1.0 / 9.0)).abs() < 1e-15);
    }
}
