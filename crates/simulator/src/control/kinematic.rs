//! Laws without a plant: those of the planner, which move positions.

use super::{Command, ControlLaw, Reference};
use crate::plant::PlantState;
use platewash_planner::control::ControlLaw as WaypointLaw;
use std::fmt;

/// A law of the planner, stepped once a sample towards the next sample's configuration, as the paper's program steps towards
/// the next waypoint.
pub struct Kinematic(pub Box<dyn WaypointLaw>);

impl fmt::Debug for Kinematic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Kinematic")
    }
}

impl ControlLaw for Kinematic {
    fn begin_segment(&mut self) {
        self.0.begin_segment();
    }

    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command {
        Command::Position(self.0.step(&reference.next.q, &state.q))
    }
}
