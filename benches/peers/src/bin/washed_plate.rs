//! Chooses the configurations for washing a plate of `kitchen` again and again, on demand: for
//! `benches/peers/redundancy_against_tesseract.py`, which takes turns with it.
//!
//! The arguments are the plate and the radius of its wash path \[m\]. The first line of output is the work as JSON: the plan file, the
//! pairs of bodies that must keep clear and 361 places of the tip along the path, equally far apart. Every line of input is then
//! answered by a line: the nanoseconds that one choice took, the configurations in it, the travel of all joints \[rad\].

use nalgebra::Vector3;
use platewash_planner::plan;
use platewash_problems::stages::{configurations, surroundings, wash_path};
use platewash_scenario::Scenario;
use platewash_workcell::wash_path::WashCurve;
use serde_json::json;
use std::error::Error;
use std::io::{BufRead, Write};
use std::time::Instant;

const PLACES: usize = 361;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let plate: usize = arguments.next().ok_or("which plate?")?.parse()?;
    let radius_m: f64 = arguments.next().ok_or("which radius?")?.parse()?;
    let job = Scenario::load("kitchen")?.job()?;
    let centre = job.terms().plates.get(plate).ok_or("there is no such plate")?.centre();
    let mut path = wash_path(&job, plate)?;
    path.curve.radius_m = radius_m;
    path.curve.closing_ring = true;
    let around = surroundings(&job)?;
    let mut out = std::io::stdout().lock();
    let work = json!({
        "plan": plan(&job)?.plan,
        "pairs": around.pair_names(),
        "places_m": places(&path.curve, centre),
    });
    writeln!(out, "{work}")?;
    for line in std::io::stdin().lock().lines() {
        line?;
        let start = Instant::now();
        let washed = configurations(&job, &around, &path)?;
        let spent = start.elapsed();
        writeln!(out, "{} {} {}", spent.as_nanos(), washed.q.len(), washed.travel_rad())?;
        out.flush()?;
    }
    Ok(())
}

/// Places along a curve \[m\].
fn places(curve: &WashCurve, centre: Vector3<f64>) -> Vec<[f64; 3]> {
    const FINE: usize = 50_000;
    let theta = |k: usize| curve.end() * k as f64 / FINE as f64;
    let mut length_m = vec![0.0];
    for k in 0..FINE {
        let [from, to] = [theta(k), theta(k + 1)].map(|theta| curve.at(theta).position);
        length_m.push(length_m[k] + (to - from).norm());
    }
    let step_m = length_m[FINE] / (PLACES - 1) as f64;
    (0..PLACES)
        .map(|i| length_m.partition_point(|l| *l < i as f64 * step_m).min(FINE))
        .map(|k| (centre + curve.at(theta(k)).position.push(0.0)).into())
        .collect()
}
