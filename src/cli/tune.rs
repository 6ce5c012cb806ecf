//! `platewash tune`: a control law at many frequencies and dampings, and what each buys.

use super::failure::{ExitCode, Failure};
use super::law::{LawArguments, positive};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::{exit, output};
use anyhow::ensure;
use clap::Args;
use platewash::kinematics::words::percent;
use platewash::simulator::simulate::{TuneOutcome, TuneRow};
use platewash::workcell::simulation::SimulationSettings;
use platewash::workcell::words::quoted;
use platewash::{Plan, SimulationVerdict, tune};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

/// Most settings of one call.
const MOST_SETTINGS: usize = 10_000;

/// Arguments of `tune`.
#[derive(Debug, Args)]
pub struct TuneArguments {
    /// Plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    #[command(flatten)]
    pub law: LawArguments,
    /// Natural frequencies in rad/s, separated by commas
    #[arg(long, value_name = "RAD/S,…", value_delimiter = ',', value_parser = positive, default_value = "5,10,15,20,30,50")]
    pub frequencies: Vec<f64>,
    /// Damping ratios, separated by commas
    #[arg(long, value_name = "RATIO,…", value_delimiter = ',', value_parser = positive, default_value = "0.7,1")]
    pub dampings: Vec<f64>,
}

/// One setting as JSON.
#[derive(Debug, Serialize)]
struct Row {
    frequency_rad_s: f64,
    damping_ratio: f64,
    #[serde(flatten)]
    outcome: Outcome,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Outcome {
    Simulated(TuneOutcome),
    Refused(String),
}

impl Row {
    /// How the simulation ended; `None` where it was refused.
    fn verdict(&self) -> Option<SimulationVerdict> {
        match &self.outcome {
            Outcome::Simulated(outcome) => Some(outcome.verdict),
            Outcome::Refused(_) => None,
        }
    }
}

impl From<TuneRow> for Row {
    fn from(row: TuneRow) -> Self {
        Self {
            frequency_rad_s: row.frequency_rad_s,
            damping_ratio: row.damping_ratio,
            outcome: match row.outcome {
                Ok(outcome) => Outcome::Simulated(outcome),
                Err(error) => Outcome::Refused(platewash::Failure::from(error).to_string()),
            },
        }
    }
}

/// Simulates a plan file at every pair of a frequency and a damping; prints the trade-off, with `--out` writes `tune.csv` too.
pub fn run(options: &Options, arguments: &TuneArguments) -> Result<ExitCode, Failure> {
    check(arguments).map_err(Failure::input)?;
    let table = options.out.as_ref().map(|folder| folder.join("tune.csv"));
    output::check_places(table.as_slice())?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let settings = arguments.law.settings(&file.plan);
    if settings.law.is_kinematic() {
        return Err(file.refused(format_args!(
            "law \"{}\" has no frequency to tune: ask for --law pd, pd_gravity or computed_torque",
            settings.law.name()
        )));
    }
    let rows: Vec<Row> = {
        let _progress = Progress::new(options.quiet, "simulating");
        let rows = tune(
            &file.plan,
            &file.arm,
            &settings,
            &arguments.frequencies,
            &arguments.dampings,
            &options.cancel,
        )?;
        rows.into_iter().map(Row::from).collect()
    };
    if let Some(table) = table {
        output::write_files(&[output::file(table, csv(&rows))], &options.cancel)?;
    }
    output::print_either(options.json, &rows, || text(&file.plan, &settings, &rows))?;
    // The best of them.
    let outcomes = rows.iter().filter_map(Row::verdict).map(exit::Outcome::from);
    match outcomes.min() {
        Some(best) => Ok(best.answer()),
        None => Err(file.refused(format_args!(
            "none of {} settings can be simulated; the table says why",
            rows.len()
        ))),
    }
}

fn check(arguments: &TuneArguments) -> anyhow::Result<()> {
    let settings = arguments.frequencies.len() * arguments.dampings.len();
    ensure!(
        settings <= MOST_SETTINGS,
        "{settings} settings; at most {MOST_SETTINGS} at a time"
    );
    Ok(())
}

fn text(plan: &Plan, settings: &SimulationSettings, rows: &[Row]) -> String {
    let (name, law, rate) = (&plan.provenance.scenario, settings.law.name(), settings.control.rate_hz);
    let name = quoted(name);
    let mut text = format!("{name} under {law}, {rate} samples a second\n\n");
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{:>9} {:>8} {:>12} {:>12} {:>12} {:>9} {:>11}  wash",
        "ω rad/s", "damping", "tip rms mm", "tip max mm", "torque N·m", "work J", "swept %"
    );
    for row in rows {
        let _ = write!(text, "{:>9} {:>8} ", row.frequency_rad_s, row.damping_ratio);
        let _ = match &row.outcome {
            Outcome::Refused(why) => writeln!(text, "refused: {why}"),
            Outcome::Simulated(outcome) => writeln!(
                text,
                "{:>12.3} {:>12.3} {:>12.2} {:>9.1} {:>11}  {}",
                1e3 * outcome.tip_rms_m,
                1e3 * outcome.tip_max_m,
                largest(outcome),
                outcome.work_j,
                outcome.least_swept.map_or_else(|| "–".to_owned(), percent),
                outcome.verdict.words()
            ),
        };
    }
    text.push_str("\ntorque: of the joint that needs most; swept: of the plate that is swept least\n");
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text =
        "frequency_rad_s,damping_ratio,verdict,tip_rms_m,tip_max_m,torque_max_n_m,work_j,least_swept\n".to_owned();
    for row in rows {
        let _ = write!(text, "{},{},", row.frequency_rad_s, row.damping_ratio);
        let _ = match &row.outcome {
            Outcome::Refused(_) => writeln!(text, "refused,,,,,"),
            Outcome::Simulated(outcome) => writeln!(
                text,
                "{},{},{},{},{},{}",
                outcome.verdict.words(),
                outcome.tip_rms_m,
                outcome.tip_max_m,
                largest(outcome),
                outcome.work_j,
                outcome.least_swept.map_or_else(String::new, |share| share.to_string())
            ),
        };
    }
    text
}

fn largest(outcome: &TuneOutcome) -> f64 {
    outcome.torque_max_n_m.iter().copied().fold(0.0, f64::max)
}
