//! Robot programs of the shipped scenarios: what is written reads back, keeps to its plan and is judged again.
//!
//! More seeds: cargo test --release --test programs -- --ignored
#![allow(clippy::unwrap_used, missing_docs)]

use platewash::certificate::{Requirement, Status};
use platewash::export::dialect::{Dialect, Points};
use platewash::export::dialects::DIALECTS;
use platewash::export::{ExportSettings, Exported, compare, export};
use platewash::scenario::{Program, SHIPPED};
use platewash::workcell::plan::Plan;
use platewash::{CancelToken, Certified, RobotModel, Scenario, certify, plan};
use rayon::prelude::*;

/// Seeds of each scenario in the suite, and of the kitchen beyond it.
const SEEDS: std::ops::RangeInclusive<u64> = 1..=3;
const MORE_SEEDS: std::ops::RangeInclusive<u64> = 1..=200;

fn certified(name: &str, seed: u64) -> (Certified<Plan>, RobotModel) {
    let scenario = Scenario {
        seed,
        ..Scenario::load(name).unwrap()
    };
    let job = scenario.job().unwrap();
    (certify(plan(&job).unwrap().plan, job.arm()).unwrap(), job.arm().clone())
}

/// The scenarios that are certified.
fn scenarios() -> impl Iterator<Item = &'static str> {
    let is_certified = |name: &&str| Scenario::load(name).unwrap().job.program == Program::Certified;
    SHIPPED.iter().map(|scenario| scenario.name).filter(is_certified)
}

/// The dialects that take an arm with its job.
fn dialects(plan: &Certified<Plan>, arm: &RobotModel) -> Vec<&'static dyn Dialect> {
    let job = &plan.plan().job;
    let all: Vec<_> = DIALECTS
        .iter()
        .filter(|dialect| dialect.accepts(job, arm).is_ok())
        .copied()
        .collect();
    assert!(
        ["rapid", "ros2", "csv"]
            .iter()
            .all(|name| all.iter().any(|dialect| dialect.name() == *name))
    );
    all
}

/// All that is promised of a program, measured on what was read back, and on motions that are evaluated here.
fn check(plan: &Certified<Plan>, arm: &RobotModel, dialect: &dyn Dialect) {
    let settings = ExportSettings::default();
    let cancel = CancelToken::new();
    let exported = export(plan, arm, dialect, &settings, &cancel).unwrap();
    points_are_the_plans(plan.plan(), dialect, &exported);
    for case in &exported.judged.cases {
        let off = case
            .proof
            .checks
            .iter()
            .find(|check| check.requirement == Requirement::PlanDeviation)
            .unwrap();
        assert_eq!(off.status, Status::Proved);
        assert!(
            off.measure.unwrap().bound.unwrap() <= 2e-4,
            "{}: {off:?}",
            dialect.name()
        );
        assert!(case.proof.holds());
    }
    let again = export(plan, arm, dialect, &settings, &cancel).unwrap();
    assert_eq!(exported.files, again.files);
    let compared = compare(plan, arm, &exported.files, &cancel).unwrap();
    assert!(compared.is_unchanged(), "{}: {:?}", dialect.name(), compared.changes);
    assert!(compared.judged.holds());
}

/// Each point within 1e-4° of the plan at its time, the times in sum those of the plan, no step too short.
fn points_are_the_plans(plan: &Plan, dialect: &dyn Dialect, exported: &Exported) {
    let motion = plan.knots.motion().unwrap();
    let points = &exported.reading.points;
    for point in points {
        let planned = motion.at(point.t_s).unwrap();
        let off_deg = (planned.q - point.q_rad).amax().to_degrees();
        assert!(off_deg <= 1e-4, "{}: {off_deg}° off", point.place);
    }
    let sum_s = points[points.len() - 1].t_s - points[0].t_s;
    let most_s = match dialect.points() {
        Points::Steps { step_s } => step_s,
        _ => 1e-3,
    };
    assert!(
        (sum_s - plan.duration_s()).abs() <= most_s,
        "{}: {sum_s} s",
        dialect.name()
    );
    if let Points::Chords { least_s } = dialect.points() {
        let steps = points.windows(2).map(|both| both[1].t_s - both[0].t_s);
        assert!(
            steps.fold(1.0, f64::min) >= least_s.min(0.01) - 2e-6,
            "{}",
            dialect.name()
        );
    }
}

fn all_hold(name: &str, seeds: std::ops::RangeInclusive<u64>) {
    let seeds: Vec<_> = seeds.collect();
    seeds.into_par_iter().for_each(|seed| {
        let (plan, arm) = certified(name, seed);
        for dialect in dialects(&plan, &arm) {
            check(&plan, &arm, dialect);
        }
    });
}

#[test]
fn programs_of_the_shipped_scenarios_hold() {
    for name in scenarios() {
        // Where plates are listed, every seed has the same layout.
        let lists = Scenario::load(name).unwrap().lists_plates();
        all_hold(name, if lists { 1..=1 } else { SEEDS });
    }
}

#[test]
#[ignore = "takes minutes"]
fn programs_of_many_kitchens_hold() {
    all_hold("kitchen", MORE_SEEDS);
}
