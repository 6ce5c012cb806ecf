//! What the motors give at most.

use platewash_kinematics::{AXES, JointLimits, JointVector};
use platewash_workcell::simulation::PlantSettings;

/// Torque limits, joint by joint \[N·m\]; `None` where none is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TorqueLimits(pub [Option<f64>; AXES]);

impl TorqueLimits {
    /// Those of the settings, otherwise those of the arm's description.
    #[must_use]
    pub fn new(settings: &PlantSettings, limits: &JointLimits) -> Self {
        Self(settings.torque_limit_n_m.map_or(limits.effort, |given| given.map(Some)))
    }

    /// The torques \[N·m\], cut to the limits.
    #[inline]
    #[must_use]
    pub fn cut(&self, torque: &JointVector) -> JointVector {
        JointVector::from_fn(|joint, _| match self.0[joint] {
            // Unlike `clamp`, which panics for a limit that is NaN.
            Some(most) => torque[joint].min(most).max(-most),
            None => torque[joint],
        })
    }

    /// Largest share of its limit that each joint takes at `torque` \[N·m\]; `None` where no limit is known.
    #[must_use]
    pub fn shares(&self, torque: &JointVector) -> [Option<f64>; AXES] {
        std::array::from_fn(|joint| self.0[joint].map(|most| torque[joint].abs() / most))
    }
}
