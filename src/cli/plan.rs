//! `platewash plan`: the plan file and its CSV.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output::File;
use super::progress::Progress;
use super::time_step::TimeStep;
use super::{cycle, output, results};
use clap::Args;
use platewash::planner::cycle::InfeasibleReport;
use platewash::planner::plan::{PlanSegment, Summary};
use platewash::planner::scenario::Program;
use platewash::planner::{job, plan};
use platewash::workcell::csv::MotionTable;
use platewash::workcell::words::counted;
use platewash::workcell::{csv, tool};
use platewash::{Job, JobReport, Plan, PlanError, RobotModel, Scenario, Trajectory};
use serde::Serialize;
use std::path::PathBuf;

/// Folder that is written to without `--out`.
const DEFAULT_FOLDER: &str = "out";

/// Arguments of `plan` and `run`.
#[derive(Debug, Args, Default)]
pub struct PlanArguments {
    /// File for the planned motion's CSV [default: trajectory.csv in the output folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    #[command(flatten)]
    pub time_step: TimeStep,
}

/// Plans the scenario and writes the plan and its CSV.
pub fn run(options: &Options, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    results::check_places(&folder(options), &["plan.json"], &csv_file(options, arguments))?;
    if scenario.job.program == Program::Certified {
        return cycle::plan(options, &scenario, arguments);
    }
    let (job, report) = match carry_out(options, &scenario)? {
        Followed::Judged(both) => *both,
        Followed::Infeasible(report) => return infeasible(options, &scenario, &report),
    };
    let segments = plan::segments(&job);
    let files = files(options, &job, &segments, &report, arguments)?;
    results::write(&folder(options), &files)?;
    let summary = report.summary();
    output::print_either(options.json, &Planned::of(&summary), || {
        let [reached, asked] = summary.waypoints_reached;
        let line = format!(
            "{reached} of {asked} waypoints reached, {:.2} s of motion",
            summary.duration_s
        );
        format!("{}\n{line}\n", first_line(&summary))
    })?;
    name_files(options, &files);
    Ok(Outcome::from(report.verdict).job(scenario.job.on_failure))
}

/// What `plan` says of a plan: its summary, and that it proves nothing.
#[derive(Debug, Serialize)]
pub struct Planned<'a> {
    /// Always false: proving is for `run` and `verify`.
    proved: bool,
    #[serde(flatten)]
    summary: &'a Summary,
}

impl<'a> Planned<'a> {
    /// Of a plan's summary.
    pub fn of(summary: &'a Summary) -> Self {
        Self { proved: false, summary }
    }
}

/// The first line of what `plan` says.
pub fn first_line(summary: &Summary) -> String {
    format!("planned, not proved: {}", summary.headline)
}

/// What came of the paper's program.
pub enum Followed {
    /// A motion, judged.
    Judged(Box<(Job, JobReport)>),
    /// Nothing: the plates have no place.
    Infeasible(InfeasibleReport),
}

/// Reports a job that cannot be done, in place of what earlier calls left.
pub fn infeasible(options: &Options, scenario: &Scenario, report: &InfeasibleReport) -> Result<ExitCode, Failure> {
    let folder = folder(options);
    let text = output::text(report);
    let files = vec![
        output::file(folder.join("report.json"), output::json(report)?),
        output::file(folder.join("report.txt"), &text),
    ];
    results::write(&folder, &files)?;
    output::print_either(options.json, report, || text.clone())?;
    name_files(options, &files);
    Ok(Outcome::from(report.verdict).job(scenario.job.on_failure))
}

/// Plans, follows and judges a scenario that is not too much work, with a sign of life.
pub fn carry_out(options: &Options, scenario: &Scenario) -> Result<Followed, Failure> {
    let _progress = Progress::new(options.quiet, "planning");
    let robot = options.arm(scenario)?;
    let placed = job::place_plates(scenario, &robot).map_err(PlanError::from);
    let job = match placed.and_then(|layout| Job::on(scenario, robot, layout)) {
        Ok(job) => job,
        Err(error) => {
            return match InfeasibleReport::new(scenario, &error) {
                Some(report) => Ok(Followed::Infeasible(report)),
                None => Err(options.failure(error)),
            };
        }
    };
    tracing::info!(
        "planned {} waypoints on {}",
        job.tool_path.len(),
        counted(job.layout.plates.len(), "plate")
    );
    let report = job.report()?;
    tracing::info!("checked {} violations", report.executed.violations.len());
    Ok(Followed::Judged(Box::new((job, report))))
}

/// Where files go.
pub fn folder(options: &Options) -> PathBuf {
    options.out.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_FOLDER))
}

/// Where the planned motion's CSV goes.
pub fn csv_file(options: &Options, arguments: &PlanArguments) -> PathBuf {
    let default = || folder(options).join("trajectory.csv");
    arguments.csv.clone().unwrap_or_else(default)
}

/// The plan file and the planned motion's CSV, not written yet.
pub fn files<'a>(
    options: &Options,
    job: &'a Job,
    segments: &'a [PlanSegment],
    report: &JobReport,
    arguments: &PlanArguments,
) -> Result<Vec<File<'a>>, Failure> {
    let csv = motion_csv(&job.scenario, &job.robot, &job.planned, segments, arguments)?;
    let plan = Plan::new(job, report)?.to_json()?;
    Ok(vec![
        output::file(folder(options).join("plan.json"), plan),
        output::file(csv_file(options, arguments), csv),
    ])
}

/// A motion as CSV.
pub fn motion_csv<'a>(
    scenario: &Scenario,
    robot: &'a RobotModel,
    motion: &'a Trajectory,
    segments: &'a [PlanSegment],
    arguments: &PlanArguments,
) -> Result<MotionTable<'a>, Failure> {
    let tip = tool::tip_frame(robot, &scenario.tool);
    let dt_s = arguments.time_step.of(scenario, motion.duration_s())?;
    Ok(csv::table(motion, segments, robot, &tip, dt_s)?)
}

/// Says what was written.
pub fn name_files(options: &Options, files: &[File<'_>]) {
    let names: Vec<_> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    output::message(options.quiet, &format!("wrote {}", names.join(", ")));
}
