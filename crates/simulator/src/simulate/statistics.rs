//! Root mean square, 95 % and largest of many numbers.

use serde::Serialize;

/// How large errors are.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Spread {
    /// Root mean square.
    pub rms: f64,
    /// 95 of 100 are not above it (the nearest rank).
    pub p95: f64,
    /// The largest.
    pub max: f64,
}

impl Spread {
    /// Of magnitudes, in any order; zeros of none.
    #[must_use]
    pub fn of(mut values: Vec<f64>) -> Self {
        if values.is_empty() {
            return Self::default();
        }
        let squares: f64 = values.iter().map(|v| v * v).sum();
        let rms = (squares / values.len() as f64).sqrt();
        let rank = (19 * values.len()).div_ceil(20) - 1;
        let (_, p95, above) = values.select_nth_unstable_by(rank, f64::total_cmp);
        let p95 = *p95;
        let max = above.iter().copied().fold(p95, f64::max);
        Self { rms, p95, max }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_counted_from_one() {
        let spread = Spread::of((1..=20).rev().map(f64::from).collect());
        assert_eq!((spread.p95, spread.max), (19.0, 20.0));
        assert!((spread.rms - (2870.0f64 / 20.0).sqrt()).abs() < 1e-15);
        let one = Spread::of(vec![3.0]);
        assert_eq!((one.rms, one.p95, one.max), (3.0, 3.0, 3.0));
        assert_eq!(Spread::of(Vec::new()), Spread::default());
        assert_eq!(Spread::of((1..=100).map(f64::from).collect()).p95, 95.0);
    }
}
