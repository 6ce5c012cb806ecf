//! Two plates with a wall between them, over which or round which an arm has to find its way.

use platewash_scenario::{BodyShape, ObstacleSection, Scenario, ScenarioError, StatedShape};
use platewash_workcell::random::stream;
use rand::RngExt;

/// `kitchen` with two plates 0.40 to 0.60 m apart and a wall half-way between them, 10 to 30 mm thick and 0.10 to 0.45 m high; a cell a
/// seed.
///
/// # Errors
/// [`ScenarioError`], where the shipped scenario cannot be read.
pub fn walled(seed: u64) -> Result<Scenario, ScenarioError> {
    let mut rng = stream(seed, "walls");
    let mut scenario = Scenario::load("kitchen")?;
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
        name: WALL.to_owned(),
        body: StatedShape {
            shape: Some(BodyShape::Box),
            size_m: Some([0.4, thick, high]),
            ..StatedShape::default()
        },
        at_m: Some([x, y, 0.5 * high]),
        rpy_deg: [0.0, 0.0, middle.to_degrees()],
        ..ObstacleSection::default()
    });
    Ok(scenario)
}

/// The wall's name.
pub const WALL: &str = "wall";
