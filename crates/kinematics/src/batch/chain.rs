//! The chain of one frame, folded once more so that a joint costs as few operations as its geometry allows.
//!
//! Between two joint axes stands a constant transform. Its rotation is written in z–x–z angles,
//! `Rz(φ) Rx(α) Rz(ψ)`; φ and ψ turn about joint axes and are added to the joint angles, and the origins slide along
//! their axes until the translation has one entry less. What is left,
//!
//! `T_base_frame = S · Π_k [ Rz(q_k + o_k) · Trans(t_k) · Rx(α_k) ] · Rz(ω)`,
//!
//! is the Denavit–Hartenberg form without its trouble with nearly parallel axes, because the common normal is used
//! where it is well defined only. Most α are 0 or π/2, which cost nothing.

use crate::joints::AXES;
use crate::model::Frame;
use crate::model::RobotModel;
use crate::rotation::RigidTransform;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Matrix3, Vector3};

/// Magnitude of a constant (m, or a sine or cosine) below which it counts as rounding and becomes 0.
const ROUNDING: f64 = 1e-15;

/// Constant rotation about x after a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bend {
    /// α = 0, and the translation is along x.
    Parallel,
    /// α = π/2, and the translation has no y entry.
    Perpendicular,
    /// Any other α.
    General {
        /// sin α.
        sin: f64,
        /// cos α.
        cos: f64,
    },
}

/// Constant transform after a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Link {
    /// Translation `t` in the turned frame \[m\].
    pub translation: [f64; 3],
    /// Rotation `Rx(α)`.
    pub bend: Bend,
}

/// Chain of a frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    /// Frame of joint 1 at q = 0, `S`, or the frame itself on the base.
    pub start: RigidTransform,
    /// Offsets `o` added to the joint positions \[rad\]; 0 beyond the frame.
    pub offsets: [f64; AXES],
    /// Joints between the base and the frame.
    pub links: Vec<Link>,
    /// (sin ω, cos ω), unless ω = 0.
    pub end: Option<(f64, f64)>,
}

/// Constant transform `Rz(φ) Trans(t) Rx(α) Rz(ψ)`.
struct Split {
    phi: f64,
    translation: Vector3<f64>,
    sin: f64,
    cos: f64,
    psi: f64,
}

impl Chain {
    /// Builds the chain of `frame`.
    pub fn new(robot: &RobotModel, frame: &Frame) -> Self {
        let joints = frame.body();
        if joints == 0 {
            return Self {
                start: frame.offset,
                offsets: [0.0; AXES],
                links: Vec::new(),
                end: None,
            };
        }
        let behind = |k: usize| {
            if k + 1 < joints {
                &robot.folded()[k + 1]
            } else {
                &frame.offset
            }
        };
        let mut splits: Vec<Split> = (0..joints.min(AXES)).map(|k| split(behind(k))).collect();
        let start = slide(robot.folded()[0], &mut splits);
        let (mut offsets, mut turned) = ([0.0; AXES], 0.0);
        for (offset, split) in offsets.iter_mut().zip(&splits) {
            *offset = turned + split.phi;
            turned = split.psi;
        }
        let end = (turned.abs() > ROUNDING).then(|| sin_cos(turned));
        let links = splits.iter().map(link).collect();
        Self {
            start,
            offsets,
            links,
            end,
        }
    }
}

/// Slides the joints' origins along their axes so that translations lose an entry; returns the new start.
fn slide(mut start: RigidTransform, splits: &mut [Split]) -> RigidTransform {
    for k in 0..splits.len() {
        let by = if k == 0 {
            splits[0].translation.z
        } else {
            let before = &mut splits[k - 1];
            let by = if before.sin > 0.5 {
                before.translation.y / before.sin
            } else {
                -before.translation.z / before.cos
            };
            before.translation += Vector3::new(0.0, -before.sin, before.cos) * by;
            by
        };
        if k == 0 {
            start.translation += start.rotation.column(2) * by;
        }
        splits[k].translation.z -= by;
    }
    start
}

/// Returns the z–x–z angles. For parallel axes φ is along the translation, which then has an entry less.
fn split(rigid: &RigidTransform) -> Split {
    let r = &rigid.rotation;
    let sin = (r.m13 * r.m13 + r.m23 * r.m23).sqrt();
    let t = rigid.translation;
    let (phi, alpha) = if sin > ROUNDING {
        (atan2(r.m13, -r.m23), atan2(sin, r.m33))
    } else {
        (atan2(without_rounding(t.y), without_rounding(t.x)), atan2(0.0, r.m33))
    };
    let (sin, cos) = sin_cos(alpha);
    let (sin_phi, cos_phi) = sin_cos(phi);
    let unturn = Matrix3::new(cos_phi, sin_phi, 0.0, -sin_phi, cos_phi, 0.0, 0.0, 0.0, 1.0);
    let unbend = Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, sin, 0.0, -sin, cos);
    // The rest is Rz(ψ) even where φ is ill defined: whatever rounding took from φ, ψ gives back.
    let rest = unbend * unturn * r;
    let psi = atan2(rest.m21 - rest.m12, rest.m11 + rest.m22);
    Split {
        phi,
        translation: unturn * t,
        sin,
        cos,
        psi,
    }
}

/// Returns the cheapest form that fits the angle and the translation.
fn link(split: &Split) -> Link {
    let t = split.translation.map(without_rounding);
    let (sin, cos) = (without_rounding(split.sin), without_rounding(split.cos));
    let bend = match (t.y == 0.0, t.z == 0.0) {
        (true, _) if cos == 0.0 => Bend::Perpendicular,
        (true, true) if sin == 0.0 && cos > 0.0 => Bend::Parallel,
        _ => Bend::General { sin, cos },
    };
    Link {
        translation: t.into(),
        bend,
    }
}

fn without_rounding(x: f64) -> f64 {
    if x.abs() < ROUNDING { 0.0 } else { x }
}
