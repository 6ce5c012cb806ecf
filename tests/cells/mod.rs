//! Cells with obstacles: planned, proved, and refused where something is in the way.
//!
//!     cargo test --release --test main cells -- --ignored --nocapture      the same in great numbers, with the shares found

mod clutter;
mod swept;
mod walls;

use platewash::bodies::clearance::exclusions;
use platewash::certificate::Certificate;
use platewash::workcell::Obstacle;
use platewash::{Plan, Scenario, plan, prove};

/// What came of a cell.
#[derive(Debug, Clone, PartialEq)]
enum Outcome {
    Proved,
    NotProved(String),
    NotPlanned(String),
}

/// A plan of a scenario, with what is proved of it.
fn judged(scenario: &Scenario) -> (Outcome, Option<(Plan, Certificate)>) {
    let job = match scenario.job() {
        Ok(job) => job,
        Err(failure) => return (Outcome::NotPlanned(failure.to_string()), None),
    };
    let planned = match plan(&job) {
        Ok(planned) => planned.plan,
        Err(error) => return (Outcome::NotPlanned(error.to_string()), None),
    };
    let certificate = prove(&planned, job.arm()).unwrap();
    let outcome = if certificate.passes() {
        Outcome::Proved
    } else {
        Outcome::NotProved(certificate.headline.clone())
    };
    (outcome, Some((planned, certificate)))
}

/// A plan among some more obstacles, sealed again.
fn among(plan: &Plan, arm: &platewash::RobotModel, obstacles: Vec<Obstacle>) -> Plan {
    let mut plan = plan.clone();
    let world = &mut plan.job.workcell;
    world.obstacles.extend(obstacles);
    world.exclusions = exclusions(arm, &world.tool, &world.obstacles).unwrap();
    plan.hash = Some(plan.seal().unwrap());
    plan
}
