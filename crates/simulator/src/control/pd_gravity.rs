//! Proportional–derivative control with gravity compensation.

use super::gains::Gains;
use super::law::{Command, ControlLaw, Reference};
use crate::dynamics::DynamicsModel;
use crate::plant::PlantState;
use platewash_workcell::simulation::FeedForward;

/// τ = Kp e + Kd ė + g(q): at rest the error is zero (Takegaki, Arimoto, *J. Dyn. Sys. Meas. Control* 103, 1981); moving, it
/// is what accelerations need, about q̈_d/ω².
#[derive(Debug, Clone, PartialEq)]
pub struct PdGravity<'a> {
    /// The arm as the law believes it to be.
    pub model: &'a DynamicsModel,
    /// Gains \[N·m/rad, N·m·s/rad\].
    pub gains: Gains,
    /// Whether ė is that of the error or of the arm alone.
    pub feed_forward: FeedForward,
}

impl ControlLaw for PdGravity<'_> {
    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command {
        let (position, speed) = reference.errors(state, self.feed_forward);
        let correction = self.gains.kp.component_mul(&position) + self.gains.kd.component_mul(&speed);
        Command::Torque(self.model.gravity_torque(&state.q) + correction)
    }
}
