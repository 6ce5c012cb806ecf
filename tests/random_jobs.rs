//! Jobs that nobody thought of: what is planned of them is proved, and does the job that was asked for.

use platewash::bodies::assembly;
use platewash::certificate::{Requirement, differences, prove};
use platewash::planner::PlannedJob;
use platewash::workcell::job::{OrderRule, Planner, PlannerSettings};
use platewash::workcell::random::stream;
use platewash::workcell::tool::StraightTool;
use platewash::{JobTerms, Plate, RobotModel, WashJob, plan};
use platewash_fixtures::{is_thorough, kitchen_terms};
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::sync::Arc;

/// A number in a range.
fn any(random: &mut Pcg64, [least, most]: [f64; 2]) -> f64 {
    least + (most - least) * random.random::<f64>()
}

/// One to three plates round the base, well apart.
fn plates(random: &mut Pcg64, rim_m: f64) -> Vec<Plate> {
    let count = random.random_range(1..=3);
    let first = any(random, [-80.0, -20.0]);
    let place = |k: i32, random: &mut Pcg64| {
        let azimuth = (first + 70.0 * f64::from(k) + any(random, [-5.0, 5.0])).to_radians();
        let rho_m = any(random, [0.34, 0.42]);
        let height_m = any(random, [0.03, 0.08]);
        let centre = [rho_m * azimuth.cos(), rho_m * azimuth.sin(), height_m];
        Plate::level_disc(centre, rim_m, any(random, [0.005, 0.03]))
    };
    (0..count).map(|k| place(k, random)).collect()
}

fn tool(random: &mut Pcg64) -> StraightTool {
    StraightTool {
        length_m: any(random, [0.12, 0.2]),
        radius_m: any(random, [0.01, 0.02]),
        sponge_radius_m: any(random, [0.02, 0.035]),
        sponge_height_m: any(random, [0.02, 0.03]),
        ..StraightTool::default()
    }
}

/// Everything that a job states, drawn.
fn terms(random: &mut Pcg64, robot: &RobotModel) -> JobTerms {
    let rim_m = any(random, [0.07, 0.145]);
    let tool = tool(random);
    let mut terms = kitchen_terms(robot, plates(random, rim_m));
    terms.workcell = assembly::workcell_on_floor(robot, tool.into()).unwrap();
    let path_radius_m = rim_m - any(random, [0.0, 0.8]) * tool.sponge_radius_m;
    let Planner::Wash(settings) = terms.planner else {
        unreachable!("the kitchen is washed");
    };
    let orders = [OrderRule::Nearest, OrderRule::Given, OrderRule::Fastest];
    let settings = PlannerSettings {
        path_radius_m: Some(path_radius_m),
        // Neighbouring windings overlap by a fifth of the sponge or more.
        turns: Some(any(random, [0.65, 0.8]) * path_radius_m / tool.sponge_radius_m + 0.5),
        closing_ring: Some(true),
        lift_m: any(random, [0.02, 0.06]),
        order: orders[random.random_range(0..3)],
        ..settings
    };
    terms.planner = Planner::Wash(settings);
    let wanted = &mut terms.requirements;
    wanted.as_listed = settings.order == OrderRule::Given;
    wanted.coverage = 0.9;
    wanted.clearance_m = any(random, [0.0, 0.012]);
    wanted.tilt_rad = any(random, [5.0, 30.0]).to_radians();
    wanted.wash_speed_m_s = any(random, [0.05, 0.5]);
    wanted.wash_acceleration_m_s2 = any(random, [1.0, 6.0]);
    terms.limits.tip_speed_m_s = any(random, [0.3, 1.5]);
    terms.limits.joint_acceleration_rad_s2 = std::array::from_fn(|_| any(random, [2.0, 8.0]));
    terms.home_rad[1][0] = any(random, [-1.0, 1.0]);
    terms
}

/// What came of a job: `None` where no way to do it was found.
fn judged(seed: u64, arm: &Arc<RobotModel>) -> Option<PlannedJob> {
    let mut random = stream(seed, "random jobs");
    let job = WashJob::new(arm.clone(), terms(&mut random, arm)).unwrap();
    let planned = match plan(&job) {
        Ok(planned) => planned,
        Err(error) => {
            assert!(error.is_infeasible(), "seed {seed}: {error}");
            return None;
        }
    };
    let certificate = prove(&planned.plan, arm).unwrap();
    let broken: Vec<_> = certificate.broken().map(|check| check.requirement).collect();
    // No planner can promise how much a stated number of turns sweeps.
    assert!(
        broken.is_empty() || broken == [Requirement::Swept],
        "seed {seed}: {certificate}"
    );
    assert_eq!(certificate.waived, [], "seed {seed}");
    assert_eq!(differences(&planned.plan.job, job.terms()), [], "seed {seed}");
    assert!(planned.plan.is_sealed());
    broken.is_empty().then_some(planned)
}

#[test]
fn plans_of_random_jobs_are_proved() {
    let arm = Arc::new(RobotModel::irb120().unwrap());
    let seeds: Vec<_> = (1..=if is_thorough() { 48 } else { 15 }).collect();
    let planned: Vec<_> = seeds.par_iter().filter_map(|seed| judged(*seed, &arm)).collect();
    assert!(
        3 * planned.len() >= 2 * seeds.len(),
        "{} of {}",
        planned.len(),
        seeds.len()
    );
    let plates = |count: usize| planned.iter().any(|planned| planned.plan.order.len() == count);
    assert!(plates(1) && plates(2) && plates(3));
}
