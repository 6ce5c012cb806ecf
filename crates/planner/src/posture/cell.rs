//! The arm, its tool and what stands around it; and how the tool stands at a contact point.

use super::PostureError;
use super::inverse::Inverse;
use crate::trig::sin_cos;
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Frame, JointVector, Pose, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout::Plate;
use platewash_workcell::tool::Tool;
use platewash_workcell::tool::tip_frame;

/// A horizontal distance from axis 1 below which it has no direction \[m\].
const ON_AXIS_M: f64 = 1e-9;

/// What a posture is searched in. Plates are horizontal: their normal is z of the base frame.
#[derive(Debug)]
pub struct Cell<'a> {
    /// The arm.
    pub robot: &'a RobotModel,
    /// The tip: the centre of the sponge's far face, z leaving the tool.
    pub tip: Frame,
    /// The bodies around, the plates among them.
    pub clearance: &'a ClearanceModel,
    /// The plates, as in `clearance`.
    pub plates: &'a [Plate],
    pub(super) inverse: Inverse<'a>,
    /// A point of axis 1 and its direction, base frame.
    axis_1: [Vector3<f64>; 2],
    /// The direction of the tip frame that lies across the arm's plane while joints 4 and 6 rest: unit, z = 0.
    across: Vector3<f64>,
}

/// A contact point seen from axis 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Distance from axis 1 \[m\].
    pub r: f64,
    /// ρ̂: the horizontal direction away from axis 1.
    pub out: Vector3<f64>,
}

impl<'a> Cell<'a> {
    /// A cell. `tool` and `plates` are those that `clearance` was made with.
    ///
    /// # Errors
    /// [`PostureError::Ik`], for a solver that refuses its settings.
    pub fn new(
        robot: &'a RobotModel,
        tool: &Tool,
        clearance: &'a ClearanceModel,
        plates: &'a [Plate],
    ) -> Result<Self, PostureError> {
        let tip = tip_frame(robot, tool);
        let axes = robot.fk(&JointVector::zeros()).joint_axes();
        let mut cell = Self {
            robot,
            tip,
            clearance,
            plates,
            inverse: Inverse::new(robot, tip)?,
            axis_1: [robot.reach_bound(&tip).0.coords, axes[0]],
            across: Vector3::y(),
        };
        cell.across = cell.across_at_rest(&axes[4]);
        Ok(cell)
    }

    /// Where the tip frame must be to wash `contact` \[m\] with the tool tilted by `tilt_rad` in the arm's plane, the vertical
    /// plane through axis 1 and the contact point: z of the tip is `−(cos τ ẑ + sin τ ρ̂)`, so that τ > 0 leans
    /// the flange away from axis 1. The yaw is the one at which joints 4 and 6 rest on arms whose wrist allows it.
    ///
    /// On axis 1 itself ρ̂ is x of the base frame.
    #[must_use]
    pub fn tip_pose(&self, contact: Vector3<f64>, tilt_rad: f64) -> Pose {
        Pose::from(&self.tip_rigid(&contact, tilt_rad))
    }

    pub(super) fn tip_rigid(&self, contact: &Vector3<f64>, tilt_rad: f64) -> Rigid {
        let Seen { out, .. } = self.seen(contact);
        self.leaning(contact, &out, &out, tilt_rad)
    }

    /// The tip with the flange leaning towards `lean`, horizontal, by its length \[rad\].
    pub(super) fn tip_leaning(&self, contact: &Vector3<f64>, lean: &Vector3<f64>) -> Rigid {
        let Seen { out, .. } = self.seen(contact);
        let tilt_rad = lean.norm();
        let towards = if tilt_rad > 0.0 { lean / tilt_rad } else { out };
        self.leaning(contact, &out, &towards, tilt_rad)
    }

    /// The straight tool whose `across` points along `ẑ × out`, turned about `ẑ × lean` by the tilt.
    fn leaning(&self, contact: &Vector3<f64>, out: &Vector3<f64>, lean: &Vector3<f64>, tilt_rad: f64) -> Rigid {
        let (s, c) = sin_cos(tilt_rad);
        let side = Vector3::z().cross(out);
        let hinge = Vector3::z().cross(lean);
        let z = -(Vector3::z() * c + lean * s);
        let leant = lean * c - Vector3::z() * s;
        let across = leant * side.dot(lean) + hinge * side.dot(&hinge);
        let [here, there] = [(across, z), (self.across, Vector3::z())]
            .map(|(across, z)| Matrix3::from_columns(&[across, z, across.cross(&z)]));
        Rigid {
            rotation: here * there.transpose(),
            translation: *contact,
        }
    }

    /// Distance of a point \[m\] from axis 1 \[m\].
    #[must_use]
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.seen(point).r
    }

    pub(super) fn seen(&self, contact: &Vector3<f64>) -> Seen {
        let [point, direction] = self.axis_1;
        let away = contact - point;
        let away = away - direction * direction.dot(&away);
        let level = Vector3::new(away.x, away.y, 0.0);
        Seen {
            r: away.norm(),
            out: level.try_normalize(ON_AXIS_M).unwrap_or_else(Vector3::x),
        }
    }

    /// Axis 5 at q = 0 in the tip frame, across the tool, in the sense that it has against ẑ × ρ̂ there.
    fn across_at_rest(&self, axis_5: &Vector3<f64>) -> Vector3<f64> {
        let tip = self.robot.fk(&JointVector::zeros()).rigid(&self.tip);
        let inside = tip.rotation.tr_mul(axis_5);
        let across = Vector3::new(inside.x, inside.y, 0.0);
        let Some(across) = across.try_normalize(1e-6) else {
            return Vector3::y();
        };
        let side = Vector3::z().cross(&self.seen(&tip.translation).out);
        across * 1.0_f64.copysign(side.dot(axis_5))
    }
}
