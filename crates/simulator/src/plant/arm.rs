//! An arm that torques move.

use super::felt::Felt;
use super::friction::Friction;
use super::limits::TorqueLimits;
use super::sponge::{Push, SpongeOnPlates};
use super::state::PlantState;
use super::{euler, rk4};
use crate::dynamics::DynamicsModel;
use platewash_kinematics::{JointLimits, JointVector};
use platewash_workcell::simulation::{Integrator, PlantSettings};

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
    /// The plant that the settings describe; `limits` are those of the arm's description, whose known efforts are
    /// the torque limits where the settings give none.
    #[must_use]
    pub fn new(model: DynamicsModel, limits: &JointLimits, settings: &PlantSettings) -> Self {
        Self {
            model,
            friction: Friction {
                viscous_n_m_s: settings.viscous_friction_n_m_s.into(),
                coulomb_n_m: settings.coulomb_friction_n_m.into(),
            },
            limits: TorqueLimits::new(settings, limits),
            integrator: settings.integrator,
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
            Integrator::SemiImplicitEuler => euler::step((&self.model, &self.friction), state, torque, h),
            Integrator::Rk4 => rk4::step(state, h, |state| self.acceleration(state, torque)),
        }
    }

    /// As [`Self::step`], with plates that push a sponge: as they do at the start of the step (semi-implicit Euler), or at every state that
    /// the step looks at (Runge–Kutta). Also what the foam feels at the start.
    #[must_use]
    pub fn step_on(
        &self,
        sponge: &SpongeOnPlates,
        state: &PlantState,
        torque: &JointVector,
        h: f64,
    ) -> (PlantState, JointVector, Felt) {
        let first = sponge.push(&self.model, state);
        let pushed = |push: &Push| torque + push.torque;
        let (next, qdd) = match self.integrator {
            Integrator::SemiImplicitEuler => euler::step((&self.model, &self.friction), state, &pushed(&first), h),
            Integrator::Rk4 => rk4::step(state, h, |at| {
                let push = if at == state {
                    first
                } else {
                    sponge.push(&self.model, at)
                };
                self.acceleration(at, &pushed(&push))
            }),
        };
        (next, qdd, first.felt)
    }

    /// Acceleration under joint torques and friction \[rad/s²\].
    #[must_use]
    pub fn acceleration(&self, state: &PlantState, torque: &JointVector) -> JointVector {
        let net = torque - self.friction.torque(&state.qd);
        self.model.forward_dynamics(&state.q, &state.qd, &net)
    }
}
