//! `platewash sweep`: many layouts of one scenario, each planned and proved.

use super::failure::ExitCode;
use super::files::Files;
use super::numbers::seed;
use super::options::Options;
use super::output::{self, Progress, Reader};
use super::terminal::shown;
use anyhow::{Context, Result, ensure};
use clap::Args;
use platewash::scenario::Program;
use platewash::study::{Outcome, Row};
use platewash::workcell::job::MAX_SEED;
use platewash::{Scenario, sweep};
use std::io::IsTerminal;
use std::ops::{ControlFlow, RangeInclusive};

/// Most layouts of one call.
const MOST_LAYOUTS: u64 = 100_000;

/// First line of the table.
const HEADER: &str = "seed,outcome,duration_s,swept,pressed,clearance_m,reason\n";

/// Arguments of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArguments {
    /// First and last seed, for example 1..200
    #[arg(long, value_name = "FIRST..LAST", value_parser = seeds, allow_hyphen_values = true)]
    seeds: RangeInclusive<u64>,
}

fn seeds(text: &str) -> Result<RangeInclusive<u64>> {
    let expected = || {
        format!("must be FIRST..LAST, two whole numbers from 0 to {MAX_SEED} (2^53 − 1), the first at most the last")
    };
    let (first, last) = text.split_once("..").with_context(expected)?;
    let end = |text: &str| seed(text.trim()).with_context(expected);
    let (first, last) = (end(first)?, end(last)?);
    ensure!(first <= last, expected());
    ensure!(last - first < MOST_LAYOUTS, "at most {MOST_LAYOUTS} layouts at a time");
    Ok(first..=last)
}

/// Plans and proves a layout a seed; prints a table (CSV), each row as soon as it is done, or JSON, and with `--out` writes `sweep.csv` there.
pub fn run(options: &Options, arguments: &SweepArguments) -> Result<ExitCode> {
    let scenario = options.scenario()?;
    ensure!(
        scenario.job.program == Program::Certified,
        "sweep plans certified jobs; scenario \"{}\" has job.program = \"paper\": see reproduce",
        scenario.name
    );
    let mut files = Files::new(options.out.clone(), &["sweep.csv"]);
    files.check()?;
    options.arm(&scenario)?;
    let (rows, reader) = rows(options, &scenario, arguments)?;
    options.cancel.check()?;
    if options.out.is_none() && reader == Reader::Gone {
        // Nobody wants the other rows, nor a verdict about them.
        return Ok(ExitCode::Done);
    }
    files.add(
        "sweep.csv",
        HEADER.to_owned() + &rows.iter().map(csv_line).collect::<String>(),
    );
    files.write(&options.cancel)?;
    if options.json {
        output::print(&output::json(&rows)?)?;
    }
    let count = |outcome| rows.iter().filter(|row: &&Row| row.outcome == outcome).count();
    let (total, proved, not_proved) = (rows.len(), count(Outcome::Proved), count(Outcome::NotProved));
    let [infeasible, not_found, failed] = [Outcome::Infeasible, Outcome::NotFound, Outcome::Error].map(count);
    options.say(&format!(
        "{proved} of {total} proved, {not_proved} planned but not proved, {infeasible} infeasible, {not_found} not found, {failed} with an error"
    ));
    if let Some(worst) = worst_row_text(&rows) {
        options.say(&worst);
    }
    let code = match infeasible + not_found + failed {
        0 => ExitCode::NotVerified.unless(not_proved == 0),
        _ => ExitCode::Infeasible,
    };
    Ok(code.job(scenario.job.on_failure))
}

/// A row as a line of the table.
fn csv_line(row: &Row) -> String {
    let number = |v: Option<f64>| v.map(|v| v.to_string()).unwrap_or_default();
    let numbers = [row.duration_s, row.swept, row.pressed, row.clearance_m]
        .map(number)
        .join(",");
    let reason = row.reason.as_deref().unwrap_or_default().replace('"', "\"\"");
    format!("{},{},{numbers},\"{reason}\"\n", row.axes["seed"], row.outcome.code())
}

/// The row to look at first, in words: one that is not proved, or else the one of the least clearance; and the slowest of those proved.
fn worst_row_text(rows: &[Row]) -> Option<String> {
    let others = rows.iter().filter(|row| row.outcome != Outcome::Proved);
    if let Some(row) = others.max_by_key(|row| row.outcome) {
        let reason = row.reason.as_ref().map(|reason| format!(": {reason}"));
        let (seed, outcome) = (&row.axes["seed"], row.outcome.code());
        return Some(format!("worst: seed {seed}, {outcome}{}", reason.unwrap_or_default()));
    }
    let of = |number: fn(&Row) -> Option<f64>| {
        rows.iter()
            .filter_map(move |row| Some((number(row)?, &row.axes["seed"])))
    };
    let (clearance_m, nearest) = of(|row| row.clearance_m).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let (duration_s, slowest) = of(|row| row.duration_s).max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(format!(
        "least clearance: seed {nearest}, {:.1} mm; slowest: seed {slowest}, {duration_s:.2} s",
        1e3 * clearance_m
    ))
}

/// The rows; as text they are printed one by one, in the order of the seeds, as JSON in the end. Where nothing is written to a
/// file, the rows end when the reader of standard output leaves.
fn rows(options: &Options, scenario: &Scenario, arguments: &SweepArguments) -> Result<(Vec<Row>, Reader)> {
    let shows_rows = !options.json && std::io::stdout().is_terminal();
    let _progress = Progress::new(options.quiet || shows_rows, "planning and proving");
    let (mut printed, mut header) = (Ok(Reader::There), Some(HEADER));
    let mut print = |row: &Row| {
        if !options.json && matches!(printed, Ok(Reader::There)) {
            let line = header.take().unwrap_or_default().to_owned() + &csv_line(row);
            printed = output::print(&shown(&line));
        }
        match printed {
            Ok(Reader::There) => ControlFlow::Continue(()),
            Ok(Reader::Gone) if options.out.is_some() => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    };
    let rows = sweep(scenario, arguments.seeds.clone(), &options.cancel, &mut print);
    let rows = rows.map_err(|error| options.failure(error))?;
    Ok((rows, printed?))
}
