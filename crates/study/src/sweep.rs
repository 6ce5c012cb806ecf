//! Sweep: a study of one axis, the seed, whose rows no folder keeps.

use crate::row::Row;
use crate::row_maker::{judged, row_of};
use crate::study::RowAddress;
use platewash_kinematics::RobotModel;
use platewash_scenario::{Failure, Scenario, ScenarioError, TextKind, check_seed};
use platewash_workcell::cancel::CancelToken;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// Plans and proves the scenario with every seed: `done` gets each row in the order in which they are given, as soon as it and those before it
/// are done. No further layout begins once `done` breaks or the token cancels; then the rows that `done` got are returned. Threads are
/// rayon's, and the rows depend on none of them.
///
/// # Errors
/// [`Failure`] for a scenario that is wrong for every seed; what goes wrong with one is a row.
pub fn sweep(
    scenario: &Scenario,
    seeds: impl Iterator<Item = u64> + Clone + Send,
    cancel: &CancelToken,
    done: &mut (dyn FnMut(&Row) -> ControlFlow<()> + Send),
) -> Result<Vec<Row>, Failure> {
    let seed_error = |problem| ScenarioError {
        kind: TextKind::Scenario,
        source_name: scenario.name.as_str().into(),
        line: None,
        problem,
    };
    let greatest = seeds.clone().max().unwrap_or_default();
    check_seed("the last of the seeds", greatest).map_err(seed_error)?;
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
    let in_order = Mutex::new((Vec::new(), BTreeMap::new(), ControlFlow::Continue(()), done));
    let locked = || in_order.lock().unwrap_or_else(PoisonError::into_inner);
    // A bridge hands the seeds out one after the other, so that the first rows are done first. That somebody broke off is no
    // error: the rows up to there are kept.
    let _: Option<()> = (0..).zip(seeds).par_bridge().try_for_each(|place| {
        let row = row(scenario, &arm, place, cancel)?;
        let (rows, waiting, flow, done) = &mut *locked();
        waiting.insert(row.index, row);
        while flow.is_continue()
            && let Some(row) = waiting.remove(&(rows.len() as u64))
        {
            *flow = done(&row);
            rows.push(row);
        }
        flow.continue_value()
    });
    Ok(in_order.into_inner().unwrap_or_else(PoisonError::into_inner).0)
}

/// One layout, by its index and seed; `None` where it was given up.
fn row(scenario: &Scenario, arm: &Arc<RobotModel>, (index, seed): (u64, u64), cancel: &CancelToken) -> Option<Row> {
    let mut scenario = scenario.clone();
    scenario.seed = seed;
    let address = RowAddress::new(0, &scenario.name, BTreeMap::from([("seed".to_owned(), seed.into())]));
    let row = Row::new(index, address.key, scenario.name.clone(), address.axes);
    row_of(row, judged(&scenario, arm, cancel)).map(|(row, _)| row)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The range holds more seeds than could ever be planned.
    #[test]
    fn planning_ends_when_nobody_reads_rows() {
        let mut told = Vec::new();
        let mut tell = |row: &Row| {
            told.push(row.axes["seed"].as_u64().unwrap());
            if told.len() < 2 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        let kitchen = Scenario::load("kitchen").unwrap();
        let rows = sweep(&kitchen, 1..=u64::from(u32::MAX), &CancelToken::new(), &mut tell).unwrap();
        assert_eq!(told, [1, 2]);
        assert_eq!(rows.iter().map(|row| row.index).collect::<Vec<_>>(), [0, 1]);
    }
}
