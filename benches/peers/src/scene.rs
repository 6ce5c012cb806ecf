//! A cell as data for others: the arm's joints, every body as convex shapes, the pairs that must keep clear.

use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{Frame, Link, Pose};
use platewash_problems::stages::surroundings;
use platewash_bodies::job::WashJob;
use platewash_workcell::words::plate_name;
use platewash_workcell::ObstacleShape;
use serde_json::{Value, json};
use std::error::Error;

/// A cell, in the frame of the arm's base. Lengths are in metres, angles in radians; rotations are rows of matrices.
///
/// `joints` are transforms from one joint's frame to the next at zero, the joint turning about z of its own; a body is fixed to what `by`
/// joints move, its shapes placed in the last one's frame.
///
/// # Errors
/// An arm with a shape that is none.
pub fn scene(job: &WashJob) -> Result<Value, Box<dyn Error>> {
    let (arm, terms) = (job.arm(), job.seen_from_base());
    let limits = arm.limits();
    let tool = &terms.workcell.tool;
    let mut bodies: Vec<Value> = arm.links().iter().filter_map(of_link).collect();
    let flange = tool.mounting_frame(arm);
    let (sponge, at) = tool.sponge.free_body();
    for held in &tool.bodies {
        bodies.push(body(&held.name, &flange, &[(held.shape.clone(), held.pose)], 0.0));
    }
    bodies.push(body("sponge", &flange, &[(sponge, at)], 0.0));
    for obstacle in &terms.workcell.obstacles {
        let at = |shape: &Shape| (shape.clone(), obstacle.pose);
        let shapes = match &obstacle.shape {
            ObstacleShape::HalfSpace => Vec::new(),
            ObstacleShape::Convex(shape) => vec![at(shape)],
            ObstacleShape::Parts(hulls) => hulls
                .iter()
                .map(|points| at(&Shape::Hull { points: points.clone() }))
                .collect(),
        };
        let mut value = body(&obstacle.name, &Frame::base(), &shapes, obstacle.margin_m);
        if shapes.is_empty() {
            value["half_space"] = placed(&RigidTransform::from(&obstacle.pose));
        }
        bodies.push(value);
    }
    for (k, plate) in terms.plates.iter().enumerate() {
        bodies.push(body(&plate_name(k), &Frame::base(), &plate.bodies(), 0.0));
    }
    Ok(json!({
        "joints": arm.folded().iter().map(placed).collect::<Vec<_>>(),
        "limits_rad": [limits.lower.as_slice(), limits.upper.as_slice()],
        "bodies": bodies,
        "pairs": surroundings(job)?.pair_names(),
        "clearance_m": terms.requirements.clearance_m,
    }))
}

fn of_link(link: &Link) -> Option<Value> {
    let shapes: Vec<_> = link.collision.iter().map(|p| (p.shape.clone(), p.pose)).collect();
    (!shapes.is_empty()).then(|| body(&link.name, &link.frame, &shapes, 0.0))
}

fn body(name: &str, frame: &Frame, shapes: &[(Shape, Pose)], grown_m: f64) -> Value {
    let shapes = shapes.iter().map(|(shape, pose)| {
        let mut value = placed(frame.offset(&RigidTransform::from(pose)).on_body());
        value["shape"] = json!(shape);
        value
    });
    json!({
        "name": name,
        "by": frame.body(),
        "shapes": shapes.collect::<Vec<_>>(),
        "grown_m": grown_m,
    })
}

fn placed(at: &RigidTransform) -> Value {
    let rows: Vec<[f64; 3]> = at.rotation.row_iter().map(|row| [row[0], row[1], row[2]]).collect();
    json!({ "rotation": rows, "position_m": at.translation.as_slice() })
}
