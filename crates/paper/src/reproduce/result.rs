//! What is asked of a reproduction, and what it says.

use super::statistics::Estimate;
use serde::Serialize;

/// What to measure, and how often.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ReproduceSettings {
    /// Layouts simulated in each of the paper's two regions.
    pub layouts: usize,
    /// Layouts begun to measure each dead-end rate.
    pub draws: usize,
    /// Seed of every random stream.
    pub seed: u64,
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

/// One measured quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Stable key, e.g. `dead_end_rate.text.4_plates`; listed in `docs/reproduce.md`.
    pub key: String,
    /// Group heading.
    pub group: &'static str,
    /// What it is, in words.
    pub quantity: String,
    /// Unit: `%`, `mm`, `deg` or empty for a ratio.
    pub unit: &'static str,
    /// What the paper's text takes for granted, in the same unit, where it says anything.
    pub paper: Option<f64>,
    /// Measured value.
    pub measured: f64,
    /// Half-width of the 95 % interval; `None` where the value has no sampling error or too few samples.
    pub half_width_95: Option<f64>,
}

/// Everything measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reproduction {
    /// What was asked.
    pub settings: ReproduceSettings,
    /// The quantities, in reading order.
    pub rows: Vec<Row>,
}

/// One row of the table.
pub(super) fn row(
    group: &'static str,
    key: String,
    quantity: String,
    unit: &'static str,
    paper: Option<f64>,
    estimate: Estimate,
) -> Row {
    Row {
        key,
        group,
        quantity,
        unit,
        paper,
        measured: estimate.value,
        half_width_95: estimate.half_width_95,
    }
}
