//! `platewash plan`: the plan file and its CSV.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::progress::Progress;
use super::{cycle, output, results, run};
use anyhow::{Context, anyhow, ensure};
use clap::Args;
use platewash::planner::plan::PlanSegment;
use platewash::planner::scenario::Program;
use platewash::planner::words::counted;
use platewash::planner::{csv, job, plan, robot};
use platewash::{Job, JobReport, Plan, PlanError, RobotModel, Scenario, Trajectory};
use std::path::PathBuf;

/// Most rows of a CSV file: some 300 megabytes.
const MAX_ROWS: f64 = 1e6;

/// Folder that is written to without `--out`.
const DEFAULT_FOLDER: &str = "out";

/// Arguments of `plan` and `run`.
#[derive(Debug, Args, Default)]
pub struct PlanArguments {
    /// File for the planned motion's CSV [default: trajectory.csv in the output folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Time step of the CSV files in seconds [default: the scenario's control.dt_s]
    #[arg(long, value_name = "S", value_parser = time_step, allow_negative_numbers = true)]
    pub dt: Option<f64>,
}

/// Plans the scenario and writes the plan and its CSV.
pub fn run(options: &Options, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    if scenario.job.program == Program::Certified {
        return cycle::plan(options, &scenario, arguments);
    }
    let (job, report) = carry_out(options, &scenario)?;
    let files = files(options, &job, &report, arguments)?;
    results::write(&folder(options), &files)?;
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

/// Plans, follows and judges a scenario that is not too much work, with a sign of life.
pub fn carry_out(options: &Options, scenario: &Scenario) -> Result<(Job, JobReport), Failure> {
    let _progress = Progress::new(options.quiet, "planning");
    let robot = robot::load(&scenario.robot)?;
    let layout = job::place_plates(scenario, &robot).map_err(PlanError::from)?;
    let job = Job::on(scenario, robot, layout).map_err(|error| options.failure(error))?;
    tracing::info!(
        "planned {} waypoints on {}",
        job.tool_path.len(),
        counted(job.layout.plates.len(), "plate")
    );
    let report = job.report()?;
    tracing::info!("checked {} violations", report.executed.violations.len());
    Ok((job, report))
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
pub fn files(
    options: &Options,
    job: &Job,
    report: &JobReport,
    arguments: &PlanArguments,
) -> Result<Vec<(PathBuf, String)>, Failure> {
    let segments = plan::segments(job);
    let csv = motion_csv(&job.scenario, &job.robot, &job.planned, &segments, arguments)?;
    Ok(vec![
        (folder(options).join("plan.json"), Plan::new(job, report)?.to_json()?),
        (csv_file(options, arguments), csv),
    ])
}

/// A motion as CSV.
pub fn motion_csv(
    scenario: &Scenario,
    robot: &RobotModel,
    motion: &Trajectory,
    segments: &[PlanSegment],
    arguments: &PlanArguments,
) -> Result<String, Failure> {
    let tip = robot::tip_frame(robot, &scenario.tool);
    let dt_s = check_rows(scenario, motion.duration_s(), arguments)?;
    Ok(csv::table(motion, segments, robot, &tip, dt_s)?)
}

/// The time step of the CSV \[s\], if `duration_s` of motion, or more, gives not too many rows.
pub fn check_rows(scenario: &Scenario, duration_s: f64, arguments: &PlanArguments) -> Result<f64, Failure> {
    let (key, dt_s) = match arguments.dt {
        Some(dt_s) => ("--dt", dt_s),
        None => ("control.dt_s", scenario.control.dt_s),
    };
    if duration_s / dt_s <= MAX_ROWS {
        return Ok(dt_s);
    }
    let least = duration_s / MAX_ROWS;
    let instead = if arguments.dt.is_some() {
        ""
    } else {
        ", there or as --dt"
    };
    Err(Failure::input(anyhow!(
        "{key}: a time step of {dt_s} s gives more than {MAX_ROWS} rows of CSV for {duration_s:.1} s of motion; give at least \
         {least:e} s{instead}"
    )))
}

fn time_step(text: &str) -> anyhow::Result<f64> {
    let expected = "must be a positive number of seconds";
    let dt_s: f64 = text.parse().context(expected)?;
    ensure!(dt_s.is_finite() && dt_s > 0.0, expected);
    Ok(dt_s)
}

/// Says what was written.
pub fn name_files(options: &Options, files: &[(PathBuf, String)]) {
    let names: Vec<_> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    output::message(options.quiet, &format!("wrote {}", names.join(", ")));
}
