//! From home to home, and at rest where a wash begins and where it ends.

use crate::check::{Check, Discrepancy};
use crate::requirement::Requirement;
use crate::schedule::Schedule;
use platewash_kinematics::JointVector;
use platewash_workcell::plan::Plan;
use platewash_workcell::segment::SegmentKind;

/// Largest distance from home that counts as there \[rad\], and largest speed that counts as rest \[rad/s\].
const THERE: f64 = 1e-9;

/// The first and the last knot are the job's home positions, at rest.
pub(crate) fn home_to_home(plan: &Plan) -> Check {
    let mut wrong = Vec::new();
    let knots = &plan.knots;
    let ends = [
        (knots.q_rad.first(), knots.qd_rad_s.first()),
        (knots.q_rad.last(), knots.qd_rad_s.last()),
    ];
    for (i, (home, end)) in plan.job.home_rad.iter().zip(ends).enumerate() {
        let name = ["first", "last"][i];
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
    Check::stated(Requirement::HomeToHome, wrong)
}

/// The arm rests where a wash begins and where it ends.
pub(crate) fn rest_at_wash_ends(plan: &Plan, schedule: &Schedule) -> Check {
    let mut wrong = Vec::new();
    for span in schedule.spans.iter().filter(|s| s.kind == SegmentKind::Wash) {
        for knot in [span.pieces.start, span.pieces.end] {
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
    Check::stated(Requirement::RestAtWashEnds, wrong)
}

fn list(q: &JointVector) -> String {
    let numbers: Vec<_> = q.iter().map(f64::to_string).collect();
    format!("[{}]", numbers.join(", "))
}
