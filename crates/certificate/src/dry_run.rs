//! A dry run is what it says: its plates are raised, and the real ones stand below them as obstacles.
//!
//! That these are kept clear of is the clearance's to prove, as of any obstacle. Which plan the dry run is one of is stated, and not
//! judged: that takes the other plan.

use crate::check::{Check, Discrepancy};
use crate::face::PLACE_M;
use crate::requirement::Requirement;
use crate::subject::Subject;
use nalgebra::Vector3;
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::plate::Plate;
use platewash_workcell::words::millimetres;
use platewash_workcell::workcell::Obstacle;

/// Every plate of a dry run has its real one below it; `None` where the job is no dry run.
pub(crate) fn check(subject: &Subject<'_>) -> Option<Check> {
    let dry_run = subject.job.dry_run.as_ref()?;
    let obstacles = &subject.job.workcell.obstacles;
    let plates = subject.plates().iter().enumerate();
    let mut wrong: Vec<_> = plates
        .filter_map(|(i, plate)| missing(dry_run, obstacles, i, plate))
        .collect();
    if !dry_run.names_a_hash() {
        let stated = format!("{:?}", dry_run.parent);
        wrong.push(Discrepancy::new("dry_run.parent", stated, "the hash of a plan"));
    }
    Some(Check::stated(Requirement::DryRun, wrong))
}

/// What is wrong with the real plate below a raised one.
fn missing(dry_run: &DryRun, obstacles: &[Obstacle], index: usize, plate: &Plate) -> Option<Discrepancy> {
    let name = DryRun::real_name(index);
    let lowered = -plate.axis() * dry_run.height_m;
    let expected = DryRun::standing(index, plate);
    let place = expected.pose.translation.vector + lowered;
    let below = millimetres(dry_run.height_m);
    let Some(found) = obstacles.iter().find(|obstacle| obstacle.name == name) else {
        let words = format!("plate {index} itself, {below} below where it is raised to");
        return Some(Discrepancy::new(format!("obstacle {name:?}"), "not stated", words));
    };
    let off_m = (found.pose.translation.vector - place).norm();
    let axis = found.pose.rotation * Vector3::z();
    let turned = (axis - plate.axis()).norm();
    if found.shape == expected.shape && off_m <= PLACE_M && turned <= PLACE_M {
        return None;
    }
    let stated = format!(
        "{} from it, turned by {turned:.3} rad, {:?}",
        millimetres(off_m),
        found.shape
    );
    let words = format!("plate {index}, {below} lower, {:?}", expected.shape);
    Some(Discrepancy::new(format!("obstacle {name:?}"), stated, words))
}
