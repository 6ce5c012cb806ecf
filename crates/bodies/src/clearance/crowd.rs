//! The bounded obstacles in a tree of boxes: many of those far from a part of arm or tool are skipped together.

#[cfg(test)]
mod tests;

use crate::clearance::body::{Body, BodyKind};
use crate::clearance::part::PlacedPart;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use platewash_kinematics::BodyPoses;

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
