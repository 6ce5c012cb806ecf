//! `platewash dry-run`: the motion of a proved plan in the air, slower, as a plan of its own.

use super::details::{DetailArguments, whole};
use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::law::positive;
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::text::text;
use super::{output, results};
use anyhow::anyhow;
use clap::Args;
use platewash::certificate::prove_with;
use platewash::planner::{InfeasibleReport, PlanError, Planned, Watch, plan_in_order};
use platewash::workcell::dry_run::{DryRunError, HEIGHT_M, SPEED_M_S, check_paths, dry_run_job, least_height_m};
use platewash::workcell::words::printable;
use platewash::{Certificate, Plan, Verdict, WashJob};
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};

/// Folder in the output folder that its files go to, so that they never take the place of the parent's.
const FOLDER: &str = "dry-run";

/// Names in that folder that are its own.
const OWNED: [&str; 4] = ["plan.json", "certificate.json", "report.json", "report.txt"];

/// Lower heights that are tried where the one that was asked for is not found to work.
const TRIES: u32 = 6;

/// How much higher is tried where none of them does \[m\].
const HIGHER_M: [f64; 3] = [0.005, 0.02, 0.05];

/// Arguments of `dry-run`.
#[derive(Debug, Args)]
pub struct DryRunArguments {
    /// Plan file; it must be proved
    #[arg(value_name = "PLAN")]
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

/// What is said of a dry run.
#[derive(Debug, Serialize)]
struct Report<'a> {
    /// Hash of the plan that is tried out.
    parent: &'a str,
    height_m: f64,
    tip_speed_m_s: f64,
    /// Whether the motion in the air is proved. It says nothing about washing.
    proved: bool,
    headline: &'a str,
    duration_s: f64,
    /// Duration of the plan that is tried out \[s\].
    parent_duration_s: f64,
    plates: usize,
    certificate: &'a Certificate,
}

/// What is said where there is none.
#[derive(Debug, Serialize)]
struct NoReport {
    parent: String,
    height_m: f64,
    /// A height that was found to work \[m\]; `None` where none of those tried does.
    works_at_m: Option<f64>,
    #[serde(flatten)]
    why: InfeasibleReport,
}

/// Proves a plan, plans and proves its dry run, and writes that.
pub fn run(options: &Options, arguments: &DryRunArguments) -> Result<ExitCode, Failure> {
    let folder = results::folder(options).join(FOLDER);
    let places = OWNED.map(|name| folder.join(name));
    output::check_places(&places)?;
    refuse_own_place(&arguments.plan, &places)?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let progress = Progress::new(options.quiet, "proving the plan");
    let asked = job(&file, arguments.height, arguments.speed)?;
    let parent = file.prove(options)?;
    if !parent.passes() {
        let first = &parent.headline;
        let words = format_args!("a dry run is one of a proved plan; this one is {first}");
        return Err(file.not_verified(words));
    }
    let order = &file.plan.order;
    let watch = Watch {
        tell: &|activity| progress.say("planning the dry run", activity),
        cancel: &options.cancel,
    };
    let planned = match plan_in_order(&asked, order, &file.plan.wash_paths, &watch) {
        Ok(planned) => planned,
        Err(error) => {
            let Some(why) = InfeasibleReport::new(asked.name(), asked.terms().seed, &error) else {
                return Err(platewash::Failure::from(error).into());
            };
            let works_at_m = other_height(&file, arguments, &watch)?;
            drop(progress);
            let end = NoReport::new(&file.plan, arguments.height, works_at_m, why);
            return end.tell(options, &places);
        }
    };
    check_paths(&file.plan, &planned.plan).map_err(|error| refused(&file, error))?;
    let mut certificate = prove_with(&planned.plan, &file.arm, &options.cancel).map_err(platewash::Failure::from)?;
    certificate.set_parent_compared();
    drop(progress);
    tell(options, arguments, &file.plan, (&planned, &certificate), &places)
}

/// The job of the dry run.
fn job(file: &PlanFile<'_>, height_m: f64, speed_m_s: f64) -> Result<WashJob, Failure> {
    dry_run_job(&file.plan, &file.arm, height_m, speed_m_s).map_err(|error| refused(file, error))
}

/// Why a plan has no dry run.
fn refused(file: &PlanFile<'_>, error: DryRunError) -> Failure {
    match error {
        DryRunError::NotSealed | DryRunError::OtherPaths => file.not_verified(error),
        error => file.refused(error),
    }
}

/// Another height at which a plan is found \[m\]: the greatest of some lower ones, or the least of some higher ones.
fn other_height(file: &PlanFile<'_>, arguments: &DryRunArguments, watch: &Watch<'_>) -> Result<Option<f64>, Failure> {
    let works = |height_m: f64| {
        // A height at which there is no job works as little as one at which there is no plan.
        let Ok(job) = job(file, height_m, arguments.speed) else {
            return Ok(false);
        };
        match plan_in_order(&job, &file.plan.order, &file.plan.wash_paths, watch) {
            Ok(_) => Ok(true),
            Err(PlanError::Cancelled(cancelled)) => Err(Failure::from(cancelled)),
            Err(_) => Ok(false),
        }
    };
    let (mut low, mut high, mut found) = (least_height_m(&file.plan.job), arguments.height, None);
    for _ in 0..TRIES {
        let height_m = typed(0.5 * (low + high));
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
        let height_m = typed(arguments.height + more_m);
        if found.is_none() && works(height_m)? {
            found = Some(height_m);
        }
    }
    Ok(found)
}

/// A height as a whole number of millimetres, so that it can be typed in \[m\].
fn typed(height_m: f64) -> f64 {
    (1e3 * height_m).floor() / 1e3
}

fn tell(
    options: &Options,
    arguments: &DryRunArguments,
    parent: &Plan,
    (planned, certificate): (&Planned, &Certificate),
    [plan, proof, data, sheet]: &[PathBuf; 4],
) -> Result<ExitCode, Failure> {
    let report = Report {
        parent: parent.hash.as_deref().unwrap_or_default(),
        height_m: arguments.height,
        tip_speed_m_s: arguments.speed,
        proved: certificate.passes(),
        headline: &certificate.headline,
        duration_s: planned.plan.duration_s(),
        parent_duration_s: parent.duration_s(),
        plates: planned.plan.order.len(),
        certificate,
    };
    let json = planned.plan.to_json().map_err(platewash::Failure::from)?;
    let files = [
        output::file(plan.clone(), json),
        output::file(proof.clone(), output::json(certificate)?),
        output::file(data.clone(), output::json(&report)?),
        output::file(sheet.clone(), whole(&report)),
    ];
    output::replace(&files, &[plan, proof, data, sheet].map(Clone::clone), &options.cancel)?;
    output::print_either(options.json, &report, || arguments.details.printed(&report))?;
    results::name(options, &files);
    let outcome = if report.proved {
        Outcome::Good
    } else {
        Outcome::NotVerified
    };
    Ok(outcome.answer())
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

impl NoReport {
    fn new(parent: &Plan, height_m: f64, works_at_m: Option<f64>, why: InfeasibleReport) -> Self {
        let parent = parent.hash.clone().unwrap_or_default();
        let lower = match works_at_m {
            Some(works_at_m) => format!("--height {works_at_m} was found to work"),
            None => "none of the heights that were tried besides was found to work".to_owned(),
        };
        let reason = format!("a dry run {height_m} m above the plates: {}; {lower}", why.reason);
        let why = why.explained(reason);
        Self {
            parent,
            height_m,
            works_at_m,
            why,
        }
    }

    fn tell(&self, options: &Options, [plan, proof, data, sheet]: &[PathBuf; 4]) -> Result<ExitCode, Failure> {
        let words = text(&self.why);
        let files = [
            output::file(data.clone(), output::json(self)?),
            output::file(sheet.clone(), &words),
        ];
        output::replace(&files, &[plan, proof, data, sheet].map(Clone::clone), &options.cancel)?;
        output::print_either(options.json, self, || words.clone())?;
        results::name(options, &files);
        let outcome = match self.why.verdict {
            Verdict::Infeasible | Verdict::NotFound => Outcome::Infeasible,
            Verdict::Washed | Verdict::Swept | Verdict::DryRun | Verdict::NotVerified => Outcome::NotVerified,
        };
        Ok(outcome.answer())
    }
}

/// Refuses a plan that the dry run would be written over.
fn refuse_own_place(plan: &Path, places: &[PathBuf]) -> Result<(), Failure> {
    let place = |path: &Path| output::place(path).ok();
    let Some(own) = place(plan) else { return Ok(()) };
    if places.iter().any(|other| place(other).as_ref() == Some(&own)) {
        let name = printable(&plan.display().to_string());
        return Err(Failure::input(anyhow!(
            "{name}: is where the dry run is written: give --out another folder"
        )));
    }
    Ok(())
}
