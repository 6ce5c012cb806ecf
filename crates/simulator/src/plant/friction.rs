//! Viscous and Coulomb friction.
//!
//! τ_f = (b + c / max(|q̇|, v₀)) q̇: the Coulomb torque c is constant above the speed v₀ and in proportion to it below, where
//! a joint that should stick creeps at less than v₀.

use platewash_kinematics::JointVector;

/// Speed below which Coulomb friction is in proportion to speed \[rad/s\].
pub const CREEP_RAD_S: f64 = 0.005;

/// Friction in the joints; none by default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Friction {
    /// b \[N·m·s/rad\], not negative.
    pub viscous_n_m_s: JointVector,
    /// c \[N·m\], not negative.
    pub coulomb_n_m: JointVector,
}

impl Friction {
    /// d(q̇) \[N·m·s/rad\]: friction torque divided by speed.
    #[inline]
    #[must_use]
    pub fn coefficient(&self, qd: &JointVector) -> JointVector {
        self.viscous_n_m_s + self.coulomb_n_m.zip_map(qd, |c, v| c / v.abs().max(CREEP_RAD_S))
    }

    /// The torque that resists speeds `qd` \[rad/s\], with their sign \[N·m\].
    #[inline]
    #[must_use]
    pub fn torque(&self, qd: &JointVector) -> JointVector {
        self.coefficient(qd).component_mul(qd)
    }

    /// The largest coefficient, that of joints at rest \[N·m·s/rad\].
    #[must_use]
    pub fn largest(&self) -> JointVector {
        self.coefficient(&JointVector::zeros())
    }
}
