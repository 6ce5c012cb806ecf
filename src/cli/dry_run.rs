//! `platewash dry-run`: the motion of a proved plan in the air, slower, as a plan of its own.

use super::failure::ExitCode;
use super::files::{Files, REPORTS, place};
use super::numbers::positive;
use super::options::Options;
use super::output::{DetailArguments, full_report, json};
use super::plan_file::PlanFile;
use anyhow::{Error, Result, bail};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::motion::dry_run::{DryRunError, check_paths, dry_run_job, least_height_m};
use platewash::planner::{InfeasibleReport, PlanError, Watch, plan_in_order};
use platewash::workcell::dry_run::{HEIGHT_M, SPEED_M_S};
use platewash::workcell::words::printable;
use platewash::{Certificate, Failure, WashJob};
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Number of lower heights to try where the requested height is not found to work.
const TRIES: u32 = 6;

/// Increments of the requested height to try where no lower height works \[m\].
const HIGHER_M: [f64; 3] = [0.005, 0.02, 0.05];

/// Arguments of `dry-run`.
#[derive(Debug, Args)]
pub struct DryRunArguments {
    /// Plan file; it must be proved
    pub plan: PathBuf,
    /// Height of the motion above the plates in metres
    #[arg(long, value_name = "M", default_value_t = HEIGHT_M, value_parser = positive, allow_negative_numbers = true)]
    pub height: f64,
    /// Largest speed of the tip in m/s; at most the plan's
    #[arg(long, value_name = "M/S", default_value_t = SPEED_M_S, value_parser = positive, allow_negative_numbers = true)]
    pub speed: f64,
    #[command(flatten)]
    pub details: DetailArguments,
}

/// Report on a dry run.
#[derive(Debug, Serialize)]
struct Report<'a> {
    /// Hash of the plan that is tried out.
    parent: &'a str,
    height_m: f64,
    tip_speed_m_s: f64,
    /// True where the motion in the air is proved. It says nothing about washing.
    proved: bool,
    headline: &'a str,
    duration_s: f64,
    /// Duration of the plan that is tried out \[s\].
    parent_duration_s: f64,
    plates: usize,
    certificate: &'a Certificate,
}

/// Report where there is no dry run.
#[derive(Debug, Serialize)]
struct NoDryRun<'a> {
    parent: &'a str,
    height_m: f64,
    /// A height that was found to work \[m\]; `None` where none of those tried does.
    works_at_m: Option<f64>,
    #[serde(flatten)]
    why: InfeasibleReport,
}

/// Proves a plan, plans and proves its dry run, and writes that.
pub fn run(options: &Options, arguments: &DryRunArguments) -> Result<ExitCode> {
    // Its own folder in the output folder, so that it never takes the place of its parent's files.
    let mut files = Files::new(options.folder().join("dry-run"), &REPORTS[..4]);
    files.check()?;
    refuse_own_place(&arguments.plan, &files.places(&REPORTS[..4]))?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let asked = job(&file, arguments.height, arguments.speed)?;
    file.prove_as_parent(options, "dry run")?;
    let progress = options.progress("planning the dry run");
    let watch = progress.watch(&options.cancel);
    let hash = file.plan.hash.as_deref().unwrap_or_default();
    let planned = match plan_in_order(&asked, &file.plan.order, &file.plan.wash_paths, &watch) {
        Ok(planned) => planned,
        Err(error) => {
            let why = InfeasibleReport::new(asked.name(), asked.terms().seed, &error);
            let why = why.ok_or(Failure::from(error))?;
            let works_at_m = other_height(&file, arguments, &watch)?;
            drop(progress);
            let report = NoDryRun::new(hash, arguments.height, works_at_m, why);
            files.add_report("report", &report)?;
            files.answer(options, &report, || full_report(&report))?;
            return Ok(report.why.verdict.into());
        }
    };
    check_paths(&file.plan, &planned.plan).map_err(|error| refused(&file, error))?;
    let mut certificate = prove_with(&planned.plan, &file.arm, &options.cancel).map_err(Failure::from)?;
    certificate.set_parent_compared();
    drop(progress);
    let report = Report {
        parent: hash,
        height_m: arguments.height,
        tip_speed_m_s: arguments.speed,
        proved: certificate.passes(),
        headline: &certificate.headline,
        duration_s: planned.plan.duration_s(),
        parent_duration_s: file.plan.duration_s(),
        plates: planned.plan.order.len(),
        certificate: &certificate,
    };
    files.add("plan.json", planned.plan.to_json().map_err(Failure::from)?);
    files.add("certificate.json", json(&certificate)?);
    files.add_report("report", &report)?;
    files.answer(options, &report, || arguments.details.printed(&report))?;
    Ok(ExitCode::NotVerified.unless(report.proved))
}

/// The job of the dry run.
fn job(file: &PlanFile<'_>, height_m: f64, speed_m_s: f64) -> Result<WashJob> {
    dry_run_job(&file.plan, &file.arm, height_m, speed_m_s).map_err(|error| refused(file, error))
}

/// Error for a plan that has no dry run.
fn refused(file: &PlanFile<'_>, error: DryRunError) -> Error {
    match error {
        DryRunError::NotSealed | DryRunError::OtherPaths => file.not_verified(error),
        error => file.refused(error),
    }
}

/// Another height at which a plan is found \[m\]: the greatest of some lower ones, or the least of some higher ones.
fn other_height(file: &PlanFile<'_>, arguments: &DryRunArguments, watch: &Watch<'_>) -> Result<Option<f64>> {
    let works = |height_m: f64| {
        // A height at which there is no job works as little as one at which there is no plan.
        let Ok(job) = job(file, height_m, arguments.speed) else {
            return anyhow::Ok(false);
        };
        match plan_in_order(&job, &file.plan.order, &file.plan.wash_paths, watch) {
            Ok(_) => Ok(true),
            Err(PlanError::Cancelled(cancelled)) => Err(cancelled.into()),
            Err(_) => Ok(false),
        }
    };
    let (mut low, mut high, mut found) = (least_height_m(&file.plan.job), arguments.height, None);
    for _ in 0..TRIES {
        let height_m = whole_millimetres(0.5 * (low + high));
        if !(height_m > low && height_m < high) {
            break;
        }
        if works(height_m)? {
            (low, found) = (height_m, Some(height_m));
        } else {
            high = height_m;
        }
    }
    for more_m in HIGHER_M {
        let height_m = whole_millimetres(arguments.height + more_m);
        if found.is_none() && works(height_m)? {
            found = Some(height_m);
        }
    }
    Ok(found)
}

/// A height as a whole number of millimetres, so that it can be typed in \[m\].
fn whole_millimetres(height_m: f64) -> f64 {
    (1e3 * height_m).floor() / 1e3
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            parent,
            tip_speed_m_s,
            duration_s,
            parent_duration_s,
            ..
        } = self;
        self.certificate.fmt(f)?;
        writeln!(
            f,
            "\nparent {parent}\n{duration_s:.2} s with the tip at most {tip_speed_m_s} m/s; the parent takes {parent_duration_s:.2} s\n\
             platewash verify DRY-RUN --parent PLAN compares both"
        )
    }
}

impl NoDryRun<'_> {
    fn new(parent: &str, height_m: f64, works_at_m: Option<f64>, why: InfeasibleReport) -> NoDryRun<'_> {
        let lower = match works_at_m {
            Some(works_at_m) => format!("--height {works_at_m} was found to work"),
            None => "none of the heights that were tried besides was found to work".to_owned(),
        };
        let reason = format!("a dry run {height_m} m above the plates: {}; {lower}", why.reason);
        NoDryRun {
            parent,
            height_m,
            works_at_m,
            why: why.explained(reason),
        }
    }
}

impl fmt::Display for NoDryRun<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.why.fmt(f)
    }
}

/// Refuses a plan that the dry run would be written over.
fn refuse_own_place(plan: &Path, places: &[PathBuf]) -> Result<()> {
    let Ok(own) = place(plan) else { return Ok(()) };
    if places.iter().any(|other| place(other).is_ok_and(|other| other == own)) {
        let name = printable(&plan.display().to_string());
        bail!("{name}: is where the dry run is written: give --out another folder");
    }
    Ok(())
}
