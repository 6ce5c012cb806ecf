//! Re-measures what the paper's program does, over many layouts.
//!
//! Every quantity is measured by running the program's own parts (layout law, spiral, transition, inverse kinematics
//! seeded with the executed configuration, control law), not copied from anywhere. The paper's column says what its text
//! takes for granted: that layouts are found, points reached, nothing touched, and plates covered.
//!
//! Errors are half-widths of 95 % intervals: Wilson's for dead ends, batch means over layouts (up to 20 batches) for
//! everything else, because waypoints of one layout are not independent. Shares of 0 and 100 % state three over the number of
//! layouts, and coverage adds the raster's proven error.

mod cell;
mod law;
mod rows;
mod stall;
mod statistics;
mod table;

pub use law::FrequencyResponse;

use crate::error::PlanError;
use crate::scenario::{RegionName, Scenario};
use rayon::prelude::*;
use serde::Serialize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

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

/// The paper's regions with the scenarios that state them.
const REGIONS: [(RegionName, &str, &str); 2] = [
    (RegionName::Text, "text", "paper-text"),
    (RegionName::Appendix, "appendix", "paper-appendix"),
];

/// Measures everything; `progress(done, total)` is called after each layout, from any thread, and ends the work when it breaks.
///
/// The answer does not depend on the number of threads.
///
/// # Errors
/// [`PlanError`] from a stage of the program, never for a layout that does not wash; [`PlanError::Stopped`] when `progress`
/// breaks.
pub fn reproduce(
    settings: &ReproduceSettings,
    progress: &(dyn Fn(usize, usize) -> ControlFlow<()> + Sync),
) -> Result<Reproduction, PlanError> {
    let mut rows = stall::rows(settings)?;
    rows.extend(law::rows(&Scenario::load("paper-appendix")?.control));
    let done = AtomicUsize::new(0);
    let total = REGIONS.len() * settings.layouts;
    let mut pooled = Vec::new();
    for (_, region, scenario) in REGIONS {
        let bench = cell::Bench::new(Scenario::load(scenario)?)?;
        let measure = |k: usize| {
            let sample = bench.measure(settings.seed, region, k);
            match progress(1 + done.fetch_add(1, Ordering::Relaxed), total) {
                ControlFlow::Continue(()) => sample,
                ControlFlow::Break(()) => Err(PlanError::Stopped),
            }
        };
        let samples = (0..settings.layouts)
            .into_par_iter()
            .map(measure)
            .collect::<Result<Vec<_>, _>>()?;
        rows.extend(rows::feasibility(region, &samples));
        pooled.extend(samples);
    }
    rows.extend(rows::tracking(&pooled));
    rows.extend(rows::coverage(&pooled)?);
    Ok(Reproduction {
        settings: *settings,
        rows,
    })
}
