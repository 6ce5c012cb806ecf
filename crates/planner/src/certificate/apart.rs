//! Plates keep apart from each other and from the base.

use super::neighbours::{TOUCHING_M, gap};
use super::promise::{Discrepancy, Promise, PromiseName, Status};
use crate::plan::Plan;
use crate::scenario::Overlap;
use platewash_kinematics::RobotModel;
use platewash_workcell::words::millimetres;

/// Promises that no two plates overlap and that none lies over the base's footprint; findings alone where the scenario
/// only wants to be told.
pub(super) fn promise(plan: &Plan, robot: &RobotModel) -> Promise {
    let plates = &plan.plates;
    let mut wrong = Vec::new();
    let base = platewash_workcell::layout::base_footprint(robot);
    for (i, plate) in plates.iter().enumerate() {
        let beyond = |value: f64, [least, most]: [f64; 2]| (least - value).max(value - most).max(0.0);
        let (dx, dy) = (beyond(plate.x_m, base.x_m), beyond(plate.y_m, base.y_m));
        let gap = (dx * dx + dy * dy).sqrt() - plate.radius_m;
        if gap < -TOUCHING_M {
            wrong.push(Discrepancy::new(
                format!("gap between plate {i} and the base"),
                millimetres(gap),
                "none below 0",
            ));
        }
    }
    for a in 0..plates.len() {
        for b in a + 1..plates.len() {
            let gap = gap(&plates[a], &plates[b]);
            if gap < -TOUCHING_M {
                let what = format!("gap between plate {a} and plate {b}");
                wrong.push(Discrepancy::new(what, millimetres(gap), "none below 0"));
            }
        }
    }
    let mut promise = Promise::stated(PromiseName::PlatesApart, wrong);
    if plan.scenario.layout.overlap == Overlap::Report && promise.status == Status::Fail {
        promise.status = Status::Exempt;
    }
    promise
}
