//! `platewash run` and `plan` of a certified job.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan::{self, PlanArguments, Planned};
use super::progress::Progress;
use super::run::RunArguments;
use super::{output, results, simulate};
use platewash::planner::certificate::{self, PairsShown};
use platewash::planner::cycle::{CycleReport, InfeasibleReport};
use platewash::simulator::simulate::{PlateVerdict, table};
use platewash::workcell::csv::MotionTable;
use platewash::{Cycle, Scenario, Setup, SimulationReport, SimulationVerdict};
use serde::Serialize;

/// Plans the cycle and writes the plan and its CSV; nothing is proved.
pub fn plan(options: &Options, scenario: &Scenario, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let cycle = match carry_out(options, scenario)? {
        Cycled::Planned(cycle) => cycle,
        Cycled::Infeasible(report) => return plan::infeasible(options, scenario, &report),
    };
    let plan = cycle.to_plan()?;
    let files = vec![
        output::file(plan::folder(options).join("plan.json"), plan.to_json()?),
        output::file(plan::csv_file(options, arguments), csv(&cycle, arguments)?),
    ];
    results::write(&plan::folder(options), &files)?;
    output::print_either(options.json, &Planned::of(&plan.summary), || {
        format!("{}\nplatewash verify proves it\n", plan::first_line(&plan.summary))
    })?;
    plan::name_files(options, &files);
    Ok(ExitCode::SUCCESS)
}

/// What came of planning.
enum Cycled {
    Planned(Box<Cycle>),
    Infeasible(InfeasibleReport),
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
    /// What the first line adds to what is proved: that nothing was simulated, or that the simulation fails.
    fn first_line(&self) -> Option<String> {
        match self {
            Self::Done(report) if report.verdict == SimulationVerdict::Washed => None,
            Self::Done(report) => {
                let overload = report.payload.overload().map(|words| format!("OVERLOADED: {words}"));
                let leaves_one = report
                    .plates
                    .iter()
                    .any(|plate| plate.verdict == PlateVerdict::NotWashed);
                let not_washed =
                    (overload.is_none() || leaves_one).then(|| format!("NOT WASHED under {}", report.law.name()));
                Some(overload.into_iter().chain(not_washed).collect::<Vec<_>>().join("; "))
            }
            Self::Refused { .. } => Some("NOT SIMULATED".to_owned()),
        }
    }

    /// No simulation at all is no failure of the plan.
    fn outcome(&self) -> Outcome {
        match self {
            Self::Done(report) if report.verdict != SimulationVerdict::Washed => Outcome::NotVerified,
            _ => Outcome::Good,
        }
    }
}

impl RunReport {
    fn new(mut cycle: CycleReport, simulation: Simulated) -> Self {
        if let Some(more) = simulation.first_line() {
            cycle.headline = format!("{}; {more}", cycle.headline);
        }
        Self { cycle, simulation }
    }

    fn text(&self, pairs: PairsShown) -> String {
        let simulation = match &self.simulation {
            Simulated::Done(report) => report.to_string(),
            Simulated::Refused { refused } => format!("NOT SIMULATED: {refused}\n"),
        };
        output::text(&format_args!("{}\n\n{simulation}", self.cycle.text(pairs)))
    }
}

/// Plans the cycle, proves it, simulates it, and writes plan, both motions, certificate and report.
pub fn run(options: &Options, scenario: &Scenario, arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let pairs = arguments.pairs();
    let arguments = &arguments.plan;
    let cycle = match carry_out(options, scenario)? {
        Cycled::Planned(cycle) => cycle,
        Cycled::Infeasible(report) => return plan::infeasible(options, scenario, &report),
    };
    let plan = cycle.to_plan()?;
    let setup = Setup::of(&plan);
    let dt_s = arguments
        .time_step
        .of(scenario, simulate::lasts_at_most_s(&plan, &setup))?;
    let certificate = certificate::verify(&plan, &cycle.robot).map_err(Failure::internal)?;
    let folder = plan::folder(options);
    let (execution, simulation) = match simulate::carry_out(&plan, &cycle.robot, &setup) {
        Ok((execution, report)) => (Some(execution), Simulated::Done(Box::new(report))),
        Err(error) => {
            let refused = error.to_string();
            (None, Simulated::Refused { refused })
        }
    };
    let proof = output::json(&certificate)?;
    let report = RunReport::new(CycleReport::new(&cycle, certificate), simulation);
    let text = report.text(pairs);
    let mut files = vec![
        output::file(folder.join("plan.json"), plan.to_json()?),
        output::file(plan::csv_file(options, arguments), csv(&cycle, arguments)?),
        output::file(folder.join("certificate.json"), proof),
    ];
    if let Some(execution) = &execution {
        let executed = table(execution, &plan, &cycle.robot, dt_s)?;
        files.push(output::file(folder.join("executed.csv"), executed));
    }
    files.push(output::file(folder.join("report.json"), output::json(&report)?));
    files.push(output::file(folder.join("report.txt"), &text));
    results::write(&folder, &files)?;
    output::print_either(options.json, &report, || text.clone())?;
    plan::name_files(options, &files);
    // The worse of the two.
    let outcome = Outcome::from(report.cycle.verdict).max(report.simulation.outcome());
    Ok(outcome.job(scenario.job.on_failure))
}

fn carry_out(options: &Options, scenario: &Scenario) -> Result<Cycled, Failure> {
    let robot = options.arm(scenario)?;
    let progress = Progress::new(options.quiet, "planning");
    match Cycle::with_arm(scenario, robot, &|activity| progress.say("planning", activity)) {
        Ok(cycle) => {
            tracing::info!("planned {} knots", cycle.motion.times().len());
            Ok(Cycled::Planned(Box::new(cycle)))
        }
        Err(error) => match InfeasibleReport::new(scenario, &error) {
            Some(report) => Ok(Cycled::Infeasible(report)),
            None => Err(options.failure(error)),
        },
    }
}

fn csv<'a>(cycle: &'a Cycle, arguments: &PlanArguments) -> Result<MotionTable<'a>, Failure> {
    let scenario = &cycle.scenario;
    plan::motion_csv(scenario, &cycle.robot, &cycle.motion, &cycle.segments, arguments)
}
