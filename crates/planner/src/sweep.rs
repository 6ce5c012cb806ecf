//! Many layouts of one scenario, each planned and proved.

use crate::certificate::{self, Certificate, CertificateVerdict, PromiseName, headline};
use crate::cycle::Cycle;
use crate::error::{Infeasibility, PlanError};
use crate::robot;
use crate::scenario::{Scenario, ScenarioError, check_seed};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::{ControlFlow, RangeInclusive};
use std::sync::{Mutex, PoisonError};

/// How one layout ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SweepOutcome {
    /// Planned, and every promise proved.
    Proved,
    /// Planned, but a promise is broken or not proved.
    NotProved,
    /// The layout cannot be washed.
    Infeasible,
    /// No way to wash the layout was found; there may be one.
    NotFound,
    /// The numbers of this seed cannot be computed with.
    Error,
}

impl SweepOutcome {
    /// Its name, as in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::NotProved => "not_proved",
            Self::Infeasible => "infeasible",
            Self::NotFound => "not_found",
            Self::Error => "error",
        }
    }
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
    /// Where nothing was planned: why. Where something is not proved: the promises. Where it is proved but for what the scenario waives:
    /// that.
    pub reason: Option<String>,
}

/// Plans and proves the scenario with every seed, in order; threads are rayon's, and the answer depends on none of them.
///
/// # Errors
/// [`PlanError`] for a scenario that is wrong for every seed; what goes wrong with one is a row.
pub fn sweep(scenario: &Scenario, seeds: RangeInclusive<u64>) -> Result<Vec<SweepRow>, PlanError> {
    sweep_each(scenario, seeds, &mut |_| ControlFlow::Continue(()))
}

/// The same; `done` is told each row in the order of the seeds, as soon as it and those before it are done. Where it breaks,
/// no further layout is begun, and the rows that it was told are the answer.
///
/// # Errors
/// As [`sweep`].
pub fn sweep_each(
    scenario: &Scenario,
    seeds: RangeInclusive<u64>,
    done: &mut (dyn FnMut(&SweepRow) -> ControlFlow<()> + Send),
) -> Result<Vec<SweepRow>, PlanError> {
    let seed_error = |problem| ScenarioError {
        source_name: scenario.name.clone(),
        line: None,
        problem,
    };
    check_seed("the last of the seeds", *seeds.end()).map_err(seed_error)?;
    scenario.validate()?;
    scenario.check_work()?;
    match Cycle::check(scenario, &robot::load(&scenario.robot)?, &[]) {
        Err(error) if !error.is_infeasible() => return Err(error),
        _ => (),
    }
    let in_order = Mutex::new(InOrder {
        rows: Vec::new(),
        waiting: BTreeMap::new(),
        flow: ControlFlow::Continue(()),
        done,
    });
    let locked = || in_order.lock().unwrap_or_else(PoisonError::into_inner);
    // A bridge hands the seeds out one after the other, so that the first rows are done first. That somebody broke off is no
    // error: the rows up to there are kept.
    let _: Option<()> = seeds.enumerate().par_bridge().try_for_each(|(place, seed)| {
        let row = row(scenario, seed);
        locked().add(place, row).continue_value()
    });
    Ok(in_order.into_inner().unwrap_or_else(PoisonError::into_inner).rows)
}

/// Rows that come in any order, told and kept in that of the seeds.
struct InOrder<'a> {
    rows: Vec<SweepRow>,
    waiting: BTreeMap<usize, SweepRow>,
    /// Whether somebody still wants rows.
    flow: ControlFlow<()>,
    done: &'a mut (dyn FnMut(&SweepRow) -> ControlFlow<()> + Send),
}

impl InOrder<'_> {
    fn add(&mut self, place: usize, row: SweepRow) -> ControlFlow<()> {
        self.waiting.insert(place, row);
        while self.flow.is_continue() {
            let Some(row) = self.waiting.remove(&self.rows.len()) else {
                break;
            };
            self.flow = (self.done)(&row);
            self.rows.push(row);
        }
        self.flow
    }
}

fn row(scenario: &Scenario, seed: u64) -> SweepRow {
    let scenario = Scenario {
        seed,
        ..scenario.clone()
    };
    let cycle = match Cycle::plan(&scenario) {
        Ok(cycle) => cycle,
        Err(error) => {
            let outcome = match error.infeasibility() {
                Some(Infeasibility::Proved) => SweepOutcome::Infeasible,
                Some(Infeasibility::NotFound) => SweepOutcome::NotFound,
                None => SweepOutcome::Error,
            };
            return SweepRow::nothing(seed, outcome, error.to_string());
        }
    };
    let proof = cycle
        .to_plan()
        .map_err(|e| e.to_string())
        .and_then(|plan| certificate::verify(&plan, &cycle.robot).map_err(|e| e.to_string()));
    match proof {
        Ok(certificate) => SweepRow::planned(seed, &cycle, &certificate),
        Err(reason) => SweepRow::nothing(seed, SweepOutcome::NotProved, reason),
    }
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
        let waived = headline::but_for(certificate);
        let waived = Some(waived.trim()).filter(|waived| !waived.is_empty());
        let bound = |name| certificate.promise(name)?.measure?.bound;
        Self {
            seed,
            outcome: match certificate.verdict {
                CertificateVerdict::Pass => SweepOutcome::Proved,
                CertificateVerdict::Fail => SweepOutcome::NotProved,
            },
            duration_s: Some(cycle.motion.duration_s()),
            crossings_s: Some(cycle.crossings.iter().map(|c| c.duration_s).sum()),
            coverage: bound(PromiseName::Coverage),
            clearance_m: bound(PromiseName::Clearance),
            reason: headline::not_kept(certificate).or(waived.map(str::to_owned)),
        }
    }
}

/// The first line of the table.
pub const HEADER: &str = "seed,outcome,duration_s,crossings_s,coverage,clearance_m,reason\n";

impl SweepRow {
    /// The row as a line of CSV.
    #[must_use]
    pub fn csv_line(&self) -> String {
        let number = |v: Option<f64>| v.map(|v| v.to_string()).unwrap_or_default();
        let reason = self.reason.as_deref().unwrap_or_default().replace('"', "\"\"");
        let numbers = [self.duration_s, self.crossings_s, self.coverage, self.clearance_m]
            .map(number)
            .join(",");
        format!("{},{},{numbers},\"{reason}\"\n", self.seed, self.outcome.name())
    }
}

/// Rows as CSV, with a header.
#[must_use]
pub fn csv(rows: &[SweepRow]) -> String {
    let lines = rows.iter().map(SweepRow::csv_line);
    std::iter::once(HEADER.to_owned()).chain(lines).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_told_in_the_order_of_the_seeds_whichever_is_done_first() {
        let mut told = Vec::new();
        let mut tell = |row: &SweepRow| {
            told.push(row.seed);
            ControlFlow::Continue(())
        };
        let mut in_order = InOrder {
            rows: Vec::new(),
            waiting: BTreeMap::new(),
            flow: ControlFlow::Continue(()),
            done: &mut tell,
        };
        let row = |seed| SweepRow::nothing(seed, SweepOutcome::Error, "a \"b\"".to_owned());
        assert!(in_order.add(2, row(12)).is_continue());
        assert!(in_order.rows.is_empty());
        assert!(in_order.add(0, row(10)).is_continue());
        assert_eq!(in_order.rows.len(), 1);
        assert!(in_order.add(1, row(11)).is_continue());
        assert_eq!(in_order.rows.len(), 3);
        assert_eq!(told, [10, 11, 12]);
        assert_eq!(row(7).csv_line(), "7,error,,,,,\"a \"\"b\"\"\"\n");
    }

    /// Of more seeds than could ever be planned.
    #[test]
    fn nothing_more_is_planned_once_nobody_wants_rows() {
        let mut told = Vec::new();
        let mut tell = |row: &SweepRow| {
            told.push(row.seed);
            if told.len() < 2 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        let rows = sweep_each(&Scenario::load("kitchen").unwrap(), 1..=u64::from(u32::MAX), &mut tell).unwrap();
        assert_eq!(told, [1, 2]);
        assert_eq!(rows.iter().map(|row| row.seed).collect::<Vec<_>>(), [1, 2]);
    }
}
