//! What the arm must keep clear of.

use platewash_kinematics::JointVector;
use platewash_workcell::clearance::{ClearanceModel, PairClearance};
use std::fmt::Debug;

/// What the arm is doing at a configuration: decides which bodies may be near each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stretch {
    /// It washes a plate or is on the line over one, by its index: the sponge may be near that one, and near those whose rims it may
    /// touch meanwhile.
    AtPlate(usize),
    /// Anything else.
    Free,
}

impl Stretch {
    /// What planning keeps beyond the clearance asked for, as it looks at a motion in steps: these are short at a plate \[m\].
    #[must_use]
    pub fn reserve_m(self) -> f64 {
        match self {
            Self::AtPlate(_) => 5e-4,
            Self::Free => 1e-3,
        }
    }
}

/// What the arm must keep clear of.
pub trait Surroundings: Debug + Sync {
    /// Whether at `q` \[rad\] every pair that counts keeps `required_m`.
    fn is_clear(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> bool;

    /// The nearest of the pairs that do not; `None` where there is none.
    fn too_near(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> Option<PairClearance>;

    /// Whether the body of that name stands around the arm: it is not of the arm, its tool or the plates.
    fn is_obstacle(&self, _name: &str) -> bool {
        false
    }
}

impl Surroundings for ClearanceModel {
    fn is_clear(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> bool {
        match stretch {
            Stretch::AtPlate(plate) => self.keeps_washing(q, plate, required_m),
            Stretch::Free => self.keeps(q, required_m),
        }
    }

    fn too_near(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> Option<PairClearance> {
        match stretch {
            Stretch::AtPlate(plate) => self.nearest_washing(q, plate, required_m),
            Stretch::Free => ClearanceModel::too_near(self, q, &[], required_m).into_iter().next(),
        }
    }

    fn is_obstacle(&self, name: &str) -> bool {
        ClearanceModel::is_obstacle(self, name)
    }
}
