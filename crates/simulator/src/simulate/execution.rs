//! The executed motion, sample by sample.

use crate::plant::{FoamLoad, PlantState, TorqueLimits};
use platewash_kinematics::JointVector;

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time of the sample \[s\].
    pub t_s: f64,
    /// Index of the plan's segment.
    pub segment: usize,
    /// Positions that the plan asks for \[rad\].
    pub commanded: JointVector,
    /// State of the arm.
    pub state: PlantState,
    /// Acceleration over the step that follows \[rad/s²\].
    pub qdd: JointVector,
    /// Torques held until the next sample, within the limits \[N·m\]; zeros under a kinematic law.
    pub torque: JointVector,
    /// Load on the sponge's foam; `None` where it is not simulated.
    pub load: Option<FoamLoad>,
}

/// Motion that the arm made.
#[derive(Debug, Clone, PartialEq)]
pub struct Execution {
    /// Time between samples \[s\].
    pub period_s: f64,
    /// Samples in time order, the first one at 0 s, on the path and at its speed.
    pub samples: Vec<Sample>,
    /// Torque limits of the plant; `None` under a kinematic law.
    pub limits: Option<TorqueLimits>,
    /// Samples at which a torque limit cut the torque of the law.
    pub saturated: usize,
}
