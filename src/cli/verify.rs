//! `platewash verify`: the certificate of a plan file, and whether it is a plan of the scenario, or a dry run or recovery of the plan, that
//! it should be of.

use super::export;
use super::failure::{ExitCode, not_verified};
use super::input_file::refused;
use super::options::{Options, PLAN_STATES};
use super::output::DetailArguments;
use super::plan_file::{self, PlanFile};
use anyhow::{Result, bail, ensure};
use clap::Args;
use platewash::certificate::{Difference, HashFinding, Verdict, differences, paper_headline, prove_with};
use platewash::motion::dry_run::{DryRunError, dry_run_terms};
use platewash::motion::plan::Process;
use platewash::planner::RecoveryError;
use platewash::scenario::Program;
use platewash::workcell::dry_run::DryRun;
use platewash::workcell::job::Recovery;
use platewash::workcell::words::{count_with_noun, quoted};
use platewash::{Certificate, Failure, JobTerms, Plan, RobotModel, Scenario};
use serde::Serialize;
use serde_json::json;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// Plan file
    plan: PathBuf,
    /// Scenario that the plan should be for; each field of the job is compared. The seed is --seed, or the plan's
    #[arg(long, value_name = "FILE|NAME")]
    against: Option<String>,
    /// All files of a robot program exported from the plan and perhaps changed since: it is compared with a new export and judged
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["against", "parent"])]
    program: Vec<PathBuf>,
    /// Plan file that this dry run or recovery should belong to: job, order and wash paths are compared
    #[arg(long, value_name = "PLAN")]
    parent: Option<PathBuf>,
    #[command(flatten)]
    details: DetailArguments,
}

/// Answer of `verify` on a plan.
#[derive(Debug, Serialize)]
struct Answer {
    #[serde(flatten)]
    judgement: Judgement,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<PlanComparison>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parent: Option<PlanComparison>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Judgement {
    Washing(Box<Certificate>),
    /// A run of the paper's program, which has no certificate.
    Paper {
        verdict: Verdict,
        headline: String,
        process: Process,
        scenario: String,
        duration_s: f64,
        hash: HashFinding,
    },
}

/// Comparison of a plan with the scenario or the parent that it should come from.
#[derive(Debug, Serialize)]
struct PlanComparison {
    #[serde(flatten)]
    other: Other,
    differences: Vec<Difference>,
}

/// Scenario or parent that a plan should come from.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Other {
    Scenario {
        scenario: String,
        seed: u64,
    },
    Parent {
        hash: Option<String>,
        #[serde(skip)]
        kind: &'static str,
    },
}

/// Judges a plan file for the arm that it is for.
pub fn run(options: &Options, arguments: &VerifyArguments) -> Result<ExitCode> {
    if arguments.against.is_none() && options.seed.is_some() {
        bail!("--seed: {PLAN_STATES}");
    }
    if !arguments.program.is_empty() {
        return export::verify_program(options, &arguments.plan, &arguments.program);
    }
    let plan = plan_file::read(&arguments.plan)?;
    let asked = arguments.against.as_ref();
    let asked = asked.map(|name| against_scenario(options, name, &plan)).transpose()?;
    let (against, arm) = asked.unzip();
    let mut parent = None;
    let judgement = match plan.process {
        Process::Paper => {
            let name = arguments.plan.display();
            ensure!(
                arguments.parent.is_none(),
                "{name}: a run of the paper's program is neither a dry run nor a recovery"
            );
            Judgement::Paper {
                verdict: Verdict::Fail,
                headline: paper_headline(&plan),
                process: plan.process,
                duration_s: plan.duration_s(),
                hash: HashFinding::check(&plan),
                scenario: plan.provenance.scenario,
            }
        }
        Process::Wash => {
            let file = PlanFile::with_arm(options, &arguments.plan, plan, arm.as_ref())?;
            let given = arguments.parent.as_ref();
            parent = given.map(|path| against_parent(options, &file, path)).transpose()?;
            let mut certificate = file.prove(options)?;
            if parent.as_ref().is_some_and(PlanComparison::agrees) {
                certificate.set_parent_compared();
            }
            Judgement::Washing(certificate.into())
        }
    };
    let answer = Answer {
        judgement,
        against,
        parent,
    };
    options.print(&answer, || arguments.details.printed(&answer))?;
    let passes = matches!(&answer.judgement, Judgement::Washing(certificate) if certificate.passes());
    Ok(ExitCode::NotVerified.unless(passes && answer.comparisons().all(PlanComparison::agrees)))
}

/// Compares every field of a job with what a scenario asks for, by its name or file, with the seed of `--seed`, otherwise the plan's; and
/// the scenario's arm.
fn against_scenario(options: &Options, name: &str, plan: &Plan) -> Result<(PlanComparison, Arc<RobotModel>)> {
    let options = Options {
        scenario: Some(name.to_owned()),
        seed: options.seed.or(Some(plan.job.seed)),
        fix: match &options.urdf {
            Some(_) if options.fix.is_empty() => plan.job.workcell.arm.fixed.clone().into_iter().collect(),
            _ => options.fix.clone(),
        },
        ..options.clone()
    };
    let scenario = options.scenario()?;
    let asked = scenario
        .arm()
        .and_then(|arm| Ok((terms(&options, &scenario, &arm)?, arm)));
    let (terms, arm) = asked.map_err(|failure| options.failure(failure))?;
    let against = PlanComparison {
        differences: differences(&plan.job, &terms),
        other: Other::Scenario {
            scenario: scenario.name.clone(),
            seed: scenario.seed,
        },
    };
    Ok((against, arm))
}

/// Resolved job of a scenario, with its plates placed again.
fn terms(options: &Options, scenario: &Scenario, arm: &Arc<RobotModel>) -> Result<JobTerms, Failure> {
    let progress = options.progress("placing the plates");
    let watch = progress.watch(&options.cancel);
    match scenario.job.program {
        Program::Certified => {
            let layout = scenario.place(arm, &watch)?;
            Ok(scenario.job_on(arm, &layout)?.terms().clone())
        }
        Program::Paper => {
            let layout = scenario.layout(arm)?;
            Ok(scenario.paper_job_on(arm, layout)?.terms()?)
        }
    }
}

/// Compares a dry run or a recovery, field by field, with what that of the plan at `path` has, and its order and paths with those of that
/// plan, which must be proved.
fn against_parent(options: &Options, file: &PlanFile<'_>, path: &Path) -> Result<PlanComparison> {
    let (found, parent) = (&file.plan, plan_file::read(path)?);
    let (kind, mut all) = match (&found.job.dry_run, &found.job.recovery) {
        (Some(dry_run), _) => ("dry run", against_tried(file, dry_run, path, &parent)?),
        (None, Some(recovery)) => ("recovery", against_stopped(found, recovery, path, &parent)?),
        (None, None) => {
            return Err(file.refused(
                "it is neither a dry run nor a recovery; --parent is for plans of platewash dry-run and platewash recover",
            ));
        }
    };
    let washed = |plate: usize| found.job.washes(plate);
    let order: Vec<_> = parent.order.iter().filter(|plate| washed(**plate)).collect();
    let paths: Vec<_> = parent.wash_paths.iter().filter(|path| washed(path.plate)).collect();
    all.extend(differences(
        &json!({"order": found.order, "wash_paths": found.wash_paths}),
        &json!({"order": order, "wash_paths": paths}),
    ));
    // What a dry run or a recovery says of its parent rests on the parent's proof.
    let proved = prove_with(&parent, &file.arm, &options.cancel).map_err(|error| file.failure(error.into()))?;
    if !proved.passes() {
        all.push(Difference {
            key: "parent".to_owned(),
            found: proved.headline,
            expected: "a proved plan".to_owned(),
        });
    }
    Ok(PlanComparison {
        other: Other::Parent {
            hash: parent.hash,
            kind,
        },
        differences: all,
    })
}

/// Compares the job of a dry run with that of a dry run of the plan at `path`, of the same height and speed.
fn against_tried(file: &PlanFile<'_>, dry_run: &DryRun, path: &Path, parent: &Plan) -> Result<Vec<Difference>> {
    let found = &file.plan.job;
    match dry_run_terms(parent, &file.arm, dry_run.height_m, found.limits.tip_speed_m_s) {
        Ok(expected) => Ok(differences(found, &expected)),
        Err(error @ (DryRunError::Height { .. } | DryRunError::TooLow { .. } | DryRunError::Speed { .. })) => {
            Ok(vec![Difference {
                key: "dry_run".to_owned(),
                found: error.to_string(),
                expected: "is one of the plan given".to_owned(),
            }])
        }
        Err(DryRunError::NotSealed) => Err(not_verified(refused(path, DryRunError::NotSealed))),
        Err(error) => Err(refused(path, error)),
    }
}

/// Compares the job of a recovery with that of the plan at `path`. The stop alone decides which plates are left, where the arm stands and
/// which pairs are near there.
fn against_stopped(found: &Plan, recovery: &Recovery, path: &Path, parent: &Plan) -> Result<Vec<Difference>> {
    if !parent.is_sealed() {
        return Err(not_verified(refused(path, RecoveryError::NotSealed)));
    }
    let recovery = Recovery {
        parent: parent.hash.clone().unwrap_or_default(),
        ..recovery.clone()
    };
    let pairs = found.job.workcell.reduced_clearances.iter();
    let at_stop = pairs.filter(|pair| pair.at_stop).cloned().collect();
    let expected = parent.job.recovered(recovery, found.job.home_rad[0], at_stop);
    Ok(differences(&found.job, &expected))
}

impl Answer {
    fn comparisons(&self) -> impl Iterator<Item = &PlanComparison> {
        [&self.parent, &self.against].into_iter().flatten()
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.comparisons()
            .try_for_each(|other| f.write_str(&other.first_words()))?;
        match &self.judgement {
            Judgement::Washing(certificate) => certificate.fmt(f)?,
            Judgement::Paper {
                headline,
                scenario,
                hash,
                ..
            } => {
                let (scenario, hash) = (quoted(scenario), hash.words());
                writeln!(f, "{headline}\nscenario {scenario}, as the plan names it\n{hash}")?;
            }
        }
        let mut others = [&self.against, &self.parent].into_iter().flatten();
        others.try_for_each(|other| write!(f, "\n{other}"))
    }
}

impl PlanComparison {
    /// True where nothing differs.
    fn agrees(&self) -> bool {
        self.differences.is_empty()
    }

    /// Words that begin the answer; empty where nothing differs.
    fn first_words(&self) -> String {
        let count = fields_differ(self.differences.len());
        match &self.other {
            _ if self.agrees() => String::new(),
            Other::Scenario { .. } => format!("OTHER JOB than that of {}: {count}; ", self.other),
            Other::Parent { kind, .. } => format!("NO {} of the plan given: {count}; ", kind.to_uppercase()),
        }
    }
}

impl fmt::Display for Other {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario { scenario, seed } => write!(f, "{}, seed {seed}", quoted(scenario)),
            Self::Parent { hash, .. } => f.write_str(hash.as_deref().unwrap_or("without a hash")),
        }
    }
}

impl fmt::Display for PlanComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (other, count) = (&self.other, fields_differ(self.differences.len()));
        let says = match other {
            Other::Scenario { .. } => {
                writeln!(f, "against {other}: {count}")?;
                "the scenario"
            }
            Other::Parent { kind, .. } => {
                let from = match self.agrees() {
                    true => format!(" from what a {kind} must have"),
                    false => String::new(),
                };
                writeln!(
                    f,
                    "{kind} of {other}: {count}{from}; that plan itself is not proved here"
                )?;
                &format!("a {kind}")
            }
        };
        self.differences
            .iter()
            .try_for_each(|Difference { key, found, expected }| {
                writeln!(f, "  {key}: the plan says {found}, {says} {expected}")
            })
    }
}

/// Number of fields that differ between two jobs, in words.
pub fn fields_differ(count: usize) -> String {
    match count {
        0 => "no field differs".to_owned(),
        1 => "1 field differs".to_owned(),
        several => format!("{} differ", count_with_noun(several, "field")),
    }
}
