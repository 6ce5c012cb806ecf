//! Plates keep apart from each other and from the base, obstacles from both.

use crate::check::{Check, Discrepancy};
use crate::face::{PLACE_M, gap};
use crate::requirement::Requirement;
use crate::subject::Subject;
use platewash_workcell::clearance::{ClearanceError, gap_of_plates};
use platewash_workcell::job::Overlap;
use platewash_workcell::layout::base_footprint;
use platewash_workcell::plate::Plate;
use platewash_workcell::words::millimetres;
use platewash_workcell::workcell::ObstacleShape;

/// No two plates share a place and none that lies level lies over the base's footprint; findings alone where the job only wants to be told.
/// No obstacle reaches into a plate that it does not hold, or into the base; of floors [`crate::statements::plates`] tells.
///
/// # Errors
/// [`ClearanceError`] for a shape that is none.
pub(crate) fn check(subject: &Subject<'_>) -> Result<Check, ClearanceError> {
    let plates = subject.plates();
    let mut wrong = Vec::new();
    let base = base_footprint(subject.robot);
    let level = Plate::level_disc([0.0; 3], 1.0, 1.0);
    for (i, plate) in plates.iter().enumerate().filter(|(_, plate)| plate.is_parallel(&level)) {
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
            let gap = between(subject, &plates[a], &plates[b]);
            if gap < -PLACE_M {
                let what = format!("gap between plate {a} and plate {b}");
                wrong.push(Discrepancy::new(what, millimetres(gap), "none below 0"));
            }
        }
    }
    let obstacles = &subject.job.workcell.obstacles;
    let is_floor = |name: &str| {
        obstacles
            .iter()
            .any(|o| o.name == name && o.shape == ObstacleShape::HalfSpace)
    };
    let mut reaching = subject.job.standing_overlaps(subject.robot)?;
    reaching.retain(|found| !(is_floor(&found.obstacle) && found.other.starts_with("plate ")));
    let reaches = !reaching.is_empty();
    wrong.extend(reaching.into_iter().map(|found| {
        let what = format!("how far obstacle {:?} reaches into {:?}", found.obstacle, found.other);
        Discrepancy::new(
            what,
            millimetres(found.by_m),
            "not at all, but for plates that it holds",
        )
    }));
    // That plates overlap may be waived, that something stands in them is not.
    let waives = subject.job.requirements.overlap == Overlap::Report && !reaches;
    Ok(Check::stated(Requirement::PlatesApart, wrong).waived_if(waives))
}

/// How far two plates are apart \[m\]: those that are parallel seen along their axis, where neither lies over the other; all others by
/// their bodies, and no deeper than their distance tells.
fn between(subject: &Subject<'_>, a: &Plate, b: &Plate) -> f64 {
    if a.is_over(b) || b.is_over(a) || a.is_back_of(b) {
        return 0.0;
    }
    let seen_m = gap(a, b);
    if a.is_parallel(b) {
        return seen_m;
    }
    gap_of_plates(subject.robot, a, b)
}
