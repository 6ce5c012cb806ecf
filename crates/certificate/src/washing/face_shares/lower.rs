//! Lower bounds that are affine over a square cell, and the share of the cell where one is below a threshold.

/// Lower bound over a cell: value + slope·(place − middle), seen along the plate's axis, and −|over_height| times the height error of the
/// plate.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Lower {
    /// Value at the middle.
    pub value: f64,
    /// Slope along x and y.
    pub slope: [f64; 2],
    /// Slope along the height of the plate.
    pub over_height: f64,
    /// Likely upper bound on the amount by which the bounded quantity exceeds the bound.
    pub slack: f64,
}

impl Lower {
    /// Returns a bound that is the same everywhere.
    pub const fn flat(value: f64, slack: f64) -> Self {
        Self {
            value,
            slope: [0.0; 2],
            over_height: 0.0,
            slack,
        }
    }

    pub fn add(&mut self, other: &Self) {
        self.value += other.value;
        self.slope = [self.slope[0] + other.slope[0], self.slope[1] + other.slope[1]];
        self.over_height += other.over_height;
        self.slack += other.slack;
    }

    /// Returns the bound that holds for every height of the plate within its error; its slope along the height is 0.
    pub fn over_height_error(&self, height_error_m: f64) -> Self {
        Self {
            value: self.value - self.over_height.abs() * height_error_m,
            over_height: 0.0,
            ..*self
        }
    }

    /// Length of the slope.
    pub fn steepness(&self) -> f64 {
        let [x, y] = self.slope;
        (x * x + y * y).sqrt()
    }

    /// Least value over a cell.
    pub fn least(&self, half: f64) -> f64 {
        self.value - half * (self.slope[0].abs() + self.slope[1].abs())
    }

    /// Upper bound on the share of a cell where the bound is below a threshold.
    pub fn share_below(&self, threshold: f64, half: f64) -> f64 {
        share_below_0(self.value - threshold, self.slope.map(|slope| slope.abs() * half))
    }

    /// Returns the likely upper bound.
    pub fn likely(&self) -> Self {
        Self {
            value: self.value + self.slack,
            ..*self
        }
    }

    /// Returns the same bound with another middle, `[x, y]` away from this one.
    pub fn seen_from(&self, [x, y]: [f64; 2]) -> Self {
        Self {
            value: self.value + (self.slope[0] * x + self.slope[1] * y),
            ..*self
        }
    }
}

/// Share of the square [−1, 1]² where value + a x + b y < 0, with a and b not below 0, rounded up. With t = a + b − value it is the
/// distribution of a sum of two uniform variables, (t₊² − (t − 2a)₊² − (t − 2b)₊² + (t − 2a − 2b)₊²) / (8 a b).
fn share_below_0(value: f64, [a, b]: [f64; 2]) -> f64 {
    let (a, b) = (a.max(b), a.min(b));
    let t = a + b - value;
    if t <= 0.0 {
        return 0.0;
    }
    if value.is_nan() || t >= 2.0 * (a + b) {
        return 1.0;
    }
    // Hardly any slope along one edge: as if all were as low as the lower end of it.
    if b <= 1e-6 * a {
        return (t / (2.0 * a)).min(1.0);
    }
    let part = |less: f64| (t - less).max(0.0) * (t - less).max(0.0);
    let sum = part(0.0) - part(2.0 * a) - part(2.0 * b);
    // The error of the cancellation is less than this.
    (sum / (8.0 * a * b) + 1e-9).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against squares a hundredth of the cell wide.
        #[test]
        fn the_share_agrees_with_counted_squares(value in -3.0..3.0f64, a in 0.0..2.0f64, b in 0.0..2.0f64, flat in 0..4) {
            let (a, b) = if flat == 0 { (a, 0.0) } else { (a, b) };
            let n = 100;
            let at = |k: i32| (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
            let below = (0..n * n).filter(|k| value + a * at(k / n) + b * at(k % n) < 0.0).count();
            let share = below as f64 / f64::from(n * n);
            prop_assert!((share_below_0(value, [a, b]) - share).abs() < 0.03, "{share}");
        }
    }

    #[test]
    fn nan_counts_as_below() {
        assert!(share_below_0(f64::NAN, [1.0, 1.0]) >= 1.0);
        assert!(share_below_0(-1.0, [0.0, 0.0]) >= 1.0 && share_below_0(1.0, [0.0, 0.0]) <= 0.0);
    }
}
