//! Tool of an arm: a rigid chain of convex bodies behind its flange, a sponge at the end, and its mass.
//!
//! Poses are in the mounting frame, that of the link that carries the tool: `tool0` unless another is stated, z out of the arm.

use crate::pose;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::atan2;
use platewash_kinematics::{AXES, Frame, Pose, RobotModel, ToolFrame, ToolFrameError};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_1_SQRT_2;
use ts_rs::TS;

/// Greatest overlap of bodies that counts as touching: the rounding of positions \[m\].
const TOUCHING_M: f64 = 1e-9;

/// Tool of an arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Link behind joint 6 that carries the tool, and its axis along which the tool leaves it, as the text of a
    /// [`ToolMount`](platewash_kinematics::tool_mount::ToolMount): `flange:x`, `link_eef` for z; `None` for `tool0`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mounted_on: Option<String>,
    /// Bodies between the flange and the sponge; empty if there is no tool.
    pub bodies: Vec<ToolBody>,
    /// Sponge; it counts as a body if there are others.
    pub sponge: Sponge,
    /// Pose of the tip, `T_flange_tip`: the centre of the sponge's far face, with z out of the tool; the mounting frame without a tool.
    #[serde(with = "pose")]
    #[ts(as = "pose::PoseFields")]
    pub tip: Pose,
    /// Mass of all bodies together; `None` for none.
    pub mass: Option<ToolMass>,
}

/// Body of a tool.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct ToolBody {
    /// Name, for messages.
    pub name: String,
    /// Shape in the body's frame.
    pub shape: Shape,
    /// Pose in the mounting frame, `T_flange_body`.
    #[serde(with = "pose")]
    #[ts(as = "pose::PoseFields")]
    pub pose: Pose,
}

/// Sponge: a cylinder whose height can be compressed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
#[ts(optional_fields)]
pub struct Sponge {
    /// Radius \[m\]. It also determines coverage.
    pub radius_m: f64,
    /// Height while it washes \[m\]: the distance of its holder from the tip.
    pub height_m: f64,
    /// Compression c while it washes \[m\], an assumption. Without load it reaches beyond the tip by as much, with the height
    /// [`Self::free_height_m`]. The tip may lift by as much and the sponge still touches.
    pub compression_m: f64,
    /// Least and greatest stiffness E of an elastic foundation, pressure over strain \[Pa\], an assumption; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_pa: Option<[f64; 2]>,
    /// Pose while it washes, `T_flange_sponge`: its middle, with z along its axis.
    #[serde(with = "pose")]
    #[ts(as = "pose::PoseFields")]
    pub pose: Pose,
}

/// State of a sponge relative to the plate that it washes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touch {
    /// The sponge touches.
    On,
    /// The tip is above the face by more than the sponge's compression.
    Lifted,
    /// The tip is deeper than the sponge is high: its holder would reach into the plate.
    Pressed,
}

/// Mass properties of a tool.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct ToolMass {
    /// Mass \[kg\]: an assumption.
    pub mass_kg: f64,
    /// Centre of mass, mounting frame \[m\].
    pub com_m: [f64; 3],
    /// Inertia about the centre of mass: ixx, ixy, ixz, iyy, iyz, izz \[kg·m²\].
    pub inertia_kg_m2: [f64; 6],
}

/// Straight tool: a round handle along z with a sponge at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightTool {
    /// Distance from the flange to the sponge's far face \[m\]; 0 for no tool.
    pub length_m: f64,
    /// Radius of the handle \[m\].
    pub radius_m: f64,
    /// Radius of the sponge \[m\].
    pub sponge_radius_m: f64,
    /// Height of the sponge \[m\].
    pub sponge_height_m: f64,
    /// Compression of the sponge while it washes \[m\].
    pub sponge_compression_m: f64,
    /// Least and greatest stiffness of the sponge \[Pa\]; `None` if unknown.
    pub sponge_stiffness_pa: Option<[f64; 2]>,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Distance of the centre of mass from the flange \[m\]; `None` for half the length.
    pub com_m: Option<f64>,
    /// Inertia about the centre of mass \[kg·m²\]; `None` for that of a uniform cylinder of the handle's radius over the whole length.
    pub inertia_kg_m2: Option<[f64; 6]>,
}

impl Default for StraightTool {
    /// Returns no tool, and a sponge of 25 mm.
    fn default() -> Self {
        Self {
            length_m: 0.0,
            radius_m: 0.02,
            sponge_radius_m: 0.025,
            sponge_height_m: 0.025,
            sponge_compression_m: 0.005,
            sponge_stiffness_pa: None,
            mass_kg: 0.3,
            com_m: None,
            inertia_kg_m2: None,
        }
    }
}

impl StraightTool {
    fn mass(&self) -> Option<ToolMass> {
        let (m, l, r) = (self.mass_kg, self.length_m, self.radius_m);
        if l == 0.0 || m == 0.0 {
            return None;
        }
        // c = l/2, I = m diag(3r² + l², 3r² + l², 6r²)/12.
        let across = m * (3.0 * r * r + l * l) / 12.0;
        let cylinder = [across, 0.0, 0.0, across, 0.0, 0.5 * m * r * r];
        Some(ToolMass {
            mass_kg: m,
            com_m: [0.0, 0.0, self.com_m.unwrap_or(0.5 * l)],
            inertia_kg_m2: self.inertia_kg_m2.unwrap_or(cylinder),
        })
    }
}

impl From<StraightTool> for Tool {
    fn from(tool: StraightTool) -> Self {
        let along = |z: f64| Pose::translation(0.0, 0.0, z);
        let handle_m = tool.length_m - tool.sponge_height_m;
        let handle = ToolBody {
            name: "handle".to_owned(),
            shape: Shape::Cylinder {
                radius_m: tool.radius_m,
                half_length_m: handle_m / 2.0,
            },
            pose: along(handle_m / 2.0),
        };
        let has_body = tool.length_m > 0.0 && handle_m > 0.0;
        Self {
            mounted_on: None,
            bodies: if has_body { vec![handle] } else { Vec::new() },
            sponge: Sponge {
                radius_m: tool.sponge_radius_m,
                height_m: tool.sponge_height_m,
                compression_m: tool.sponge_compression_m,
                stiffness_pa: tool.sponge_stiffness_pa,
                pose: along(handle_m + tool.sponge_height_m / 2.0),
            },
            tip: along(tool.length_m),
            mass: tool.mass(),
        }
    }
}

impl Tool {
    /// Returns the tool on the link that is stated to carry it, for [`Self::on`].
    #[must_use]
    pub fn mounted(self, on: Option<String>) -> Self {
        Self { mounted_on: on, ..self }
    }

    /// Returns the tool of an arm that carries none. Any arm has one: it is on the link that joint 6 moves.
    #[must_use]
    pub fn none(robot: &RobotModel) -> Self {
        let last = robot.joints()[AXES - 1].child.clone();
        Self::from(StraightTool::default()).mounted(Some(last))
    }

    /// Returns the tool as an arm carries it: on the stated link, or on the one that the description tells. The default `tool0` is not stored.
    ///
    /// # Errors
    /// [`ToolFrameError::NoMount`].
    pub fn on(self, robot: &RobotModel) -> Result<Self, ToolFrameError> {
        let found = robot.find_tool_mount().map(|mount| mount.to_string());
        // A tool0 that is not along axis 6 is no default.
        let is_default = |link: &String| link == ToolFrame::Tool0.name() && found.is_ok();
        let link = match self.mounted_on.clone() {
            Some(stated) => stated,
            None => found.clone()?,
        };
        let tool = self.mounted(Some(link).filter(|link| !is_default(link)));
        tool.check_mount(robot)?;
        Ok(tool)
    }

    /// True if there is a tool that can touch anything.
    #[must_use]
    pub fn is_present(&self) -> bool {
        !self.bodies.is_empty()
    }

    /// Returns true if the sponge is at the side of a face that it washes: its tip at that height over the face \[m\], its axis at an angle of
    /// that cosine from the normal, all of the rim at its holder is over the face. So it goes away from the plate along the normal.
    #[must_use]
    pub fn is_over_face(&self, height_m: f64, cosine: f64) -> bool {
        let (sponge, sine) = (&self.sponge, (1.0 - cosine * cosine).max(0.0).sqrt());
        cosine >= FRAC_1_SQRT_2 && height_m + sponge.height_m * cosine - sponge.radius_m * sine >= 0.0
    }

    /// Returns the state of the sponge with its tip at a height over a face \[m\]. Without a tool body the sponge counts as touching
    /// everywhere, as in the report of the paper's program.
    #[must_use]
    pub fn touch(&self, height_m: f64) -> Touch {
        if self.is_present() {
            self.sponge.touch(height_m)
        } else {
            Touch::On
        }
    }

    /// Returns the first body that reaches into the sponge, and its depth beyond the plane behind the sponge \[m\], if it is more than the
    /// rounding of positions.
    ///
    /// A body counts with its box along the axes of the tip: it reaches in if that overlaps the sponge's cylinder. A body wholly beside the
    /// sponge may reach any distance.
    #[must_use]
    pub fn in_sponge(&self) -> Option<(&ToolBody, f64)> {
        let [radius_m, height_m] = [self.sponge.radius_m, self.sponge.height_m];
        self.bodies.iter().find_map(|body| {
            let pose = self.tip.inverse() * body.pose;
            let reach = |way: Vector3<f64>| {
                let along = pose.translation.vector.dot(&way);
                along + body.shape.support(&pose.inverse_transform_vector(&way))
            };
            let by_m = reach(Vector3::z()) + height_m;
            let aside = |way: Vector3<f64>| f64::max(0.0, -reach(way)).max(-reach(-way));
            let [x, y] = [aside(Vector3::x()), aside(Vector3::y())];
            let is_beside = x * x + y * y >= radius_m * radius_m || reach(-Vector3::z()) < 0.0;
            // NaN, which is nowhere, is refused with bodies that are none.
            (by_m > TOUCHING_M && !is_beside).then_some((body, by_m))
        })
    }

    /// Checks that the arm has the link that carries the tool.
    ///
    /// # Errors
    /// [`ToolFrameError::NoMount`].
    pub fn check_mount(&self, robot: &RobotModel) -> Result<(), ToolFrameError> {
        robot.tool_mount(self.mounted_on.as_deref()).map(drop)
    }

    /// Returns the frame that carries the tool, z out of the arm; [`Frame::invalid`] on an arm that [`Self::check_mount`] refuses.
    #[must_use]
    pub fn mounting_frame(&self, robot: &RobotModel) -> Frame {
        robot
            .tool_mount(self.mounted_on.as_deref())
            .unwrap_or_else(|_| Frame::invalid())
    }

    /// Returns the frame of the tip on an arm.
    #[must_use]
    pub fn tip_frame(&self, robot: &RobotModel) -> Frame {
        self.mounting_frame(robot).offset(&RigidTransform::from(&self.tip))
    }
}

impl Sponge {
    /// Largest angle of the tool from a plate's normal that the sponge allows \[rad\].
    ///
    /// The free sponge is a cylinder of height `h` and radius `s`, tilted by τ about the middle of its far face, which is in the
    /// plate's plane. The middle of its near face is at the height `h cos τ`, and the lowest point of the rim there `s sin τ` below:
    /// it is above the plate while `tan τ < h / s`. Beyond `atan(h / s)` the rim, and with it what holds the sponge, would have to
    /// go through the plate.
    #[must_use]
    pub fn greatest_tilt_rad(&self) -> f64 {
        atan2(self.height_m, self.radius_m)
    }

    /// Returns the state of the sponge with its tip at a height over a face \[m\].
    #[must_use]
    pub fn touch(&self, height_m: f64) -> Touch {
        if height_m < -self.height_m {
            Touch::Pressed
        } else if height_m <= self.compression_m {
            Touch::On
        } else {
            Touch::Lifted
        }
    }

    /// Height without load \[m\].
    #[must_use]
    pub fn free_height_m(&self) -> f64 {
        self.height_m + self.compression_m
    }

    /// Shape while it washes, relative to its pose.
    #[must_use]
    pub fn shape(&self) -> Shape {
        Shape::Cylinder {
            radius_m: self.radius_m,
            half_length_m: self.height_m / 2.0,
        }
    }

    /// Shape without load, and its pose `T_flange_shape`.
    #[must_use]
    pub fn free_body(&self) -> (Shape, Pose) {
        let shape = Shape::Cylinder {
            radius_m: self.radius_m,
            half_length_m: self.free_height_m() / 2.0,
        };
        (shape, self.pose * Pose::translation(0.0, 0.0, self.compression_m / 2.0))
    }
}

/// Returns the pose of a tip at a position that points straight down: a half turn about y, which the paper's `eul2quat([0, pi/2, 0])` means
/// for MATLAB's `tool0`.
#[must_use]
pub fn tool_down(position: Vector3<f64>) -> Pose {
    // Exact, so that no joint sees the rounding of π: the quaternion (w, x, y, z) = (0, 0, 1, 0).
    let half_turn = UnitQuaternion::new_unchecked(Quaternion::new(0.0, 0.0, 1.0, 0.0));
    Pose::from_parts(position.into(), half_turn)
}
