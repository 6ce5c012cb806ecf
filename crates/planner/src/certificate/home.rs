//! From home to home, and at rest where a wash begins and where it ends.

use super::promise::{Discrepancy, Promise, PromiseName};
use super::schedule::Schedule;
use crate::plan::Plan;
use crate::tool_path::SegmentKind;
use platewash_kinematics::JointVector;

/// Largest distance from home that counts as there \[rad\], and largest speed that counts as rest \[rad/s\].
const THERE: f64 = 1e-9;

/// The first and the last knot are the scenario's home positions, at rest, and the plan says so.
pub(super) fn home_to_home(plan: &Plan) -> Promise {
    let homes = plan.scenario.homes();
    let mut wrong = Vec::new();
    let knots = &plan.knots;
    let ends = [
        (knots.q_rad.first(), knots.qd_rad_s.first()),
        (knots.q_rad.last(), knots.qd_rad_s.last()),
    ];
    for (i, (home, end)) in homes.iter().zip(ends).enumerate() {
        let name = ["first", "last"][i];
        if plan.home_rad[i] != *home {
            wrong.push(Discrepancy::new(
                format!("home_rad[{i}]"),
                list(&plan.home_rad[i]),
                list(home),
            ));
        }
        let (Some(q), Some(qd)) = end else { continue };
        if (q - home).amax() > THERE {
            wrong.push(Discrepancy::new(
                format!("positions of the {name} knot"),
                list(q),
                list(home),
            ));
        }
        if qd.amax() > THERE {
            wrong.push(Discrepancy::new(format!("speeds of the {name} knot"), list(qd), "rest"));
        }
    }
    Promise::stated(PromiseName::HomeToHome, wrong)
}

/// The arm rests where a wash begins and where it ends.
pub(super) fn rest_at_wash_ends(plan: &Plan, schedule: &Schedule) -> Promise {
    let mut wrong = Vec::new();
    for stage in schedule.stages.iter().filter(|s| s.kind == SegmentKind::Wash) {
        for knot in [stage.pieces.start, stage.pieces.end] {
            let qd = plan.knots.qd_rad_s[knot];
            if qd.amax() > THERE {
                wrong.push(Discrepancy::new(
                    format!("speeds at {:.4} s", plan.knots.t_s[knot]),
                    list(&qd),
                    "rest",
                ));
            }
        }
    }
    Promise::stated(PromiseName::RestAtWashEnds, wrong)
}

fn list(q: &JointVector) -> String {
    let numbers: Vec<_> = q.iter().map(f64::to_string).collect();
    format!("[{}]", numbers.join(", "))
}
