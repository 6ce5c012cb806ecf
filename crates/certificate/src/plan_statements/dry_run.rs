//! Checks of a dry run: its plates are raised, and the real ones stand below them as obstacles.
//!
//! Requirement 4 of `docs/certificate.md`.
//!
//! The real plates are checked like those of a washing: they must not reach into the floor, an obstacle, each other or the base. The
//! clearance check covers them, as it covers any obstacle. The name of the parent plan is stated and not judged: comparing takes the other
//! plan.

use crate::judged_job::JudgedJob;
use crate::plan_statements::plates;
use crate::report::check::{Check, Discrepancy};
use crate::report::requirement::Requirement;
use crate::washing::face::PLACE_M;
use nalgebra::Vector3;
use platewash_bodies::clearance::ClearanceError;
use platewash_workcell::Obstacle;
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::words::{millimetres, plate_name};

/// Checks that every plate of a dry run has its real one below it, and that the real plates have valid places. Returns `None` where the job
/// is no dry run.
///
/// # Errors
/// [`ClearanceError`] for a shape that is none.
pub(crate) fn check(judged: &JudgedJob<'_>) -> Result<Option<Check>, ClearanceError> {
    let Some(dry_run) = &judged.job.dry_run else {
        return Ok(None);
    };
    let obstacles = &judged.job.workcell.obstacles;
    let plates = judged.plates().iter().enumerate();
    let mut wrong: Vec<_> = plates
        .filter_map(|(i, plate)| missing(dry_run, obstacles, i, plate))
        .collect();
    if !dry_run.names_a_hash() {
        let stated = format!("{:?}", dry_run.parent);
        wrong.push(Discrepancy::new("dry_run.parent", stated, "the hash of a plan"));
    }
    wrong.extend(misplaced(judged, dry_run)?);
    Ok(Some(Check::stated(Requirement::DryRun, wrong)))
}

/// Finds real plates at places that are taken: in the floor, in an obstacle, in each other or in the base.
fn misplaced(judged: &JudgedJob<'_>, dry_run: &DryRun) -> Result<Vec<Discrepancy>, ClearanceError> {
    let job = judged.job;
    let plates: Vec<_> = job.plates.iter().map(|plate| dry_run.lowered(plate)).collect();
    let mut workcell = job.workcell.clone();
    let real_names: Vec<_> = (0..plates.len()).map(DryRun::real_name).collect();
    workcell
        .obstacles
        .retain(|obstacle| !real_names.contains(&obstacle.name));
    let washing = JobTerms {
        workcell,
        plates,
        dry_run: None,
        ..job.clone()
    };
    let washing = JudgedJob::new(&washing, judged.robot, Vec::new());
    let checks = [plates::plates(&washing), plates::plates_apart(&washing)?];
    let broken = checks.into_iter().filter(|check| !check.status.is_kept());
    let of_real = |wrong: Discrepancy| Discrepancy {
        what: format!("real plates: {}", wrong.what),
        ..wrong
    };
    Ok(broken.flat_map(|check| check.discrepancies).map(of_real).collect())
}

/// Returns the error of the real plate below a raised one, if there is any.
fn missing(dry_run: &DryRun, obstacles: &[Obstacle], index: usize, plate: &Plate) -> Option<Discrepancy> {
    let name = DryRun::real_name(index);
    let expected = DryRun::plate_as_obstacle(index, &dry_run.lowered(plate));
    let below = millimetres(dry_run.height_m);
    let Some(found) = obstacles.iter().find(|obstacle| obstacle.name == name) else {
        let words = format!("{} itself, {below} below where it is raised to", plate_name(index));
        return Some(Discrepancy::new(format!("obstacle {name:?}"), "not stated", words));
    };
    let off_m = (found.pose.translation.vector - expected.pose.translation.vector).norm();
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
    let words = format!("{}, {below} lower, {:?}", plate_name(index), expected.shape);
    Some(Discrepancy::new(format!("obstacle {name:?}"), stated, words))
}
