//! Rate at which sequential sampling comes to a dead end: there the paper's program hangs.

use super::row::Row;
use super::settings::ReproduceSettings;
use super::statistics::binomial_percent;
use crate::error::PaperError;
use crate::part::PaperPart;
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::layout::{Attempt, Sampler};
use platewash_workcell::random;
use rayon::prelude::*;

/// Plates asked for, for each of which the rate is measured.
const COUNTS: [usize; 3] = [3, 4, 5];

/// Layouts begun per random stream; a constant, so that the answer does not depend on the number of threads.
const BLOCK: usize = 500;

/// The rate in each region for each number of plates.
pub(super) fn rows(settings: &ReproduceSettings, cancel: &CancelToken) -> Result<Vec<Row>, PaperError> {
    const GROUP: &str = "Rejection sampling that never ends";
    let mut rows = Vec::new();
    for part in PaperPart::ALL {
        let (region, sampler) = (part.name(), Sampler::new(&part.region(), &part.spacing())?);
        for count in COUNTS {
            let block = |b: usize| {
                cancel.check()?;
                let mut rng = random::stream(settings.seed, &format!("reproduce/dead ends/{region}/{count}/{b}"));
                let begun = 0..BLOCK.min(settings.draws - b * BLOCK);
                Ok(begun
                    .filter(|_| matches!(sampler.attempt(count, &mut rng), Attempt::DeadEnd { .. }))
                    .count())
            };
            let blocks = (0..settings.draws.div_ceil(BLOCK)).into_par_iter().map(block);
            let stalled: usize = blocks.collect::<Result<Vec<_>, Cancelled>>()?.into_iter().sum();
            let key = format!("dead_end_rate.{region}.{count}_plates");
            let quantity = format!("runs that hang, {count} plates, {region} region");
            let rate = binomial_percent(stalled, settings.draws);
            rows.push(Row::new(GROUP, key, quantity, "%", 0.0, rate));
        }
    }
    Ok(rows)
}
