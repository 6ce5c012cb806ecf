//! An arm that torques move: friction, torque limits, and the steps of two integrators, semi-implicit Euler and the
//! classical Runge–Kutta scheme (Kutta 1901).
//!
//! With d = d(q̇) taken at the start of the step and friction at its end, (M + h diag(d)) q̈ = τ − C q̇ − g − d q̇; then
//! q̇ += h q̈, q += h q̇. Symplectic without friction; friction alone never turns a joint round, however stiff it is.
//!
//! τ_f = (b + c / max(|q̇|, v₀)) q̇: the Coulomb torque c is constant above the speed v₀ and in proportion to it below, where
//! a joint that should stick creeps at less than v₀.

use crate::dynamics::DynamicsModel;
use crate::plant::foam::FoamLoad;
use crate::plant::sponge::SpongeOnPlates;
use crate::plant::state::PlantState;
use platewash_kinematics::{AXES, JointLimits, JointVector};
use platewash_workcell::simulation::{Integrator, PlantSettings};

/// An arm that torques move.
#[derive(Debug, Clone, PartialEq)]
pub struct Plant {
    /// Its rigid bodies.
    pub model: DynamicsModel,
    /// Friction in the joints.
    pub friction: Friction,
    /// Torque limits of the motors.
    pub limits: TorqueLimits,
    /// Integrator of the motion.
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
        self.step_under(state, h, |_| *torque)
    }

    fn step_under(
        &self,
        state: &PlantState,
        h: f64,
        torque: impl Fn(&PlantState) -> JointVector,
    ) -> (PlantState, JointVector) {
        match self.integrator {
            Integrator::SemiImplicitEuler => euler_step(&self.model, &self.friction, state, &torque(state), h),
            Integrator::Rk4 => rk4_step(state, h, |at| self.acceleration(at, &torque(at))),
        }
    }

    /// Steps as [`Self::step`], with plates that push a sponge: with their effect at the start of the step (semi-implicit Euler),
    /// or at every state that the step evaluates (Runge–Kutta). Also returns the load on the foam at the start.
    #[must_use]
    pub fn step_on(
        &self,
        sponge: &SpongeOnPlates,
        state: &PlantState,
        torque: &JointVector,
        h: f64,
    ) -> (PlantState, JointVector, FoamLoad) {
        let first = sponge.push(&self.model, state);
        let push = |at: &PlantState| {
            if at == state {
                first
            } else {
                sponge.push(&self.model, at)
            }
        };
        let (next, qdd) = self.step_under(state, h, |at| torque + push(at).torque);
        (next, qdd, first.load)
    }

    /// Acceleration under joint torques and friction \[rad/s²\].
    #[must_use]
    pub fn acceleration(&self, state: &PlantState, torque: &JointVector) -> JointVector {
        let net = torque - self.friction.torque(&state.qd);
        self.model.forward_dynamics(&state.q, &state.qd, &net)
    }
}

#[inline]
pub(crate) fn euler_step(
    model: &DynamicsModel,
    friction: &Friction,
    state: &PlantState,
    torque: &JointVector,
    h: f64,
) -> (PlantState, JointVector) {
    let d = friction.coefficient(&state.qd);
    let net = torque - d.component_mul(&state.qd);
    let qdd = model.forward_dynamics_with(&state.q, &state.qd, &net, &(d * h));
    let qd = state.qd + qdd * h;
    let q = state.q + qd * h;
    (PlantState { q, qd }, qdd)
}

/// The state `h` \[s\] later, and the acceleration at the start.
#[inline]
pub(crate) fn rk4_step(
    state: &PlantState,
    h: f64,
    acceleration: impl Fn(&PlantState) -> JointVector,
) -> (PlantState, JointVector) {
    let ahead = |qd: &JointVector, qdd: &JointVector, by: f64| PlantState {
        q: state.q + qd * by,
        qd: state.qd + qdd * by,
    };
    let a1 = acceleration(state);
    let second = ahead(&state.qd, &a1, 0.5 * h);
    let a2 = acceleration(&second);
    let third = ahead(&second.qd, &a2, 0.5 * h);
    let a3 = acceleration(&third);
    let fourth = ahead(&third.qd, &a3, h);
    let a4 = acceleration(&fourth);
    let mean =
        |k1: &JointVector, k2: &JointVector, k3: &JointVector, k4: &JointVector| (k1 + (k2 + k3) * 2.0 + k4) / 6.0;
    let speed = mean(&state.qd, &second.qd, &third.qd, &fourth.qd);
    (ahead(&speed, &mean(&a1, &a2, &a3, &a4), h), a1)
}

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

/// Torque limits, joint by joint \[N·m\]; `None` where none is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TorqueLimits(pub [Option<f64>; AXES]);

impl TorqueLimits {
    /// Limits of the settings, otherwise those of the arm's description.
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
