//! Gains of the torque laws.

use crate::dynamics::DynamicsModel;
use platewash_kinematics::{JointLimits, JointVector};
use platewash_planner::scenario::{ControlLawName, ControlSection};

/// Proportional and derivative gains, joint by joint: \[N·m/rad\] and \[N·m·s/rad\], or \[1/s²\] and \[1/s\] for computed
/// torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Kp.
    pub kp: JointVector,
    /// Kd.
    pub kd: JointVector,
}

impl Gains {
    /// Kp = M ω², Kd = 2 ζ ω M: a joint of inertia M alone is then a second-order system of natural frequency ω \[rad/s\] and
    /// damping ratio ζ.
    #[must_use]
    pub fn of_frequency(inertia_kg_m2: &JointVector, frequency_rad_s: f64, damping_ratio: f64) -> Self {
        Self {
            kp: inertia_kg_m2 * (frequency_rad_s * frequency_rad_s),
            kd: inertia_kg_m2 * (2.0 * damping_ratio * frequency_rad_s),
        }
    }

    /// Those of a `[control]` section: given outright, or from frequency and damping with M each joint's largest inertia
    /// within the limits, 1 for computed torque.
    #[must_use]
    pub fn new(section: &ControlSection, law: ControlLawName, model: &DynamicsModel, limits: &JointLimits) -> Self {
        if let (Some(kp), Some(kd)) = (section.joint_kp, section.joint_kd) {
            return Self {
                kp: kp.into(),
                kd: kd.into(),
            };
        }
        let inertia = match law {
            ControlLawName::ComputedTorque => JointVector::repeat(1.0),
            _ => model.largest_inertias(limits),
        };
        Self::of_frequency(&inertia, section.frequency_rad_s, section.damping_ratio)
    }
}
