//! Check that fixed bodies are apart: obstacles from plates and from the arm's base, plates at an angle to the base from the base.
//!
//! What stands may touch what it stands on, and neither moves. So these pairs need no clearance, and the margins of obstacles, which say
//! how much more a moving body keeps, do not count. The floor at height 0 that a job has by default may reach into the base: it is the
//! ground that the base stands on, or higher, and moving bodies keep clear of it.
//!
//! The distance of two plates, which do not move, is computed here, too.

#[cfg(test)]
mod tests;

use crate::clearance::body::{Body, BodyKind, obstacle_body, place, plate_body, world_with};
use crate::clearance::distance::bracketed;
use crate::clearance::error::ClearanceError;
use crate::clearance::model::{ClearanceModel, from_base};
use crate::clearance::overlap::{TOUCH_M, depth};
use crate::clearance::part::{Part, PlacedPart};
use crate::clearance::solid::SHEET_M;
use nalgebra::Vector6;
use platewash_kinematics::{BodyPoses, JointVector, RobotModel};
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Tool;
use platewash_workcell::words::{plate_name, printable};
use platewash_workcell::{Obstacle, ObstacleShape, Workcell};
use std::fmt;

/// Fixed body that overlaps another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FixedBody {
    /// Obstacle, by its name.
    Obstacle(String),
    /// Obstacle of several convex parts, by its name.
    Parts(String),
    /// Plate, by its index.
    Plate(usize),
}

impl FixedBody {
    /// Name of the body.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Obstacle(name) | Self::Parts(name) => name.clone(),
            Self::Plate(index) => plate_name(*index),
        }
    }
}

impl fmt::Display for FixedBody {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Obstacle(name) | Self::Parts(name) => write!(f, "obstacle '{}'", printable(name)),
            Self::Plate(index) => f.write_str(&plate_name(*index)),
        }
    }
}

/// Two fixed bodies that overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct FixedOverlap {
    /// The first body.
    pub body: FixedBody,
    /// Name of the plate, or of the link of the arm.
    pub other: String,
    /// Upper bound on the depth of the overlap \[m\].
    pub by_m: f64,
}

/// Finds the obstacles of a workcell that reach into its plates, except those that they hold, or into the base of the arm. Also finds the
/// plates that reach into the base. Plates that are level with the base are checked with [`BaseFootprint::gap_m`]. The raised plates of a dry run are ignored, as
/// nothing is there; its real ones are those of its parent.
///
/// [`BaseFootprint::gap_m`]: platewash_workcell::layout::BaseFootprint::gap_m
///
/// # Errors
/// [`ClearanceError`] for an invalid shape.
pub fn standing_overlaps(
    robot: &RobotModel,
    workcell: &Workcell,
    plates: &[Plate],
    dry_run: Option<&DryRun>,
) -> Result<Vec<FixedOverlap>, ClearanceError> {
    let is_real_plate = |obstacle: &Obstacle| {
        let named = |i| obstacle.name == DryRun::real_name(i);
        dry_run.is_some() && (0..plates.len()).any(named)
    };
    let counts = |obstacle: &&Obstacle| !is_real_plate(obstacle);
    let counting: Vec<_> = workcell.obstacles.iter().filter(counts).collect();
    let poses = robot.fk(&JointVector::zeros());
    let standing = if dry_run.is_some() { &[] } else { plates };
    let tilted: Vec<_> = (0..standing.len()).filter(|&i| !standing[i].is_level()).collect();
    // If all plates lie level on the ground, the base does not count.
    let arm = match tilted.is_empty() && counting.iter().all(|obstacle| obstacle.is_ground()) {
        true => Vec::new(),
        false => world_with(robot, |body| body == 0, &Tool::none(robot), &[])?,
    };
    let mut bodies: Vec<Body> = Vec::with_capacity(standing.len());
    for (i, plate) in standing.iter().enumerate() {
        let body = plate_body(i, plate, bodies.last());
        bodies.push(body);
    }
    let in_base = |&i: &usize| in_base(i, &bodies[i], &arm, &poses);
    let mut found: Vec<_> = tilted.iter().filter_map(in_base).collect();
    for obstacle in counting {
        let body = obstacle_body(&Obstacle {
            margin_m: 0.0,
            ..obstacle.clone()
        })?;
        let stays = |link: &&Body| !obstacle.is_ground() && link.kind == BodyKind::Link(0);
        let touch_m = match obstacle.shape {
            ObstacleShape::Parts(_) => TOUCH_M + SHEET_M,
            _ => TOUCH_M,
        };
        let free = bodies
            .iter()
            .enumerate()
            .filter(|(i, _)| !obstacle.holds_plates.contains(i));
        for other in free.map(|(_, plate)| plate).chain(arm.iter().filter(stays)) {
            let by_m = overlap(&body, other, &poses);
            // NaN is no overlap that could be told: poses are finite.
            if by_m > touch_m {
                let (name, other) = (obstacle.name.clone(), other.name.clone());
                let standing = match obstacle.shape {
                    ObstacleShape::Parts(_) => FixedBody::Parts(name),
                    _ => FixedBody::Obstacle(name),
                };
                found.push(FixedOverlap {
                    body: standing,
                    other,
                    by_m,
                });
            }
        }
    }
    Ok(found)
}

impl ClearanceModel {
    /// Returns the overlap with the base of a plate that is not level with it, if there is one.
    #[must_use]
    pub fn plate_in_base(&self, plate: usize) -> Option<FixedOverlap> {
        let here = self.bodies.iter().find(|body| body.kind == BodyKind::Plate(plate))?;
        let poses = self.robot.fk(&JointVector::zeros());
        let tilted = self
            .plates
            .get(plate)
            .filter(|plate| !from_base(self.to_base.as_ref(), plate).is_level());
        tilted.and_then(|_| in_base(plate, here, &self.bodies, &poses))
    }
}

/// Returns the overlap of a plate with the base, which is among `bodies`, if there is one.
fn in_base(index: usize, plate: &Body, bodies: &[Body], poses: &BodyPoses) -> Option<FixedOverlap> {
    let mut base = bodies.iter().filter(|body| body.kind == BodyKind::Link(0));
    base.find_map(|link| {
        let by_m = overlap(plate, link, poses);
        (by_m > TOUCH_M).then(|| FixedOverlap {
            body: FixedBody::Plate(index),
            other: link.name.clone(),
            by_m,
        })
    })
}

/// Upper bound on the depth by which two bodies overlap \[m\]; 0 if they do not.
fn overlap(a: &Body, b: &Body, poses: &BodyPoses) -> f64 {
    let outer = [a, b].map(|body| place(std::slice::from_ref(body), poses).remove(0));
    let near = |p: &PlacedPart<'_>, r: &PlacedPart<'_>| p.sphere_gap(r) <= 0.0;
    let [first, second] = &outer;
    let meet = first
        .iter()
        .any(|p| second.iter().any(|r| near(p, r) && depth(p, r) > 0.0));
    if !meet {
        return 0.0;
    }
    let [first, second] = [a, b].map(|body| body.parts.iter().map(|part| part.place(poses)).collect::<Vec<_>>());
    let pairs = first.iter().flat_map(|p| second.iter().map(move |r| (p, r)));
    pairs
        .filter(|(p, r)| near(p, r))
        .map(|(p, r)| depth(p, r))
        .fold(0.0, f64::max)
}

/// Lower bound on the distance of two plates \[m\], negative if they overlap: for parallel plates seen along their axis, for others by
/// their bodies. It is 0 if one lies over the other, or both are faces of one disc. The arm gives the frames; both plates are in its base
/// frame.
#[must_use]
pub fn gap_of_plates(robot: &RobotModel, a: &Plate, b: &Plate) -> f64 {
    if a.is_over(b) || b.is_over(a) || a.is_back_of(b) {
        return 0.0;
    }
    if a.is_parallel(b) {
        return a.gap_beside_m(b);
    }
    gap_of_bodies(robot, a, b)
}

/// Lower bound on the distance of the bodies of two plates \[m\].
fn gap_of_bodies(robot: &RobotModel, a: &Plate, b: &Plate) -> f64 {
    let poses = robot.fk(&Vector6::zeros());
    let [a, b] = [a, b].map(|plate| plate_body(0, plate, None));
    let whole = least(a.outer(), b.outer(), &poses);
    if whole > 0.0 {
        return whole;
    }
    least(parts(&a), parts(&b), &poses)
}

fn parts(body: &Body) -> &[Part] {
    &body.parts
}

fn least(a: &[Part], b: &[Part], poses: &BodyPoses) -> f64 {
    let mut least = f64::INFINITY;
    for part in a {
        let placed = part.place(poses);
        for other in b {
            let other = other.place(poses);
            if placed.sphere_gap(&other) < least {
                let (_, at_least) = bracketed(&placed, &other);
                least = least.min(at_least);
            }
        }
    }
    least
}
