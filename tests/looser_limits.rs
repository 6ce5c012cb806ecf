//! A looser limit on speeds or accelerations never gives a plan that takes noticeably longer.
//!
//! `PLATEWASH_THOROUGH=1` tries all shipped scenarios and all factors.

use platewash::scenario::{Program, SHIPPED};
use platewash::{Scenario, plan};
use platewash_fixtures::is_thorough;
use rayon::prelude::*;

/// Factors on speeds and on accelerations.
const FACTORS: [f64; 4] = [1.0, 1.5, 2.0, 4.0];

/// Scenarios and factors after every change.
const FEW: [&str; 4] = ["kitchen", "coupe", "sink", "sizes"];
const FEW_FACTORS: [f64; 2] = [1.0, 4.0];

/// Plates behind posts: the tilts are found by a search, whose time nothing estimates.
const SEARCHED: &str = "rack";

/// Greatest ratio of the times with looser and with tighter limits.
const LONGER: f64 = 1.02;

/// Duration of the plan of a scenario with its speeds and accelerations multiplied \[s\].
fn duration_s(name: &str, [speeds, accelerations]: [f64; 2]) -> f64 {
    let mut scenario = Scenario::load(name).unwrap();
    scenario.wash.speed_m_s *= speeds;
    scenario.limits.tip_speed_m_s *= speeds;
    scenario.wash.acceleration_m_s2 *= accelerations;
    scenario.limits.tip_acceleration_m_s2 *= accelerations;
    scenario.limits.joint_acceleration_rad_s2 = scenario.limits.joint_acceleration_rad_s2.map(|a| a * accelerations);
    let planned = plan(&scenario.job().unwrap());
    planned
        .unwrap_or_else(|error| panic!("{name} × {speeds}, {accelerations}: {error}"))
        .plan
        .duration_s()
}

#[test]
fn looser_limits_never_give_longer_plans() {
    let shipped = SHIPPED.iter().map(|shipped| shipped.name);
    let is_ours = |name: &&str| *name != SEARCHED && Scenario::load(name).unwrap().job.program == Program::Certified;
    let (names, factors): (Vec<&str>, &[f64]) = if is_thorough() {
        (shipped.filter(is_ours).collect(), &FACTORS)
    } else {
        (FEW.to_vec(), &FEW_FACTORS)
    };
    let pairs: Vec<[f64; 2]> = factors.iter().flat_map(|v| factors.iter().map(|a| [*v, *a])).collect();
    for name in names {
        let durations: Vec<f64> = pairs.par_iter().map(|pair| duration_s(name, *pair)).collect();
        for (looser, time_s) in pairs.iter().zip(&durations) {
            for (tighter, least_s) in pairs.iter().zip(&durations) {
                let is_looser = looser[0] >= tighter[0] && looser[1] >= tighter[1];
                assert!(
                    !is_looser || *time_s <= LONGER * least_s,
                    "{name}: {time_s} s with limits × {looser:?}, {least_s} s × {tighter:?}"
                );
            }
        }
    }
}
