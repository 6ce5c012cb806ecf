//! What the arm holds.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Frame, Pose, RobotModel};
use serde::{Deserialize, Serialize};

/// A handle along the z axis of the mounting frame, with a sponge at its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tool {
    /// From the flange to the sponge's far face \[m\]; 0 for no tool body.
    pub length_m: f64,
    /// Radius of the handle \[m\].
    pub radius_m: f64,
    /// Radius of the sponge \[m\]; also decides coverage.
    pub sponge_radius_m: f64,
    /// Height of the sponge \[m\].
    pub sponge_height_m: f64,
    /// How far the sponge is pressed in while it washes \[m\]: the tip may lift as far and still touch. An assumption.
    pub sponge_compression_m: f64,
    /// Mass of the tool body \[kg\]: an assumption.
    pub mass_kg: f64,
    /// Distance of its centre of mass from the flange along its axis \[m\]; without it, half its length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub com_m: Option<f64>,
    /// Its inertia about the centre of mass, ixx, ixy, ixz, iyy, iyz, izz with z along it \[kg·m²\]; without it, that of a
    /// uniform cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 6]>,
}

impl Default for Tool {
    fn default() -> Self {
        Self {
            length_m: 0.0,
            radius_m: 0.02,
            sponge_radius_m: 0.025,
            sponge_height_m: 0.025,
            sponge_compression_m: 0.005,
            mass_kg: 0.3,
            com_m: None,
            inertia_kg_m2: None,
        }
    }
}

/// The frame at the centre of the sponge's far face, z leaving the tool; the mounting frame without a tool body.
#[must_use]
pub fn tip_frame(robot: &RobotModel, tool: &Tool) -> Frame {
    robot.mounting_frame().offset(&Rigid {
        translation: Vector3::new(0.0, 0.0, tool.length_m),
        ..Rigid::identity()
    })
}

/// Pose of the tip at a position, pointing straight down: a half turn about y, which is what the paper's
/// `eul2quat([0, pi/2, 0])` means for MATLAB's `tool0`.
#[must_use]
pub fn tool_down(position: Vector3<f64>) -> Pose {
    // Exact, so that no joint sees the rounding of π: the quaternion (w, x, y, z) = (0, 0, 1, 0).
    let half_turn = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.0, 0.0, 1.0, 0.0));
    Pose::from_parts(position.into(), half_turn)
}
