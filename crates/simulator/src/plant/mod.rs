//! The arm as a plant: torques in, motion out.
//!
//! M(q) q̈ + C(q, q̇) q̇ + g(q) = τ + Jᵀ f − d(q̇) q̇, with f the plate's force on the sponge and d the friction
//! ([`friction`]). Torque limits cut τ.
//!
//! | concept | file |
//! | --- | --- |
//! | state | `state.rs` |
//! | viscous and Coulomb friction | `friction.rs` |
//! | torque limits | `limits.rs` |
//! | one step of semi-implicit Euler; of Runge and Kutta | `euler.rs`, `rk4.rs` |

mod euler;
pub mod friction;
mod limits;
mod rk4;
mod state;

pub use friction::Friction;
pub use limits::TorqueLimits;
pub use state::PlantState;

use crate::dynamics::DynamicsModel;
use platewash_kinematics::{JointLimits, JointVector};
use platewash_planner::scenario::{Integrator, PlantSection};

/// An arm that torques move.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// Its rigid bodies.
    pub model: DynamicsModel,
    /// Friction in the joints.
    pub friction: Friction,
    /// What the motors give at most.
    pub limits: TorqueLimits,
    /// How the motion is integrated.
    pub integrator: Integrator,
}

impl Plant {
    /// The plant that a `[plant]` section describes; `limits` are those of the arm's description, whose known efforts are
    /// the torque limits where the section gives none.
    #[must_use]
    pub fn new(model: DynamicsModel, limits: &JointLimits, section: &PlantSection) -> Self {
        Self {
            model,
            friction: Friction {
                viscous_n_m_s: section.viscous_friction_n_m_s.into(),
                coulomb_n_m: section.coulomb_friction_n_m.into(),
            },
            limits: TorqueLimits::new(section, limits),
            integrator: section.integrator,
        }
    }

    /// A plant without friction and limits.
    #[must_use]
    pub fn ideal(model: DynamicsModel, integrator: Integrator) -> Self {
        Self {
            model,
            friction: Friction::default(),
            limits: TorqueLimits::default(),
            integrator,
        }
    }

    /// The state `h` \[s\] later under constant joint torques \[N·m\], which are not limited here, and the acceleration over
    /// the step (semi-implicit Euler) or at its start (Runge–Kutta) \[rad/s²\].
    #[must_use]
    pub fn step(&self, state: &PlantState, torque: &JointVector, h: f64) -> (PlantState, JointVector) {
        match self.integrator {
            Integrator::SemiImplicitEuler => euler::step(self, state, torque, h),
            Integrator::Rk4 => rk4::step(state, h, |state| self.acceleration(state, torque)),
        }
    }

    /// Acceleration under joint torques and friction \[rad/s²\].
    #[must_use]
    pub fn acceleration(&self, state: &PlantState, torque: &JointVector) -> JointVector {
        let net = torque - self.friction.torque(&state.qd);
        self.model.forward_dynamics(&state.q, &state.qd, &net)
    }
}
