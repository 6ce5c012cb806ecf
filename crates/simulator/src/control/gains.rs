//! Gains of the torque laws.

use crate::dynamics::DynamicsModel;
use platewash_kinematics::{JointLimits, JointVector};
use platewash_workcell::simulation::ControlSettings;

/// Proportional and derivative gains, joint by joint: \[N·m/rad\] and \[N·m·s/rad\], or \[1/s²\] and \[1/s\] for computed
/// torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Kp.
    pub kp: JointVector,
    /// Kd.
    pub kd: JointVector,
}

/// What gains multiply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loop {
    /// Torques: `pd` and `pd_gravity`.
    Torque,
    /// Accelerations: `computed_torque`.
    Acceleration,
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

    /// Those of the settings: given outright, or from frequency and damping with M each joint's largest inertia within the limits, 1
    /// where they multiply accelerations.
    #[must_use]
    pub fn new(settings: &ControlSettings, of: Loop, model: &DynamicsModel, limits: &JointLimits) -> Self {
        if let (Some(kp), Some(kd)) = (settings.joint_kp, settings.joint_kd) {
            return Self {
                kp: kp.into(),
                kd: kd.into(),
            };
        }
        let inertia = match of {
            Loop::Acceleration => JointVector::repeat(1.0),
            Loop::Torque => model.largest_inertias(limits),
        };
        Self::of_frequency(&inertia, settings.frequency_rad_s, settings.damping_ratio)
    }
}
