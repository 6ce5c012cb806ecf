//! A perfect servo.

use super::law::{Command, ControlLaw, Reference};
use crate::plant::PlantState;

/// The commanded configuration is taken at once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExactLaw;

impl ControlLaw for ExactLaw {
    fn command(&mut self, reference: &Reference, _state: &PlantState) -> Command {
        Command::Position(reference.next.q)
    }
}
