//! `platewash verify`: the certificate of a plan file, and whether its job is the one that a scenario asks for.

use super::against::{Against, Asked};
use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::handed_over;
use super::options::Options;
use super::output;
use super::pairs::PairArguments;
use super::parent::OfParent;
use super::plan_file::{self, PlanFile};
use super::progress::Progress;
use super::refused::PLAN_STATES;
use anyhow::anyhow;
use clap::Args;
use platewash::certificate::{HashFinding, PairsShown, Verdict, paper_headline};
use platewash::workcell::plan::Process;
use platewash::workcell::words::quoted;
use platewash::{Certificate, Plan};
use serde::Serialize;
use std::path::PathBuf;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// Scenario that the plan should be a plan of, a file or a shipped name: it is resolved again, with --seed or otherwise the
    /// plan's seed, and every field of the job compared
    #[arg(long, value_name = "FILE|NAME")]
    pub against: Option<String>,
    /// A program that was exported of the plan and may have been changed since, all its files: it is read back, compared with the one
    /// that is made of the plan, and judged as it stands
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["against", "parent"])]
    pub program: Vec<PathBuf>,
    /// Plan file that a dry run should be one of: its job, its order and its wash paths are compared
    #[arg(long, value_name = "PLAN")]
    pub parent: Option<PathBuf>,
    #[command(flatten)]
    pub pairs: PairArguments,
}

/// What is said of a plan.
#[derive(Debug, Serialize)]
struct Answer {
    #[serde(flatten)]
    judgement: Judgement,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<Against>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parent: Option<OfParent>,
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
    let mut parent = None;
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
            parent = given.map(|path| OfParent::compare(&file, path)).transpose()?;
            let progress = Progress::new(options.quiet, "proving");
            let mut certificate = file.prove(options)?;
            drop(progress);
            if parent.as_ref().is_some_and(OfParent::agrees) {
                certificate.set_parent_compared();
            }
            Judgement::Washing(Box::new(certificate))
        }
    };
    let answer = Answer {
        judgement,
        against,
        parent,
    };
    output::print_either(options.json, &answer, || answer.text(arguments.pairs.shown()))?;
    Ok(answer.outcome().answer())
}

impl Answer {
    fn outcome(&self) -> Outcome {
        let passes = match &self.judgement {
            Judgement::Washing(certificate) => certificate.passes(),
            Judgement::Paper(_) => false,
        };
        let of_parent = self.parent.as_ref().is_none_or(OfParent::agrees);
        if passes && of_parent && self.against.as_ref().is_none_or(Against::agrees) {
            Outcome::Good
        } else {
            Outcome::NotVerified
        }
    }

    fn text(&self, pairs: PairsShown) -> String {
        let first = self.against.as_ref().map_or_else(String::new, Against::first_words);
        let judgement = match &self.judgement {
            Judgement::Washing(certificate) => certificate.table(pairs).to_string(),
            Judgement::Paper(no_certificate) => no_certificate.text(),
        };
        let against = self.against.as_ref();
        let against = against.map_or_else(String::new, |against| format!("\n{against}"));
        let of = self.parent.as_ref().map_or_else(String::new, OfParent::first_words);
        let parent = self.parent.as_ref();
        let parent = parent.map_or_else(String::new, |parent| format!("\n{parent}"));
        format!("{of}{first}{judgement}{against}{parent}")
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
