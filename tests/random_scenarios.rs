//! Shipped scenarios with unusual sponges, promises and walls: what is planned of them is proved.
//!
//! `PLATEWASH_RANDOM_JOBS=500 cargo test --release -p platewash --test main random_scenarios -- --nocapture` judges more of them and prints
//! what came of each.

use platewash::certificate::prove;
use platewash::planner::{Watch, plan_here};
use platewash::scenario::{BodyShape, ObstacleSection, StatedShape};
use platewash::workcell::random::stream;
use platewash::{CancelToken, Failure, Scenario};
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::fmt;

/// Jobs that are judged where nothing else is asked for.
const JOBS: u64 = 12;

/// Scenarios that are changed; their plates are drawn.
const BASES: [&str; 6] = ["kitchen", "kitchen-roomy", "rim", "dessert", "deep", "coupe"];

fn any(random: &mut Pcg64, [least, most]: [f64; 2]) -> f64 {
    least + (most - least) * random.random::<f64>()
}

/// What a job came to.
enum Outcome {
    Proved,
    Refused(String),
    NotProved(String),
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proved => write!(f, "proved"),
            Self::Refused(why) => write!(f, "refused: {why}"),
            Self::NotProved(headline) => write!(f, "{headline}"),
        }
    }
}

/// A shipped scenario with one plate or two, and everything else that a user might change.
fn scenario(seed: u64) -> Scenario {
    let random = &mut stream(seed, "random scenarios");
    loop {
        let drawn = drawn(seed, random);
        // What contradicts itself is drawn again.
        if drawn.validate().is_ok() {
            return drawn;
        }
    }
}

fn drawn(seed: u64, random: &mut Pcg64) -> Scenario {
    let mut scenario = Scenario::load(BASES[random.random_range(0..BASES.len())]).unwrap();
    scenario.name = format!("{} {seed}", scenario.name);
    let is_flat = scenario.layout.plate_radius_m.is_some();
    if is_flat {
        scenario.layout.plate_radius_m = Some(any(random, [0.05, 0.15]));
    }
    let plate_m = scenario.layout.plate_radius_m.unwrap_or(0.135);
    scenario.job.required_coverage = any(random, [0.9, 0.999]);
    let tool = &mut scenario.tool;
    tool.length_m = any(random, [0.12, 0.2]);
    tool.radius_m *= any(random, [0.6, 1.2]);
    tool.sponge_radius_m *= any(random, [0.7, 1.4]);
    tool.sponge_height_m *= any(random, [0.7, 1.4]);
    tool.sponge_compression_m = any(random, [0.1, 0.5]) * tool.sponge_height_m;
    let softest = any(random, [4.0, 30.0]);
    tool.sponge_stiffness_kpa = Some([softest, softest * any(random, [1.0, 4.0])]);
    let compression_m = tool.sponge_compression_m;
    let wash = &mut scenario.wash;
    (wash.turns, wash.closing_ring, wash.path_radius_m) = (None, None, None);
    wash.clearance_m = any(random, [0.002, 0.015]);
    wash.tilt_max_deg = any(random, [8.0, 30.0]);
    wash.speed_m_s = any(random, [0.05, 0.4]);
    wash.acceleration_m_s2 = any(random, [1.0, 6.0]);
    wash.lift_m = any(random, [0.02, 0.06]);
    wash.contact = random.random_bool(0.8);
    let mut stated = |range: [f64; 2]| random.random_bool(0.7).then(|| any(random, range));
    wash.contact_compression_m = stated([0.0, 0.5 * compression_m]);
    wash.contact_height_error_m = stated([0.0001, 0.4 * compression_m]);
    wash.contact_share = stated([0.9, 0.999]);
    wash.contact_strain = stated([0.5, 0.8]);
    wash.contact_force_n = stated([0.0, 3.0]).map(|least| [least, 80.0]);
    wash.contact_time_s = stated([0.0, 0.4]);
    wash.contact_time_share = stated([0.9, 0.999]);
    wash.contact_dose_pa_m = stated([0.0, 100.0]);
    wash.contact_dose_share = stated([0.9, 0.999]);
    let azimuth = any(random, [-100.0, 100.0]).to_radians();
    let rho_m = any(random, [0.34, 0.46]);
    let [x, y] = [rho_m * azimuth.cos(), rho_m * azimuth.sin()];
    scenario.layout.positions_m = Some(vec![[x, y]]);
    if random.random_bool(0.5) {
        // A wall beside the plate, across some direction from it.
        let toward = any(random, [0.0, 360.0]);
        let thickness_m = any(random, [0.005, 0.05]);
        let away_m = plate_m + any(random, [0.005, 0.08]) + 0.5 * thickness_m;
        let (sine, cosine) = f64::to_radians(toward).sin_cos();
        let height_m = any(random, [0.03, 0.3]);
        scenario.obstacle.push(ObstacleSection {
            name: "wall beside".to_owned(),
            body: StatedShape {
                shape: Some(BodyShape::Box),
                size_m: Some([thickness_m, any(random, [0.05, 0.4]), height_m]),
                ..StatedShape::default()
            },
            at_m: Some([x + away_m * cosine, y + away_m * sine, 0.5 * height_m]),
            rpy_deg: [0.0, 0.0, toward],
            ..ObstacleSection::default()
        });
    }
    scenario
}

fn judged(seed: u64) -> Outcome {
    let scenario = scenario(seed);
    let arm = scenario.arm().unwrap();
    let cancel = CancelToken::new();
    let watch = Watch::silent(&cancel);
    let job = scenario
        .place(&arm, &watch)
        .and_then(|layout| scenario.job_on(&arm, &layout));
    let planned = match job.and_then(|job| plan_here(&job, &watch).map_err(Failure::from)) {
        Ok(planned) => planned,
        Err(Failure::Plan(error)) if error.is_infeasible() => return Outcome::Refused(error.to_string()),
        // An obstacle stands in the arm, or in the plate.
        Err(Failure::Job(error)) => return Outcome::Refused(error.to_string()),
        Err(error) => panic!("seed {seed}: {error}"),
    };
    let certificate = prove(&planned.plan, &arm).unwrap();
    if certificate.passes() {
        Outcome::Proved
    } else {
        Outcome::NotProved(certificate.headline)
    }
}

#[test]
fn plans_of_random_scenarios_are_proved() {
    let count = std::env::var("PLATEWASH_RANDOM_JOBS").ok();
    let count = count.map_or(JOBS, |count| count.parse().unwrap());
    let outcomes: Vec<_> = (1..=count)
        .into_par_iter()
        .map(|seed| {
            let outcome = judged(seed);
            println!("{seed}: {outcome}");
            outcome
        })
        .collect();
    let of = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|outcome| is(outcome)).count();
    let proved = of(|outcome| matches!(outcome, Outcome::Proved));
    let refused = of(|outcome| matches!(outcome, Outcome::Refused(_)));
    let not_proved = of(|outcome| matches!(outcome, Outcome::NotProved(_)));
    println!("of {count} jobs {proved} are proved, {refused} refused, {not_proved} planned and not proved");
    assert_eq!(not_proved, 0);
    assert!(8 * proved > outcomes.len() && refused > 0);
}

/// With a short tool the arm leans so that the washes which suffice on the bare face give too little of it the dose: denser ones are found.
#[test]
fn a_kitchen_with_a_short_tool_is_washed_more_densely() {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.seed = 3;
    scenario.tool.length_m = 0.1;
    let arm = scenario.arm().unwrap();
    let cancel = CancelToken::new();
    let watch = Watch::silent(&cancel);
    let layout = scenario.place(&arm, &watch).unwrap();
    let planned = plan_here(&scenario.job_on(&arm, &layout).unwrap(), &watch).unwrap();
    let certificate = prove(&planned.plan, &arm).unwrap();
    assert!(certificate.passes(), "{}", certificate.headline);
}
