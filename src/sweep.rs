//! Many layouts of one scenario, each planned and proved.

use platewash_certificate::{Certificate, Requirement};
use platewash_kinematics::RobotModel;
use platewash_planner::Planned;
use platewash_scenario::{Failure, Scenario, ScenarioError, check_seed};
use platewash_study::{Outcome, judged};
use platewash_workcell::cancel::CancelToken;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::{ControlFlow, RangeInclusive};
use std::sync::{Arc, Mutex, PoisonError};

/// One layout.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepRow {
    /// The scenario's seed.
    pub seed: u64,
    /// How it ended.
    pub outcome: Outcome,
    /// Duration of the motion \[s\].
    pub duration_s: Option<f64>,
    /// Sum of the transits \[s\].
    pub transits_s: Option<f64>,
    /// Share swept of the plate that is swept least, guaranteed.
    pub swept: Option<f64>,
    /// Smallest clearance of all pairs but the sponge and the plates while it works, guaranteed \[m\].
    pub clearance_m: Option<f64>,
    /// Where nothing was planned: why. Where something is not proved: the requirements. Where it is proved but for what the scenario waives:
    /// that.
    pub reason: Option<String>,
}

/// Plans and proves the scenario with every seed, in order; threads are rayon's, and the answer depends on none of them.
///
/// # Errors
/// [`Failure`] for a scenario that is wrong for every seed; what goes wrong with one is a row.
pub fn sweep(scenario: &Scenario, seeds: RangeInclusive<u64>) -> Result<Vec<SweepRow>, Failure> {
    sweep_each(scenario, seeds, &CancelToken::new(), &mut |_| ControlFlow::Continue(()))
}

/// [`sweep`], one row after the other: `done` is told each in the order of the seeds, as soon as it and those before it are done. Where
/// it breaks, or the token cancels, no further layout is begun, and the rows that it was told are the answer.
///
/// # Errors
/// As [`sweep`].
pub fn sweep_each(
    scenario: &Scenario,
    seeds: RangeInclusive<u64>,
    cancel: &CancelToken,
    done: &mut (dyn FnMut(&SweepRow) -> ControlFlow<()> + Send),
) -> Result<Vec<SweepRow>, Failure> {
    let seed_error = |problem| ScenarioError {
        source_name: scenario.name.clone(),
        line: None,
        problem,
    };
    check_seed("the last of the seeds", *seeds.end()).map_err(seed_error)?;
    scenario.validate()?;
    scenario.check_work()?;
    let arm = match scenario.check() {
        Ok((arm, _)) => arm,
        Err(error) if error.infeasibility().is_some() => scenario.arm()?,
        Err(error) => return Err(error),
    };
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
        let row = row(scenario, &arm, seed, cancel)?;
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

/// One layout; `None` where it was given up.
fn row(scenario: &Scenario, arm: &Arc<RobotModel>, seed: u64, cancel: &CancelToken) -> Option<SweepRow> {
    let scenario = Scenario {
        seed,
        ..scenario.clone()
    };
    match judged(&scenario, arm, cancel) {
        Ok((planned, certificate)) => Some(SweepRow::planned(seed, &planned, &certificate)),
        Err(error) if error.is_cancelled() => None,
        Err(error) => Some(SweepRow::nothing(seed, Outcome::from(&error), error.to_string())),
    }
}

impl SweepRow {
    fn nothing(seed: u64, outcome: Outcome, reason: String) -> Self {
        Self {
            seed,
            outcome,
            duration_s: None,
            transits_s: None,
            swept: None,
            clearance_m: None,
            reason: Some(reason),
        }
    }

    fn planned(seed: u64, planned: &Planned, certificate: &Certificate) -> Self {
        Self {
            seed,
            outcome: Outcome::judged(certificate.verdict),
            duration_s: Some(planned.plan.duration_s()),
            transits_s: Some(planned.transits.iter().map(|c| c.duration_s).sum()),
            swept: certificate.bound(Requirement::Swept),
            clearance_m: certificate.bound(Requirement::Clearance),
            reason: certificate.reason(),
        }
    }
}

/// The first line of a sweep as CSV.
pub const SWEEP_HEADER: &str = "seed,outcome,duration_s,transits_s,swept,clearance_m,reason\n";

impl SweepRow {
    /// The row as a line of CSV.
    #[must_use]
    pub fn csv_line(&self) -> String {
        let number = |v: Option<f64>| v.map(|v| v.to_string()).unwrap_or_default();
        let reason = self.reason.as_deref().unwrap_or_default().replace('"', "\"\"");
        let numbers = [self.duration_s, self.transits_s, self.swept, self.clearance_m]
            .map(number)
            .join(",");
        format!("{},{},{numbers},\"{reason}\"\n", self.seed, self.outcome.code())
    }
}

/// Rows as CSV, with a header.
#[must_use]
pub fn sweep_csv(rows: &[SweepRow]) -> String {
    let lines = rows.iter().map(SweepRow::csv_line);
    std::iter::once(SWEEP_HEADER.to_owned()).chain(lines).collect()
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
        let row = |seed| SweepRow::nothing(seed, Outcome::Error, "a \"b\"".to_owned());
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
        let rows = sweep_each(
            &Scenario::load("kitchen").unwrap(),
            1..=u64::from(u32::MAX),
            &CancelToken::new(),
            &mut tell,
        )
        .unwrap();
        assert_eq!(told, [1, 2]);
        assert_eq!(rows.iter().map(|row| row.seed).collect::<Vec<_>>(), [1, 2]);
    }
}
