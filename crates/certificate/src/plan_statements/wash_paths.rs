//! Checks of the wash paths: one for each plate, in the order of washing, within the ranges that can be judged.
//!
//! Requirement 6 of `docs/certificate.md`.
//!
//! The planner is free to choose a wash path. Its quality is judged by the coverage, the deviation of the tip and the reach of the sponge;
//! here only its numbers are checked.

use crate::report::check::{Check, Discrepancy};
use crate::report::requirement::Requirement;
use platewash_motion::plan::Plan;
use platewash_workcell::job::{Statement, StatementRule};
use platewash_workcell::wash_path::{CurveNumber, WashPath};

/// Greatest lift \[m\].
const GREATEST_M: f64 = 10.0;

fn is_within((_, found, [least, most]): &CurveNumber) -> bool {
    (least..=most).contains(&found)
}

/// Returns the numbers of a path with their ranges. The swept area grows with them, and so does the time of judging it.
fn numbers(path: &WashPath, tilt_rad: f64) -> Vec<CurveNumber> {
    let curve = &path.curve;
    let mut numbers = curve.numbers().to_vec();
    numbers.extend([
        ("lift_m", path.lift_m, [f64::MIN_POSITIVE, GREATEST_M]),
        ("cone_rad", path.cone_rad, [0.0, tilt_rad]),
    ]);
    numbers.extend(curve.pattern_numbers());
    numbers
}

/// Returns the wash path of each plate, if there is one that can be judged.
pub(crate) fn by_plate(plan: &Plan) -> Vec<Option<WashPath>> {
    let tilt_rad = plan.job.tilt_max_rad();
    if plan.job.kind().rule(Statement::WashPaths) == StatementRule::Refused {
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
