//! The shipped scenarios, each planned once for all tests of this program.

use platewash::scenario::{Program, SHIPPED};
use platewash::{Plan, Scenario, WashJob, plan};
use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

/// Seed of every shipped scenario.
pub const SEED: u64 = 1;

type Planned = (WashJob, Plan);

static PLANNED: LazyLock<BTreeMap<&str, OnceLock<Planned>>> =
    LazyLock::new(|| certified().map(|name| (name, OnceLock::new())).collect());

/// Names of the scenarios that are certified.
pub fn certified() -> impl Iterator<Item = &'static str> {
    let is_certified = |name: &&str| Scenario::load(name).unwrap().job.program == Program::Certified;
    SHIPPED.iter().map(|scenario| scenario.name).filter(is_certified)
}

/// The job of a shipped scenario and its plan.
pub fn planned(name: &str) -> &'static Planned {
    let make = || {
        let scenario = Scenario::load(name).unwrap();
        assert_eq!(scenario.seed, SEED, "{name}");
        let job = scenario.job().unwrap();
        let plan = plan(&job).unwrap().plan;
        (job, plan)
    };
    // In threads of its own: a worker that waits for a part of this plan would take other work, which may wait for the plan.
    let alone = || rayon::ThreadPoolBuilder::new().build().unwrap().install(make);
    PLANNED[name].get_or_init(|| std::thread::scope(|scope| scope.spawn(alone).join().unwrap()))
}
