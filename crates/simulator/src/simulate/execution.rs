//! The executed motion, sample by sample.

use crate::plant::{Felt, PlantState, TorqueLimits};
use platewash_kinematics::JointVector;

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// When \[s\].
    pub t_s: f64,
    /// Index of the plan's segment.
    pub segment: usize,
    /// Positions that the plan asks for \[rad\].
    pub commanded: JointVector,
    /// Where the arm is.
    pub state: PlantState,
    /// Acceleration over the step that follows \[rad/s²\].
    pub qdd: JointVector,
    /// Torques held until the next sample, within the limits \[N·m\]; zeros under a kinematic law.
    pub torque: JointVector,
    /// What the sponge's foam feels; `None` where it is not simulated.
    pub felt: Option<Felt>,
}

/// What the arm did.
#[derive(Debug, Clone, PartialEq)]
pub struct Execution {
    /// Time between samples \[s\].
    pub period_s: f64,
    /// Samples in time order, the first one at 0 s, on the path and at its speed.
    pub samples: Vec<Sample>,
    /// Torque limits of the plant; `None` under a kinematic law.
    pub limits: Option<TorqueLimits>,
    /// Samples at which a torque limit cut what the law asked for.
    pub saturated: usize,
}
