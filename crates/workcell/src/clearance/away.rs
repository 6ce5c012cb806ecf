//! How far a body that the arm carries is from many that stand still, at once: bounds that are quick and good enough for what is far.
//!
//! Along any direction n the gap min n·b − max n·a is a lower bound of the distance of two parts. The direction that is tried leads from the point
//! of the standing part that is nearest to the middle of the moving one to that middle: the better, the farther they are apart.

use super::body::BodyKind;
use super::distance::nearest_to;
use super::lever::{self, Levers};
use super::model::ClearanceModel;
use super::motion::ROUNDING_M;
use super::part::{Part, Placed};
use platewash_kinematics::{BodyPoses, JointVector};

/// A part of a body that the arm carries, and the obstacles that it must keep clear of.
#[derive(Debug)]
pub struct MovingPart<'a> {
    part: &'a Part,
    greatest: Levers,
    obstacles: Vec<Standing<'a>>,
}

/// An obstacle, placed.
struct Standing<'a> {
    pair: usize,
    parts: Vec<Placed<'a>>,
}

impl std::fmt::Debug for Standing<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Standing({})", self.pair)
    }
}

impl ClearanceModel {
    /// The parts of what moves, each with the obstacles of some pairs, by their index; pairs of anything else are left aside, half-spaces among them.
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
                let standing = |&(pair, body): &(usize, usize)| Standing {
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
    /// How many obstacles it must keep clear of.
    #[must_use]
    pub fn obstacle_count(&self) -> usize {
        self.obstacles.len()
    }

    /// The pair of an obstacle, by its index in the model.
    #[must_use]
    pub fn pair(&self, obstacle: usize) -> Option<usize> {
        self.obstacles.get(obstacle).map(|standing| standing.pair)
    }

    /// How far no point of the part is displaced from where it is in the configuration of `poses` while each joint is within `drift` of that \[rad\], \[m\].
    #[must_use]
    pub fn displaced(&self, poses: &BodyPoses, drift: &JointVector) -> f64 {
        let point = poses.rigid(&self.part.frame()).translation;
        let here = self.part.widened(&lever::at(poses, self.part.body(), &point));
        lever::within(&here, drift, &self.greatest).dot(drift)
    }

    /// Lower bounds of the distances from some of the obstacles \[m\], by their place in the list.
    pub fn gaps<'b>(&'b self, poses: &BodyPoses, obstacles: &'b [usize]) -> impl Iterator<Item = f64> + 'b {
        let placed = self.part.place(poses);
        let of = move |standing: &Standing<'_>| {
            standing
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

/// A lower bound of the distance of a standing and a moving part \[m\], rounding included.
fn gap(standing: &Placed<'_>, moving: &Placed<'_>) -> f64 {
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
