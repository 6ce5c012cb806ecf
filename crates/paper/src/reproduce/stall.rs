//! How often sequential sampling comes to a dead end: there the paper's program hangs.

use super::result::{ReproduceSettings, Row, row};
use super::statistics::binomial_percent;
use crate::error::PaperError;
use crate::part::PaperPart;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::layout::{Attempt, Sampler};
use platewash_workcell::random;
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Plates asked for, for each of which the rate is measured.
const COUNTS: [usize; 3] = [3, 4, 5];

/// Layouts begun per random stream; a constant, so that the answer does not depend on the number of threads.
const BLOCK: usize = 500;

/// The rates; `go_on` is asked now and then, from any thread, and ends the work when it breaks.
pub(super) fn rows(
    settings: &ReproduceSettings,
    go_on: &(dyn Fn() -> ControlFlow<()> + Sync),
) -> Result<Vec<Row>, PaperError> {
    const GROUP: &str = "Rejection sampling that never ends";
    let mut rows = Vec::new();
    for part in PaperPart::ALL {
        let (region, sampler) = (part.name(), Sampler::new(&part.region(), &part.spacing())?);
        for count in COUNTS {
            let stalled = dead_ends(&sampler, settings, region, count, go_on)?;
            rows.push(row(
                GROUP,
                format!("dead_end_rate.{region}.{count}_plates"),
                format!("runs that hang, {count} plates, {region} region"),
                "%",
                Some(0.0),
                binomial_percent(stalled, settings.draws),
            ));
        }
    }
    Ok(rows)
}

fn dead_ends(
    sampler: &Sampler,
    settings: &ReproduceSettings,
    region: &str,
    count: usize,
    go_on: &(dyn Fn() -> ControlFlow<()> + Sync),
) -> Result<usize, Cancelled> {
    let block = |b: usize| {
        let mut rng = random::stream(settings.seed, &format!("reproduce/dead ends/{region}/{count}/{b}"));
        let attempts = BLOCK.min(settings.draws - b * BLOCK);
        let dead_ends = (0..attempts)
            .filter(|_| matches!(sampler.attempt(count, &mut rng), Attempt::DeadEnd { .. }))
            .count();
        match go_on() {
            ControlFlow::Continue(()) => Ok(dead_ends),
            ControlFlow::Break(()) => Err(Cancelled),
        }
    };
    let blocks = (0..settings.draws.div_ceil(BLOCK)).into_par_iter().map(block);
    Ok(blocks.collect::<Result<Vec<_>, _>>()?.into_iter().sum())
}
