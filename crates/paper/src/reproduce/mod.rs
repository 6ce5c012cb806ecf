//! Measures the results of the paper's program again, over many layouts.
//!
//! Every quantity is measured by running the program's own parts (layout law, spiral, transit, inverse kinematics
//! seeded with the executed configuration, control law), not copied from anywhere. The paper's column says what its text
//! takes for granted: that layouts are found, points reached, nothing touched, and plates covered.
//!
//! Errors are half-widths of 95 % intervals: Wilson's for dead ends, batch means over layouts (up to 20 batches) for
//! everything else, because waypoints of one layout are not independent. Shares of 0 and 100 % state three over the number of
//! layouts, and coverage adds the raster's proven error.

mod dead_ends;
mod law;
mod layout;
mod rows;
mod statistics;

pub use law::FrequencyResponse;

use crate::error::PaperError;
use crate::job::PaperJob;
use crate::part::PaperPart;
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::layout::Layout;
use rayon::prelude::*;
use serde::Serialize;
use statistics::Estimate;
use std::fmt::{self, Display, Formatter};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

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

/// One measured quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Stable key, e.g. `dead_end_rate.text.4_plates`; listed in `docs/reproduce.md`.
    pub key: String,
    /// Group heading.
    pub group: &'static str,
    /// Name of the quantity, in words.
    pub quantity: String,
    /// Unit: `%`, `mm`, `deg` or empty for a ratio.
    pub unit: &'static str,
    /// Value that the paper's text takes for granted, in the same unit; `None` where it states none.
    pub paper: Option<f64>,
    /// Measured value, in the same unit.
    pub measured: f64,
    /// Half-width of the 95 % interval; `None` where the value has no sampling error or too few samples.
    pub half_width_95: Option<f64>,
}

/// Everything measured.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reproduction {
    /// Settings of the reproduction.
    pub settings: ReproduceSettings,
    /// The quantities, in reading order.
    pub rows: Vec<Row>,
}

/// Measures everything; `progress(done, total)` is called after each layout, from any thread.
///
/// The answer does not depend on the number of threads.
///
/// # Errors
/// [`PaperError`] from a stage of the program, never for a layout that does not wash; [`PaperError::Cancelled`] when `cancel` says
/// so.
pub fn reproduce(
    settings: &ReproduceSettings,
    cancel: &CancelToken,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Reproduction, PaperError> {
    let arm = Arc::new(RobotModel::irb120()?);
    let (done, total) = (AtomicUsize::new(0), PaperPart::ALL.len() * settings.layouts);
    let mut rows = dead_ends::rows(settings, cancel)?;
    rows.extend(law::rows());
    let mut pooled = Vec::new();
    for part in PaperPart::ALL {
        let job = PaperJob::of_part(part, arm.clone(), Layout::of(Vec::new()), 1)?;
        let measure = |k: usize| {
            cancel.check()?;
            let sample = layout::measure(part, &job, settings.seed, k);
            progress(1 + done.fetch_add(1, Ordering::Relaxed), total);
            sample
        };
        let samples = (0..settings.layouts).into_par_iter().map(measure);
        let samples = samples.collect::<Result<Vec<_>, PaperError>>()?;
        rows.extend(rows::feasibility(part.name(), &samples));
        pooled.extend(samples);
    }
    rows.extend(rows::tracking(&pooled));
    rows.extend(rows::coverage(&pooled)?);
    Ok(Reproduction {
        settings: *settings,
        rows,
    })
}

impl Row {
    fn new(
        group: &'static str,
        key: impl Into<String>,
        quantity: impl Into<String>,
        unit: &'static str,
        paper: impl Into<Option<f64>>,
        estimate: Estimate,
    ) -> Self {
        Self {
            key: key.into(),
            group,
            quantity: quantity.into(),
            unit,
            paper: paper.into(),
            measured: estimate.value,
            half_width_95: estimate.half_width_95,
        }
    }
}

impl Display for Reproduction {
    /// The table as a person reads it.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let s = &self.settings;
        writeln!(
            f,
            "The paper's program, measured: {} layouts a region, {} layouts begun a dead-end rate, seed {}\n\
             (\"paper\": what its text takes for granted; ±: half-width of the 95 % interval)",
            s.layouts, s.draws, s.seed
        )?;
        for group in self.rows.chunk_by(|a, b| a.group == b.group) {
            let heading = group[0].group;
            writeln!(
                f,
                "\n{heading}\n  {:<62} {:>9} {:>10} {:>8}",
                "", "paper", "measured", "±"
            )?;
            group.iter().try_for_each(|row| writeln!(f, "{row}"))?;
        }
        Ok(())
    }
}

impl Display for Row {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (quantity, digits) = match self.unit {
            "" => (self.quantity.clone(), 3),
            unit => (format!("{} [{unit}]", self.quantity), 1),
        };
        let known =
            |value: Option<f64>, digits: usize| value.map_or_else(|| "–".to_owned(), |v| format!("{v:.digits$}"));
        let (paper, error) = (known(self.paper, digits), known(self.half_width_95, digits + 1));
        write!(
            f,
            "  {quantity:<62} {paper:>9} {:>10.digits$} {error:>8}",
            self.measured
        )
    }
}
