//! Plates that share a place, with each other or with the arm's base.

use super::terms::JobTerms;
use crate::clearance::gap_of_plates;
use crate::layout::base_footprint;
use platewash_kinematics::RobotModel;
use platewash_kinematics::words::not_as_zero;
use std::fmt;

/// Plates that overlap by less than this touch: the rounding of places \[m\].
const PLACE_M: f64 = 1e-9;

/// A plate that shares its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateOverlap {
    /// The plate.
    pub plate: usize,
    /// The other plate; `None` for the arm's base.
    pub other: Option<usize>,
    /// How far they would have to be moved apart \[m\].
    pub by_m: f64,
}

impl JobTerms {
    /// The plates that lie over the base's footprint, then those that share a place with another: what
    /// [`Overlap::Fail`](super::Overlap::Fail) allows none of. Plates that stand at an angle and reach into the base are told by
    /// [`JobTerms::standing_overlaps`].
    #[must_use]
    pub fn plate_overlaps(&self, arm: &RobotModel) -> Vec<PlateOverlap> {
        let seen = self.seen_from_base();
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
}

impl fmt::Display for PlateOverlap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (plate, mm) = (self.plate, not_as_zero(1e3 * self.by_m, 1));
        match self.other {
            Some(other) => write!(f, "plate {plate} and plate {other} overlap by {mm} mm"),
            None => write!(f, "plate {plate} overlaps the robot's base by {mm} mm"),
        }
    }
}
