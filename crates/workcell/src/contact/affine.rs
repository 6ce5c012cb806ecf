//! What is affine over a square cell, and how much of the cell is below 0.

/// A lower bound over a cell: value + slope·(place − middle), seen along the plate's axis, and −|lower| times how far the plate may lie
/// too low or too high.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lower {
    /// At the middle.
    pub value: f64,
    /// Over x and y.
    pub slope: [f64; 2],
    /// Over the height of the plate.
    pub over_height: f64,
    /// By how much what it bounds is likely to be above it at most.
    pub slack: f64,
}

impl Lower {
    /// The same everywhere.
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

    /// The least over a cell for every height of the plate within its error: value and slope.
    pub fn settled(&self, height_error_m: f64) -> Self {
        Self {
            value: self.value - self.over_height.abs() * height_error_m,
            over_height: 0.0,
            ..*self
        }
    }

    /// How steep it is.
    pub fn steepness(&self) -> f64 {
        let [x, y] = self.slope;
        (x * x + y * y).sqrt()
    }

    /// The least over a cell.
    pub fn least(&self, half: f64) -> f64 {
        self.value - half * (self.slope[0].abs() + self.slope[1].abs())
    }

    /// The share of a cell where it is below a threshold, at least so much: none too small.
    pub fn share_below(&self, threshold: f64, half: f64) -> f64 {
        share_below_0(self.value - threshold, self.slope.map(|slope| slope.abs() * half))
    }

    /// The share of a cell where as much as is likely is below a threshold.
    pub fn hopeless(&self, threshold: f64, half: f64) -> f64 {
        let hope = Self {
            value: self.value + self.slack,
            ..*self
        };
        hope.share_below(threshold, half)
    }
}

/// The share of the square [−1, 1]² where value + a x + b y < 0, a and b not below 0: none too small. With t = a + b − value it is the
/// distribution of a sum of two even ones, (t₊² − (t − 2a)₊² − (t − 2b)₊² + (t − 2a − 2b)₊²) / (8 a b).
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
    // What cancels is off by less.
    (sum / (8.0 * a * b) + 1e-9).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against squares a hundredth of the cell wide.
        #[test]
        fn a_share_is_what_squares_say(value in -3.0..3.0f64, a in 0.0..2.0f64, b in 0.0..2.0f64, flat in 0..4) {
            let (a, b) = if flat == 0 { (a, 0.0) } else { (a, b) };
            let n = 100;
            let at = |k: i32| (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
            let below = (0..n * n).filter(|k| value + a * at(k / n) + b * at(k % n) < 0.0).count();
            let share = below as f64 / f64::from(n * n);
            prop_assert!((share_below_0(value, [a, b]) - share).abs() < 0.03, "{share}");
        }
    }

    #[test]
    fn what_is_no_number_is_below() {
        assert!(share_below_0(f64::NAN, [1.0, 1.0]) >= 1.0);
        assert!(share_below_0(-1.0, [0.0, 0.0]) >= 1.0 && share_below_0(1.0, [0.0, 0.0]) <= 0.0);
    }
}
