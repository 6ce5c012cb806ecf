//! State of the plant.

use platewash_kinematics::JointVector;

/// Positions and speeds of the joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlantState {
    /// Positions \[rad\].
    pub q: JointVector,
    /// Speeds \[rad/s\].
    pub qd: JointVector,
}

impl PlantState {
    /// At rest at `q` \[rad\].
    #[must_use]
    pub fn at_rest(q: JointVector) -> Self {
        Self {
            q,
            qd: JointVector::zeros(),
        }
    }
}
