//! What the arm must keep clear of.

use platewash_kinematics::JointVector;
use platewash_workcell::clearance::{ClearanceModel, PairClearance};
use std::fmt::Debug;

/// What the arm is doing at a configuration: decides which bodies may be near each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stretch {
    /// It washes a plate or is on the line over one: the sponge may be near the plates.
    AtPlate,
    /// Anything else.
    Free,
}

/// What the arm must keep clear of.
pub trait Surroundings: Debug + Sync {
    /// Whether at `q` \[rad\] every pair that counts keeps `required_m`.
    fn is_clear(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> bool;

    /// The nearest of the pairs that do not; `None` where there is none.
    fn too_near(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> Option<PairClearance>;
}

impl Surroundings for ClearanceModel {
    fn is_clear(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> bool {
        match stretch {
            Stretch::AtPlate => self.keeps_washing(q, required_m),
            Stretch::Free => self.keeps(q, required_m),
        }
    }

    fn too_near(&self, q: &JointVector, stretch: Stretch, required_m: f64) -> Option<PairClearance> {
        match stretch {
            Stretch::AtPlate => self.nearest_washing(q, required_m),
            Stretch::Free => ClearanceModel::too_near(self, q, &[], required_m).into_iter().next(),
        }
    }
}
