//! The bodies that a job adds to the arm: whether distances to them can be worked out at all.

use crate::error::ProveError;
use nalgebra::Point3;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::job::JobTerms;
use platewash_workcell::workcell::{MOST_BODIES, Obstacle, ObstacleShape};

/// The greatest size of a body, and the greatest distance of one from its frame, along each axis \[m\].
const GREATEST_M: f64 = 1e3;

/// Points of a hull at least and at most.
const POINTS: [usize; 2] = [4, 100_000];

/// Refuses shapes that are none and places that are nowhere.
///
/// # Errors
/// [`ProveError::Body`].
pub(crate) fn check(job: &JobTerms) -> Result<(), ProveError> {
    let world = &job.workcell;
    let tool = world.tool.bodies.iter().map(|b| (&b.name, Some(&b.shape), &b.pose));
    let obstacles = world.obstacles.iter().map(|o| match &o.shape {
        ObstacleShape::HalfSpace | ObstacleShape::Parts(_) => (&o.name, None, &o.pose),
        ObstacleShape::Convex(shape) => (&o.name, Some(shape), &o.pose),
    });
    if let Some(none) = world.obstacles.iter().find(|o| !has_sound_parts(o)) {
        let name = none.name.clone();
        return Err(ProveError::Body { name });
    }
    let sponge = "sponge".to_owned();
    let tip = "tip of the tool".to_owned();
    let frames = [(&sponge, None, &world.tool.sponge.pose), (&tip, None, &world.tool.tip)];
    let is_sound = |shape: Option<&Shape>, pose: &Pose| shape.is_none_or(is_shape) && is_place(pose);
    let mut all = tool.chain(obstacles).chain(frames);
    match all.find(|(_, shape, pose)| !is_sound(*shape, pose)) {
        Some((name, ..)) => Err(ProveError::Body { name: name.clone() }),
        None => Ok(()),
    }
}

/// Whether the parts of an obstacle that has some are hulls, not too many of them and of not too many points together.
fn has_sound_parts(obstacle: &Obstacle) -> bool {
    let ObstacleShape::Parts(hulls) = &obstacle.shape else {
        return true;
    };
    let [_, most] = POINTS;
    let points: usize = hulls.iter().map(Vec::len).sum();
    (1..=MOST_BODIES).contains(&hulls.len()) && points <= most && hulls.iter().all(|points| is_hull(points))
}

fn is_hull(points: &[Point3<f64>]) -> bool {
    let [least, most] = POINTS;
    let near = points.iter().flat_map(|p| p.iter()).all(|c| c.abs() <= GREATEST_M);
    (least..=most).contains(&points.len()) && near
}

fn is_shape(shape: &Shape) -> bool {
    let size = |size: f64| size > 0.0 && size <= GREATEST_M;
    match shape {
        Shape::Box { half_m } => half_m.iter().all(|half| size(*half)),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => size(*radius_m) && size(*half_length_m),
        Shape::Sphere { radius_m } => size(*radius_m),
        Shape::Capsule {
            radius_m,
            half_length_m,
        } => size(*radius_m) && (0.0..=GREATEST_M).contains(half_length_m),
        Shape::Hull { points } => is_hull(points),
    }
}

/// Whether a pose is a place not too far away, and a rotation.
fn is_place(pose: &Pose) -> bool {
    let near = pose.translation.vector.iter().all(|c| c.abs() <= GREATEST_M);
    near && (pose.rotation.quaternion().norm() - 1.0).abs() <= 1e-9
}
