//! Plates keep apart from each other and from the base.

use crate::check::{Check, Discrepancy};
use crate::face::{PLACE_M, gap};
use crate::requirement::Requirement;
use crate::subject::Subject;
use platewash_workcell::job::Overlap;
use platewash_workcell::layout::base_footprint;
use platewash_workcell::words::millimetres;

/// No two plates overlap and none lies over the base's footprint; findings alone where the job only wants to be told.
pub(crate) fn check(subject: &Subject<'_>) -> Check {
    let plates = subject.plates();
    let mut wrong = Vec::new();
    let base = base_footprint(subject.robot);
    for (i, plate) in plates.iter().enumerate() {
        let beyond = |value: f64, [least, most]: [f64; 2]| (least - value).max(value - most).max(0.0);
        let [x, y] = plate.centre_xy();
        let (dx, dy) = (beyond(x, base.x_m), beyond(y, base.y_m));
        let gap = (dx * dx + dy * dy).sqrt() - plate.rim_m();
        if gap < -PLACE_M {
            let what = format!("gap between plate {i} and the base");
            wrong.push(Discrepancy::new(what, millimetres(gap), "none below 0"));
        }
    }
    for a in 0..plates.len() {
        for b in a + 1..plates.len() {
            let gap = gap(&plates[a], &plates[b]);
            if gap < -PLACE_M {
                let what = format!("gap between plate {a} and plate {b}");
                wrong.push(Discrepancy::new(what, millimetres(gap), "none below 0"));
            }
        }
    }
    let waives = subject.job.requirements.overlap == Overlap::Report;
    Check::stated(Requirement::PlatesApart, wrong).waived_if(waives)
}
