//! Proportional–derivative control of independent joints.

use super::gains::Gains;
use super::law::{Command, ControlLaw, Reference};
use crate::plant::PlantState;
use platewash_workcell::simulation::FeedForward;

/// τ = Kp e + Kd ė with e = q_d − q. Nothing holds the arm up: where it rests, Kp e = g(q).
#[derive(Debug, Clone, PartialEq)]
pub struct Pd {
    /// Gains \[N·m/rad, N·m·s/rad\].
    pub gains: Gains,
    /// Whether ė is that of the error or of the arm alone.
    pub feed_forward: FeedForward,
}

impl ControlLaw for Pd {
    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command {
        let (position, speed) = reference.errors(state, self.feed_forward);
        Command::Torque(self.gains.kp.component_mul(&position) + self.gains.kd.component_mul(&speed))
    }
}
