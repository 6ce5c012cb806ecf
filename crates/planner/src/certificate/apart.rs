//! Plates keep apart from each other and from the base.

use super::promise::{Discrepancy, Promise, PromiseName, Status};
use crate::layout::Plate;
use crate::plan::Plan;
use crate::robot;
use crate::scenario::Overlap;
use platewash_kinematics::RobotModel;

/// Plates that overlap by less than this touch: the rounding of their places \[m\].
const TOUCHING_M: f64 = 1e-9;

/// Promises that no two plates overlap and that none lies over the base's footprint; findings alone where the scenario
/// only wants to be told.
pub(super) fn promise(plan: &Plan, robot: &RobotModel) -> Promise {
    let plates = &plan.plates;
    let mut wrong = Vec::new();
    let base = robot::base_footprint(robot);
    for (i, plate) in plates.iter().enumerate() {
        let beyond = |value: f64, [least, most]: [f64; 2]| (least - value).max(value - most).max(0.0);
        let (dx, dy) = (beyond(plate.x_m, base.x_m), beyond(plate.y_m, base.y_m));
        let gap = (dx * dx + dy * dy).sqrt() - plate.radius_m;
        if gap < -TOUCHING_M {
            wrong.push(Discrepancy::new(
                format!("gap between plate {i} and the base"),
                format!("{gap} m"),
                "none below 0",
            ));
        }
    }
    for a in 0..plates.len() {
        for b in a + 1..plates.len() {
            let gap = gap(&plates[a], &plates[b]);
            if gap < -TOUCHING_M {
                let what = format!("gap between plate {a} and plate {b}");
                wrong.push(Discrepancy::new(what, format!("{gap} m"), "none below 0"));
            }
        }
    }
    let mut promise = Promise::stated(PromiseName::PlatesApart, wrong);
    if plan.scenario.layout.overlap == Overlap::Report && promise.status == Status::Fail {
        promise.status = Status::Exempt;
    }
    promise
}

/// Distance between the rims of two plates of the same height, negative where they overlap \[m\].
fn gap(a: &Plate, b: &Plate) -> f64 {
    let (dx, dy) = (a.x_m - b.x_m, a.y_m - b.y_m);
    (dx * dx + dy * dy).sqrt() - a.radius_m - b.radius_m
}
