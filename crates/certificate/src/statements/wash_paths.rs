//! Checks of the wash paths: one for each plate, in the order of washing, within the ranges that can be judged.
//!
//! Requirement 6 of `docs/certificate.md`.
//!
//! The planner is free to choose a wash path. Its quality is judged by the coverage, the deviation of the tip and the reach of the sponge;
//! here only its numbers are checked.

use crate::report::check::{Check, Discrepancy};
use crate::report::requirement::Requirement;
use platewash_motion::plan::Plan;
use platewash_workcell::job::{MOST_PASSES, PlanKind, Statement, StatementRule};
use platewash_workcell::wash_path::{
    LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_RINGS, MOST_TRIM_RAD, MOST_TURNS, WashPath,
};
use std::f64::consts::{PI, TAU};

/// Greatest outer radius of a path, and greatest lift \[m\].
const GREATEST_M: f64 = 10.0;

/// Least angle of a blend between two rings \[rad\].
const LEAST_BLEND_RAD: f64 = 1e-3;

/// Number of a path: its name, its value, and the least and greatest that can be judged.
type Number = (&'static str, f64, [f64; 2]);

fn is_within((_, found, [least, most]): &Number) -> bool {
    (least..=most).contains(&found)
}

/// Returns the numbers of a path with their ranges. The swept area grows with them, and so does the time of judging it.
fn numbers(path: &WashPath, tilt_rad: f64) -> Vec<Number> {
    let curve = &path.curve;
    // A spiral of mean radius R/2, and a ring.
    let length_m = PI * curve.radius_m * (curve.turns + 2.0);
    let mut numbers = Vec::from([
        ("curve.radius_m", curve.radius_m, [LEAST_RADIUS_M, GREATEST_M]),
        ("curve.turns", curve.turns, [LEAST_TURNS, MOST_TURNS]),
        ("curve.start_angle_rad", curve.start_angle_rad, [-TAU, TAU]),
        ("curve.trim_rad", curve.trim_rad, [0.0, MOST_TRIM_RAD]),
        ("length of the curve", length_m, [0.0, LONGEST_M]),
        ("lift_m", path.lift_m, [f64::MIN_POSITIVE, GREATEST_M]),
        ("cone_rad", path.cone_rad, [0.0, tilt_rad]),
    ]);
    if let Some(rings) = &curve.rings {
        let count = rings.count as f64;
        // No ring is longer than the outermost.
        let laps = f64::from(rings.laps);
        let length_m = TAU * curve.radius_m * (laps * count + 1.0);
        numbers.extend([
            ("curve.rings.laps", laps, [1.0, f64::from(MOST_PASSES)]),
            ("curve.rings.count", count, [2.0, MOST_RINGS as f64]),
            ("curve.rings.inner_m", rings.inner_m, [0.0, curve.radius_m]),
            ("curve.rings.lead_rad", rings.lead_rad, [0.0, TAU]),
            ("curve.rings.blend_rad", rings.blend_rad, [LEAST_BLEND_RAD, TAU]),
            ("length of the rings", length_m, [0.0, 2.0 * LONGEST_M]),
        ]);
    }
    numbers
}

/// Returns the wash path of each plate, if there is one that can be judged.
pub(crate) fn by_plate(plan: &Plan) -> Vec<Option<WashPath>> {
    let tilt_rad = plan.job.tilt_max_rad();
    if PlanKind::of(&plan.job).rule(Statement::WashPaths) == StatementRule::Refused {
        return vec![None; plan.job.plates.len()];
    }
    let is_sound = |path: &&WashPath| numbers(path, tilt_rad).iter().all(is_within);
    let of = |plate| plan.wash_path_of(plate).filter(is_sound).copied();
    (0..plan.job.plates.len()).map(of).collect()
}

/// Checks that every plate has its path.
pub(crate) fn check(plan: &Plan) -> Check {
    let mut wrong = Vec::new();
    let (found, asked) = (plan.wash_paths.len(), plan.order.len());
    if found != asked {
        wrong.push(Discrepancy::new("number of wash_paths", found, asked));
    }
    for (i, (path, plate)) in plan.wash_paths.iter().zip(&plan.order).enumerate() {
        if path.plate != *plate {
            let expected = format!("{plate}, as order[{i}] says");
            wrong.push(Discrepancy::new(format!("wash_paths[{i}].plate"), path.plate, expected));
        }
    }
    let tilt_rad = plan.job.tilt_max_rad();
    for (i, path) in plan.wash_paths.iter().enumerate() {
        let numbers = numbers(path, tilt_rad).into_iter();
        for (name, found, [least, most]) in numbers.filter(|number| !is_within(number)) {
            let what = format!("wash_paths[{i}]: {name}");
            wrong.push(Discrepancy::new(what, found, format!("from {least} to {most}")));
        }
        let passes = plan
            .job
            .plates
            .get(path.plate)
            .map_or(1, |plate| plan.job.passes_of(plate));
        let laps = path.curve.laps();
        if laps < passes {
            let what = format!("wash_paths[{i}]: curve.rings.laps");
            wrong.push(Discrepancy::new(
                what,
                laps,
                format!("at least {passes}, as the soil asks"),
            ));
        }
    }
    Check::stated(Requirement::WashPaths, wrong)
}
