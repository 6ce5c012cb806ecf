//! Check that the bodies of a job can be where they are: those that stand do not overlap, and no two that move are too near each other at
//! every configuration.

use crate::clearance::{ClearanceError, FixedOverlap, gap_of_plates, standing_overlaps, still_pairs};
use crate::job::error::JobError;
use platewash_kinematics::RobotModel;
use platewash_kinematics::words::nonzero_decimals;
use platewash_workcell::job::JobTerms;
use platewash_workcell::layout::base_footprint;
use platewash_workcell::words::plate_name;
use std::fmt;

/// Finds obstacles of a job that reach into its plates or the base of the arm, and plates that reach into the base: see
/// [`standing_overlaps`].
///
/// # Errors
/// [`ClearanceError`] for an invalid shape.
pub fn overlaps_of_fixed_bodies(job: &JobTerms, arm: &RobotModel) -> Result<Vec<FixedOverlap>, ClearanceError> {
    let seen = job.seen_from_base();
    standing_overlaps(arm, &seen.workcell, &seen.plates, seen.dry_run.as_ref())
}

/// Checks that the bodies of a job can be where they are at all: that none of those that stand overlap, and that the moving ones whose
/// distance no joint changes keep the required clearance.
///
/// # Errors
/// [`JobError::Standing`], [`JobError::StillNear`]; [`ClearanceError`] for an invalid shape.
pub fn check_standing(job: &JobTerms, arm: &RobotModel) -> Result<(), JobError> {
    let overlaps = overlaps_of_fixed_bodies(job, arm)?;
    if !overlaps.is_empty() {
        return Err(JobError::Standing(overlaps));
    }
    let required_m = job.requirements.clearance_m;
    let mut pairs = still_pairs(arm, &job.workcell)?;
    pairs.retain(|still| !still.is_clear(required_m));
    if pairs.is_empty() {
        return Ok(());
    }
    Err(JobError::StillNear { pairs, required_m })
}

/// Greatest overlap of plates that counts as touching: the rounding of positions \[m\].
const PLACE_M: f64 = 1e-9;

/// Overlap of a plate with another one or with the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateOverlap {
    /// Index of the plate.
    pub plate: usize,
    /// Index of the other plate; `None` for the arm's base.
    pub other: Option<usize>,
    /// Distance by which they would have to be moved apart \[m\].
    pub by_m: f64,
}

/// Finds the plates of a job that lie over the base's footprint, then those that overlap another one: all the cases that
/// [`Overlap::Fail`](platewash_workcell::job::Overlap::Fail) forbids. Plates that stand at an angle and reach into the base are found by
/// [`overlaps_of_fixed_bodies`].
#[must_use]
pub fn overlaps_of_plates(job: &JobTerms, arm: &RobotModel) -> Vec<PlateOverlap> {
    let seen = job.seen_from_base();
    let (plates, base) = (&seen.plates, base_footprint(arm));
    let shares = |plate: usize, other: Option<usize>, gap_m: f64| {
        let by_m = -gap_m;
        (by_m > PLACE_M).then_some(PlateOverlap { plate, other, by_m })
    };
    let over_base = |(i, plate)| base.gap_m(plate).and_then(|gap_m| shares(i, None, gap_m));
    let mut found: Vec<_> = plates.iter().enumerate().filter_map(over_base).collect();
    for (a, first) in plates.iter().enumerate() {
        for (b, second) in plates.iter().enumerate().skip(a + 1) {
            found.extend(shares(a, Some(b), gap_of_plates(arm, first, second)));
        }
    }
    found
}

impl fmt::Display for PlateOverlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (plate, mm) = (plate_name(self.plate), nonzero_decimals(1e3 * self.by_m, 1));
        match self.other {
            Some(other) => write!(f, "{plate} and {} overlap by {mm} mm", plate_name(other)),
            None => write!(f, "{plate} overlaps the robot's base by {mm} mm"),
        }
    }
}
