//! The tool as a body.

use super::body::{RigidBody, symmetric};
use nalgebra::Vector3;
use platewash_workcell::tool::ToolMass;

impl From<&ToolMass> for RigidBody {
    fn from(mass: &ToolMass) -> Self {
        Self {
            mass_kg: mass.mass_kg,
            com_m: Vector3::from(mass.com_m),
            inertia_kg_m2: symmetric(&mass.inertia_kg_m2),
        }
    }
}
