//! The bodies of a world, and which of them are what.

use super::error::ClearanceError;
use super::part::{Part, Placed};
use crate::plate::Plate;
use crate::tool::Tool;
use crate::workcell::{Obstacle, ObstacleShape};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{BodyPoses, Frame, Pose, RobotModel};

/// Something that must not be touched or must not touch.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub name: String,
    pub kind: BodyKind,
    pub parts: Vec<Part>,
}

/// What a body is; decides which pairs are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BodyKind {
    /// A link, with the index of the arm's body that carries it.
    Link(usize),
    /// Of the tool, but for the sponge.
    Tool,
    /// The sponge.
    Sponge,
    /// An obstacle.
    Obstacle,
    /// All of z ≤ 0, an obstacle.
    Floor,
    /// A plate.
    Plate(usize),
}

/// The bodies of a world without plates.
pub(super) fn world(robot: &RobotModel, tool: &Tool, obstacles: &[Obstacle]) -> Result<Vec<Body>, ClearanceError> {
    let mut bodies = Vec::new();
    for link in robot.links().iter().filter(|link| !link.collision.is_empty()) {
        let parts = link
            .collision
            .iter()
            .map(|p| Part::new(&p.shape, link.frame.offset(&Rigid::from(&p.pose))));
        bodies.push(Body {
            name: link.name.clone(),
            kind: BodyKind::Link(link.frame.body()),
            parts: parts.collect::<Option<_>>().ok_or_else(|| flat(&link.name))?,
        });
    }
    bodies.extend(tool_bodies(robot, tool)?);
    for obstacle in obstacles {
        bodies.push(obstacle_body(obstacle)?);
    }
    Ok(bodies)
}

/// The pairs of parts of two bodies.
pub(super) fn part_pairs(a: &Body, b: &Body) -> impl Iterator<Item = (usize, usize)> + use<> {
    let (in_a, in_b) = (a.parts.len(), b.parts.len());
    (0..in_a).flat_map(move |p| (0..in_b).map(move |r| (p, r)))
}

/// The parts of the bodies where the arm's bodies stand.
pub(super) fn place<'a>(bodies: &'a [Body], poses: &BodyPoses) -> Vec<Vec<Placed<'a>>> {
    let parts = |body: &'a Body| body.parts.iter().map(|part| part.place(poses)).collect();
    bodies.iter().map(parts).collect()
}

fn flat(name: &str) -> ClearanceError {
    let link = name.to_owned();
    ClearanceError::FlatHull { link }
}

fn body(name: &str, kind: BodyKind, part: Option<Part>) -> Result<Body, ClearanceError> {
    Ok(Body {
        name: name.to_owned(),
        kind,
        parts: vec![part.ok_or_else(|| flat(name))?],
    })
}

/// The bodies of a tool, fixed to the mounting frame: none where there is no tool.
fn tool_bodies(robot: &RobotModel, tool: &Tool) -> Result<Vec<Body>, ClearanceError> {
    if !tool.is_present() {
        return Ok(Vec::new());
    }
    let flange = robot.mounting_frame();
    let at = |pose: &Pose| flange.offset(&Rigid::from(pose));
    let rigid = tool.bodies.iter();
    let mut bodies: Vec<_> = rigid
        .map(|b| body(&b.name, BodyKind::Tool, Part::new(&b.shape, at(&b.pose))))
        .collect::<Result<_, _>>()?;
    let sponge = Part::new(&tool.sponge.shape(), at(&tool.sponge.pose));
    bodies.push(body("sponge", BodyKind::Sponge, sponge)?);
    Ok(bodies)
}

fn obstacle_body(obstacle: &Obstacle) -> Result<Body, ClearanceError> {
    let frame = Frame::base().offset(&Rigid::from(&obstacle.pose));
    match &obstacle.shape {
        ObstacleShape::HalfSpace => body(&obstacle.name, BodyKind::Floor, Some(Part::floor())),
        ObstacleShape::Convex(shape) => body(&obstacle.name, BodyKind::Obstacle, Part::new(shape, frame)),
    }
}

pub(super) fn plate_body(index: usize, plate: &Plate) -> Body {
    let (shape, pose) = plate.body();
    let part = Part::new(&shape, Frame::base().offset(&Rigid::from(&pose)));
    Body {
        name: format!("plate {index}"),
        kind: BodyKind::Plate(index),
        // A cylinder always has a volume.
        parts: part.into_iter().collect(),
    }
}
