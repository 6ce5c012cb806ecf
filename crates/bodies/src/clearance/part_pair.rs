//! A pair of parts: its distance at a moment, and what bounds it from there on while the joints move. The bound over a stretch of time is
//! put together in the certificate, `clearance/search.rs`.
//!
//! A pair of bodies is a list of pairs of convex parts, one of them *fixed*, on the earlier body of the chain, and one *moving*. In the
//! frame of the fixed part only the joints between the two bodies move the other. If a body has many parts, shapes that hold some of them
//! come first: a body far from a shape is far from its parts ([`PartPairs`]).
//!
//! - **First order.** No point of the moving part is displaced by more than Σ_j ρ_j |Δq_j|, so that the distance does
//!   not fall by more (ρ: [`super::lever`]).
//! - **Second order.** Along a direction n fixed to the fixed part, the gap g = min n·b − max n·a over the points of both parts
//!   is a lower bound of the distance, for any n. Each n·b is a continuous function of time whose second derivative is bounded by
//!   A = sup ‖b̈‖, but at moments at which the speeds of joints jump by Δq̇: there its first one jumps by Σ_j ρ_j |Δq̇_j| at most.
//!   Between two times h apart it is therefore at least the smaller of its end values less A h²/8 and less h/4 of each such jump,
//!   and so is g (proof: `docs/certificate.md`, (24.3)).
//!
//! No function here allocates.

use crate::clearance::body::BodyKind;
use crate::clearance::distance::{DISTANCE_ROUNDING_M, bracketed};
use crate::clearance::lever::{self, Levers};
use crate::clearance::model::ClearanceModel;
use crate::clearance::part::{Part, PlacedPart};
use parry3d_f64::math::Vector;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{BodyPoses, JointVector};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;

/// Kind of a pair, for rules that depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairKind {
    /// The sponge and a plate.
    SpongeAndPlate(usize),
    /// Any other pair.
    Other,
}

/// Two convex parts, with the joints between them and their levers.
#[derive(Debug, Clone)]
pub struct PartPair<'a> {
    fixed: &'a Part,
    moving: &'a Part,
    /// Indices of the joints that move one part in the frame of the other.
    joints: Range<usize>,
    /// Levers of the moving part that hold in every configuration.
    greatest: Levers,
}

/// Pairs of parts of two bodies, from the outside in: a pair of shapes that hold parts contains further pairs, and bounds their distances
/// from below; the innermost pairs are parts themselves.
#[derive(Debug, Clone)]
pub struct PartPairs<'a> {
    pairs: Vec<PartPair<'a>>,
    /// Ranges of the pairs that each pair contains.
    within: Vec<Range<usize>>,
    outermost: usize,
}

impl<'a> PartPairs<'a> {
    /// Indices of the outermost pairs, which contain all others.
    #[must_use]
    pub fn outermost(&self) -> Range<usize> {
        0..self.outermost
    }

    /// True if one of the bodies has many parts.
    #[must_use]
    pub fn is_of_many(&self) -> bool {
        self.pairs.len() > self.outermost
    }

    /// Returns a pair by its index.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&PartPair<'a>> {
        self.pairs.get(index)
    }

    /// Indices of the pairs that a pair contains; empty for a pair of parts.
    #[must_use]
    pub fn within(&self, index: usize) -> Range<usize> {
        self.within.get(index).cloned().unwrap_or_default()
    }

    /// Returns the pairs of parts.
    pub fn parts(&self) -> impl Iterator<Item = &PartPair<'a>> {
        let innermost = self.pairs.iter().zip(&self.within);
        innermost.filter(|(_, within)| within.is_empty()).map(|(pair, _)| pair)
    }
}

/// Moving part of a pair at one configuration.
#[derive(Debug, Clone)]
pub struct Mover<'a> {
    part: &'a Part,
    poses: &'a BodyPoses,
    rigid: RigidTransform,
    placed: OnceCell<PlacedPart<'a>>,
}

impl Mover<'_> {
    /// Poses of the arm's bodies.
    #[must_use]
    pub fn poses(&self) -> &BodyPoses {
        self.poses
    }

    fn placed(&self) -> &PlacedPart<'_> {
        self.placed.get_or_init(|| self.part.place_at(&self.rigid))
    }
}

/// Distance of two parts at one configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartDistance {
    /// Distance found \[m\]; ≤ 0 if they touch or overlap.
    pub distance_m: f64,
    /// Proved lower bound of the distance \[m\]: the gap along `normal` if the parts do not overlap.
    pub at_least_m: f64,
    /// Midpoint between the nearest points \[m\], base frame.
    pub place_m: [f64; 3],
    /// Direction from the fixed part to the moving one, in the frame of the fixed part; `None` if they overlap.
    pub normal: Option<[f64; 3]>,
}

impl ClearanceModel {
    /// Number of pairs, in the order of [`ClearanceModel::pair_names`].
    pub fn pair_count(&self) -> usize {
        self.pairs.len()
    }

    /// Returns the kind of a pair.
    pub fn pair_kind(&self, pair: usize) -> PairKind {
        let (a, b) = self.pairs[pair];
        match (self.bodies[a].kind, self.bodies[b].kind) {
            (BodyKind::Sponge, BodyKind::Plate(i)) | (BodyKind::Plate(i), BodyKind::Sponge) => {
                PairKind::SpongeAndPlate(i)
            }
            _ => PairKind::Other,
        }
    }

    /// Part of the required clearance that a pair need not keep \[m\]: 0 for most pairs.
    pub fn reduced_by_m_of(&self, pair: usize) -> f64 {
        let (a, b) = self.pairs[pair];
        self.reduced_by_m(a, b)
    }

    /// True if one of a pair is a bounded obstacle, not a half-space.
    pub fn is_beside_obstacle(&self, pair: usize) -> bool {
        let (a, b) = self.pairs[pair];
        [a, b].iter().any(|&body| self.bodies[body].kind == BodyKind::Obstacle)
    }

    /// Returns the pairs of parts of a pair of bodies.
    pub fn parts_of(&self, pair: usize) -> PartPairs<'_> {
        let zero = self.robot.fk(&JointVector::zeros());
        let (a, b) = self.pairs[pair];
        let (first, second) = (&self.bodies[a], &self.bodies[b]);
        let outer = self.part_pairs(a, b);
        let mut pairs: Vec<_> = outer
            .map(|(p, r)| PartPair::new(&first.outer()[p], &second.outer()[r], &zero))
            .collect();
        let outermost = pairs.len();
        let mut within = vec![0..0; outermost];
        let (tree, body, others) = match (&first.tree, &second.tree) {
            (_, Some(tree)) => (tree, second, first),
            (Some(tree), None) => (tree, first, second),
            (None, None) => {
                return PartPairs {
                    pairs,
                    within,
                    outermost,
                };
            }
        };
        for (held, other) in others.outer().iter().enumerate() {
            let groups = pairs.len()..pairs.len() + tree.groups.len();
            within[held] = groups.clone();
            pairs.extend(tree.groups.iter().map(|group| PartPair::new(other, &group.ball, &zero)));
            within.resize(groups.end, 0..0);
            for (at, group) in groups.zip(&tree.groups) {
                within[at] = pairs.len()..pairs.len() + group.members.len();
                let parts = body.parts[group.members.clone()].iter();
                pairs.extend(parts.map(|part| PartPair::new(other, part, &zero)));
                within.resize(pairs.len(), 0..0);
            }
        }
        PartPairs {
            pairs,
            within,
            outermost,
        }
    }
}

impl<'a> PartPair<'a> {
    fn new(a: &'a Part, b: &'a Part, zero: &BodyPoses) -> Self {
        let (fixed, moving) = if a.body() <= b.body() { (a, b) } else { (b, a) };
        let joints = fixed.body()..moving.body();
        let point = zero.rigid(&moving.frame()).translation;
        let greatest = moving.widened(&lever::greatest(zero, moving.body(), &point));
        Self {
            fixed,
            moving,
            greatest: lever::from(&greatest, joints.start),
            joints,
        }
    }

    /// Returns the moving part where it is at some poses.
    pub fn mover<'p>(&self, poses: &'p BodyPoses) -> Mover<'p>
    where
        'a: 'p,
    {
        Mover {
            part: self.moving,
            poses,
            rigid: self.moving.rigid(poses),
            placed: OnceCell::new(),
        }
    }

    /// Returns `mover` if it is the moving part of this pair too, otherwise that part at the same poses.
    pub fn mover_as<'m, 'p>(&self, mover: &'m Mover<'p>) -> Cow<'m, Mover<'p>>
    where
        'a: 'p,
    {
        if std::ptr::eq(self.moving, mover.part) {
            Cow::Borrowed(mover)
        } else {
            Cow::Owned(self.mover(mover.poses))
        }
    }

    /// A lower bound of the distance from spheres around the parts \[m\].
    pub fn sphere_gap(&self, mover: &Mover<'_>) -> f64 {
        self.fixed
            .sphere_gap(&self.fixed.rigid(mover.poses), self.moving, &mover.rigid)
    }

    /// Lower bound of the distance from the moving part and a sphere around the fixed one \[m\]; exact up to rounding if the moving part is
    /// a capsule or a cylinder.
    pub fn gap_to_sphere(&self, mover: &Mover<'_>) -> f64 {
        let there = self.fixed.origin(mover.poses);
        self.moving.gap_to_sphere(&mover.rigid, self.fixed, &there) - DISTANCE_ROUNDING_M
    }

    /// Converts a direction from the frame of the fixed part to the base frame.
    pub fn in_base(&self, normal: [f64; 3], poses: &BodyPoses) -> [f64; 3] {
        (self.fixed.place(poses).pose.rotation * Vector::from_array(normal)).to_array()
    }

    /// Measures the distance. Its proved lower bound is g(t_m) of formula (24.2), and its direction an n for formula (24.3).
    pub fn measure(&self, mover: &Mover<'_>) -> PartDistance {
        let (fixed, moving) = (self.fixed.place(mover.poses), mover.placed());
        let (found, at_least) = bracketed(&fixed, moving);
        let normal = (fixed.pose.rotation.inverse() * Vector::from_array(found.normal)).to_array();
        PartDistance {
            distance_m: found.distance,
            at_least_m: at_least - DISTANCE_ROUNDING_M,
            place_m: found.place,
            normal: (normal != [0.0; 3]).then_some(normal),
        }
    }

    /// Gap g along a direction in the frame of the fixed part, formula (24.3): a lower bound of the distance \[m\], rounding included.
    /// `normal` is n.
    pub fn gap_along(&self, normal: [f64; 3], poses: &BodyPoses) -> f64 {
        let fixed = self.fixed.place(poses);
        let normal = fixed.pose.rotation * Vector::from_array(normal);
        gap_between(&fixed, &self.moving.place(poses), normal)
    }

    /// Gap g along a direction in the base frame \[m\], formula (24.3). `normal` is n. If the fixed part stands still, that is a direction
    /// in its frame.
    pub fn gap_along_in_base(&self, normal: [f64; 3], mover: &Mover<'_>) -> f64 {
        gap_between(
            &self.fixed.place(mover.poses),
            mover.placed(),
            Vector::from_array(normal),
        )
    }

    /// Levers ρ of the moving part while each joint is within `drift` \[rad\] of the configuration of `mover`, formula (0.2).
    pub fn levers(&self, mover: &Mover<'_>, drift: &JointVector) -> Levers {
        let point = mover.rigid.translation;
        let here = self.moving.widened(&lever::at(mover.poses, self.moving.body(), &point));
        lever::within(&lever::from(&here, self.joints.start), drift, &self.greatest)
    }

    /// Upper bound A on the acceleration of the moving part's points relative to the fixed part \[m/s²\], formula (24.3). `levers` is ρ,
    /// `speed` is D₁ \[rad/s\], `acceleration` is D₂ \[rad/s²\].
    pub fn acceleration(&self, levers: &Levers, speed: &JointVector, acceleration: &JointVector) -> f64 {
        let first = self.joints.start;
        lever::tuples(levers, first, [acceleration]) + lever::tuples(levers, first, [speed, speed])
    }
}

/// Gap g = min n·b − max n·a between two parts along a direction in the base frame, formula (24.3): a lower bound of the distance \[m\], rounding
/// included. `normal` is n.
fn gap_between(fixed: &PlacedPart<'_>, moving: &PlacedPart<'_>, normal: Vector) -> f64 {
    // Over a half-space there is one direction with a gap, which is fixed to it.
    let outwards = || moving.outwards().map(|outwards| -outwards);
    let normal = fixed.outwards().or_else(outwards).unwrap_or(normal);
    -moving.support(-normal) - fixed.support(normal) - DISTANCE_ROUNDING_M
}
