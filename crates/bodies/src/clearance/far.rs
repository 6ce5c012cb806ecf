//! Lower bounds on the distances of a body that the arm carries from many fixed bodies at once. They are quick, and good enough for far
//! bodies.
//!
//! Along any direction n the gap min n·b − max n·a is a lower bound of the distance of two parts. The direction used leads from the point
//! of the fixed part that is nearest to the middle of the moving one to that middle: it is the better the farther they are apart.
//!
//! The bounded obstacles are in a tree of boxes: many of those far from a part of arm or tool are skipped together.

#[cfg(test)]
mod tests;

use crate::clearance::body::{Body, BodyKind};
use crate::clearance::distance::nearest_to;
use crate::clearance::lever::{self, Levers};
use crate::clearance::model::ClearanceModel;
use crate::clearance::motion::ROUNDING_M;
use crate::clearance::part::{Part, PlacedPart};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use platewash_kinematics::{BodyPoses, JointVector};

/// Part of a body that the arm carries, with the obstacles that it must keep clear of.
#[derive(Debug)]
pub struct MovingPart<'a> {
    part: &'a Part,
    greatest: Levers,
    obstacles: Vec<PlacedObstacle<'a>>,
}

/// Obstacle, placed.
struct PlacedObstacle<'a> {
    pair: usize,
    parts: Vec<PlacedPart<'a>>,
}

impl std::fmt::Debug for PlacedObstacle<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Standing({})", self.pair)
    }
}

impl ClearanceModel {
    /// Returns the parts of the moving bodies, each with the obstacles of the given pairs, by index. Other pairs are ignored, including
    /// those with half-spaces.
    #[must_use]
    pub fn moving_parts(&self, pairs: &[usize]) -> Vec<MovingPart<'_>> {
        let zero = self.robot.fk(&JointVector::zeros());
        let stands = |body: usize| self.bodies[body].kind == BodyKind::Obstacle;
        let mut obstacles_of: std::collections::BTreeMap<usize, Vec<(usize, usize)>> = Default::default();
        for &pair in pairs {
            let Some(&(a, b)) = self.pairs.get(pair) else { continue };
            let (moving, standing) = if stands(a) { (b, a) } else { (a, b) };
            if stands(standing) && !stands(moving) {
                obstacles_of.entry(moving).or_default().push((pair, standing));
            }
        }
        let with_obstacles = |(moving, obstacles): (usize, Vec<(usize, usize)>)| {
            let zero = &zero;
            self.bodies[moving].outer().iter().map(move |part| {
                let standing = |&(pair, body): &(usize, usize)| PlacedObstacle {
                    pair,
                    parts: self.bodies[body].outer().iter().map(|part| part.place(zero)).collect(),
                };
                let point = zero.rigid(&part.frame()).translation;
                MovingPart {
                    part,
                    greatest: part.widened(&lever::greatest(zero, part.body(), &point)),
                    obstacles: obstacles.iter().map(standing).collect(),
                }
            })
        };
        obstacles_of.into_iter().flat_map(with_obstacles).collect()
    }
}

impl MovingPart<'_> {
    /// Number of obstacles that it must keep clear of.
    #[must_use]
    pub fn obstacle_count(&self) -> usize {
        self.obstacles.len()
    }

    /// Returns the index of the pair of an obstacle in the model.
    #[must_use]
    pub fn pair(&self, obstacle: usize) -> Option<usize> {
        self.obstacles.get(obstacle).map(|standing| standing.pair)
    }

    /// Upper bound on the displacement of the part's points from the configuration of `poses` \[m\], while each joint is within `drift`
    /// \[rad\] of it.
    #[must_use]
    pub fn displaced(&self, poses: &BodyPoses, drift: &JointVector) -> f64 {
        let point = poses.rigid(&self.part.frame()).translation;
        let here = self.part.widened(&lever::at(poses, self.part.body(), &point));
        lever::within(&here, drift, &self.greatest).dot(drift)
    }

    /// Returns lower bounds of the distances from some obstacles \[m\], by their index in the list.
    pub fn gaps<'b>(&'b self, poses: &BodyPoses, obstacles: &'b [usize]) -> impl Iterator<Item = f64> + 'b {
        let placed = self.part.place(poses);
        let of = move |obstacle: &PlacedObstacle<'_>| {
            obstacle
                .parts
                .iter()
                .map(|part| gap(part, &placed))
                .fold(f64::INFINITY, f64::min)
        };
        obstacles
            .iter()
            .map(move |&k| self.obstacles.get(k).map_or(f64::NEG_INFINITY, &of))
    }
}

/// Lower bound of the distance of a fixed and a moving part \[m\], rounding included.
fn gap(standing: &PlacedPart<'_>, moving: &PlacedPart<'_>) -> f64 {
    let spheres = standing.sphere_gap(moving);
    let middle = moving.pose.translation;
    let away = middle - nearest_to(standing, middle);
    let length = away.length();
    if length.is_nan() || length <= 0.0 {
        return spheres - ROUNDING_M;
    }
    let normal = away / length;
    let along = -moving.support(-normal) - standing.support(normal);
    spheres.max(along) - ROUNDING_M
}

/// Pairs of bodies, by their indices.
pub(crate) type Pairs = Vec<(usize, usize)>;

/// Obstacles, with the bodies that must keep clear of them.
#[derive(Debug, Clone)]
pub(crate) struct Crowd {
    /// Tree whose leaves are the obstacles.
    tree: Bvh,
    /// Bodies that are its leaves, in order, each with the box around it along the axes of the base.
    obstacles: Vec<(usize, Aabb)>,
    /// Bodies that move, each with the leaves that it is checked with.
    pub moving: Vec<(usize, Vec<bool>)>,
}

impl Crowd {
    /// Separates the pairs with bounded obstacles from all others. The poses give the frames of the arm, whose base frame is that of the
    /// obstacles.
    pub fn among(bodies: &[Body], pairs: &[(usize, usize)], poses: &BodyPoses) -> (Self, Pairs) {
        let stands = |body: &Body| body.kind == BodyKind::Obstacle;
        let standing = bodies.iter().enumerate().filter(|(_, body)| stands(body));
        let obstacles: Vec<_> = standing
            .filter_map(|(index, body)| Some((index, around(body, poses)?)))
            .collect();
        let leaf_of = |body: usize| obstacles.iter().position(|(index, _)| *index == body);
        let (mut others, mut moving) = (Vec::new(), Vec::<(usize, Vec<bool>)>::new());
        for &(a, b) in pairs {
            // The fixed body is the second of a pair, after the moving one.
            let Some(leaf) = leaf_of(b) else {
                others.push((a, b));
                continue;
            };
            let known = moving.iter().position(|(body, _)| *body == a);
            let place = known.unwrap_or_else(|| {
                moving.push((a, vec![false; obstacles.len()]));
                moving.len() - 1
            });
            moving[place].1[leaf] = true;
        }
        let boxes: Vec<_> = obstacles.iter().map(|(_, around)| *around).collect();
        let crowd = Self {
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            obstacles,
            moving,
        };
        (crowd, others)
    }

    /// Returns the obstacles, among those that `leaves` admits, whose box is not far from a part. `is_enough` decides if a distance \[m\]
    /// is far.
    pub fn obstacles_near<'a>(
        &'a self,
        leaves: &'a [bool],
        part: &'a PlacedPart<'a>,
        is_enough: impl Fn(f64) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = usize> + 'a {
        let point = Aabb::new(part.pose.translation, part.pose.translation);
        let candidates = self
            .tree
            .leaves(move |node| !is_enough(gap_m(&node.aabb(), &point) - part.bounding()));
        let mut whole = None;
        candidates.filter_map(move |leaf| {
            let leaf = leaf as usize;
            let (body, stands) = self.obstacles.get(leaf).filter(|_| leaves[leaf])?;
            let part = whole.get_or_insert_with(|| around_part(part));
            (!is_enough(gap_m(stands, part))).then_some(*body)
        })
    }
}

/// Distance of two boxes \[m\]; 0 if they overlap.
fn gap_m(a: &Aabb, b: &Aabb) -> f64 {
    let beyond = (a.mins - b.maxs).max(b.mins - a.maxs);
    beyond.max(Vector::ZERO).length()
}

/// Returns the box around a fixed body; `None` for half-spaces.
fn around(body: &Body, poses: &BodyPoses) -> Option<Aabb> {
    let parts = body.outer().iter().map(|part| part.place(poses));
    let boxes = parts.map(|part| part.outwards().is_none().then(|| around_part(&part)));
    let all: Option<Vec<_>> = boxes.collect();
    all?.into_iter()
        .reduce(|a, b| Aabb::new(a.mins.min(b.mins), a.maxs.max(b.maxs)))
}

/// Returns the box around a bounded part at its current pose.
fn around_part(part: &PlacedPart<'_>) -> Aabb {
    let along = |way: [Vector; 3]| Vector::from(way.map(|way| part.support(way)));
    let ways = [Vector::X, Vector::Y, Vector::Z];
    Aabb::new(-along(ways.map(|way| -way)), along(ways))
}
