//! How often sequential sampling comes to a dead end: there the paper's program hangs.

use super::rows::row;
use super::statistics::binomial_percent;
use super::{REGIONS, ReproduceSettings, Row};
use crate::error::PlanError;
use crate::scenario::Scenario;
use platewash_workcell::layout::{Attempt, Sampler, Spacing};
use platewash_workcell::random;
use rayon::prelude::*;

/// Plates asked for, for each of which the rate is measured.
const COUNTS: [usize; 3] = [3, 4, 5];

/// Layouts begun per random stream; a constant, so that the answer does not depend on the number of threads.
const BLOCK: usize = 500;

pub(super) fn rows(settings: &ReproduceSettings) -> Result<Vec<Row>, PlanError> {
    const GROUP: &str = "Rejection sampling that never ends";
    let mut rows = Vec::new();
    for (name, region, scenario) in REGIONS {
        let layout = Scenario::load(scenario)?.layout;
        let spacing = Spacing {
            min_distance_m: layout.min_distance_m,
            base_radius_m: layout.base_radius_m,
        };
        let sampler = Sampler::new(&name.region(), &spacing)?;
        for count in COUNTS {
            let stalled = dead_ends(&sampler, settings, region, count);
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

fn dead_ends(sampler: &Sampler, settings: &ReproduceSettings, region: &str, count: usize) -> usize {
    let block = |b: usize| {
        let mut rng = random::stream(settings.seed, &format!("reproduce/dead ends/{region}/{count}/{b}"));
        let attempts = BLOCK.min(settings.draws - b * BLOCK);
        (0..attempts)
            .filter(|_| matches!(sampler.attempt(count, &mut rng), Attempt::DeadEnd { .. }))
            .count()
    };
    (0..settings.draws.div_ceil(BLOCK)).into_par_iter().map(block).sum()
}
