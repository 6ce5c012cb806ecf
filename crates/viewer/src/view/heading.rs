//! What a page is about.

use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::{Treatment, WashJob};
use platewash_workcell::plan::{self, Plan};
use serde::Serialize;

/// What a page is about.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Heading {
    /// Name of the scenario; the arm's for one configuration.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// SHA-256 that the plan states; `None` where there is no plan.
    pub hash: Option<String>,
    /// What kind of motion it is, if any.
    pub process: Process,
    /// What must be read first of a dry run: of which plan it is one, and that nothing is washed; `None` for everything else.
    pub dry_run: Option<String>,
    /// What the job does to its plates.
    pub treatment: Treatment,
    /// Name of the arm.
    pub robot: String,
    /// Duration of the motion \[s\]; 0 where there is none.
    pub duration_s: f64,
}

/// What kind of motion is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Process {
    /// A washing, planned as a whole.
    Wash,
    /// A run of the paper's program.
    Paper,
    /// None: a single configuration.
    Configuration,
}

impl Heading {
    pub(super) fn of_plan(plan: &Plan) -> Self {
        Self {
            scenario: plan.provenance.scenario.clone(),
            seed: plan.job.seed,
            hash: plan.hash.clone(),
            process: match plan.process {
                plan::Process::Wash => Process::Wash,
                plan::Process::Paper => Process::Paper,
            },
            dry_run: plan.job.dry_run.as_ref().map(DryRun::words),
            treatment: plan.job.treatment(),
            robot: plan.job.workcell.arm.name.clone(),
            duration_s: plan.duration_s(),
        }
    }

    pub(super) fn of_job(job: &WashJob) -> Self {
        Self {
            scenario: job.name().to_owned(),
            seed: job.terms().seed,
            hash: None,
            process: Process::Wash,
            dry_run: job.terms().dry_run.as_ref().map(DryRun::words),
            treatment: job.terms().treatment(),
            robot: job.arm().name().to_owned(),
            duration_s: 0.0,
        }
    }

    pub(super) fn of_configuration(robot: &str) -> Self {
        Self {
            scenario: robot.to_owned(),
            seed: 0,
            hash: None,
            process: Process::Configuration,
            dry_run: None,
            treatment: Treatment::Swept,
            robot: robot.to_owned(),
            duration_s: 0.0,
        }
    }
}
