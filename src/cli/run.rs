//! `platewash run` and `platewash plan`: a scenario to the end, or to its plan.

use super::failure::ExitCode;
use super::files::{RESULTS, check_places};
use super::infeasible;
use super::motion::MotionArguments;
use super::options::Options;
use super::output::{DetailArguments, json};
use super::page::{self, LiveArguments, Stage};
use super::simulate::{SimulationAnswer, lasts_at_most_s};
use anyhow::Result;
use clap::Args;
use platewash::certificate::{planned_headline, prove_with};
use platewash::paper::run_with;
use platewash::planner::{PlanError, PlannedJob, plan_with};
use platewash::scenario::{Program, Remedies};
use platewash::simulator::simulate::table;
use platewash::viewer::view::ExecutedMotion;
use platewash::workcell::layout::Finding;
use platewash::workcell::words::count_with_noun;
use platewash::{Failure, Layout, PaperReport, PaperRun, RobotModel, Scenario, Verdict, WashReport};
use serde::Serialize;
use std::fmt;
use std::sync::Arc;

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

/// A washing, planned.
pub struct Washing {
    /// The arm.
    pub arm: Arc<RobotModel>,
    /// Findings about the plates.
    pub findings: Vec<Finding>,
    /// The plan.
    pub planned: PlannedJob,
}

/// Plans the washing that the scenario asks for.
pub fn wash(options: &Options, scenario: &Scenario) -> Result<Washing, Failure> {
    let arm = options.arm(scenario)?;
    options.warn(&scenario.notes_on_bodies(&arm));
    let progress = options.progress("planning");
    let watch = progress.watch(&options.cancel);
    // What fails wherever the plates lie, before they are placed.
    scenario.check_standing(&arm, &Layout::from_plates(Vec::new()))?;
    let layout = scenario.place(&arm, &watch)?;
    let job = scenario.job_on(&arm, &layout);
    let planned = job.and_then(|job| Ok(plan_with(&job, &watch)?));
    let planned = planned.map_err(|why| scenario.with_advice_on_hulls(&arm, &layout, why))?;
    tracing::info!("planned {} knots", planned.plan.knots.t_s.len());
    Ok(Washing {
        arm,
        findings: layout.findings,
        planned,
    })
}

/// Plans, follows and judges the paper's program for a scenario.
fn follow(options: &Options, scenario: &Scenario) -> Result<(PaperRun, PaperReport), Failure> {
    let _progress = options.progress("planning");
    let arm = options.arm(scenario)?;
    let layout = scenario.layout(&arm)?;
    let run = run_with(&scenario.paper_job_on(&arm, layout)?, &options.cancel)?;
    let plates = count_with_noun(run.job.layout.plates.len(), "plate");
    tracing::info!("planned {} waypoints on {plates}", run.tool_path.len());
    let report = run.report_with(&options.cancel)?;
    tracing::info!("checked {} violations", report.executed.violations.len());
    Ok((run, report))
}

/// Answer of `plan`.
#[derive(Debug, Serialize)]
struct Answer {
    /// Always false: proving is for `run` and `verify`.
    proved: bool,
    headline: String,
    /// Plates in the order of washing.
    plates: usize,
    duration_s: f64,
    #[serde(flatten)]
    waypoints: Option<Waypoints>,
}

/// Result of the paper's program at its waypoints.
#[derive(Debug, Serialize)]
struct Waypoints {
    plates_washed: usize,
    /// Number of waypoints solved, and of all waypoints.
    waypoints_reached: [usize; 2],
}

/// Plans the scenario and writes the plan and its CSV; nothing is proved.
pub fn plan(options: &Options, arguments: &MotionArguments) -> Result<ExitCode> {
    let scenario = options.fitted_scenario()?;
    check_places(&[options.folder().join("plan.json"), arguments.csv_file(options)])?;
    let ended = match scenario.job.program {
        Program::Certified => plan_washing(options, &scenario, arguments),
        Program::Paper => plan_paper(options, &scenario, arguments),
    };
    ended.or_else(|error| infeasible::end(options, &scenario, error, arguments.search_time()))
}

fn plan_washing(options: &Options, scenario: &Scenario, arguments: &MotionArguments) -> Result<ExitCode> {
    let washing = wash(options, scenario)?;
    let (plan, motion) = (&washing.planned.plan, washing.motion()?);
    let answer = Answer {
        proved: false,
        headline: planned_headline(plan),
        plates: plan.order.len(),
        duration_s: plan.duration_s(),
        waypoints: None,
    };
    let files = arguments.files(options, scenario, &washing.arm, &motion, plan)?;
    let words = || format!("{}\nplatewash verify proves it\n", answer.headline);
    files.answer(options, &answer, words)?;
    Ok(ExitCode::Done)
}

fn plan_paper(options: &Options, scenario: &Scenario, arguments: &MotionArguments) -> Result<ExitCode> {
    let (run, report) = follow(options, scenario)?;
    let plan = run.plan().map_err(Failure::from)?;
    let (duration_s, [reached, asked]) = (report.duration_s, report.waypoints_reached());
    let answer = Answer {
        proved: false,
        headline: format!("PLANNED, NOT PROVED: {}", report.headline),
        plates: report.plates.len(),
        duration_s,
        waypoints: Some(Waypoints {
            plates_washed: report.plates_washed(),
            waypoints_reached: [reached, asked],
        }),
    };
    let files = arguments.files(options, scenario, &run.job.arm, &run.planned, &plan)?;
    files.answer(options, &answer, || {
        let headline = &answer.headline;
        format!("{headline}\n{reached} of {asked} waypoints reached, {duration_s:.2} s of motion\n")
    })?;
    Ok(ExitCode::from(report.verdict).job(scenario.job.on_failure))
}

/// Plans and judges the scenario; writes the plan, both motions and the report.
pub fn run(options: &Options, arguments: &RunArguments) -> Result<ExitCode> {
    let scenario = options.fitted_scenario()?;
    let folder = options.folder();
    let places = RESULTS[..6].iter().map(|name| folder.join(name));
    let csv = arguments.motion.csv_file(options);
    check_places(&places.chain([csv]).collect::<Vec<_>>())?;
    let stage = arguments.live.prepare(options, &scenario)?;
    let ended = match scenario.job.program {
        Program::Certified => run_washing(options, &scenario, arguments, stage),
        Program::Paper => run_paper(options, &scenario, arguments),
    };
    ended.or_else(|error| infeasible::end(options, &scenario, error, arguments.motion.search_time()))
}

fn run_paper(options: &Options, scenario: &Scenario, arguments: &RunArguments) -> Result<ExitCode> {
    let (run, report) = follow(options, scenario)?;
    let (arm, motion) = (&run.job.arm, &arguments.motion);
    let plan = run.plan().map_err(Failure::from)?;
    let mut files = motion.files(options, scenario, arm, &run.planned, &plan)?;
    files.add("executed.csv", motion.table(scenario, arm, &run.executed, &plan)?);
    files.add_report("report", &report)?;
    let is_swept = report.verdict == Verdict::Swept;
    let executed = ExecutedMotion::followed(&run.executed, run.job.simulation.law, &report.headline, is_swept);
    let region = scenario.task_region(arm);
    if let Some(page) = page::render(options, &plan, arm, None, Some(&executed), &region)? {
        files.add("page.html", page);
    }
    files.answer(options, &report, || arguments.details.printed(&report))?;
    page::explain_absence();
    Ok(ExitCode::from(report.verdict).job(scenario.job.on_failure))
}

/// Plans, proves and simulates; writes plan, both motions, certificate and report.
fn run_washing(
    options: &Options,
    scenario: &Scenario,
    arguments: &RunArguments,
    stage: Option<Stage<'_>>,
) -> Result<ExitCode> {
    let washing = wash(options, scenario)?;
    let (plan, arm, motion) = (&washing.planned.plan, &washing.arm, &washing.motion()?);
    let region = scenario.task_region(arm);
    let lasts_s = lasts_at_most_s(plan, &plan.job.simulation);
    let dt_s = arguments.motion.time_step.or(scenario.control.dt_s, lasts_s)?;
    let prove = || prove_with(plan, arm, &options.cancel).map_err(Failure::from);
    let (certificate, simulation, show) = match stage {
        // Neither keeps all threads busy alone.
        None => {
            let simulate = || SimulationAnswer::new(options, plan, arm, &mut |_| {});
            let (certificate, simulation) = rayon::join(prove, simulate);
            (certificate?, simulation?, None)
        }
        Some(stage) => {
            let certificate = prove()?;
            let show = stage.open(options, (plan, arm), &certificate, &region)?;
            let simulation = show.simulated(options, plan, arm)?;
            (certificate, simulation, Some(show))
        }
    };
    let search_time = arguments.motion.search_time();
    let remedies = infeasible::remedies_of_proof(options, scenario, (arm, &certificate), search_time)?;
    let executed = simulation.executed();
    #[expect(clippy::needless_late_init, reason = "it must outlive the files, which refer to it")]
    let report;
    let (page, files) = rayon::join(
        || page::render(options, plan, arm, Some(&certificate), executed.as_ref(), &region),
        || {
            let mut files = arguments.motion.files(options, scenario, arm, motion, plan)?;
            files.add("certificate.json", json(&certificate)?);
            anyhow::Ok(files)
        },
    );
    let (page, mut files) = (page?, files?);
    let wash = WashReport::new(&washing.planned, &washing.findings, certificate);
    report = RunReport::new(wash, simulation, remedies);
    if let SimulationAnswer::Done { execution, .. } = &report.simulation {
        files.add("executed.csv", table(execution, plan, arm, dt_s)?);
    }
    files.add_report("report", &report)?;
    if let Some(page) = page {
        files.add("page.html", page);
    }
    files.answer(options, &report, || arguments.details.printed(&report))?;
    page::explain_absence();
    if let Some(show) = show {
        show.part(options);
    }
    // The worse of the two.
    let code = ExitCode::from(report.wash.verdict).max(report.simulation.exit_code());
    Ok(code.job(scenario.job.on_failure))
}

impl Washing {
    /// The planned motion.
    fn motion(&self) -> Result<platewash::Trajectory, Failure> {
        Ok(self.planned.plan.knots.motion().map_err(PlanError::from)?)
    }
}

/// Report of `run` on a washing: the proof of the plan, and its simulation with a controlled arm.
#[derive(Debug, Serialize)]
struct RunReport {
    #[serde(flatten)]
    wash: WashReport,
    simulation: SimulationAnswer,
    /// Keys with which the plan would be proved, where it is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    remedies: Option<Remedies>,
}

impl RunReport {
    fn new(mut wash: WashReport, simulation: SimulationAnswer, remedies: Option<Remedies>) -> Self {
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
            SimulationAnswer::Done { report, .. } => report.fmt(f),
            SimulationAnswer::Refused { refused } => writeln!(f, "NOT SIMULATED: {refused}"),
        }
    }
}
