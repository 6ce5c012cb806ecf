//! `platewash verify`: the certificate of a plan file, and whether its job is the one that a scenario asks for.

use super::against::{Against, Asked};
use super::details::DetailArguments;
use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan_file::{self, PlanFile};
use super::progress::Progress;
use super::refused::PLAN_STATES;
use super::{handed_over, output, parent};
use anyhow::anyhow;
use clap::Args;
use platewash::certificate::{HashFinding, Verdict, paper_headline};
use platewash::workcell::plan::Process;
use platewash::workcell::words::quoted;
use platewash::{Certificate, Plan};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// Plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// Scenario that the plan should be for; each field of the job is compared. The seed is --seed, or the plan's
    #[arg(long, value_name = "FILE|NAME")]
    pub against: Option<String>,
    /// All files of a robot program exported from the plan and perhaps changed since: it is compared with a new export and judged
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["against", "parent"])]
    pub program: Vec<PathBuf>,
    /// Plan file that this dry run should belong to: job, order and wash paths are compared
    #[arg(long, value_name = "PLAN")]
    pub parent: Option<PathBuf>,
    #[command(flatten)]
    pub details: DetailArguments,
}

/// What is said of a plan.
#[derive(Debug, Serialize)]
struct Answer {
    #[serde(flatten)]
    judgement: Judgement,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<Against>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parent: Option<Against>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Judgement {
    Washing(Box<Certificate>),
    Paper(NoCertificate),
}

/// What is said of a run of the paper's program in place of a certificate.
#[derive(Debug, Serialize)]
struct NoCertificate {
    verdict: Verdict,
    headline: String,
    process: Process,
    scenario: String,
    duration_s: f64,
    hash: HashFinding,
}

/// Judges a plan file for the arm that it is for.
pub fn run(options: &Options, arguments: &VerifyArguments) -> Result<ExitCode, Failure> {
    if arguments.against.is_none() && options.seed.is_some() {
        return Err(Failure::input(anyhow!("--seed: {PLAN_STATES}")));
    }
    if !arguments.program.is_empty() {
        return handed_over::run(options, &arguments.plan, &arguments.program);
    }
    let plan = plan_file::read(&arguments.plan)?;
    let asked = arguments.against.as_ref();
    let asked = asked
        .map(|name| Asked::resolve(options, name, plan.job.seed))
        .transpose()?;
    let against = asked.as_ref().map(|asked| asked.compare(&plan.job));
    let mut compared = None;
    let judgement = match plan.process {
        Process::Paper if arguments.parent.is_some() => {
            let name = arguments.plan.display();
            return Err(Failure::input(anyhow!(
                "{name}: a run of the paper's program is no dry run"
            )));
        }
        Process::Paper => Judgement::Paper(NoCertificate::new(&plan)),
        Process::Wash => {
            let besides = asked.as_ref().map(|asked| &asked.arm);
            let file = PlanFile::with_arm(options, &arguments.plan, plan, besides)?;
            let given = arguments.parent.as_ref();
            compared = given.map(|path| parent::compare(&file, path)).transpose()?;
            let progress = Progress::new(options.quiet, "proving");
            let mut certificate = file.prove(options)?;
            drop(progress);
            if compared.as_ref().is_some_and(Against::agrees) {
                certificate.set_parent_compared();
            }
            Judgement::Washing(Box::new(certificate))
        }
    };
    let answer = Answer {
        judgement,
        against,
        parent: compared,
    };
    output::print_either(options.json, &answer, || arguments.details.printed(&answer))?;
    Ok(answer.outcome().answer())
}

impl Answer {
    fn outcome(&self) -> Outcome {
        let passes = match &self.judgement {
            Judgement::Washing(certificate) => certificate.passes(),
            Judgement::Paper(_) => false,
        };
        if passes && [&self.parent, &self.against].into_iter().flatten().all(Against::agrees) {
            Outcome::Good
        } else {
            Outcome::NotVerified
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for other in [&self.parent, &self.against].into_iter().flatten() {
            f.write_str(&other.first_words())?;
        }
        match &self.judgement {
            Judgement::Washing(certificate) => certificate.fmt(f)?,
            Judgement::Paper(no_certificate) => f.write_str(&no_certificate.text())?,
        }
        let mut others = [&self.against, &self.parent].into_iter().flatten();
        others.try_for_each(|other| write!(f, "\n{other}"))
    }
}

impl NoCertificate {
    fn new(plan: &Plan) -> Self {
        Self {
            verdict: Verdict::Fail,
            headline: paper_headline(plan),
            process: plan.process,
            scenario: plan.provenance.scenario.clone(),
            duration_s: plan.duration_s(),
            hash: HashFinding::of(plan),
        }
    }

    fn text(&self) -> String {
        format!(
            "{}\nscenario {}, as the plan names it\n{}\n",
            self.headline,
            quoted(&self.scenario),
            self.hash.words()
        )
    }
}
