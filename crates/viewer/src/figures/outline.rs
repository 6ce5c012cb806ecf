//! Outlines of bodies that are seen from above.

use nalgebra::{Point3, Vector3};
use platewash_kinematics::geometry::{Shape, VisualShape};
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{AXES, Frame, JointVector, Link, Pose, RobotModel};
use platewash_workcell::tool::Tool;
use platewash_workcell::{ObstacleShape, Workcell};
use std::f64::consts::TAU;

/// A convex outline, world frame \[m\].
pub type Outline = Vec<[f64; 2]>;

/// Directions in which the farthest point of a body is a corner of its outline.
const DIRECTIONS: u32 = 96;

/// The outlines of an arm's links at `q` \[rad\] and of its tool: of the links' visuals, or of the collision shapes where there are none.
/// A link that moves reaches to the next joint, so that the arm is in one piece.
#[must_use]
pub fn arm_outlines(arm: &RobotModel, tool: &Tool, mount: &Pose, q: &JointVector) -> Vec<Outline> {
    let poses = arm.fk(q);
    let at = |frame: &Frame| mount * poses.pose(frame);
    let has_shape = |link: &&Link| !(link.visuals.is_empty() && link.collision.is_empty());
    let links: Vec<&Link> = arm.links().iter().filter(has_shape).collect();
    let flange = tool.mounting_frame(arm);
    let link = |link: &&Link| {
        let (pose, body) = (at(&link.frame), link.frame.body());
        let next = links.iter().map(|next| next.frame).chain([flange]);
        let next = next.filter(|next| body > 0 && next.body() == AXES.min(body + 1));
        let joints = next
            .chain([link.frame])
            .map(|frame| at(&frame).translation.vector.xy().into());
        hull(
            &shapes(link, &pose)
                .into_iter()
                .flatten()
                .chain(joints)
                .collect::<Outline>(),
        )
    };
    let bodies = tool.bodies.iter().map(|body| (body.shape.clone(), body.pose));
    let sponge = tool.is_present().then(|| (tool.sponge.shape(), tool.sponge.pose));
    let carried = bodies
        .chain(sponge)
        .map(|(shape, pose)| solid(&shape, &(at(&flange) * pose)));
    links.iter().map(link).chain(carried).collect()
}

/// The shapes of a link whose frame is at a pose.
fn shapes(link: &Link, at: &Pose) -> Vec<Outline> {
    if link.visuals.is_empty() {
        return link
            .collision
            .iter()
            .map(|body| solid(&body.shape, &(at * body.pose)))
            .collect();
    }
    let visuals = link.visuals.iter().map(|visual| match &visual.shape {
        VisualShape::Solid(shape) => solid(shape, &(at * visual.pose)),
        VisualShape::Mesh(triangles) => {
            let corners = triangles.iter().flatten().map(|corner| corner.cast());
            points(corners, &(at * visual.pose))
        }
    });
    visuals.collect()
}

/// Whatever stands around, the floor apart.
pub(super) fn obstacles(workcell: &Workcell) -> Vec<Outline> {
    let all = workcell.obstacles.iter().flat_map(|obstacle| match &obstacle.shape {
        ObstacleShape::HalfSpace => Vec::new(),
        ObstacleShape::Convex(shape) => vec![solid(shape, &obstacle.pose)],
        ObstacleShape::Parts(hulls) => {
            let parts = hulls.iter().map(|hull| points(hull.iter().copied(), &obstacle.pose));
            parts.collect()
        }
    });
    all.collect()
}

/// A solid at a pose (`T_world_shape`).
pub(super) fn solid(shape: &Shape, pose: &Pose) -> Outline {
    match shape {
        Shape::Box { half_m: [x, y, z] } => {
            let sides = [-1.0, 1.0];
            let corner = |k: usize| Point3::new(sides[k & 1] * x, sides[k >> 1 & 1] * y, sides[k >> 2] * z);
            points((0..8).map(corner), pose)
        }
        Shape::Hull { points: corners } => points(corners.iter().copied(), pose),
        Shape::Sphere { radius_m } => round(*radius_m, 0.0, false, pose),
        Shape::Capsule {
            radius_m,
            half_length_m,
        } => round(*radius_m, *half_length_m, false, pose),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => round(*radius_m, *half_length_m, true, pose),
    }
}

/// A shape about its z axis, its ends flat or half spheres.
fn round(radius_m: f64, half_length_m: f64, is_flat: bool, pose: &Pose) -> Outline {
    let axis = pose.rotation * Vector3::z();
    outline(|direction| {
        let along = axis.dot(direction);
        let across = (direction - axis * along).try_normalize(1e-9).unwrap_or_default();
        let out = if is_flat { across } else { *direction };
        let at = pose.translation.vector + axis * half_length_m * along.signum() + out * radius_m;
        at.xy().into()
    })
}

/// The hull of points.
fn points(points: impl Iterator<Item = Point3<f64>>, pose: &Pose) -> Outline {
    hull(&points.map(|at| (pose * at).coords.xy().into()).collect::<Outline>())
}

/// The hull of places.
fn hull(seen: &[[f64; 2]]) -> Outline {
    if seen.is_empty() {
        return Vec::new();
    }
    outline(|direction| {
        let along = |at: &[f64; 2]| at[0] * direction.x + at[1] * direction.y;
        let farther = |best: [f64; 2], at: &[f64; 2]| if along(at) > along(&best) { *at } else { best };
        seen.iter().fold(seen[0], farther)
    })
}

/// The farthest point of a body in each direction, counter-clockwise.
fn outline(farthest: impl Fn(&Vector3<f64>) -> [f64; 2]) -> Outline {
    let directions = (0..DIRECTIONS).map(|k| {
        let (s, c) = sin_cos(TAU * (f64::from(k) + 0.5) / f64::from(DIRECTIONS));
        farthest(&Vector3::new(c, s, 0.0))
    });
    let mut corners: Outline = directions.collect();
    corners.dedup();
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn outlines_agree_with_hand_calculation() {
        let cube = solid(
            &Shape::Box {
                half_m: [1.0, 2.0, 3.0],
            },
            &Pose::translation(1.0, 0.0, 0.0),
        );
        assert_eq!(cube, [[2.0, 2.0], [0.0, 2.0], [0.0, -2.0], [2.0, -2.0]]);
        // A cylinder that lies along x is a rectangle.
        let lying = Pose::rotation(Vector3::y() * FRAC_PI_2);
        let cylinder = Shape::Cylinder {
            radius_m: 0.5,
            half_length_m: 2.0,
        };
        for [x, y] in solid(&cylinder, &lying) {
            assert!(
                (x.abs() - 2.0).abs() < 1e-12 && (y.abs() - 0.5).abs() < 1e-12,
                "{x} {y}"
            );
        }
        for [x, y] in solid(&Shape::Sphere { radius_m: 0.5 }, &lying) {
            assert!((x * x + y * y - 0.25).abs() < 1e-12);
        }
        assert!(solid(&Shape::Hull { points: Vec::new() }, &lying).is_empty());
    }
}
