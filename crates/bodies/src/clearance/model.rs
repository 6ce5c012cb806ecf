//! Distances of all pairs at one configuration.

use crate::clearance::body::{Ball, Body, BodyKind, is_of_arm, part_pairs, place, plate_body, world};
use crate::clearance::crowd::{Crowd, Pairs};
use crate::clearance::distance::{Separation, bracketed};
use crate::clearance::error::ClearanceError;
use crate::clearance::pair_clearance::{PairClearance, required_of};
use crate::clearance::pairs::{self, always_touching};
use crate::clearance::part::PlacedPart;
use crate::clearance::still::{Still, StillPair, still};
use crate::clearance::tree::Order;
use platewash_kinematics::{BodyPoses, JointVector, Pose, RobotModel};
use platewash_workcell::Workcell;
use platewash_workcell::plate::Plate;

/// The two bodies of a model that are nearest to each other at one configuration, with their nearest points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestBodies {
    /// The two bodies, by index in [`ClearanceModel::body_names`].
    pub bodies: [usize; 2],
    /// Distance \[m\]; ≤ 0 if they touch or overlap.
    pub distance_m: f64,
    /// Nearest point of each body \[m\], base frame; if they overlap, one point of their common part, or two.
    pub points_m: [[f64; 3]; 2],
}

/// Bodies and pairs of one job, ready for many configurations.
#[derive(Debug, Clone)]
pub struct ClearanceModel {
    pub(crate) robot: RobotModel,
    pub(crate) bodies: Vec<Body>,
    /// Spheres that hold the bodies.
    pub(crate) balls: Vec<Ball>,
    pub(crate) pairs: Vec<(usize, usize)>,
    /// Pairs whose distance no joint changes. Pairs that are checked may be among them.
    pub(crate) still: Vec<Still>,
    /// Pairs that need not keep all of the required clearance.
    pub(crate) reduced: pairs::ReducedPairs,
    /// Pairs with bounded obstacles, and below all others.
    pub(crate) crowd: Crowd,
    pub(crate) others: Pairs,
    /// Pose of the world in the base frame, `T_base_world`, if they differ.
    pub(crate) to_base: Option<Pose>,
    /// Plates, world frame.
    pub(crate) plates: Vec<Plate>,
    /// Link and axis on which the tool is mounted, if stated.
    mounted_on: Option<String>,
}

impl ClearanceModel {
    /// Builds the model of an arm in its workcell, with the plates, both in the world.
    ///
    /// Pairs: links with each other; the tool's bodies with the links; every moving body with the obstacles and the plates. Pairs that the
    /// workcell excludes are left out.
    ///
    /// # Errors
    /// [`ClearanceError::FlatHull`] for a mesh without volume, [`ClearanceError::NotReducible`] for a pair that cannot have a clearance of
    /// its own.
    pub fn new(robot: &RobotModel, workcell: &Workcell, plates: &[Plate]) -> Result<Self, ClearanceError> {
        let to_base = (!workcell.is_in_base_frame()).then(|| workcell.mount.inverse());
        let mut bodies = world(robot, &workcell.tool, &workcell.obstacles_from_base())?;
        for (i, plate) in plates.iter().enumerate() {
            let body = plate_body(i, &from_base(to_base.as_ref(), plate), bodies.last());
            bodies.push(body);
        }
        let pairs = pairs::choose(&bodies, &workcell.exclusions);
        let still = still(robot, &workcell.tool, &bodies);
        let reduced = pairs::reduced(&bodies, &pairs, &still, &workcell.reduced_clearances)?;
        let (crowd, others) = Crowd::among(&bodies, &pairs, &robot.fk(&JointVector::zeros()));
        Ok(Self {
            pairs,
            still,
            reduced,
            crowd,
            others,
            robot: robot.clone(),
            balls: bodies.iter().map(Ball::around).collect(),
            bodies,
            to_base,
            plates: plates.to_vec(),
            mounted_on: workcell.tool.mounted_on.clone(),
        })
    }

    /// Returns the model of the same arm and tool among as many plates that lie elsewhere. The pairs do not depend on the positions of the
    /// plates, and the arm's bodies are reused.
    #[must_use]
    pub fn among(&self, plates: &[Plate]) -> Self {
        let mut model = self.clone();
        model.lay(plates);
        model
    }

    /// Same as [`ClearanceModel::among`], in place.
    pub fn lay(&mut self, plates: &[Plate]) {
        for (here, plate) in self.plates.iter_mut().zip(plates) {
            *here = *plate;
        }
        for (body, ball) in self.bodies.iter_mut().zip(&mut self.balls) {
            if let BodyKind::Plate(index) = body.kind
                && let Some(plate) = plates.get(index)
            {
                *body = plate_body(index, &from_base(self.to_base.as_ref(), plate), Some(body));
                *ball = Ball::around(body);
            }
        }
    }

    /// Names of the bodies of each pair that is checked.
    #[must_use]
    pub fn pair_names(&self) -> Vec<(&str, &str)> {
        let name = |i: usize| self.bodies[i].name.as_str();
        self.pairs.iter().map(|&(a, b)| (name(a), name(b))).collect()
    }

    /// Names of the bodies.
    #[must_use]
    pub fn body_names(&self) -> Vec<&str> {
        self.bodies.iter().map(|body| body.name.as_str()).collect()
    }

    /// True if the body of that name is an obstacle, and not of the arm, its tool or the plates.
    #[must_use]
    pub fn is_obstacle(&self, name: &str) -> bool {
        let stands_around = |body: &Body| matches!(body.kind, BodyKind::Obstacle | BodyKind::Floor);
        self.bodies.iter().any(|body| body.name == name && stands_around(body))
    }

    /// True if the body of that name is of the arm or its tool.
    #[must_use]
    pub fn is_of_arm(&self, name: &str) -> bool {
        is_of_arm(&self.bodies, name)
    }

    /// True if a pair, by index, touches in each of some configurations spread over the limits of the joints, as links that share a joint or
    /// surround each other do.
    #[must_use]
    pub fn touches_in_samples(&self, pair: usize) -> bool {
        let pairs = [self.pairs[pair]];
        !always_touching(&self.robot, &self.bodies, &pairs, vec![0]).is_empty()
    }

    /// Returns the pairs whose distance no joint changes, with their distances: a link over a half-space that joint 1 turns about its
    /// normal, and bodies of the tool round about axis 6 beside the link that carries joint 6. Pairs that are checked at each configuration
    /// are not among them.
    #[must_use]
    pub fn still_pairs(&self) -> Vec<StillPair> {
        let once = self.still.iter().filter(|still| !self.pairs.contains(&still.pair));
        let measured =
            once.filter_map(|still| still.measured(&self.robot, &self.bodies, |a, b| self.reduced_by_m(a, b)));
        measured.collect()
    }

    /// Distances of all pairs at `q` \[rad\], in the order of [`ClearanceModel::pair_names`].
    #[must_use]
    pub fn all(&self, q: &JointVector) -> Vec<PairClearance> {
        let poses = self.robot.fk(q);
        let placed = place(&self.bodies, &poses);
        let all = self.pairs.iter().map(|&(a, b)| {
            let least = self
                .part_pairs(a, b)
                .filter_map(|parts| self.separation(a, b, parts, (&placed, &poses), f64::INFINITY));
            self.describe(a, b, nearest(least))
        });
        all.collect()
    }

    /// Returns the pair with the smallest distance at `q` \[rad\]. The sponge may touch the plates in `working`.
    ///
    /// `None` if there is nothing to check: a description without collision geometry.
    #[must_use]
    pub fn smallest(&self, q: &JointVector, working: &[usize]) -> Option<PairClearance> {
        let (a, b, found) = self.least(q, |a, b| !self.exempt(a, b, working))?;
        Some(self.describe(a, b, found))
    }

    /// Same as [`ClearanceModel::smallest`] among the pairs that must keep all of the required clearance, with both of the nearest points.
    #[must_use]
    pub fn nearest(&self, q: &JointVector, working: &[usize]) -> Option<NearestBodies> {
        let counts = |a, b| !self.exempt(a, b, working) && self.reduced_by_m(a, b) == 0.0;
        let (a, b, found) = self.least(q, counts)?;
        Some(NearestBodies {
            bodies: [a, b],
            distance_m: found.distance,
            points_m: found.points(),
        })
    }

    /// Returns the pair with the smallest distance, among those that count.
    fn least(&self, q: &JointVector, counts: impl Fn(usize, usize) -> bool) -> Option<(usize, usize, Separation)> {
        let poses = self.robot.fk(q);
        let placed = place(&self.bodies, &poses);
        let mut best: Option<(usize, usize, Separation)> = None;
        let mut candidates: Vec<_> = self
            .pairs
            .iter()
            .filter(|&&(a, b)| counts(a, b))
            .flat_map(|&(a, b)| self.part_pairs(a, b).map(move |(p, r)| (a, b, p, r)))
            .map(|(a, b, p, r)| (placed[a][p].sphere_gap(&placed[b][r]), a, b, p, r))
            .collect();
        candidates.sort_by(|x, y| x.0.total_cmp(&y.0));
        for (at_least, a, b, p, r) in candidates {
            if best.as_ref().is_some_and(|(.., s)| at_least >= s.distance) {
                break;
            }
            let below = best.as_ref().map_or(f64::INFINITY, |(.., s)| s.distance);
            let found = self.separation(a, b, (p, r), (&placed, &poses), below);
            if let Some(found) = found
                && best.as_ref().is_none_or(|(.., s)| found.distance < s.distance)
            {
                best = Some((a, b, found));
            }
        }
        best
    }

    /// Returns all pairs that are in contact or nearer than `required_m` at `q` \[rad\], nearest first. The sponge may touch the plates in
    /// `working`.
    #[must_use]
    pub fn too_near(&self, q: &JointVector, working: &[usize], required_m: f64) -> Vec<PairClearance> {
        let poses = self.robot.fk(q);
        let placed = place(&self.bodies, &poses);
        let pairs = self.pairs.iter().filter(|&&(a, b)| !self.exempt(a, b, working));
        let near = pairs.map(|&(a, b)| {
            let candidates = self.part_pairs(a, b);
            let required_m = required_of(required_m, self.reduced_by_m(a, b));
            let candidates = candidates.filter(|&(p, r)| placed[a][p].sphere_gap(&placed[b][r]) <= required_m);
            // A pair at this distance or beyond is not too near.
            let below = required_m.max(f64::MIN_POSITIVE);
            let found = candidates.filter_map(|parts| self.separation(a, b, parts, (&placed, &poses), below));
            self.describe(a, b, nearest(found))
        });
        let mut near: Vec<_> = near.filter(|pair| !pair.is_clear(required_m)).collect();
        near.sort_by(|x, y| x.distance_m.total_cmp(&y.distance_m));
        near
    }

    /// True if the sponge may be near a plate while it works on another one, or on that one itself.
    pub(crate) fn may_touch(&self, working_on: usize, plate: usize) -> bool {
        let beside = || self.plates.get(working_on).zip(self.plates.get(plate));
        working_on == plate || beside().is_some_and(|(own, other)| own.may_touch_beside(other) || own.is_back_of(other))
    }

    fn exempt(&self, a: usize, b: usize, working: &[usize]) -> bool {
        match (self.bodies[a].kind, self.bodies[b].kind) {
            (BodyKind::Sponge, BodyKind::Plate(i)) | (BodyKind::Plate(i), BodyKind::Sponge) => working.contains(&i),
            _ => false,
        }
    }

    pub(crate) fn part_pairs(&self, a: usize, b: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        part_pairs(&self.bodies[a], &self.bodies[b])
    }

    /// Returns the distance of two bodies by a pair of their outer parts, between bounds. For a body with a tree it is that of its parts if
    /// less than `below` \[m\]; otherwise `None`, or a distance not below it.
    fn separation(
        &self,
        a: usize,
        b: usize,
        (p, r): (usize, usize),
        (placed, poses): (&[Vec<PlacedPart<'_>>], &BodyPoses),
        below: f64,
    ) -> Option<Separation> {
        let (outer, at_least) = bracketed(&placed[a][p], &placed[b][r]);
        if at_least >= below {
            return Some(outer);
        }
        self.within((a, b), (p, r), poses, |p, r| bracketed(p, r).0, below)
            .unwrap_or(Some(outer))
    }

    /// Returns the distance of the parts of a body with a tree to a part of another one, if it is less than `below` \[m\]; `None` if
    /// neither body has one.
    pub(crate) fn within(
        &self,
        (a, b): (usize, usize),
        (p, r): (usize, usize),
        poses: &BodyPoses,
        measure: impl Fn(&PlacedPart<'_>, &PlacedPart<'_>) -> Separation,
        below: f64,
    ) -> Option<Option<Separation>> {
        let (first, second) = (&self.bodies[a], &self.bodies[b]);
        match (&first.tree, &second.tree) {
            (_, Some(tree)) => {
                let other = (&first.outer()[p], Order::TreeSecond);
                Some(tree.nearest(&second.parts, other, poses, (measure, below)))
            }
            (Some(tree), None) => {
                let other = (&second.outer()[r], Order::TreeFirst);
                Some(tree.nearest(&first.parts, other, poses, (measure, below)))
            }
            (None, None) => None,
        }
    }

    pub(crate) fn describe(&self, a: usize, b: usize, found: Separation) -> PairClearance {
        PairClearance {
            a: self.bodies[a].name.clone(),
            b: self.bodies[b].name.clone(),
            distance_m: found.distance,
            place_m: found.place,
            has_hull: [a, b].iter().any(|&body| self.bodies[body].has_hull()),
            mounted_on: self.mounted_on.clone().filter(|_| {
                [a, b]
                    .iter()
                    .any(|&body| matches!(self.bodies[body].kind, BodyKind::Tool | BodyKind::Sponge))
            }),
            reduced_by_m: self.reduced_by_m(a, b),
        }
    }

    /// Part of the required clearance that a pair need not keep \[m\]: 0 for most pairs.
    pub(crate) fn reduced_by_m(&self, a: usize, b: usize) -> f64 {
        let of_pair = self.reduced.iter().find(|(pair, _)| *pair == (a, b));
        of_pair.map_or(0.0, |(_, by_m)| *by_m)
    }
}

/// Converts a plate from the world to the base frame.
pub(crate) fn from_base(to_base: Option<&Pose>, plate: &Plate) -> Plate {
    to_base.map_or(*plate, |to_base| plate.seen_from(to_base))
}

pub(crate) fn nearest(separations: impl Iterator<Item = Separation>) -> Separation {
    separations
        .min_by(|x, y| x.distance.total_cmp(&y.distance))
        .unwrap_or(Separation {
            distance: f64::INFINITY,
            place: [0.0; 3],
            normal: [0.0; 3],
        })
}
