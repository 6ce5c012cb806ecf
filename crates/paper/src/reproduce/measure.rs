//! All measurements, one after the other.

use super::result::{ReproduceSettings, Reproduction};
use super::{law, layout, rows, stall};
use crate::error::PaperError;
use crate::part::PaperPart;
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::Cancelled;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Measures everything; `progress(done, total)` is called after each layout, and with none done while dead ends are counted, from any
/// thread. It ends the work when it breaks.
///
/// The answer does not depend on the number of threads.
///
/// # Errors
/// [`PaperError`] from a stage of the program, never for a layout that does not wash; [`PaperError::Cancelled`] when `progress`
/// breaks.
pub fn reproduce(
    settings: &ReproduceSettings,
    progress: &(dyn Fn(usize, usize) -> ControlFlow<()> + Sync),
) -> Result<Reproduction, PaperError> {
    let arm = Arc::new(RobotModel::irb120()?);
    let done = AtomicUsize::new(0);
    let total = PaperPart::ALL.len() * settings.layouts;
    let mut rows = stall::rows(settings, &|| progress(0, total))?;
    rows.extend(law::rows());
    let mut pooled = Vec::new();
    for part in PaperPart::ALL {
        let bench = layout::Bench::new(part, &arm)?;
        let measure = |k: usize| {
            let sample = bench.measure(settings.seed, k);
            match progress(1 + done.fetch_add(1, Ordering::Relaxed), total) {
                ControlFlow::Continue(()) => sample,
                ControlFlow::Break(()) => Err(Cancelled.into()),
            }
        };
        let samples = (0..settings.layouts)
            .into_par_iter()
            .map(measure)
            .collect::<Result<Vec<_>, _>>()?;
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
