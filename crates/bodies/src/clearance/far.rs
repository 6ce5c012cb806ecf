//! Lower bounds on the distances of a body that the arm carries from many fixed bodies at once. They are quick, and good enough for far
//! bodies.
//!
//! Along any direction n the gap min n·b − max n·a is a lower bound of the distance of two parts. The direction used leads from the point
//! of the fixed part that is nearest to the middle of the moving one to that middle: it is the better the farther they are apart.

use crate::clearance::body::BodyKind;
use crate::clearance::distance::{DISTANCE_ROUNDING_M, nearest_to};
use crate::clearance::lever::{self, Levers};
use crate::clearance::model::ClearanceModel;
use crate::clearance::part::{Part, PlacedPart};
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

    /// Upper bound on the displacement of the part's points from the configuration of `poses` \[m\], Σ ρ |Δq| of formula (24.2) in
    /// `docs/certificate.md`. `drift` is |Δq| \[rad\].
    #[must_use]
    pub fn displaced(&self, poses: &BodyPoses, drift: &JointVector) -> f64 {
        let point = poses.rigid(&self.part.frame()).translation;
        let here = self.part.widened(&lever::at(poses, self.part.body(), &point));
        lever::within(&here, drift, &self.greatest).dot(drift)
    }

    /// Returns lower bounds g of the distances from some obstacles \[m\], for formula (24.2), by their index in the list.
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
        return spheres - DISTANCE_ROUNDING_M;
    }
    let normal = away / length;
    let along = -moving.support(-normal) - standing.support(normal);
    spheres.max(along) - DISTANCE_ROUNDING_M
}
