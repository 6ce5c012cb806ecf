//! `platewash simulate` and `platewash tune`: a plan under a control law, what is left of the wash, and what other gains buy.

use super::failure::ExitCode;
use super::files::{Files, RESULTS};
use super::motion::TimeStep;
use super::numbers::positive;
use super::options::Options;
use super::output::DetailArguments;
use super::plan_file::PlanFile;
use anyhow::{Context, Result, ensure};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use platewash::kinematics::words::percent;
use platewash::server::LiveEnd;
use platewash::simulator::simulate::{Sample, TuneOutcome, simulate_watched, table};
use platewash::viewer::view::ExecutedMotion;
use platewash::workcell::simulation::{ControlLawName, SimulationSettings};
use platewash::workcell::words::quoted;
use platewash::{Execution, Failure, Plan, RobotModel, SimulationError, SimulationReport};
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;

/// Most settings of one call of `tune`.
const MOST_SETTINGS: usize = 10_000;

/// The control law, where it is not the plan's.
#[derive(Debug, Args)]
struct LawArguments {
    /// Control law [default: the plan's]
    #[arg(long, value_name = "LAW", value_parser = laws())]
    law: Option<ControlLawName>,
    /// Sample rate of a torque law in Hz [default: the plan's]
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    rate: Option<f64>,
}

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct SimulateArguments {
    /// Plan file
    plan: PathBuf,
    #[command(flatten)]
    law: LawArguments,
    /// Natural frequency in rad/s [default: the plan's]
    #[arg(long, value_name = "RAD/S", value_parser = positive, allow_negative_numbers = true)]
    frequency: Option<f64>,
    /// Damping ratio [default: the plan's]
    #[arg(long, value_name = "RATIO", value_parser = positive, allow_negative_numbers = true)]
    damping: Option<f64>,
    #[command(flatten)]
    time_step: TimeStep,
    #[command(flatten)]
    details: DetailArguments,
}

/// Arguments of `tune`.
#[derive(Debug, Args)]
pub struct TuneArguments {
    /// Plan file
    plan: PathBuf,
    #[command(flatten)]
    law: LawArguments,
    /// Natural frequencies in rad/s, separated by commas
    #[arg(long, value_name = "RAD/S,…", value_delimiter = ',', value_parser = positive, default_value = "5,10,15,20,30,50")]
    frequencies: Vec<f64>,
    /// Damping ratios, separated by commas
    #[arg(long, value_name = "RATIO,…", value_delimiter = ',', value_parser = positive, default_value = "0.7,1")]
    dampings: Vec<f64>,
}

fn laws() -> impl TypedValueParser<Value = ControlLawName> {
    let names = ControlLawName::ALL.map(ControlLawName::name);
    PossibleValuesParser::new(names).try_map(|name| ControlLawName::named(&name).context("no such law"))
}

impl LawArguments {
    /// The settings that the plan states, but for what the arguments say.
    fn settings(&self, plan: &Plan) -> SimulationSettings {
        let mut settings = plan.job.simulation.clone();
        settings.law = self.law.unwrap_or(settings.law);
        settings.control.rate_hz = self.rate.unwrap_or(settings.control.rate_hz);
        settings
    }
}

impl SimulateArguments {
    fn settings(&self, plan: &Plan) -> SimulationSettings {
        let mut settings = self.law.settings(plan);
        let control = &mut settings.control;
        if self.frequency.is_some() || self.damping.is_some() {
            // A frequency or a damping that is asked for is not overruled by gains of the plan.
            (control.joint_kp, control.joint_kd) = (None, None);
        }
        control.frequency_rad_s = self.frequency.unwrap_or(control.frequency_rad_s);
        control.damping_ratio = self.damping.unwrap_or(control.damping_ratio);
        settings
    }
}

/// Simulates a plan file, judges the execution, and writes it as CSV and the report.
pub fn simulate(options: &Options, arguments: &SimulateArguments) -> Result<ExitCode> {
    let owned = &RESULTS[7..];
    Files::new(options.folder(), owned).check()?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let (plan, settings) = (&file.plan, arguments.settings(&file.plan));
    let (stated_s, lasts_s) = (plan.job.simulation.control.dt_s, lasts_at_most_s(plan, &settings));
    let dt_s = arguments.time_step.or(stated_s, lasts_s)?;
    let done = carried_out(options, plan, &file.arm, &settings, &mut |_| {});
    let (execution, report) = done.map_err(|error| file.failure(error.into()))?;
    let mut files = Files::new(options.folder(), owned);
    files.add("simulated.csv", table(&execution, plan, &file.arm, dt_s)?);
    files.add_report("simulation", &report)?;
    files.answer(options, &report, || arguments.details.printed(&report))?;
    Ok(report.verdict.into())
}

/// Longest duration of an execution of a plan \[s\]: its last sample may come a period after the plan's end.
pub fn lasts_at_most_s(plan: &Plan, settings: &SimulationSettings) -> f64 {
    plan.duration_s() + settings.period_s()
}

/// Simulates and judges a plan, and tells `watch` of each sample when it is known.
fn carried_out(
    options: &Options,
    plan: &Plan,
    arm: &RobotModel,
    settings: &SimulationSettings,
    watch: &mut dyn FnMut(&Sample),
) -> Result<(Execution, SimulationReport), SimulationError> {
    let _progress = options.progress("simulating");
    let execution = simulate_watched(plan, arm, settings, &options.cancel, watch)?;
    let report = SimulationReport::new(plan, arm, settings, &execution)?;
    Ok((execution, report))
}

/// Result of simulating a plan with the settings that the plan states.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum SimulationAnswer {
    /// An execution, judged.
    Done {
        /// The execution.
        #[serde(skip)]
        execution: Execution,
        /// Report on the execution.
        #[serde(flatten)]
        report: Box<SimulationReport>,
    },
    /// No execution: the arm's dynamics are not known, or the control law was refused.
    Refused {
        /// Reason, in words.
        refused: String,
    },
}

impl SimulationAnswer {
    /// Simulates a plan, and tells `watch` of each sample when it is known.
    pub fn new(options: &Options, plan: &Plan, arm: &RobotModel, watch: &mut dyn FnMut(&Sample)) -> Result<Self> {
        match carried_out(options, plan, arm, &plan.job.simulation, watch) {
            Ok((execution, report)) => Ok(Self::Done {
                execution,
                report: report.into(),
            }),
            Err(SimulationError::Cancelled(cancelled)) => Err(cancelled.into()),
            Err(error) => Ok(Self::Refused {
                refused: Failure::from(error).to_string(),
            }),
        }
    }

    /// End of the simulation, for pages that show it live.
    pub fn live_end(&self) -> LiveEnd {
        let (headline, washed) = match self {
            Self::Done { report, .. } => (report.headline.clone(), Some(report.verdict.is_done())),
            Self::Refused { refused } => (format!("NOT SIMULATED: {refused}"), None),
        };
        LiveEnd { headline, washed }
    }

    /// Addition to the first line of the report: nothing was simulated, or the simulation fails. `None` where it succeeds.
    pub fn first_line(&self) -> Option<String> {
        let report = match self {
            Self::Done { report, .. } if report.verdict.is_done() => return None,
            Self::Done { report, .. } => report,
            Self::Refused { .. } => return Some("NOT SIMULATED".to_owned()),
        };
        let overload = report.payload.overload().map(|words| format!("OVERLOADED: {words}"));
        let left = report.plates.iter().find(|plate| !plate.verdict.is_done());
        let words = left.map(|plate| plate.verdict.words());
        let words = words.or_else(|| overload.is_none().then(|| report.verdict.words()));
        let not_done =
            words.map(|words| format!("in the simulation {} under {}", words.to_uppercase(), report.law.name()));
        Some(overload.into_iter().chain(not_done).collect::<Vec<_>>().join("; "))
    }

    /// Executed motion for a page; `None` where nothing was simulated.
    pub fn executed(&self) -> Option<ExecutedMotion> {
        match self {
            Self::Done { execution, report } => Some(ExecutedMotion::simulated(execution, report)),
            Self::Refused { .. } => None,
        }
    }

    /// No simulation at all is no failure of the plan.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Done { report, .. } => report.verdict.into(),
            Self::Refused { .. } => ExitCode::Done,
        }
    }
}

/// One setting of `tune` as JSON.
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

/// Simulates a plan file at every pair of a frequency and a damping; prints the trade-off, with `--out` writes `tune.csv` too.
pub fn tune(options: &Options, arguments: &TuneArguments) -> Result<ExitCode> {
    let (frequencies, dampings) = (&arguments.frequencies, &arguments.dampings);
    let count = frequencies.len() * dampings.len();
    ensure!(
        count <= MOST_SETTINGS,
        "{count} settings; at most {MOST_SETTINGS} at a time"
    );
    let mut files = Files::new(options.out.clone(), &["tune.csv"]);
    files.check()?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let settings = arguments.law.settings(&file.plan);
    if settings.law.is_kinematic() {
        return Err(file.refused(format_args!(
            "law \"{}\" has no frequency to tune: ask for --law pd, pd_gravity or computed_torque",
            settings.law.name()
        )));
    }
    let rows = options.during("simulating", || {
        platewash::tune(&file.plan, &file.arm, &settings, frequencies, dampings, &options.cancel)
    });
    let rows = rows?.into_iter().map(|row| Row {
        frequency_rad_s: row.frequency_rad_s,
        damping_ratio: row.damping_ratio,
        outcome: match row.outcome {
            Ok(outcome) => Outcome::Simulated(outcome),
            Err(error) => Outcome::Refused(Failure::from(error).to_string()),
        },
    });
    let rows: Vec<Row> = rows.collect();
    files.add("tune.csv", csv(&rows));
    files.answer(options, &rows, || text(&file.plan, &settings, &rows))?;
    // The best of them.
    let codes = rows.iter().filter_map(|row| match &row.outcome {
        Outcome::Simulated(outcome) => Some(ExitCode::from(outcome.verdict)),
        Outcome::Refused(_) => None,
    });
    codes.min().ok_or_else(|| {
        file.refused(format_args!(
            "none of {count} settings can be simulated; the table says why"
        ))
    })
}

fn text(plan: &Plan, settings: &SimulationSettings, rows: &[Row]) -> String {
    let (name, law) = (quoted(&plan.provenance.scenario), settings.law.name());
    let mut text = format!("{name} under {law}, {} samples a second\n\n", settings.control.rate_hz);
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
    text + "\ntorque: of the joint that needs most; swept: of the plate that is swept least\n"
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
