//! The obstacles that have an end, in a tree of boxes: those that a part of arm or tool is far from are passed over many at once.

use super::body::{Body, BodyKind};
use super::part::Placed;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use platewash_kinematics::BodyPoses;

/// Pairs of bodies, by their indices.
pub(super) type Pairs = Vec<(usize, usize)>;

/// Obstacles, and what must keep clear of which.
#[derive(Debug, Clone)]
pub(super) struct Crowd {
    /// Its leaves are the obstacles.
    tree: Bvh,
    /// The bodies that are its leaves, in order, each with the box around it along the axes of the base.
    obstacles: Vec<(usize, Aabb)>,
    /// Each body that moves, with the leaves that it is checked with.
    pub moving: Vec<(usize, Vec<bool>)>,
}

impl Crowd {
    /// The crowd among some pairs, and all other pairs. An arm lends its frames, whose base is where obstacles stand.
    pub fn among(bodies: &[Body], pairs: &[(usize, usize)], poses: &BodyPoses) -> (Self, Pairs) {
        let stands = |body: &Body| body.kind == BodyKind::Obstacle;
        let standing = bodies.iter().enumerate().filter(|(_, body)| stands(body));
        let obstacles: Vec<_> = standing
            .filter_map(|(index, body)| Some((index, around(body, poses)?)))
            .collect();
        let leaf_of = |body: usize| obstacles.iter().position(|(index, _)| *index == body);
        let (mut others, mut moving) = (Vec::new(), Vec::<(usize, Vec<bool>)>::new());
        for &(a, b) in pairs {
            // What stands follows what moves: it is the second of a pair.
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

    /// The obstacles, of those that `leaves` lets in, whose box is not far from a part: `is_enough` tells of a distance \[m\] whether it is.
    pub fn near<'a>(
        &'a self,
        leaves: &'a [bool],
        part: &'a Placed<'a>,
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

/// Distance of two boxes; 0 where they overlap \[m\].
fn gap_m(a: &Aabb, b: &Aabb) -> f64 {
    let beyond = (a.mins - b.maxs).max(b.mins - a.maxs);
    beyond.max(Vector::ZERO).length()
}

/// The box around a body that stands still; `None` of half-spaces.
fn around(body: &Body, poses: &BodyPoses) -> Option<Aabb> {
    let parts = body.outer().iter().map(|part| part.place(poses));
    let boxes = parts.map(|part| part.outwards().is_none().then(|| around_part(&part)));
    let all: Option<Vec<_>> = boxes.collect();
    all?.into_iter()
        .reduce(|a, b| Aabb::new(a.mins.min(b.mins), a.maxs.max(b.maxs)))
}

/// The box around a part with an end, where it is now.
fn around_part(part: &Placed<'_>) -> Aabb {
    let along = |way: [Vector; 3]| Vector::from(way.map(|way| part.support(way)));
    let ways = [Vector::X, Vector::Y, Vector::Z];
    Aabb::new(-along(ways.map(|way| -way)), along(ways))
}

#[cfg(test)]
mod tests;
