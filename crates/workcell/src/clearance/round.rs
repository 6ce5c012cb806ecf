//! Bodies of a tool that joint 6 turns on the spot.

use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Frame, Pose};

/// How far a body may be off axis 6 and still count as round about it \[m\], and its axis turned from it \[rad\]: what descriptions with five
/// digits of an angle leave open.
const OFF: f64 = 1e-4;

/// Whether a body at `T_flange_body` of a mounting frame is round about axis 6, to [`OFF`]: its distance from what carries joint 6 is then the same in every
/// configuration.
pub(super) fn is_round_about_axis_6(flange: &Frame, shape: &Shape, pose: &Pose) -> bool {
    // Axis 6 is z of the frame of its body.
    let body = flange.on_body().then(&Rigid::from(pose));
    let is_on_axis = body.translation.xy().norm() <= OFF;
    let is_along = body.rotation.column(2).xy().norm() <= OFF;
    match shape {
        Shape::Sphere { .. } => is_on_axis,
        Shape::Cylinder { .. } | Shape::Capsule { .. } => is_on_axis && is_along,
        Shape::Box { .. } | Shape::Hull { .. } => false,
    }
}
