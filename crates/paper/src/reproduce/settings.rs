//! Settings of the reproduction.

use serde::Serialize;

/// Settings of the reproduction: the quantities to measure, and the sample sizes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ReproduceSettings {
    /// Layouts simulated in each of the paper's two regions.
    pub layouts: usize,
    /// Layouts begun to measure each dead-end rate.
    pub draws: usize,
    /// Seed of every random stream.
    pub seed: u64,
}

impl ReproduceSettings {
    /// Most layouts that are simulated in a region: minutes of work.
    pub const MOST_LAYOUTS: usize = 10_000;

    /// Most layouts begun for each dead-end rate: tens of seconds of work, for rates right to a tenth of a percent.
    pub const MOST_DRAWS: usize = 1_000_000;
}

impl Default for ReproduceSettings {
    fn default() -> Self {
        Self {
            layouts: 400,
            draws: 20_000,
            seed: 1,
        }
    }
}
