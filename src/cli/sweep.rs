//! `platewash sweep`: many layouts of one scenario, each planned and proved.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::{self, Options};
use super::output::{self, Reader};
use super::progress::Progress;
use super::text::text;
use anyhow::{Context, ensure};
use clap::Args;
use platewash::scenario::Program;
use platewash::workcell::job::MAX_SEED;
use platewash::{SWEEP_HEADER, Scenario, SweepRow, study, sweep_csv, sweep_each};
use std::cmp::Ordering;
use std::io::IsTerminal;
use std::ops::{ControlFlow, RangeInclusive};

/// Most layouts of one call.
const MOST_LAYOUTS: u64 = 100_000;

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// First and last seed, for example 1..200
    #[arg(long, value_name = "FIRST..LAST", value_parser = seeds, allow_hyphen_values = true)]
    pub seeds: RangeInclusive<u64>,
}

/// Plans and proves a layout a seed; prints a table (CSV), each row as soon as it is done, or JSON, and with `--out` writes `sweep.csv` there.
pub fn run(options: &Options, arguments: &SweepArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    if scenario.job.program != Program::Certified {
        return Err(Failure::input(anyhow::anyhow!(
            "sweep plans certified jobs; scenario \"{}\" has job.program = \"paper\": see reproduce",
            scenario.name
        )));
    }
    let table = options.out.as_ref().map(|folder| folder.join("sweep.csv"));
    output::check_places(table.as_slice())?;
    options.arm(&scenario)?;
    let (rows, reader) = rows(options, &scenario, arguments)?;
    options.cancel.check()?;
    if table.is_none() && reader == Reader::Gone {
        // Nobody wants the other rows, nor a verdict about them.
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(table) = table {
        output::write_files(&[output::file(table, sweep_csv(&rows))], &options.cancel)?;
    }
    if options.json {
        output::print(&output::json(&rows)?)?;
    }
    let count = |outcome| rows.iter().filter(|row: &&SweepRow| row.outcome == outcome).count();
    let [proved, not_proved, infeasible, not_found, failed] = [
        study::Outcome::Proved,
        study::Outcome::NotProved,
        study::Outcome::Infeasible,
        study::Outcome::NotFound,
        study::Outcome::Error,
    ]
    .map(count);
    let total = rows.len();
    output::message(
        options.quiet,
        &format!(
            "{proved} of {total} proved, {not_proved} planned but not proved, {infeasible} infeasible, {not_found} not found, {failed} with an error"
        ),
    );
    if let Some(worst) = worst(&rows) {
        output::message(options.quiet, &worst);
    }
    let outcome = if infeasible + not_found + failed > 0 {
        Outcome::Infeasible
    } else if not_proved > 0 {
        Outcome::NotVerified
    } else {
        Outcome::Good
    };
    Ok(outcome.job(scenario.job.on_failure))
}

/// The row to look at first, in words: one that is not proved, or else the one of the least clearance; and the slowest of those proved.
fn worst(rows: &[SweepRow]) -> Option<String> {
    if let Some(row) = rows
        .iter()
        .filter(|row| row.outcome != study::Outcome::Proved)
        .max_by_key(|row| row.outcome)
    {
        let reason = row
            .reason
            .as_ref()
            .map_or_else(String::new, |reason| format!(": {reason}"));
        return Some(format!("worst: seed {}, {}{reason}", row.seed, row.outcome.code()));
    }
    let nearest = rows
        .iter()
        .min_by(|a, b| a.clearance_m.partial_cmp(&b.clearance_m).unwrap_or(Ordering::Equal))?;
    let slowest = rows
        .iter()
        .max_by(|a, b| a.duration_s.partial_cmp(&b.duration_s).unwrap_or(Ordering::Equal))?;
    Some(format!(
        "least clearance: seed {}, {:.1} mm; slowest: seed {}, {:.2} s",
        nearest.seed,
        1e3 * nearest.clearance_m?,
        slowest.seed,
        slowest.duration_s?
    ))
}

/// The rows; as text they are printed one by one, in the order of the seeds, as JSON in the end. Where nothing is written to a
/// file, the rows end when the reader of standard output leaves.
fn rows(
    options: &Options,
    scenario: &Scenario,
    arguments: &SweepArguments,
) -> Result<(Vec<SweepRow>, Reader), Failure> {
    let shows_rows = !options.json && std::io::stdout().is_terminal();
    let _progress = Progress::new(options.quiet || shows_rows, "planning and proving");
    let (mut printed, mut header) = (Ok(Reader::There), Some(SWEEP_HEADER));
    let mut print = |row: &SweepRow| {
        if !options.json && matches!(printed, Ok(Reader::There)) {
            let line = header.take().unwrap_or_default().to_owned() + &row.csv_line();
            printed = output::print(&text(&line));
        }
        match printed {
            Ok(Reader::There) => ControlFlow::Continue(()),
            Ok(Reader::Gone) if options.out.is_some() => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    };
    let rows = sweep_each(scenario, arguments.seeds.clone(), &options.cancel, &mut print);
    let rows = rows.map_err(|error| options.failure(error))?;
    Ok((rows, printed?))
}

fn seeds(text: &str) -> anyhow::Result<RangeInclusive<u64>> {
    let expected = || {
        format!("must be FIRST..LAST, two whole numbers from 0 to {MAX_SEED} (2^53 − 1), the first at most the last")
    };
    let (first, last) = text.split_once("..").with_context(expected)?;
    let end = |text: &str| options::seed(text.trim()).with_context(expected);
    let (first, last) = (end(first)?, end(last)?);
    ensure!(first <= last, expected());
    ensure!(last - first < MOST_LAYOUTS, "at most {MOST_LAYOUTS} layouts at a time");
    Ok(first..=last)
}
