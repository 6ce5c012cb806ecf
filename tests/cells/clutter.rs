//! The kitchen among boxes and cylinders that stand about at random, outside of the columns over its plates.

use super::{Outcome, judged};
use platewash::Scenario;
use platewash::scenario::{BodyShape, ObstacleSection, StatedShape};
use platewash::workcell::random::stream;
use rand::RngExt;

/// Between an obstacle and the column over a plate: half of the tool and a clearance \[m\].
const BESIDE_M: f64 = 0.05;

/// Bodies of 40 to 100 mm, their tops at most 130 mm high.
fn cell(seed: u64, bodies: usize) -> Scenario {
    let mut scenario = Scenario::load("kitchen-spiral").unwrap();
    let plates = scenario.job().unwrap().terms().plates.clone();
    let mut rng = stream(seed, "clutter");
    while scenario.obstacle.len() < bodies {
        let [x, y]: [f64; 2] = [rng.random_range(-0.75..0.75), rng.random_range(-0.75..0.75)];
        let [a, b, h] = [(); 3].map(|()| rng.random_range(0.04..0.1));
        let out = 0.5 * f64::hypot(a, b);
        let over_plate = plates.iter().any(|plate| {
            let [px, py] = plate.centre_xy();
            f64::hypot(x - px, y - py) < plate.rim_m() + BESIDE_M + out
        });
        // The base, and home: the tool hangs down at (0.374, 0).
        let at_arm = f64::hypot(x, y) < 0.25 + out || f64::hypot(x - 0.374, y) < 0.08 + out;
        if over_plate || at_arm {
            continue;
        }
        let z = rng.random_range(0.5 * h..0.13 - 0.5 * h);
        let is_box = rng.random_bool(0.5);
        scenario.obstacle.push(ObstacleSection {
            name: format!("body {}", scenario.obstacle.len()),
            body: StatedShape {
                shape: Some(if is_box { BodyShape::Box } else { BodyShape::Cylinder }),
                size_m: is_box.then_some([a, b, h]),
                radius_m: (!is_box).then_some(0.5 * a),
                length_m: (!is_box).then_some(h),
                ..StatedShape::default()
            },
            at_m: Some([x, y, z]),
            rpy_deg: [0.0, 0.0, rng.random_range(-180.0..180.0)],
            ..ObstacleSection::default()
        });
    }
    scenario
}

fn share(cells: u64) -> usize {
    let mut proved = 0;
    for seed in 1..=cells {
        let (outcome, _) = judged(&cell(seed, 30));
        proved += usize::from(outcome == Outcome::Proved);
        if outcome != Outcome::Proved {
            eprintln!("clutter {seed}: {outcome:?}");
        }
    }
    eprintln!("{proved} of {cells} cluttered kitchens proved");
    proved
}

#[test]
fn a_cluttered_kitchen_is_proved() {
    assert_eq!(share(6), 6);
}

#[test]
#[ignore = "200 kitchens"]
fn many_cluttered_kitchens_are_proved() {
    assert!(share(200) >= 190);
}
