//! Many layouts of one scenario, each planned and proved.

use platewash_certificate::Requirement;
use platewash_kinematics::RobotModel;
use platewash_scenario::{Failure, Scenario, ScenarioError, TextKind, check_seed};
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
    /// Outcome of planning and proving.
    pub outcome: Outcome,
    /// Duration of the motion \[s\].
    pub duration_s: Option<f64>,
    /// Sum of the transits \[s\].
    pub transits_s: Option<f64>,
    /// Share swept of the plate that is swept least, guaranteed.
    pub swept: Option<f64>,
    /// Smallest clearance of all pairs but the sponge and the plates while it works, guaranteed \[m\].
    pub clearance_m: Option<f64>,
    /// Cause, where nothing was planned; otherwise the requirements that are not proved, or those that the scenario waives.
    pub reason: Option<String>,
}

/// Plans and proves the scenario with every seed, in order; threads are rayon's, and the answer depends on none of them.
///
/// # Errors
/// [`Failure`] for a scenario that is wrong for every seed; what goes wrong with one is a row.
pub fn sweep(scenario: &Scenario, seeds: RangeInclusive<u64>) -> Result<Vec<SweepRow>, Failure> {
    sweep_each(scenario, seeds, &CancelToken::new(), &mut |_| ControlFlow::Continue(()))
}

/// Runs [`sweep`] row by row: `done` gets each row in the order of the seeds, as soon as it and those before it are done. No
/// further layout begins once `done` breaks or the token cancels; then the rows that `done` got are returned.
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
        kind: TextKind::Scenario,
        source_name: scenario.name.as_str().into(),
        line: None,
        problem,
    };
    check_seed("the last of the seeds", *seeds.end()).map_err(seed_error)?;
    // Its files are read once, not for every seed.
    let read = scenario.plates_read()?;
    let scenario = &*read;
    scenario.validate()?;
    scenario.check_work()?;
    let arm = match scenario.check() {
        Ok((arm, _)) => arm,
        Err(error) if error.infeasibility().is_some() => scenario.arm()?,
        Err(error) => return Err(error),
    };
    let (first, told) = (*seeds.start(), ControlFlow::Continue(()));
    let in_order = Mutex::new((Vec::new(), BTreeMap::new(), told, done));
    let locked = || in_order.lock().unwrap_or_else(PoisonError::into_inner);
    // A bridge hands the seeds out one after the other, so that the first rows are done first. That somebody broke off is no
    // error: the rows up to there are kept.
    let _: Option<()> = seeds.par_bridge().try_for_each(|seed| {
        let row = row(scenario, &arm, seed, cancel)?;
        let (rows, waiting, flow, done) = &mut *locked();
        waiting.insert(seed, row);
        while flow.is_continue()
            && let Some(row) = waiting.remove(&(first + rows.len() as u64))
        {
            *flow = done(&row);
            rows.push(row);
        }
        flow.continue_value()
    });
    Ok(in_order.into_inner().unwrap_or_else(PoisonError::into_inner).0)
}

/// One layout; `None` where it was given up.
fn row(scenario: &Scenario, arm: &Arc<RobotModel>, seed: u64, cancel: &CancelToken) -> Option<SweepRow> {
    let mut scenario = scenario.clone();
    scenario.seed = seed;
    let none = SweepRow {
        seed,
        outcome: Outcome::Error,
        duration_s: None,
        transits_s: None,
        swept: None,
        clearance_m: None,
        reason: None,
    };
    match judged(&scenario, arm, cancel) {
        Ok((planned, certificate)) => Some(SweepRow {
            outcome: Outcome::judged(certificate.verdict),
            duration_s: Some(planned.plan.duration_s()),
            transits_s: Some(planned.transits.iter().map(|c| c.duration_s).sum()),
            swept: certificate.bound(Requirement::Swept),
            clearance_m: certificate.bound(Requirement::Clearance),
            reason: certificate.reason(),
            ..none
        }),
        Err(error) if error.is_cancelled() => None,
        Err(error) => Some(SweepRow {
            outcome: Outcome::from(&error),
            reason: Some(error.to_string()),
            ..none
        }),
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
    fn a_reason_is_quoted_as_csv_has_it() {
        let row = SweepRow {
            seed: 7,
            outcome: Outcome::Error,
            duration_s: None,
            transits_s: None,
            swept: None,
            clearance_m: Some(0.5),
            reason: Some("a \"b\"".to_owned()),
        };
        assert_eq!(row.csv_line(), "7,error,,,,0.5,\"a \"\"b\"\"\"\n");
    }

    /// The range holds more seeds than could ever be planned.
    #[test]
    fn planning_ends_when_nobody_reads_rows() {
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
