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
mod row;
mod rows;
mod settings;
mod statistics;

pub use law::FrequencyResponse;
pub use row::Row;
pub use settings::ReproduceSettings;

use crate::error::PaperError;
use crate::job::PaperJob;
use crate::part::PaperPart;
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::layout::Layout;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

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
        let job = PaperJob::of_part(part, arm.clone(), Layout::from_plates(Vec::new()), 1)?;
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
