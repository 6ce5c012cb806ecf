//! `platewash simulate`: a plan under a control law, and what is left of the wash.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::time_step::TimeStep;
use super::{exit, output, plan, results};
use anyhow::{Context, ensure};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use platewash::planner::scenario::ControlLawName;
use platewash::simulator::{self, Execution, Setup, SimulationError};
use platewash::{Plan, RobotModel, SimulationReport};
use std::fmt::Display;
use std::path::PathBuf;

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct SimulateArguments {
    /// The plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    #[command(flatten)]
    pub law: LawArguments,
    /// Natural frequency in rad/s [default: the scenario's control.frequency_rad_s]
    #[arg(long, value_name = "RAD/S", value_parser = positive, allow_negative_numbers = true)]
    pub frequency: Option<f64>,
    /// Damping ratio [default: the scenario's control.damping_ratio]
    #[arg(long, value_name = "RATIO", value_parser = positive, allow_negative_numbers = true)]
    pub damping: Option<f64>,
    #[command(flatten)]
    pub time_step: TimeStep,
}

/// The control law, where it is not the scenario's.
#[derive(Debug, Args)]
pub struct LawArguments {
    /// Control law in place of the scenario's
    #[arg(long, value_name = "LAW", value_parser = laws())]
    pub law: Option<ControlLawName>,
    /// Samples a second of a torque law in Hz [default: the scenario's control.rate_hz]
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub rate: Option<f64>,
}

impl LawArguments {
    /// The setup that the plan's scenario states, but for what the arguments say.
    pub fn setup(&self, plan: &Plan) -> Setup {
        let mut setup = Setup::of(plan);
        setup.law = self.law.unwrap_or(setup.law);
        setup.control.rate_hz = self.rate.unwrap_or(setup.control.rate_hz);
        setup
    }
}

/// Simulates a plan file, judges the execution, and writes it as CSV and the report.
pub fn run(options: &Options, arguments: &SimulateArguments) -> Result<ExitCode, Failure> {
    let folder = plan::folder(options);
    let places = results::SIMULATED.map(|name| folder.join(name));
    output::check_places(&places)?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let mut setup = arguments.law.setup(&file.plan);
    let control = &mut setup.control;
    if arguments.frequency.is_some() || arguments.damping.is_some() {
        // A frequency or a damping that is asked for is not overruled by gains of the scenario.
        (control.joint_kp, control.joint_kd) = (None, None);
    }
    control.frequency_rad_s = arguments.frequency.unwrap_or(control.frequency_rad_s);
    control.damping_ratio = arguments.damping.unwrap_or(control.damping_ratio);
    let scenario = &file.plan.scenario;
    let dt_s = arguments.time_step.of(scenario, lasts_at_most_s(&file.plan, &setup))?;
    let (execution, report) = {
        let _progress = Progress::new(options.quiet, "simulating");
        carry_out(&file.plan, &file.robot, &setup).map_err(|e| file.refused(e))?
    };
    let csv = simulator::simulate::table(&execution, &file.plan, &file.robot, dt_s)?;
    let text = output::text(&report);
    let contents: [Box<dyn Display + '_>; 3] = [Box::new(csv), Box::new(output::json(&report)?), Box::new(&text)];
    let files: Vec<_> = places.into_iter().zip(contents).collect();
    output::write_files(&files)?;
    output::print_either(options.json, &report, || text.clone())?;
    plan::name_files(options, &files);
    Ok(exit::simulated([report.verdict], scenario.job.on_failure))
}

/// How long an execution of a plan lasts at most \[s\]: its last sample may come a period after the plan's end.
pub fn lasts_at_most_s(plan: &Plan, setup: &Setup) -> f64 {
    plan.knots.t_s.last().copied().unwrap_or(0.0) + setup.period_s()
}

/// Simulates and judges a plan.
pub fn carry_out(
    plan: &Plan,
    robot: &RobotModel,
    setup: &Setup,
) -> Result<(Execution, SimulationReport), SimulationError> {
    let execution = simulator::simulate(plan, robot, setup)?;
    let report = SimulationReport::new(plan, robot, setup, &execution)?;
    Ok((execution, report))
}

fn laws() -> impl TypedValueParser<Value = ControlLawName> {
    let names = ControlLawName::ALL.map(ControlLawName::name);
    PossibleValuesParser::new(names).try_map(|name| ControlLawName::named(&name).context("no such law"))
}

/// A finite number above 0.
pub fn positive(text: &str) -> anyhow::Result<f64> {
    let expected = "must be a finite number above 0";
    let number: f64 = text.trim().parse().context(expected)?;
    ensure!(number.is_finite() && number > 0.0, expected);
    Ok(number)
}
