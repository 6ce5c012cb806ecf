//! The tool as a body.

use super::body::{RigidBody, symmetric};
use nalgebra::{Matrix3, Vector3};
use platewash_workcell::tool::Tool;

impl RigidBody {
    /// The tool of a scenario in the mounting frame, z along the tool, origin at the flange; `None` without a tool body or
    /// without mass.
    ///
    /// Unless the scenario says otherwise it is a uniform cylinder of the handle's radius r over the whole length l:
    /// c = l/2, I = m diag(3r² + l², 3r² + l², 6r²)/12.
    #[must_use]
    pub fn tool(tool: &Tool) -> Option<Self> {
        let (m, l, r) = (tool.mass_kg, tool.length_m, tool.radius_m);
        if l == 0.0 || m == 0.0 {
            return None;
        }
        let across = m * (3.0 * r * r + l * l) / 12.0;
        let cylinder = Matrix3::from_diagonal(&Vector3::new(across, across, 0.5 * m * r * r));
        Some(Self {
            mass_kg: m,
            com_m: Vector3::new(0.0, 0.0, tool.com_m.unwrap_or(0.5 * l)),
            inertia_kg_m2: tool.inertia_kg_m2.as_ref().map_or(cylinder, symmetric),
        })
    }
}
