//! Pairs of moving bodies whose distance no joint changes. A search over the motion leaves them out; they are judged once.
//!
//! Joint 1 turns a link about the normal of a half-space, so that the link keeps its height. Joint 6 turns a body of the tool that is round
//! about axis 6 on the spot, beside the link that carries the joint. Both are so up to the rounding of descriptions: the distance that is
//! stated is less by what a turn can change.
//!
//! They keep the required clearance, as all pairs do, with two exceptions, where only contact counts. An arm stands on the ground, the floor at
//! height 0 of its base, by intent, and its links are as high over it as they are made. A body of the tool in front of the flange stands
//! against it by intent, and the link that carries joint 6 is as near as the flange is thick. The shape of that link may even reach through the
//! middle of the flange, as shapes hold more than the link: such a part does not count if it reaches no farther than [`THROUGH_M`]. A plane
//! whose normal does not lead away from that link is no flange.

use crate::clearance::body::{Body, BodyKind, place, world_with};
use crate::clearance::distance::{Separation, bracketed};
use crate::clearance::error::ClearanceError;
use crate::clearance::overlap::{TOUCH_M, depth};
use crate::clearance::pair_clearance::{PairClearance, is_clear};
use crate::clearance::part::{Part, PlacedPart};
use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{BodyPoses, Frame, JointVector, RobotModel};
use platewash_workcell::tool::Tool;
use platewash_workcell::{ObstacleShape, ReducedClearance, Workcell, is_pair};

/// Body of the arm that carries joint 6.
pub(crate) const CARRIER: usize = 5;

/// Greatest distance in front of the flange that the shape of the link behind it reaches \[m\].
const THROUGH_M: f64 = 0.01;

/// Greatest angle between axis 1 and the normal of a half-space over which a link keeps its height \[rad\].
const UPRIGHT: f64 = 1.5e-6;

/// Greatest distance of a body from axis 6 that counts as round about it \[m\], and greatest angle of its axis \[rad\]: the rounding of
/// descriptions with five digits of an angle.
const OFF: f64 = 1e-4;

/// Pair of bodies whose distance no joint changes.
#[derive(Debug, Clone, PartialEq)]
pub struct StillPair {
    /// The pair with its distance.
    pub pair: PairClearance,
    /// Lower bound on the distance at every configuration \[m\]; less than 0 by the depth of an overlap, or more.
    pub at_least_m: f64,
    /// True if only contact counts: a link over the ground that the arm stands on, and a body of the tool in front of the flange.
    pub only_contact: bool,
}

impl StillPair {
    /// True if the pair keeps what is required of it where `required_m` is required of most pairs \[m\].
    #[must_use]
    pub fn is_clear(&self, required_m: f64) -> bool {
        if self.only_contact {
            return self.at_least_m >= -TOUCH_M;
        }
        is_clear(self.at_least_m, self.pair.required_m(required_m))
    }
}

/// Same as [`ClearanceModel::still_pairs`](crate::clearance::ClearanceModel::still_pairs) for an arm in its workcell, without the other bodies.
///
/// # Errors
/// [`ClearanceError`] for an invalid shape.
pub fn still_pairs(robot: &RobotModel, workcell: &Workcell) -> Result<Vec<StillPair>, ClearanceError> {
    let obstacles = workcell.obstacles_from_base();
    let floors = obstacles.iter().filter(|o| o.shape == ObstacleShape::HalfSpace);
    let bodies = world_with(robot, |body| body == 1 || body == CARRIER, &workcell.tool, floors)?;
    let reduced_by_m = |a: usize, b: usize| {
        let is_of_pair = |r: &&ReducedClearance| is_pair(&r.pair, (&bodies[a].name, &bodies[b].name));
        workcell
            .reduced_clearances
            .iter()
            .find(is_of_pair)
            .map_or(0.0, |r| r.by_m)
    };
    let found = still(robot, &workcell.tool, &bodies).into_iter();
    Ok(found
        .filter_map(|still| still.measured(robot, &bodies, reduced_by_m))
        .collect())
}

/// Pair whose distance no joint changes.
#[derive(Debug, Clone)]
pub(crate) struct Still {
    /// The bodies, by index.
    pub pair: (usize, usize),
    /// Most by which a turn may change the distance after all \[m\].
    change_m: f64,
    /// The flange, where the second body is in front of it.
    mounted_on: Option<Frame>,
    /// True if the second body is the ground.
    is_on_ground: bool,
}

impl Still {
    /// Measures the pair; `None` where the second body can meet no part of the first before it meets the flange. `reduced_by_m` is the part
    /// of the required clearance that a pair need not keep \[m\].
    pub fn measured(
        &self,
        robot: &RobotModel,
        bodies: &[Body],
        reduced_by_m: impl Fn(usize, usize) -> f64,
    ) -> Option<StillPair> {
        let poses = robot.fk(&JointVector::zeros());
        let (a, b) = self.pair;
        let [first, second] = [a, b].map(|body| &bodies[body]);
        let [mut here, there] = [first, second].map(|body| place(std::slice::from_ref(body), &poses).remove(0));
        if let Some(flange) = &self.mounted_on {
            let middle = Part::ball(0.0, *flange);
            let middle = middle.place(&poses);
            let plane = Plane::from_flange(flange, &poses);
            here.retain(|part| bracketed(part, &middle).1 > TOUCH_M || plane.reach_m(part) > THROUGH_M);
        }
        let mut nearest: Option<Separation> = None;
        let mut least_m = f64::INFINITY;
        for (part, other) in here
            .iter()
            .flat_map(|part| there.iter().map(move |other| (part, other)))
        {
            let (found, at_least_m) = bracketed(part, other);
            let at_least_m = if at_least_m > 0.0 {
                at_least_m
            } else {
                -depth(part, other).max(0.0)
            };
            least_m = least_m.min(at_least_m);
            if nearest.is_none_or(|nearest| found.distance < nearest.distance) {
                nearest = Some(found);
            }
        }
        let found = nearest?;
        // Margins are for what need not be as near as it is.
        let margins = second.parts.iter().map(Part::margin_m);
        let margin_m = if self.is_on_ground {
            margins.fold(0.0, f64::max)
        } else {
            0.0
        };
        Some(StillPair {
            pair: PairClearance {
                a: first.name.clone(),
                b: second.name.clone(),
                distance_m: found.distance,
                place_m: found.place,
                has_hull: first.has_hull() || second.has_hull(),
                mounted_on: None,
                reduced_by_m: reduced_by_m(a, b),
            },
            at_least_m: least_m - self.change_m + margin_m,
            only_contact: self.mounted_on.is_some() || self.is_on_ground,
        })
    }
}

/// Returns the pairs whose distance no joint changes.
pub(crate) fn still(robot: &RobotModel, tool: &Tool, bodies: &[Body]) -> Vec<Still> {
    let flange = tool.mounting_frame(robot);
    let of = |a: usize, b: usize| {
        let (first, second) = (&bodies[a], &bodies[b]);
        let (change_m, mounted_on) = match (first.kind, second.kind) {
            (BodyKind::Link(1), BodyKind::Floor) => (height_change_m(robot, first, second)?, None),
            (BodyKind::Link(CARRIER), BodyKind::Tool | BodyKind::Sponge) => {
                (turn_m(second)?, is_in_front(robot, second, &flange).then_some(flange))
            }
            _ => return None,
        };
        Some(Still {
            pair: (a, b),
            change_m,
            mounted_on,
            is_on_ground: second.parts.iter().all(Part::is_ground),
        })
    };
    // Links come first among bodies, and half-spaces after the tool.
    let pairs = (0..bodies.len()).flat_map(|a| (a + 1..bodies.len()).map(move |b| (a, b)));
    pairs.filter_map(|(a, b)| of(a, b)).collect()
}

/// Plane of a flange, base frame.
struct Plane {
    at: Vector,
    /// Axis of the flange, out of the arm.
    out: Vector,
}

impl Plane {
    fn from_flange(flange: &Frame, poses: &BodyPoses) -> Self {
        let RigidTransform { rotation, translation } = poses.rigid(flange);
        let vector = |v: Vector3<f64>| Vector::new(v.x, v.y, v.z);
        Self {
            at: vector(translation),
            out: vector(rotation.column(2).into_owned()),
        }
    }

    /// Greatest distance in front of the plane of a point of a part \[m\].
    fn reach_m(&self, part: &PlacedPart<'_>) -> f64 {
        part.support(self.out) - self.out.dot(self.at)
    }

    /// Greatest distance behind the plane of a point of a part \[m\].
    fn behind_m(&self, part: &PlacedPart<'_>) -> f64 {
        part.support(-self.out) + self.out.dot(self.at)
    }
}

/// True if a body of the tool does not reach behind the flange, and the flange faces away from the link that carries joint 6.
fn is_in_front(robot: &RobotModel, body: &Body, flange: &Frame) -> bool {
    let poses = robot.fk(&JointVector::zeros());
    let plane = Plane::from_flange(flange, &poses);
    let [x, y, z] = poses.bodies()[CARRIER].translation.into();
    let faces_away = plane.out.dot(plane.at - Vector::new(x, y, z)) > 0.0;
    faces_away
        && body
            .parts
            .iter()
            .all(|part| plane.behind_m(&part.place(&poses)) <= TOUCH_M)
}

/// Most by which joint 1 changes the height of a body over a half-space \[m\]; `None` if it does not turn it about the normal.
///
/// A turn moves a point at the distance r from the axis by at most 2 r, across the axis. Along a normal at the angle φ to the axis that is
/// at most 2 r sin φ.
pub(crate) fn height_change_m(robot: &RobotModel, body: &Body, floor: &Body) -> Option<f64> {
    let poses = robot.fk(&JointVector::zeros());
    let [axis, ..] = poses.joint_axes();
    let across = |part: &Part| axis.cross(&part.rigid(&poses).rotation.column(2)).norm();
    let sine = floor.parts.iter().map(across).fold(0.0, f64::max);
    (sine <= UPRIGHT).then(|| 2.0 * sine * widest_m(body))
}

/// Greatest distance of a point of a body from the axis that turns it, z of its frame, or more \[m\].
fn widest_m(body: &Body) -> f64 {
    let reach = |part: &Part| off(&part.frame().on_body().translation) + part.bounding();
    body.parts.iter().map(reach).fold(0.0, f64::max)
}

/// Most by which joint 6 changes the place of a body of the tool that is round about axis 6 \[m\]; `None` for another body.
///
/// The turned body is the same shape about the turned axis. Its middle is moved by at most twice its distance from axis 6, and its axis
/// turned by at most twice the angle between the two.
pub(crate) fn turn_m(body: &Body) -> Option<f64> {
    let of_part = |part: &Part| {
        let RigidTransform { rotation, translation } = *part.frame().on_body();
        let (away_m, sine) = (off(&translation), off(&rotation.column(2).into_owned()));
        let angle = if part.is_ball() { 0.0 } else { sine };
        let is_round = part.is_round() && away_m <= OFF && angle <= OFF;
        // An angle up to OFF exceeds its sine by less than a part in 10⁸.
        is_round.then(|| 2.0 * (away_m + 1.000_001 * angle * part.bounding()))
    };
    let parts = body.parts.iter().map(of_part);
    parts
        .collect::<Option<Vec<_>>>()
        .map(|all| all.into_iter().fold(0.0, f64::max))
}

/// Distance of a place from the z axis.
fn off(place: &Vector3<f64>) -> f64 {
    place.xy().norm()
}
