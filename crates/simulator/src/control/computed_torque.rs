//! Computed torque: the arm's own model makes every joint a double integrator.

use super::gains::Gains;
use super::law::{Command, ControlLaw, Reference};
use crate::dynamics::DynamicsModel;
use crate::plant::PlantState;
use platewash_workcell::simulation::FeedForward;

/// τ = M(q) (q̈_d + Kd ė + Kp e) + C(q, q̇) q̇ + g(q), one inverse dynamics; then ë + Kd ė + Kp e = 0 (Lynch, Park, *Modern
/// Robotics*, §11.4.2).
#[derive(Debug, Clone, PartialEq)]
pub struct ComputedTorque<'a> {
    /// The arm as the law believes it to be.
    pub model: &'a DynamicsModel,
    /// Gains \[1/s², 1/s\].
    pub gains: Gains,
    /// Whether speeds and accelerations of the commanded motion are used.
    pub feed_forward: FeedForward,
}

impl ControlLaw for ComputedTorque<'_> {
    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command {
        let (position, speed) = reference.errors(state, self.feed_forward);
        let correction = self.gains.kp.component_mul(&position) + self.gains.kd.component_mul(&speed);
        let wanted = match self.feed_forward {
            FeedForward::Velocity => reference.now.qdd + correction,
            FeedForward::None => correction,
        };
        Command::Torque(self.model.inverse_dynamics(&state.q, &state.qd, &wanted))
    }
}
