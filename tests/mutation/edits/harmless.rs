//! What promises nothing, and what is too small to break anything.

use super::retime;
use crate::edit::{Edits, Kind};
use platewash::planner::scenario::OnFailure;

pub fn add(edits: &mut Edits) {
    let mut words = |what, apply| edits.harmless(Kind::Words, what, apply);
    words("name", |p| p.scenario.name = "renamed".into());
    words("seed", |p| p.scenario.seed += 1);
    words("what failure leads to", |p| {
        p.scenario.job.on_failure = OnFailure::Report
    });
    words("spacing of plates that are drawn", |p| {
        p.scenario.layout.min_distance_m = 0.31
    });
    words("waypoints of the paper's program", |p| p.scenario.wash.points += 1);
    words("control", |p| p.scenario.control.dt_s *= 2.0);
    let mut rounding = |what, apply| edits.harmless(Kind::Rounding, what, apply);
    rounding("positions", |p| {
        p.knots.q_rad.iter_mut().for_each(|q| q.apply(|v| *v = rounded(*v)))
    });
    rounding("speeds", |p| {
        p.knots.qd_rad_s.iter_mut().for_each(|v| v.apply(|v| *v = rounded(*v)))
    });
    rounding("times", |p| retime(p, |_, t| rounded(t)));
    rounding("places of plates", |p| {
        p.plates
            .iter_mut()
            .for_each(|plate| (plate.x_m, plate.y_m) = (rounded(plate.x_m), rounded(plate.y_m)));
    });
}

/// To 13 decimals.
fn rounded(value: f64) -> f64 {
    (value * 1e13).round() / 1e13
}
