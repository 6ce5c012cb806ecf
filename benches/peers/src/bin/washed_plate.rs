//! Chooses the posture for washing a plate of `kitchen` again and again, on demand: for
//! `benches/peers/posture_against_tesseract.py`, which takes turns with it.
//!
//! The arguments are the plate and the stroke's radius \[m\]. The first line of output is the work as JSON: the layout's plan
//! file and 361 places of the tip along the stroke, equally far apart. Every line of input is then answered by a line: the
//! nanoseconds that one choice took, the configurations in it, the travel of all joints \[rad\].

use nalgebra::Vector3;
use platewash_planner::cycle::Cycle;
use platewash_planner::posture::{Cell, PostureSettings, washing};
use platewash_planner::scenario::Scenario;
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::stroke::Stroke;
use serde_json::json;
use std::error::Error;
use std::io::{BufRead, Write};
use std::time::Instant;

const PLACES: usize = 361;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let plate: usize = arguments.next().ok_or("which plate?")?.parse()?;
    let radius_m: f64 = arguments.next().ok_or("which radius?")?.parse()?;
    let scenario = Scenario::load("kitchen")?;
    let cycle = Cycle::plan(&scenario)?;
    let plates = &cycle.layout.plates;
    let at = plates.get(plate).ok_or("there is no such plate")?;
    let centre = Vector3::new(at.x_m, at.y_m, at.z_m);
    let stroke = Stroke {
        radius_m,
        turns: scenario.wash.turns,
        start_angle_rad: 0.0,
        closing_ring: true,
    };
    let mut out = std::io::stdout().lock();
    let work = json!({ "plan": cycle.to_plan()?, "places_m": places(&stroke, centre) });
    writeln!(out, "{work}")?;
    let clearance = ClearanceModel::new(&cycle.robot, &scenario.tool, plates)?;
    let cell = Cell::new(&cycle.robot, &scenario.tool, &clearance, plates)?;
    let settings = PostureSettings {
        tilt_max_rad: scenario.wash.tilt_max_deg.to_radians(),
        clearance_m: scenario.wash.clearance_m,
    };
    let [home, _] = scenario.homes();
    for line in std::io::stdin().lock().lines() {
        line?;
        let start = Instant::now();
        let washed = washing(&cell, &stroke, centre, plate, &settings, &home)?;
        let spent = start.elapsed();
        let travel: f64 = washed.q.windows(2).map(|q| (q[1] - q[0]).abs().sum()).sum();
        writeln!(out, "{} {} {travel}", spent.as_nanos(), washed.q.len())?;
        out.flush()?;
    }
    Ok(())
}

/// Places along the stroke \[m\].
fn places(stroke: &Stroke, centre: Vector3<f64>) -> Vec<[f64; 3]> {
    const FINE: usize = 50_000;
    let theta = |k: usize| stroke.end() * k as f64 / FINE as f64;
    let mut length_m = vec![0.0];
    for k in 0..FINE {
        let [from, to] = [theta(k), theta(k + 1)].map(|theta| stroke.at(theta).position);
        length_m.push(length_m[k] + (to - from).norm());
    }
    let step_m = length_m[FINE] / (PLACES - 1) as f64;
    (0..PLACES)
        .map(|i| length_m.partition_point(|l| *l < i as f64 * step_m).min(FINE))
        .map(|k| (centre + stroke.at(theta(k)).position.push(0.0)).into())
        .collect()
}
