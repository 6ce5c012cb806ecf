//! `platewash recover`: after a stop home from where the arm stands, and the plates that are left.

use super::export::joint_3;
use super::failure::ExitCode;
use super::files::Files;
use super::numbers::{Unit, joints};
use super::options::Options;
use super::output::{DetailArguments, full_report, json};
use super::plan_file::PlanFile;
use anyhow::{Context, Error, Result, anyhow};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::export::Joint3;
use platewash::kinematics::AXES;
use platewash::planner::{PlanError, Recovered, RecoveryError, Stop, recover};
use platewash::workcell::job::Treatment;
use platewash::workcell::words::pair_text;
use platewash::{Certificate, Failure, PairClearance, Plan};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Names that belong to a recovery in its folder.
const NAMES: [&str; 6] = [
    "home.json",
    "home.certificate.json",
    "rest.json",
    "rest.certificate.json",
    "report.json",
    "report.txt",
];

/// Arguments of `recover`.
#[derive(Debug, Args)]
pub struct RecoverArguments {
    /// Plan file that was stopped; it must be proved
    plan: PathBuf,
    /// Six joint positions of the arm where it stands [deg]
    #[arg(long, value_name = "Q", num_args = AXES, required = true, allow_negative_numbers = true)]
    at_deg: Vec<f64>,
    /// Count of axis 3 in those positions, as that of export: with-joint-2 where they are read off a controller that counts it so
    /// [default: independent, as the description]
    #[arg(long, value_name = "COUNT", value_parser = joint_3)]
    joint_3: Option<Joint3>,
    /// Time in the plan at which it was stopped [s] [default: the earliest at which the plan is about there]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    stopped_s: Option<f64>,
    #[command(flatten)]
    details: DetailArguments,
}

/// Report on a recovery.
#[derive(Debug, Serialize)]
struct Report {
    /// Hash of the plan that was stopped.
    parent: String,
    /// True where the motion home and the plan of the plates that are left are proved.
    proved: bool,
    headline: String,
    stop: Stop,
    /// Pairs of bodies that are nearer where the arm stands than the job asks, without the sponge and the plate that it is at.
    near: Vec<PairClearance>,
    home: ProvedPlan,
    /// The plates that are left; `None` where all were washed.
    rest: Option<ProvedPlan>,
    /// Treatment of the plates by the stopped plan.
    #[serde(skip)]
    treatment: Treatment,
    /// Requirements of the stopped plan that are laxer than usual, as its first line ends.
    #[serde(skip)]
    laxer: String,
}

/// A plan of a recovery, judged.
#[derive(Debug, Serialize)]
struct ProvedPlan {
    /// Indices of the plates that it washes, in order.
    order: Vec<usize>,
    duration_s: f64,
    certificate: Certificate,
}

impl ProvedPlan {
    fn new(options: &Options, file: &PlanFile<'_>, plan: &Plan) -> Result<Self> {
        let proved = prove_with(plan, &file.arm, &options.cancel);
        let mut certificate = proved.map_err(|error| file.failure(error.into()))?;
        certificate.set_parent_compared();
        Ok(Self {
            order: plan.order.clone(),
            duration_s: plan.duration_s(),
            certificate,
        })
    }
}

/// Plans and proves the way home and the plates that are left, and writes both.
pub fn run(options: &Options, arguments: &RecoverArguments) -> Result<ExitCode> {
    let mut files = Files::new(options.folder().join("recovery"), &NAMES);
    files.check()?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let parent = file.prove_as_parent(options, "recovery")?;
    let at = joints(&arguments.at_deg, Unit::Degrees).context("--at-deg")?;
    let at = arguments.joint_3.unwrap_or_default().convert_back(&at);
    let progress = options.progress("planning the recovery");
    let watch = progress.watch(&options.cancel);
    let recovered = match recover(&file.plan, &file.arm, &at, arguments.stopped_s, &watch) {
        Ok(recovered) => recovered,
        Err(error) => {
            drop(progress);
            return refused(options, &file, error);
        }
    };
    let Recovered { stop, near, home, rest } = recovered;
    let judged = |plan: &Plan| ProvedPlan::new(options, &file, plan);
    let mut report = Report {
        parent: file.plan.hash.clone().unwrap_or_default(),
        proved: false,
        headline: String::new(),
        home: judged(&home)?,
        rest: rest.as_ref().map(judged).transpose()?,
        stop,
        near,
        treatment: file.plan.job.treatment(),
        laxer: parent.laxer(),
    };
    drop(progress);
    report.judge();
    for (name, plan, judged) in [
        ("home", Some(&home), Some(&report.home)),
        ("rest", rest.as_ref(), report.rest.as_ref()),
    ] {
        if let Some((plan, judged)) = plan.zip(judged) {
            files.add(&format!("{name}.json"), plan.to_json().map_err(Failure::from)?);
            files.add(&format!("{name}.certificate.json"), json(&judged.certificate)?);
        }
    }
    files.add("report.json", json(&report)?);
    files.add("report.txt", full_report(&report));
    files.answer(options, &report, || arguments.details.printed(&report))?;
    Ok(ExitCode::NotVerified.unless(report.proved))
}

/// Answer where there is no recovery.
#[derive(Debug, Serialize)]
struct RefusalAnswer {
    proved: bool,
    headline: String,
}

/// Says why there is no recovery: as an answer where the arm stands so that none was found, else as an error.
fn refused(options: &Options, file: &PlanFile<'_>, error: RecoveryError) -> Result<ExitCode> {
    match error {
        RecoveryError::Limit(_) | RecoveryError::Touching { .. } | RecoveryError::NoWay { .. } => {
            let headline = format!("NOT RECOVERED: {error}");
            let answer = RefusalAnswer {
                proved: false,
                headline,
            };
            options.print(&answer, || format!("{}\n", answer.headline))?;
            Ok(ExitCode::Infeasible)
        }
        RecoveryError::Time { .. } | RecoveryError::OtherTime { .. } => Err(anyhow!("--stopped-s: {error}")),
        RecoveryError::NotSealed => Err(file.not_verified(error)),
        RecoveryError::Plan(PlanError::Cancelled(cancelled)) => Err(cancelled.into()),
        RecoveryError::Plan(error) => Err(Error::from(Failure::from(error))),
        error => Err(file.refused(error)),
    }
}

impl Report {
    /// Draws the verdict from both certificates.
    fn judge(&mut self) {
        let all = || std::iter::once(&self.home).chain(&self.rest);
        let proved = all().all(|plan| plan.certificate.passes());
        let rest = match &self.rest {
            None => format!("; all plates were {}{}", self.treatment.participle(), self.laxer),
            Some(rest) => {
                let plates = match rest.order.len() {
                    1 => "plate that is left".to_owned(),
                    more => format!("{more} plates that are left"),
                };
                format!(", then the {plates} in {:.2} s", rest.duration_s)
            }
        };
        let verdict = if proved {
            "RECOVERED, PROVED"
        } else {
            "RECOVERY NOT PROVED"
        };
        let caveat = self.stop.caveat();
        self.headline = format!("{verdict}: home in {:.2} s{rest}{caveat}", self.home.duration_s);
        self.proved = proved;
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        writeln!(f, "  stop  {}", self.stop)?;
        for PairClearance { a, b, distance_m, .. } in &self.near {
            let pair = pair_text(&[a.clone(), b.clone()]);
            writeln!(
                f,
                "  near  {pair} are {:.2} mm apart: nearer than asked, and proved to come no nearer",
                1e3 * distance_m
            )?;
        }
        writeln!(f, "  home  {}", self.home.certificate.headline)?;
        if let Some(rest) = &self.rest {
            writeln!(f, "  rest  {}", rest.certificate.headline)?;
        }
        writeln!(
            f,
            "\nplatewash export makes a program of home.json{}\n\
             what stands around the arm must be as the plan says: a plate that moved is not where the proof has it",
            match &self.rest {
                Some(_) => ", and of rest.json: run the first, then the second",
                None => "",
            }
        )?;
        if f.alternate() {
            for plan in std::iter::once(&self.home).chain(&self.rest) {
                write!(f, "\n{:#}", plan.certificate)?;
            }
        }
        Ok(())
    }
}
