//! The plans that are edited: two real jobs, planned once.

use crate::mutation::sampler::Sampler;
use platewash::certificate::{Requirement, prove};
use platewash::{JobTerms, Plan, RobotModel, Scenario, plan};
use std::sync::LazyLock;

/// A plan, its arm, and who measures what comes of it.
pub struct GoodPlan {
    pub plan: Plan,
    /// What its scenario states, resolved without the plan.
    pub terms: JobTerms,
    pub robot: &'static RobotModel,
    pub sampler: Sampler<'static>,
}

/// The shipped scenarios and the seeds of their layouts.
pub const JOBS: [(&str, u64); 2] = [("kitchen-spiral", 1), ("kitchen-rim", 2)];

static GOOD: LazyLock<[GoodPlan; 2]> = LazyLock::new(|| JOBS.map(planned));

/// Both plans.
pub fn good() -> &'static [GoodPlan; 2] {
    &GOOD
}

impl GoodPlan {
    /// All requirements, in the order of the certificate.
    pub fn requirements(&self) -> Vec<Requirement> {
        let certificate = prove(&self.plan, self.robot).unwrap();
        certificate.checks.iter().map(|check| check.requirement).collect()
    }
}

/// The scenario of a job.
pub fn scenario((name, seed): (&str, u64)) -> Scenario {
    Scenario {
        seed,
        ..Scenario::load(name).unwrap()
    }
}

fn planned(job: (&str, u64)) -> GoodPlan {
    let plan = plan(&scenario(job).job().unwrap()).unwrap().plan;
    let again = scenario(job).job().unwrap();
    // They live as long as the test runs.
    let robot = Box::leak(Box::new(again.arm().clone()));
    let origin = Box::leak(Box::new(plan.clone()));
    GoodPlan {
        plan,
        terms: again.terms().clone(),
        robot,
        sampler: Sampler::new(origin, robot),
    }
}
