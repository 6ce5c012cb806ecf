//! `platewash run` and `plan` of a certified job.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan::{self, PlanArguments};
use super::progress::Progress;
use super::{output, results, run, simulate};
use platewash::planner::certificate;
use platewash::planner::cycle::{CycleReport, InfeasibleReport};
use platewash::simulator::simulate::table;
use platewash::{Cycle, Scenario, Setup, SimulationReport, SimulationVerdict, Verdict};
use serde::Serialize;
use std::fmt;

/// Plans the cycle and writes the plan and its CSV; nothing is proved.
pub fn plan(options: &Options, scenario: &Scenario, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let cycle = match carry_out(options, scenario, arguments)? {
        Outcome::Planned(cycle) => cycle,
        Outcome::Infeasible(report) => return infeasible(options, scenario, &report),
    };
    let plan = cycle.to_plan()?;
    let files = vec![
        (plan::folder(options).join("plan.json"), plan.to_json()?),
        (plan::csv_file(options, arguments), csv(&cycle, arguments)?),
    ];
    results::write(&plan::folder(options), &files)?;
    output::print_either(options.json, &plan.summary, || {
        format!("{}\nnot proved yet: platewash verify\n", plan.summary.headline)
    })?;
    plan::name_files(options, &files);
    Ok(ExitCode::SUCCESS)
}

/// What `run` says of a certified job: the proof of the plan, and what a controlled arm makes of it.
#[derive(Debug, Serialize)]
struct RunReport {
    #[serde(flatten)]
    cycle: CycleReport,
    simulation: Simulated,
}

/// What came of the simulation.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Simulated {
    /// An execution, judged.
    Done(Box<SimulationReport>),
    /// None: the arm's dynamics are not known, or the law was refused.
    Refused { refused: String },
}

impl Simulated {
    /// Whether an execution fails to wash. None at all is no failure of the plan.
    fn fails(&self) -> bool {
        matches!(self, Self::Done(report) if report.verdict == SimulationVerdict::NotWashed)
    }
}

impl fmt::Display for RunReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n\n", self.cycle)?;
        match &self.simulation {
            Simulated::Done(report) => report.fmt(f),
            Simulated::Refused { refused } => writeln!(f, "NOT SIMULATED: {refused}"),
        }
    }
}

/// Plans the cycle, proves it, simulates it, and writes plan, both motions, certificate and report.
pub fn run(options: &Options, scenario: &Scenario, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let cycle = match carry_out(options, scenario, arguments)? {
        Outcome::Planned(cycle) => cycle,
        Outcome::Infeasible(report) => return infeasible(options, scenario, &report),
    };
    let plan = cycle.to_plan()?;
    let certificate = certificate::verify(&plan, &cycle.robot).map_err(Failure::internal)?;
    let folder = plan::folder(options);
    let mut files = vec![
        (folder.join("plan.json"), plan.to_json()?),
        (plan::csv_file(options, arguments), csv(&cycle, arguments)?),
        (folder.join("certificate.json"), output::json(&certificate)?),
    ];
    let simulation = match simulate::carry_out(&plan, &cycle.robot, &Setup::of(&plan)) {
        Ok((execution, report)) => {
            let dt_s = arguments.dt.unwrap_or(scenario.control.dt_s);
            let executed = table(&execution, &plan, &cycle.robot, dt_s)?;
            files.push((folder.join("executed.csv"), executed));
            Simulated::Done(Box::new(report))
        }
        Err(error) => Simulated::Refused {
            refused: error.to_string(),
        },
    };
    let report = RunReport {
        cycle: CycleReport::new(&cycle, certificate),
        simulation,
    };
    let text = output::text(&report);
    files.push((folder.join("report.json"), output::json(&report)?));
    files.push((folder.join("report.txt"), text.clone()));
    results::write(&folder, &files)?;
    output::print_either(options.json, &report, || text)?;
    plan::name_files(options, &files);
    let verdict = match report.cycle.verdict {
        Verdict::Washed if report.simulation.fails() => Verdict::NotVerified,
        verdict => verdict,
    };
    Ok(run::exit_code(verdict, scenario.job.on_failure))
}

/// What came of planning.
enum Outcome {
    Planned(Box<Cycle>),
    Infeasible(InfeasibleReport),
}

fn carry_out(options: &Options, scenario: &Scenario, arguments: &PlanArguments) -> Result<Outcome, Failure> {
    plan::check_rows(scenario, scenario.duration_at_least(), arguments)?;
    let progress = Progress::new(options.quiet, "planning");
    match Cycle::plan_telling(scenario, &|activity| progress.say("planning", activity)) {
        Ok(cycle) => {
            tracing::info!("planned {} knots", cycle.motion.times().len());
            Ok(Outcome::Planned(Box::new(cycle)))
        }
        Err(error) => match InfeasibleReport::new(scenario, &error) {
            Some(report) => Ok(Outcome::Infeasible(report)),
            None => Err(options.failure(error)),
        },
    }
}

/// Reports a job of which no plan came, in place of what earlier calls left.
fn infeasible(options: &Options, scenario: &Scenario, report: &InfeasibleReport) -> Result<ExitCode, Failure> {
    let folder = plan::folder(options);
    let text = output::text(report);
    let files = vec![
        (folder.join("report.json"), output::json(report)?),
        (folder.join("report.txt"), text.clone()),
    ];
    results::write(&folder, &files)?;
    output::print_either(options.json, report, || text)?;
    plan::name_files(options, &files);
    Ok(run::exit_code(report.verdict, scenario.job.on_failure))
}

fn csv(cycle: &Cycle, arguments: &PlanArguments) -> Result<String, Failure> {
    let scenario = &cycle.scenario;
    plan::motion_csv(scenario, &cycle.robot, &cycle.motion, &cycle.segments, arguments)
}
