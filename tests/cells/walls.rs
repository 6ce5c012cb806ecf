//! Two plates with a wall between them, over which or round which the arm has to find its way.

use super::{Outcome, judged};
use platewash::Scenario;
use platewash::scenario::{ObstacleSection, ObstacleShapeName};
use platewash::workcell::random::stream;
use rand::RngExt;
use std::time::Instant;

/// Plates 0.40 to 0.60 m apart, a wall 10 to 30 mm thick and 0.10 to 0.45 m high half-way between them.
fn cell(seed: u64) -> Scenario {
    let mut rng = stream(seed, "walls");
    let mut scenario = Scenario::load("kitchen").unwrap();
    let apart: f64 = rng.random_range(0.4..0.6);
    // Beside home, where the tool hangs down at azimuth 0.
    let side = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
    let middle: f64 = side * rng.random_range(0.25..0.6);
    let rho: f64 = rng.random_range(0.34..0.4);
    // Two places at the same distance from the axis, so far apart.
    let half = (0.5 * apart / rho).asin();
    let place = |azimuth: f64| [rho * azimuth.cos(), rho * azimuth.sin()];
    scenario.layout.positions_m = Some(vec![place(middle - half), place(middle + half)]);
    scenario.layout.region = None;
    let high: f64 = rng.random_range(0.1..0.45);
    let thick = rng.random_range(0.01..0.03);
    let [x, y] = place(middle).map(|c| c / rho * (0.25 + 0.2));
    scenario.obstacle.push(ObstacleSection {
        name: "wall".to_owned(),
        shape: Some(ObstacleShapeName::Box),
        size_m: Some([0.4, thick, high]),
        at_m: [x, y, 0.5 * high],
        rpy_deg: [0.0, 0.0, middle.to_degrees()],
        ..ObstacleSection::default()
    });
    scenario
}

fn share(cells: u64) -> usize {
    let mut proved = 0;
    let mut seconds: Vec<f64> = Vec::new();
    for seed in 1..=cells {
        let scenario = cell(seed);
        let start = Instant::now();
        let (outcome, _) = judged(&scenario);
        seconds.push(start.elapsed().as_secs_f64());
        proved += usize::from(outcome == Outcome::Proved);
        if outcome != Outcome::Proved {
            eprintln!("wall {seed}: {outcome:?}");
        }
    }
    seconds.sort_by(f64::total_cmp);
    let median = seconds.get(seconds.len() / 2).copied().unwrap_or_default();
    eprintln!("{proved} of {cells} cells with a wall proved; median {median:.3} s to plan and prove");
    proved
}

#[test]
fn a_way_past_a_wall_is_found_and_proved() {
    assert!(share(4) >= 2);
}

#[test]
#[ignore = "100 walls"]
fn ways_past_many_walls_are_found_and_proved() {
    assert!(share(100) >= 70);
}
