//! Plates keep apart from each other and from the base, obstacles from both.

use crate::check::{Check, Discrepancy};
use crate::requirement::Requirement;
use crate::subject::Subject;
use platewash_workcell::clearance::{ClearanceError, Standing};
use platewash_workcell::job::{Overlap, PlateOverlap};
use platewash_workcell::words::millimetres;
use platewash_workcell::workcell::ObstacleShape;

/// No two plates share a place, none that lies level lies over the base's footprint and no other one reaches into the base; findings alone where the job only wants to be told.
/// No obstacle reaches into a plate that it does not hold, or into the base; of floors [`crate::statements::plates`] tells.
///
/// # Errors
/// [`ClearanceError`] for a shape that is none.
pub(crate) fn check(subject: &Subject<'_>) -> Result<Check, ClearanceError> {
    let overlaps = subject.job.plate_overlaps(subject.robot);
    let mut wrong: Vec<_> = overlaps.iter().map(discrepancy).collect();
    let obstacles = &subject.job.workcell.obstacles;
    let is_floor = |name: &str| {
        obstacles
            .iter()
            .any(|o| o.name == name && o.shape == ObstacleShape::HalfSpace)
    };
    let mut reaching = subject.job.standing_overlaps(subject.robot)?;
    reaching.retain(|found| match &found.standing {
        Standing::Obstacle(name) => !(is_floor(name) && found.other.starts_with("plate ")),
        Standing::Parts(_) | Standing::Plate(_) => true,
    });
    let reaches = !reaching.is_empty();
    wrong.extend(reaching.into_iter().map(|found| {
        let what = format!("how far {} reaches into {:?}", found.standing, found.other);
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

fn discrepancy(overlap: &PlateOverlap) -> Discrepancy {
    let other = overlap
        .other
        .map_or_else(|| "the base".to_owned(), |other| format!("plate {other}"));
    let what = format!("gap between plate {} and {other}", overlap.plate);
    Discrepancy::new(what, millimetres(-overlap.by_m), "none below 0")
}
