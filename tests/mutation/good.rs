//! The plans that are edited: two real jobs, planned once.

use crate::sampler::Sampler;
use platewash::planner::certificate::{PromiseName, verify};
use platewash::{Cycle, Plan, RobotModel, Scenario};
use std::sync::LazyLock;

/// A plan, its arm, and who measures what comes of it.
pub struct Good {
    pub plan: Plan,
    pub robot: &'static RobotModel,
    pub sampler: Sampler<'static>,
}

/// The shipped scenarios and the seeds of their layouts.
const JOBS: [(&str, u64); 2] = [("kitchen", 1), ("kitchen-rim", 2)];

static GOOD: LazyLock<[Good; 2]> = LazyLock::new(|| JOBS.map(|(name, seed)| planned(name, seed)));

/// Both plans.
pub fn good() -> &'static [Good; 2] {
    &GOOD
}

impl Good {
    /// The names of all promises, in the order of the certificate.
    pub fn names(&self) -> Vec<PromiseName> {
        let certificate = verify(&self.plan, self.robot).unwrap();
        certificate.promises.iter().map(|p| p.name).collect()
    }
}

fn planned(name: &str, seed: u64) -> Good {
    let scenario = Scenario {
        seed,
        ..Scenario::load(name).unwrap()
    };
    let cycle = Cycle::plan(&scenario).unwrap();
    let plan = cycle.to_plan().unwrap();
    // They live as long as the test runs.
    let robot = Box::leak(Box::new(cycle.robot));
    let origin = Box::leak(Box::new(plan.clone()));
    Good {
        plan,
        robot,
        sampler: Sampler::new(origin, robot),
    }
}
