//! `platewash plan`: the plan file and its CSV.

use super::failure::Failure;
use super::options::Options;
use super::{output, run};
use clap::Args;
use platewash::planner::{csv, plan, robot};
use platewash::{Job, JobReport, Plan, Trajectory};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Folder that is written to without `--out`.
const DEFAULT_FOLDER: &str = "out";

/// Arguments of `plan` and `run`.
#[derive(Debug, Args, Default)]
pub struct PlanArguments {
    /// File for the planned motion's CSV [default: trajectory.csv in the output folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Time step of the CSV files in seconds [default: the scenario's control.dt_s]
    #[arg(long, value_name = "S")]
    pub dt: Option<f64>,
}

/// Plans the scenario and writes the plan and its CSV.
pub fn run(options: &Options, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let job = Job::run(&scenario)?;
    let report = job.report()?;
    let files = files(&job, &report, &folder(options), arguments)?;
    output::write_files(&files)?;
    let summary = report.summary();
    output::print_either(options.json, &summary, || {
        let [reached, asked] = summary.waypoints_reached;
        let line = format!(
            "{reached} of {asked} waypoints reached, {:.2} s of motion",
            summary.duration_s
        );
        format!("{}\n{line}\n", summary.headline)
    })?;
    name_files(options, &files);
    Ok(run::exit_code(report.verdict, scenario.job.on_failure))
}

/// Where files go.
pub fn folder(options: &Options) -> PathBuf {
    options.out.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_FOLDER))
}

/// The plan file and the planned motion's CSV, not written yet.
pub fn files(
    job: &Job,
    report: &JobReport,
    folder: &Path,
    arguments: &PlanArguments,
) -> Result<Vec<(PathBuf, String)>, Failure> {
    let csv = arguments.csv.clone().unwrap_or_else(|| folder.join("trajectory.csv"));
    Ok(vec![
        (folder.join("plan.json"), Plan::new(job, report)?.to_json()?),
        (csv, motion_csv(job, &job.planned, arguments)?),
    ])
}

/// A motion of the job as CSV.
pub fn motion_csv(job: &Job, motion: &Trajectory, arguments: &PlanArguments) -> Result<String, Failure> {
    let tip = robot::tip_frame(&job.robot, &job.scenario.tool);
    let dt_s = arguments.dt.unwrap_or(job.scenario.control.dt_s);
    Ok(csv::table(motion, &plan::segments(job), &job.robot, &tip, dt_s)?)
}

/// Says what was written.
pub fn name_files(options: &Options, files: &[(PathBuf, String)]) {
    let names: Vec<_> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    output::message(options.quiet, &format!("wrote {}", names.join(", ")));
}
