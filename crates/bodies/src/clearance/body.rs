//! Bodies of a world, and their kinds.

use crate::clearance::convex::HullFault;
use crate::clearance::error::ClearanceError;
use crate::clearance::part::{Part, PlacedPart};
use crate::clearance::tree::Tree;
use nalgebra::Vector3;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{BodyPoses, Frame, Pose, RobotModel};
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Tool;
use platewash_workcell::words::plate_name;
use platewash_workcell::{Obstacle, ObstacleShape};

/// Body for which clearances are computed.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub name: String,
    pub kind: BodyKind,
    pub parts: Vec<Part>,
    /// Tree of shapes that hold the parts, if there are many.
    pub tree: Option<Tree>,
}

impl Body {
    /// True if one of its parts is the convex hull of a mesh.
    pub fn has_hull(&self) -> bool {
        self.parts.iter().any(Part::is_hull)
    }

    /// Returns the parts to examine first: all parts, or the one that holds them.
    pub fn outer(&self) -> &[Part] {
        match &self.tree {
            Some(tree) => std::slice::from_ref(&tree.whole),
            None => &self.parts,
        }
    }
}

/// Sphere that holds a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ball {
    /// Index of the arm's body that carries it: 0 for fixed ones.
    body: usize,
    /// Centre, in the frame of that body \[m\].
    centre: Vector3<f64>,
    /// Radius \[m\]; infinite for a half-space.
    radius_m: f64,
}

impl Ball {
    /// Sphere about the middle of a body's outer parts.
    pub fn around(body: &Body) -> Self {
        let centres = || {
            body.outer()
                .iter()
                .map(|part| (part.bounding(), part.frame().on_body().translation))
        };
        let count = body.outer().len().max(1) as f64;
        let centre = centres().map(|(_, centre)| centre).sum::<Vector3<f64>>() / count;
        let radius_m = centres().map(|(radius_m, at)| radius_m + (at - centre).norm());
        Self {
            body: body.outer().first().map_or(0, Part::body),
            centre,
            radius_m: radius_m.fold(0.0, f64::max),
        }
    }

    /// Centre \[m\], base frame, and radius \[m\].
    pub fn placed(&self, poses: &BodyPoses) -> (Vector3<f64>, f64) {
        let RigidTransform { rotation, translation } = &poses.bodies()[self.body];
        (rotation * self.centre + translation, self.radius_m)
    }
}

/// Kind of a body; it decides which pairs are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BodyKind {
    /// Link, with the index of the arm's body that carries it.
    Link(usize),
    /// Body of the tool, except the sponge.
    Tool,
    /// Sponge.
    Sponge,
    /// Obstacle that is bounded.
    Obstacle,
    /// Obstacle that is a half-space.
    Floor,
    /// Plate, with its index.
    Plate(usize),
}

impl BodyKind {
    /// True for the bodies of the arm and its tool.
    fn is_of_arm(self) -> bool {
        matches!(self, Self::Link(_) | Self::Tool | Self::Sponge)
    }
}

/// True if the body of that name is of the arm or its tool.
pub(crate) fn is_of_arm(bodies: &[Body], name: &str) -> bool {
    bodies.iter().any(|body| body.name == name && body.kind.is_of_arm())
}

/// Returns the bodies of a world without plates.
pub(crate) fn world(robot: &RobotModel, tool: &Tool, obstacles: &[Obstacle]) -> Result<Vec<Body>, ClearanceError> {
    world_with(robot, |_| true, tool, obstacles)
}

/// Returns the bodies of a world without plates, and of the links only those on the arm's bodies that count.
pub(crate) fn world_with<'a>(
    robot: &RobotModel,
    counts: impl Fn(usize) -> bool,
    tool: &Tool,
    obstacles: impl IntoIterator<Item = &'a Obstacle>,
) -> Result<Vec<Body>, ClearanceError> {
    tool.check_mount(robot)?;
    let mut bodies = Vec::new();
    let links = robot.links().iter().filter(|link| counts(link.frame.body()));
    for link in links.filter(|link| !link.collision.is_empty()) {
        let parts = link
            .collision
            .iter()
            .map(|p| Part::new(&p.shape, link.frame.offset(&RigidTransform::from(&p.pose))));
        bodies.push(Body {
            name: link.name.clone(),
            kind: BodyKind::Link(link.frame.body()),
            parts: parts
                .collect::<Result<_, _>>()
                .map_err(|fault| refused(&link.name, fault))?,
            tree: None,
        });
    }
    bodies.extend(tool_bodies(robot, tool)?);
    for obstacle in obstacles {
        bodies.push(obstacle_body(obstacle)?);
    }
    Ok(bodies)
}

/// Returns the pairs of outer parts of two bodies.
pub(crate) fn part_pairs(a: &Body, b: &Body) -> impl Iterator<Item = (usize, usize)> + use<> {
    let (in_a, in_b) = (a.outer().len(), b.outer().len());
    (0..in_a).flat_map(move |p| (0..in_b).map(move |r| (p, r)))
}

/// Places the outer parts of the bodies at the poses of the arm's bodies.
pub(crate) fn place<'a>(bodies: &'a [Body], poses: &BodyPoses) -> Vec<Vec<PlacedPart<'a>>> {
    let parts = |body: &'a Body| body.outer().iter().map(|part| part.place(poses)).collect();
    bodies.iter().map(parts).collect()
}

fn refused(name: &str, fault: HullFault) -> ClearanceError {
    let link = name.to_owned();
    match fault {
        HullFault::Flat => ClearanceError::FlatHull { link },
        HullFault::ManyPoints(found) => ClearanceError::LargeMesh { link, found },
        HullFault::ManyCorners(found) => ClearanceError::LargeHull { link, found },
    }
}

fn body(name: &str, kind: BodyKind, part: Result<Part, HullFault>) -> Result<Body, ClearanceError> {
    Ok(Body {
        name: name.to_owned(),
        kind,
        parts: vec![part.map_err(|fault| refused(name, fault))?],
        tree: None,
    })
}

/// Returns the bodies of a tool, fixed to the mounting frame; empty without a tool.
fn tool_bodies(robot: &RobotModel, tool: &Tool) -> Result<Vec<Body>, ClearanceError> {
    if !tool.is_present() {
        return Ok(Vec::new());
    }
    let flange = tool.mounting_frame(robot);
    let at = |pose: &Pose| flange.offset(&RigidTransform::from(pose));
    let rigid = tool.bodies.iter();
    let mut bodies: Vec<_> = rigid
        .map(|b| body(&b.name, BodyKind::Tool, Part::new(&b.shape, at(&b.pose))))
        .collect::<Result<_, _>>()?;
    // Free, it is longest: compressed it lies within.
    let (shape, pose) = tool.sponge.free_body();
    let sponge = Part::new(&shape, at(&pose));
    bodies.push(body("sponge", BodyKind::Sponge, sponge)?);
    Ok(bodies)
}

/// Returns the body of an obstacle.
pub(crate) fn obstacle_body(obstacle: &Obstacle) -> Result<Body, ClearanceError> {
    let frame = Frame::base().offset(&RigidTransform::from(&obstacle.pose));
    let grown = |part: Part| part.grown(obstacle.margin_m);
    let made = match &obstacle.shape {
        ObstacleShape::HalfSpace => body(&obstacle.name, BodyKind::Floor, Ok(Part::half_space(frame))),
        ObstacleShape::Convex(shape) => body(&obstacle.name, BodyKind::Obstacle, Part::new(shape, frame)),
        ObstacleShape::Parts(hulls) => {
            let (tree, parts) = Tree::of_hulls(hulls, frame).map_err(|fault| refused(&obstacle.name, fault))?;
            Ok(Body {
                name: obstacle.name.clone(),
                kind: BodyKind::Obstacle,
                parts,
                tree,
            })
        }
    }?;
    Ok(Body {
        tree: made.tree.map(|tree| tree.grown(obstacle.margin_m)),
        parts: made.parts.into_iter().map(grown).collect(),
        ..made
    })
}

/// Returns the body of a plate. The parts of `like` are reused if it has the same shape.
pub(crate) fn plate_body(index: usize, plate: &Plate, like: Option<&Body>) -> Body {
    let known = like.and_then(|body| body.tree.as_ref());
    let (tree, parts) = Tree::from_plate(plate, known).map_or_else(
        || {
            // It has a volume.
            let (shape, pose) = plate.enclosure();
            let part = Part::new(&shape, Frame::base().offset(&RigidTransform::from(&pose)));
            (None, part.into_iter().collect())
        },
        |(tree, parts)| (Some(tree), parts),
    );
    Body {
        name: plate_name(index),
        kind: BodyKind::Plate(index),
        parts,
        tree,
    }
}
