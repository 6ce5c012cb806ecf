//! What the arm holds.

use super::body::{Body, Pose};
use platewash_workcell::tool;
use serde::Serialize;

/// A tool, flange frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tool {
    /// All bodies but the sponge; none where the arm holds nothing, and the sponge is only thought.
    pub bodies: Vec<Body>,
    /// The sponge.
    pub sponge: Sponge,
    /// `T_flange_tip`: the centre of the sponge's far face, z out of the tool.
    pub tip: Pose,
}

/// A sponge: a cylinder along z.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sponge {
    /// Radius \[m\].
    pub radius_m: f64,
    /// Height, free \[m\].
    pub height_m: f64,
    /// How far it is pressed in while it washes \[m\].
    pub compression_m: f64,
    /// `T_flange_sponge`: its middle.
    pub pose: Pose,
}

impl From<&tool::Tool> for Tool {
    fn from(tool: &tool::Tool) -> Self {
        let bodies = tool.bodies.iter();
        Self {
            bodies: bodies
                .map(|body| Body::plain(&body.name, (&body.shape).into(), &body.pose))
                .collect(),
            sponge: Sponge {
                radius_m: tool.sponge.radius_m,
                height_m: tool.sponge.height_m,
                compression_m: tool.sponge.compression_m,
                pose: (&tool.sponge.pose).into(),
            },
            tip: (&tool.tip).into(),
        }
    }
}
