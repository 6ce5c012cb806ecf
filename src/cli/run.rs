//! `platewash run`: a scenario to the end.

use super::details::{DetailArguments, whole};
use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::live::{LiveArguments, Show, Stage};
use super::motion::MotionArguments;
use super::options::Options;
use super::{execution, infeasible, output, page, paper, results, wash};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::scenario::{Program, Remedies};
use platewash::simulator::simulate::{Sample, table};
use platewash::viewer::server::LiveEnd;
use platewash::viewer::view::{Beside, Executed};
use platewash::{Execution, Plan, RobotModel, Scenario, SimulationReport, WashReport};
use serde::Serialize;
use std::fmt;

/// Arguments of `run`.
#[derive(Debug, Args, Default)]
pub struct RunArguments {
    #[command(flatten)]
    motion: MotionArguments,
    #[command(flatten)]
    details: DetailArguments,
    #[command(flatten)]
    live: LiveArguments,
}

/// Plans and judges the scenario; writes the plan, both motions and the report.
pub fn run(options: &Options, arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let others = |name: &&str| *name != "trajectory.csv" && !results::SIMULATED.contains(name);
    let names = results::OWNED.into_iter().filter(others);
    let csv = arguments.motion.csv_file(options);
    results::check_places(options, &names.collect::<Vec<_>>(), &csv)?;
    let stage = arguments.live.prepare(options, &scenario)?;
    match scenario.job.program {
        Program::Certified => run_washing(options, &scenario, arguments, stage),
        Program::Paper => run_paper(options, &scenario, arguments),
    }
}

fn run_paper(options: &Options, scenario: &Scenario, arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let followed = match paper::follow(options, scenario) {
        Ok(followed) => followed,
        Err(failure) => return infeasible::end(options, scenario, failure, arguments.motion.search_time()),
    };
    let folder = results::folder(options);
    let report = &followed.report;
    let mut files = followed.files(options, scenario, &arguments.motion)?;
    let executed = followed.executed(scenario, &arguments.motion)?;
    files.push(output::file(folder.join("executed.csv"), executed));
    files.push(output::file(folder.join("report.json"), output::json(report)?));
    files.push(output::file(folder.join("report.txt"), whole(report)));
    let executed = followed.as_executed();
    let plan = followed.run.plan().map_err(platewash::Failure::from)?;
    let region = scenario.task_region();
    let beside = Beside {
        executed: Some(&executed),
        region: Some(&region),
        ..Beside::default()
    };
    files.extend(page::file(options, &plan, &followed.run.job.arm, &beside)?);
    results::write(options, &files)?;
    output::print_either(options.json, report, || arguments.details.printed(report))?;
    results::name(options, &files);
    Ok(Outcome::from(report.verdict).job(scenario.job.on_failure))
}

/// Plans, proves and simulates; writes plan, both motions, certificate and report.
fn run_washing(
    options: &Options,
    scenario: &Scenario,
    arguments: &RunArguments,
    stage: Option<Stage<'_>>,
) -> Result<ExitCode, Failure> {
    let washing = match wash::plan(options, scenario) {
        Ok(washing) => washing,
        Err(failure) => return infeasible::end(options, scenario, failure, arguments.motion.search_time()),
    };
    let (plan, arm) = (&washing.planned.plan, &washing.arm);
    let time_step = &arguments.motion.time_step;
    let lasts_s = execution::lasts_at_most_s(plan, &plan.job.simulation);
    let dt_s = time_step.or(scenario.control.dt_s, lasts_s)?;
    let certificate = prove_with(plan, arm, &options.cancel).map_err(platewash::Failure::from)?;
    let show = stage
        .map(|stage| stage.open(options, plan, arm, &certificate))
        .transpose()?;
    let (execution, simulation) = match &show {
        Some(show) => shown(options, plan, arm, show)?,
        None => simulated(options, plan, arm, &mut |_| {})?,
    };
    let remedies =
        infeasible::remedies_of_proof(options, scenario, (arm, &certificate), arguments.motion.search_time())?;
    let proof = output::json(&certificate)?;
    let report = WashReport::new(&washing.planned, &washing.findings, certificate);
    let report = RunReport::new(report, simulation, remedies);
    let folder = results::folder(options);
    let mut files = washing.files(options, scenario, &arguments.motion)?;
    files.push(output::file(folder.join("certificate.json"), proof));
    if let Some(execution) = &execution {
        let executed = table(execution, plan, arm, dt_s)?;
        files.push(output::file(folder.join("executed.csv"), executed));
    }
    files.push(output::file(folder.join("report.json"), output::json(&report)?));
    files.push(output::file(folder.join("report.txt"), whole(&report)));
    let executed = report.simulation.as_executed(execution.as_ref());
    let region = scenario.task_region();
    let beside = Beside {
        certificate: Some(&report.wash.certificate),
        executed: executed.as_ref(),
        region: Some(&region),
        ..Beside::default()
    };
    files.extend(page::file(options, plan, arm, &beside)?);
    results::write(options, &files)?;
    output::print_either(options.json, &report, || arguments.details.printed(&report))?;
    results::name(options, &files);
    if let Some(show) = show {
        show.part(options);
    }
    // The worse of the two.
    let outcome = Outcome::from(report.wash.verdict).max(report.simulation.outcome());
    Ok(outcome.job(scenario.job.on_failure))
}

/// What `run` says of a washing: the proof of the plan, and what a controlled arm makes of it.
#[derive(Debug, Serialize)]
struct RunReport {
    #[serde(flatten)]
    wash: WashReport,
    simulation: Simulated,
    /// Keys with which the plan would be proved, where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    remedies: Option<Remedies>,
}

/// What the simulation says.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Simulated {
    /// An execution, judged.
    Done(Box<SimulationReport>),
    /// None: the arm's dynamics are not known, or the law was refused.
    Refused { refused: String },
}

/// Simulates a plan as it asks for itself, and tells `watch` of each sample when it is known.
fn simulated(
    options: &Options,
    plan: &Plan,
    arm: &RobotModel,
    watch: &mut dyn FnMut(&Sample),
) -> Result<(Option<Execution>, Simulated), Failure> {
    Ok(match execution::tried(plan, arm, &options.cancel, watch)? {
        Ok((execution, report)) => (Some(execution), Simulated::Done(Box::new(report))),
        Err(refused) => (None, Simulated::Refused { refused }),
    })
}

/// Simulates a plan in real time, while it is shown.
fn shown(
    options: &Options,
    plan: &Plan,
    arm: &RobotModel,
    show: &Show,
) -> Result<(Option<Execution>, Simulated), Failure> {
    let mut feed = show.feed(options, plan, arm);
    let (execution, simulation) = simulated(options, plan, arm, &mut |sample| feed.sample(sample))?;
    show.tell_end(options, feed.end(), simulation.live_end());
    Ok((execution, simulation))
}

impl Simulated {
    /// How it ended, for pages that show it live.
    fn live_end(&self) -> LiveEnd {
        match self {
            Self::Done(report) => LiveEnd {
                headline: report.headline.clone(),
                washed: Some(report.verdict.is_done()),
            },
            Self::Refused { refused } => LiveEnd {
                headline: format!("NOT SIMULATED: {refused}"),
                washed: None,
            },
        }
    }

    /// What the first line adds to what is proved: that nothing was simulated, or that the simulation fails.
    fn first_line(&self) -> Option<String> {
        match self {
            Self::Done(report) if report.verdict.is_done() => None,
            Self::Done(report) => {
                let overload = report.payload.overload().map(|words| format!("OVERLOADED: {words}"));
                let left = report.plates.iter().find(|plate| !plate.verdict.is_done());
                let words = left.map(|plate| plate.verdict.words());
                let words = words.or_else(|| overload.is_none().then(|| report.verdict.words()));
                let not_done = words
                    .map(|words| format!("in the simulation {} under {}", words.to_uppercase(), report.law.name()));
                Some(overload.into_iter().chain(not_done).collect::<Vec<_>>().join("; "))
            }
            Self::Refused { .. } => Some("NOT SIMULATED".to_owned()),
        }
    }

    /// What a page shows of it.
    fn as_executed(&self, execution: Option<&Execution>) -> Option<Executed> {
        match (self, execution) {
            (Self::Done(report), Some(execution)) => Some(Executed::simulated(execution, report)),
            _ => None,
        }
    }

    /// No simulation at all is no failure of the plan.
    fn outcome(&self) -> Outcome {
        match self {
            Self::Done(report) => Outcome::from(report.verdict),
            Self::Refused { .. } => Outcome::Good,
        }
    }
}

impl RunReport {
    fn new(mut wash: WashReport, simulation: Simulated, remedies: Option<Remedies>) -> Self {
        if let Some(remedies) = &remedies {
            wash.headline = format!("{}{remedies}", wash.headline);
        }
        if let Some(more) = simulation.first_line() {
            wash.headline = format!("{}; {more}", wash.headline);
        }
        Self {
            wash,
            simulation,
            remedies,
        }
    }
}

impl fmt::Display for RunReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.wash.fmt(f)?;
        writeln!(f)?;
        match &self.simulation {
            Simulated::Done(report) => report.fmt(f),
            Simulated::Refused { refused } => writeln!(f, "NOT SIMULATED: {refused}"),
        }
    }
}
