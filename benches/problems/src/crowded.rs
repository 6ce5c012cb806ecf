//! A cell crowded by obstacles that nothing comes near: what they cost is the price of looking at them.

use platewash_bodies::clearance::ClearanceModel;
use platewash_planner::plan;
use platewash_scenario::{BodyShape, ObstacleSection, Scenario, StatedShape};
use platewash_workcell::random::stream;
use rand::RngExt;
use std::collections::BTreeMap;
use std::error::Error;

/// Boxes that are tried for each one wanted.
const TRIED: usize = 12;

/// A scenario with so many boxes more, edges 40 to 200 mm, each at least `apart_m` \[m\] from all that moves at each knot of the motion that is planned
/// without them, and as near to it as boxes drawn at random within the arm's surroundings come.
///
/// # Errors
/// Those of planning; fewer boxes found than wanted.
pub fn crowded(scenario: &Scenario, count: usize, apart_m: f64) -> Result<Scenario, Box<dyn Error>> {
    let mut tried = scenario.clone();
    let mut rng = stream(7, "crowd");
    tried.obstacle.extend((0..TRIED * count).map(|k| {
        let size = [(); 3].map(|()| rng.random_range(0.04..0.2));
        let [x, y] = [(); 2].map(|()| rng.random_range(-0.9..0.9));
        ObstacleSection {
            name: format!("box {k}"),
            body: StatedShape {
                shape: Some(BodyShape::Box),
                size_m: Some(size),
                ..StatedShape::default()
            },
            at_m: Some([x, y, rng.random_range(0.5 * size[2]..0.9)]),
            rpy_deg: [0.0, 0.0, rng.random_range(0.0..180.0)],
            ..ObstacleSection::default()
        }
    }));
    let nearest = nearest(scenario, &tried)?;
    let mut kept: Vec<_> = nearest.iter().filter(|(_, near_m)| **near_m >= apart_m).collect();
    kept.sort_by(|a, b| a.1.total_cmp(b.1));
    if kept.len() < count {
        return Err(format!("{} boxes are {apart_m} m away, {count} are wanted", kept.len()).into());
    }
    kept.truncate(count);
    let keeps = |section: &ObstacleSection| kept.iter().any(|(name, _)| **name == section.name);
    tried.obstacle = scenario
        .obstacle
        .iter()
        .cloned()
        .chain(tried.obstacle.into_iter().filter(keeps))
        .collect();
    Ok(tried)
}

/// What the boxes of `tried` keep from all that moves, at the knots of the motion planned for another scenario, by name \[m\].
fn nearest(planned: &Scenario, tried: &Scenario) -> Result<BTreeMap<String, f64>, Box<dyn Error>> {
    let job = planned.job()?;
    let plan = plan(&job)?.plan;
    let plates = &plan.job.plates;
    let model = ClearanceModel::new(job.arm(), &tried.workcell(job.arm(), plates.len())?, plates)?;
    let mut nearest = BTreeMap::new();
    for q in &plan.knots.q_rad {
        for pair in model.all(q) {
            for name in [pair.a, pair.b].into_iter().filter(|name| name.starts_with("box ")) {
                let least: &mut f64 = nearest.entry(name).or_insert(f64::INFINITY);
                *least = least.min(pair.distance_m);
            }
        }
    }
    Ok(nearest)
}
