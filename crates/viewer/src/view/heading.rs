//! Heading of a page.

use platewash_bodies::job::WashJob;
use platewash_motion::plan::{Plan, Process};
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::{JobTerms, Treatment};
use serde::Serialize;
use ts_rs::TS;

/// Heading of a page.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Heading {
    /// Name of the scenario; the arm's for one configuration.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// SHA-256 that the plan states; `None` where there is no plan.
    pub hash: Option<String>,
    /// Process of the motion, planned or to come; `None` for one configuration.
    pub process: Option<Process>,
    /// Notice on a dry run, to be read first: the plan that it repeats, and that nothing is washed; `None` for everything else.
    pub dry_run: Option<String>,
    /// Treatment of the plates by the job.
    pub treatment: Treatment,
    /// Name of the arm.
    pub robot: String,
    /// Duration of the motion \[s\]; 0 where there is none.
    pub duration_s: f64,
}

impl Heading {
    pub(super) fn of_plan(plan: &Plan) -> Self {
        Self {
            hash: plan.hash.clone(),
            process: Some(plan.process),
            duration_s: plan.duration_s(),
            ..Self::of_terms(&plan.provenance.scenario, &plan.job)
        }
    }

    pub(super) fn of_job(job: &WashJob) -> Self {
        Self {
            process: Some(Process::Wash),
            ..Self::of_terms(job.name(), job.terms())
        }
    }

    fn of_terms(scenario: &str, terms: &JobTerms) -> Self {
        Self {
            scenario: scenario.to_owned(),
            seed: terms.seed,
            dry_run: terms.dry_run.as_ref().map(DryRun::words),
            treatment: terms.treatment(),
            ..Self::of_configuration(&terms.workcell.arm.name)
        }
    }

    pub(super) fn of_configuration(robot: &str) -> Self {
        Self {
            scenario: robot.to_owned(),
            seed: 0,
            hash: None,
            process: None,
            dry_run: None,
            treatment: Treatment::Swept,
            robot: robot.to_owned(),
            duration_s: 0.0,
        }
    }
}
