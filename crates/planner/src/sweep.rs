//! Many layouts of one scenario, each planned and proved.

use crate::certificate::{self, Certificate, PromiseName};
use crate::cycle::Cycle;
use crate::job::PlanError;
use crate::scenario::Scenario;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;
use std::ops::RangeInclusive;

/// How one layout ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SweepOutcome {
    /// Planned, and every promise proved.
    Proved,
    /// Planned, but a promise is broken or not proved.
    NotProved,
    /// The layout cannot be washed, or no way was found.
    Infeasible,
}

/// One layout.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepRow {
    /// The scenario's seed.
    pub seed: u64,
    /// How it ended.
    pub outcome: SweepOutcome,
    /// Duration of the cycle \[s\].
    pub duration_s: Option<f64>,
    /// Sum of the crossings \[s\].
    pub crossings_s: Option<f64>,
    /// Coverage of the plate that is covered least, guaranteed.
    pub coverage: Option<f64>,
    /// Smallest clearance of all pairs but the sponge and the plates while it works, guaranteed \[m\].
    pub clearance_m: Option<f64>,
    /// Where nothing was planned: why. Where something is not proved: the promises.
    pub reason: Option<String>,
}

/// Plans and proves the scenario with every seed, in order; threads are rayon's, and the answer depends on none of them.
///
/// # Errors
/// [`PlanError`] for a scenario that is wrong for every seed; one that only cannot be carried out is a row.
pub fn sweep(scenario: &Scenario, seeds: RangeInclusive<u64>) -> Result<Vec<SweepRow>, PlanError> {
    scenario.validate()?;
    let all: Vec<u64> = seeds.collect();
    all.into_par_iter().map(|seed| row(scenario, seed)).collect()
}

fn row(scenario: &Scenario, seed: u64) -> Result<SweepRow, PlanError> {
    let scenario = Scenario {
        seed,
        ..scenario.clone()
    };
    let cycle = match Cycle::plan(&scenario) {
        Ok(cycle) => cycle,
        Err(error) if error.is_infeasible() => {
            return Ok(SweepRow::nothing(seed, SweepOutcome::Infeasible, error.to_string()));
        }
        Err(error) => return Err(error),
    };
    let proof = cycle
        .to_plan()
        .map_err(|e| e.to_string())
        .and_then(|plan| certificate::verify(&plan, &cycle.robot).map_err(|e| e.to_string()));
    Ok(match proof {
        Ok(certificate) => SweepRow::planned(seed, &cycle, &certificate),
        Err(reason) => SweepRow::nothing(seed, SweepOutcome::NotProved, reason),
    })
}

impl SweepRow {
    fn nothing(seed: u64, outcome: SweepOutcome, reason: String) -> Self {
        Self {
            seed,
            outcome,
            duration_s: None,
            crossings_s: None,
            coverage: None,
            clearance_m: None,
            reason: Some(reason),
        }
    }

    fn planned(seed: u64, cycle: &Cycle, certificate: &Certificate) -> Self {
        let broken: Vec<_> = certificate.broken().map(|promise| promise.name.words()).collect();
        let bound = |name| certificate.promise(name)?.measure?.bound;
        Self {
            seed,
            outcome: if broken.is_empty() {
                SweepOutcome::Proved
            } else {
                SweepOutcome::NotProved
            },
            duration_s: Some(cycle.motion.duration_s()),
            crossings_s: Some(cycle.crossings.iter().map(|c| c.duration_s).sum()),
            coverage: bound(PromiseName::Coverage),
            clearance_m: bound(PromiseName::Clearance),
            reason: (!broken.is_empty()).then(|| broken.join(", ")),
        }
    }
}

/// Rows as CSV, with a header.
#[must_use]
pub fn csv(rows: &[SweepRow]) -> String {
    let mut text = String::from("seed,outcome,duration_s,crossings_s,coverage,clearance_m,reason\n");
    for row in rows {
        let number = |v: Option<f64>| v.map(|v| v.to_string()).unwrap_or_default();
        let outcome = match row.outcome {
            SweepOutcome::Proved => "proved",
            SweepOutcome::NotProved => "not_proved",
            SweepOutcome::Infeasible => "infeasible",
        };
        let reason = row.reason.as_deref().unwrap_or_default().replace('"', "\"\"");
        let numbers = [row.duration_s, row.crossings_s, row.coverage, row.clearance_m]
            .map(number)
            .join(",");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{},{outcome},{numbers},\"{reason}\"", row.seed);
    }
    text
}
