//! `platewash sweep`: many layouts of one scenario, each planned and proved.

use super::failure::{ExitCode, Failure, INFEASIBLE, NOT_VERIFIED};
use super::options::Options;
use super::output;
use super::progress::Progress;
use anyhow::{Context, ensure};
use clap::Args;
use platewash::planner::scenario::{OnFailure, Program};
use platewash::planner::sweep::{self, SweepOutcome, SweepRow};
use std::ops::RangeInclusive;

/// Most layouts of one call.
const MOST_LAYOUTS: u64 = 100_000;

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// Seeds, both ends included, e.g. 1..200
    #[arg(long, value_name = "FIRST..LAST", value_parser = seeds)]
    pub seeds: RangeInclusive<u64>,
}

/// Plans and proves a layout a seed; prints a table (CSV) or JSON, and with `--out` writes `sweep.csv` there.
pub fn run(options: &Options, arguments: &SweepArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    if scenario.job.program != Program::Certified {
        return Err(Failure::input(anyhow::anyhow!(
            "sweep plans certified jobs; scenario \"{}\" has job.program = \"paper\": see reproduce",
            scenario.name
        )));
    }
    let rows = {
        let _progress = Progress::new(options.quiet, "planning and proving");
        sweep::sweep(&scenario, arguments.seeds.clone())?
    };
    if let Some(folder) = &options.out {
        output::write_files(&[(folder.join("sweep.csv"), sweep::csv(&rows))])?;
    }
    output::print_either(options.json, &rows, || sweep::csv(&rows))?;
    let count = |outcome| rows.iter().filter(|row: &&SweepRow| row.outcome == outcome).count();
    let [proved, not_proved, infeasible] =
        [SweepOutcome::Proved, SweepOutcome::NotProved, SweepOutcome::Infeasible].map(count);
    let total = rows.len();
    output::message(
        options.quiet,
        &format!("{proved} of {total} proved, {not_proved} planned but not proved, {infeasible} infeasible"),
    );
    Ok(ExitCode::from(match scenario.job.on_failure {
        OnFailure::Fail if infeasible > 0 => INFEASIBLE,
        OnFailure::Fail if not_proved > 0 => NOT_VERIFIED,
        _ => 0,
    }))
}

fn seeds(text: &str) -> anyhow::Result<RangeInclusive<u64>> {
    let expected = "must be FIRST..LAST, two whole numbers, the first at most the last";
    let (first, last) = text.split_once("..").context(expected)?;
    let (first, last): (u64, u64) = (
        first.trim().parse().context(expected)?,
        last.trim().parse().context(expected)?,
    );
    ensure!(first <= last, expected);
    ensure!(last - first < MOST_LAYOUTS, "at most {MOST_LAYOUTS} layouts at a time");
    Ok(first..=last)
}
