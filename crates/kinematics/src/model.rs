//! Immutable model of a six-axis arm.
//!
//! Frames fixed to the arm's bodies.
//!
//! Forward kinematics: from joint positions to the pose of every frame.
//!
//! The chain is folded once, when the model is built: each joint gets a frame whose z axis is the joint's
//! axis, and the constant transforms between neighbours absorb everything fixed. At run time a joint costs
//! one sine–cosine pair and one product,
//!
//! `T_base_i = T_base_{i−1} · F_i · Rot_z(q_i)`,
//!
//! the product of exponentials written in local frames (Lynch & Park, *Modern Robotics*, ch. 4).
//!
//! Geometric Jacobian and manipulability.

use crate::geometry::{Inertial, Primitive, Shape, Visual, VisualFinding};
use crate::joints::{AXES, JointVector};
use crate::lanes::{Kernel, Vector, run_exact};
use crate::limits::{JointFriction, JointLimits};
use crate::rotation::Pose;
use crate::rotation::{Columns, RigidTransform};
use crate::srdf::DisabledPairs;
use crate::srdf::SrdfError;
use crate::trig::{atan2, sin_cos_vector};
use crate::urdf::fixed::FixedJoints;
use crate::urdf::followers::FollowerLink;
use crate::urdf::unused_statements::UnusedStatement;
use nalgebra::{Matrix3, Matrix6, Point3, Vector3};

/// Revolute joint of the chain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Joint {
    /// Name in the description.
    pub name: String,
    /// Name of the link that carries the joint.
    pub parent: String,
    /// Name of the link that the joint moves.
    pub child: String,
}

/// Link of the description, moving or fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Name in the description.
    pub name: String,
    /// Link frame, fixed to the body that carries it.
    pub frame: Frame,
    /// Collision geometry in the link frame; empty for pure frames.
    pub collision: Vec<Primitive>,
    /// Visuals in the link frame. Those that could not be read are left out ([`RobotModel::visual_findings`]).
    pub visuals: Vec<Visual>,
    /// Mass properties, if stated.
    pub inertial: Option<Inertial>,
}

/// Arm with six revolute axes in series, as its URDF describes it. Immutable once built.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotModel {
    pub(crate) name: String,
    pub(crate) sha256: String,
    pub(crate) joints: [Joint; AXES],
    pub(crate) limits: JointLimits,
    pub(crate) friction: JointFriction,
    pub(crate) unused: Vec<UnusedStatement>,
    pub(crate) left_out: Vec<FollowerLink>,
    pub(crate) folded: [RigidTransform; AXES],
    pub(crate) links: Vec<Link>,
    pub(crate) last_link: Frame,
    pub(crate) disabled: Option<DisabledPairs>,
    pub(crate) visual_findings: Vec<VisualFinding>,
    /// Names of the links whose visuals stand for collision shapes.
    pub(crate) of_visuals: Vec<String>,
    /// Names of the links whose meshes are split into convex parts.
    pub(crate) split: Vec<String>,
    pub(crate) fixed: FixedJoints,
}

impl RobotModel {
    /// Returns the model with a list of link pairs that need no collision check.
    ///
    /// # Errors
    /// [`SrdfError::UnknownLink`] if the list names a link that this arm does not have.
    pub fn with_disabled_pairs(mut self, disabled: DisabledPairs) -> Result<Self, SrdfError> {
        let left_out = self.left_out.iter().map(|left_out| left_out.link.as_str());
        disabled.check_links(self.links.iter().map(|l| l.name.as_str()).chain(left_out))?;
        self.disabled = Some(disabled);
        Ok(self)
    }

    /// Name in the description.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// SHA-256 of the URDF text and of the vertices of its collision meshes or their parts, in lower-case hexadecimal; of the text alone if
    /// there are no meshes.
    #[must_use]
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// The six joints from the base to the tip.
    #[must_use]
    pub fn joints(&self) -> &[Joint; AXES] {
        &self.joints
    }

    /// Moving joints of the description that are held still on request, with their positions \[rad, or m for a prismatic joint\].
    #[must_use]
    pub fn fixed_joints(&self) -> &FixedJoints {
        &self.fixed
    }

    /// Limits of the six joints.
    #[must_use]
    pub fn limits(&self) -> &JointLimits {
        &self.limits
    }

    /// Friction of the six joints.
    #[must_use]
    pub fn friction(&self) -> &JointFriction {
        &self.friction
    }

    /// Links of the description that are left out, as joints carry them that follow an axis (`mimic`): no clearance of them is known.
    #[must_use]
    pub fn left_out_links(&self) -> &[FollowerLink] {
        &self.left_out
    }

    /// Statements of the description that are not used or not complete, other than those that cannot matter (`docs/urdf.md`), in the order
    /// of the file.
    #[must_use]
    pub fn unused_statements(&self) -> &[UnusedStatement] {
        &self.unused
    }

    /// The first of these statements in words, from "what is not used" on, and how many more there are; `None` without any.
    #[must_use]
    pub fn unused_words(&self) -> Option<String> {
        let listed: Vec<_> = self.unused.iter().take(LISTED).map(ToString::to_string).collect();
        let more = match self.unused.len().saturating_sub(LISTED) {
            0 => String::new(),
            more => format!("; and {more} more, which `platewash robot` lists"),
        };
        let listed = listed.join("; ");
        (!listed.is_empty()).then(|| format!("what is not used or not complete: {listed}{more}"))
    }

    /// Every link of the description, ordered from the root outwards.
    #[must_use]
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Names of the links that joints move and that have no collision shapes.
    pub fn links_without_shapes(&self) -> impl Iterator<Item = &str> {
        let has_shapes = |name: &str| self.links.iter().any(|l| l.name == name && !l.collision.is_empty());
        let moved = self.joints.iter().map(|joint| joint.child.as_str());
        moved.filter(move |name| !has_shapes(name))
    }

    /// Names of the links whose visuals stand for collision shapes
    /// ([`MeshSource::with_visual_shapes`](crate::urdf::MeshSource::with_visual_shapes)).
    #[must_use]
    pub fn links_with_visual_shapes(&self) -> &[String] {
        &self.of_visuals
    }

    /// Names of the links that count as convex parts that enclose their meshes
    /// ([`MeshSource::with_split_links`](crate::urdf::MeshSource::with_split_links)).
    #[must_use]
    pub fn split_links(&self) -> &[String] {
        &self.split
    }

    /// Names of the links whose shapes are convex hulls of whole meshes.
    pub fn links_with_hulls(&self) -> impl Iterator<Item = &str> {
        let is_hull = |primitive: &Primitive| matches!(primitive.shape, Shape::Hull { .. });
        let has_hulls = move |link: &&Link| link.collision.iter().any(is_hull) && !self.split.contains(&link.name);
        let with_hulls = self.links.iter().filter(has_hulls);
        with_hulls.map(|link| link.name.as_str())
    }

    /// Visuals that could not be read and are left out. Nothing else depends on them.
    #[must_use]
    pub fn visual_findings(&self) -> &[VisualFinding] {
        &self.visual_findings
    }

    /// Frame of the link behind joint 6.
    #[must_use]
    pub fn last_link_frame(&self) -> Frame {
        self.last_link
    }

    /// True if two links share one of the six joints. A link without a shape is stood for by those that are fixed to it.
    #[must_use]
    pub fn share_a_joint(&self, a: &str, b: &str) -> bool {
        let link = |name: &str| self.links.iter().find(|link| link.name == name);
        let has_shape = |name: &str| link(name).is_some_and(|link| !link.collision.is_empty());
        let is_end = |end: &str, name: &str| {
            let are_fixed = || Some(link(end)?.frame.body() == link(name)?.frame.body());
            end == name || (!has_shape(end) && are_fixed() == Some(true))
        };
        let joins = |Joint { parent, child, .. }: &Joint| {
            (is_end(parent, a) && is_end(child, b)) || (is_end(parent, b) && is_end(child, a))
        };
        self.joints.iter().any(joins)
    }

    /// Returns the arm without its list of link pairs that need no collision check.
    #[must_use]
    pub fn without_disabled_pairs(self) -> Self {
        let disabled = None;
        Self { disabled, ..self }
    }

    /// Link pairs that need no collision check, if a list was given.
    #[must_use]
    pub fn disabled_pairs(&self) -> Option<&DisabledPairs> {
        self.disabled.as_ref()
    }

    /// SHA-256 of the SRDF of that list, in lower-case hexadecimal, if one was given.
    #[must_use]
    pub fn srdf_sha256(&self) -> Option<&str> {
        self.disabled.as_ref().map(DisabledPairs::sha256)
    }

    /// Upper bound on the distance of `frame`'s origin from a fixed point, and that point in the base frame \[m\].
    ///
    /// The point is the projection of joint 2's origin onto axis 1; the bound is the sum of the constant distances along the chain from
    /// there (triangle inequality). No pose beyond it can be reached. [`Self::sharp_reach_bound`] is often closer, and costs more.
    #[must_use]
    pub fn reach_bound(&self, frame: &Frame) -> (Point3<f64>, f64) {
        let second = self.folded[1].translation;
        let off_axis = second.xy().norm();
        let centre = self.folded[0].translation + self.folded[0].rotation.column(2) * second.z;
        let rest: f64 = self.folded[2..].iter().map(|f| f.translation.norm()).sum();
        (centre.into(), off_axis + rest + frame.offset.translation.norm())
    }

    /// Upper bound on the distance of `frame`'s origin from a point of axis 1, and that point in the base frame \[m\].
    ///
    /// A point of axis k keeps its place on the links on both sides of the axis. So the distances from a point of axis 1 to one of axis 2,
    /// and on to the frame, do not depend on the joints, and no configuration brings the frame farther away than their sum (triangle
    /// inequality). The points slide along their axes until the sum is nearly least; the bound holds for any points.
    #[must_use]
    pub fn sharp_reach_bound(&self, frame: &Frame) -> (Point3<f64>, f64) {
        let mut pose = RigidTransform::identity();
        let mut axes = Vec::with_capacity(AXES);
        for folded in &self.folded[..frame.body] {
            pose = pose.then(folded);
            axes.push((pose.translation, pose.rotation.column(2).into_owned()));
        }
        let end = pose.then(&frame.offset).translation;
        let mut points: Vec<Vector3<f64>> = axes.iter().map(|(origin, _)| *origin).collect();
        points.push(end);
        for _ in 0..SLIDES {
            for (k, (origin, direction)) in axes.iter().enumerate().rev() {
                let before = k.checked_sub(1).map(|before| points[before]);
                points[k] = origin + direction * least_way(origin, direction, before, &points[k + 1]);
            }
        }
        let bound_m = points.windows(2).map(|ends| (ends[1] - ends[0]).norm()).sum();
        (points[0].into(), bound_m)
    }

    /// Frame of the last body with its z axis on axis 6 and its origin nearest axis 5: the centre of a spherical wrist.
    #[must_use]
    pub fn wrist_frame(&self) -> Frame {
        let last = &self.folded[AXES - 1];
        let direction = last.rotation.column(2);
        // Axis 5 is z here.
        let across = direction.xy().norm_squared();
        let along_m = match across > PARALLEL {
            true => -last.translation.xy().dot(&direction.xy()) / across,
            false => 0.0,
        };
        let offset = RigidTransform {
            translation: Vector3::z() * along_m,
            ..RigidTransform::identity()
        };
        Frame::new(AXES, offset)
    }

    /// `F_i = T_{i−1}_i` at q = 0 between folded joint frames: `T_base_i = T_base_{i−1} · F_i · Rot_z(q_i)`.
    #[must_use]
    pub fn folded(&self) -> &[RigidTransform; AXES] {
        &self.folded
    }
}

/// Number of unused statements that a note lists.
const LISTED: usize = 3;

/// Square of the sine below which two axes count as parallel.
const PARALLEL: f64 = 1e-9;

/// Number of times that the points of [`RobotModel::sharp_reach_bound`] slide along their axes.
const SLIDES: usize = 16;

/// The place on an axis, from its origin \[m\], over which the way from `before` to `after` is the shortest; the foot of `after` where
/// there is nothing before.
fn least_way(
    origin: &Vector3<f64>,
    direction: &Vector3<f64>,
    before: Option<Vector3<f64>>,
    after: &Vector3<f64>,
) -> f64 {
    let seen = |point: &Vector3<f64>| {
        let from = point - origin;
        let along = from.dot(direction);
        (along, (from - direction * along).norm())
    };
    let (after, after_off) = seen(after);
    let Some((before, before_off)) = before.map(|before| seen(&before)) else {
        return after;
    };
    let off = before_off + after_off;
    if off > 0.0 {
        before + (after - before) * (before_off / off)
    } else {
        after
    }
}

/// Frame fixed to one of the arm's bodies: body 0 is the base, body i is moved by joint i.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    pub(crate) body: usize,
    /// `T_body_frame`, from the folded joint frame of the body.
    pub(crate) offset: RigidTransform,
}

impl Frame {
    pub(crate) fn new(body: usize, offset: RigidTransform) -> Self {
        Self { body, offset }
    }

    /// The base frame.
    #[must_use]
    pub fn base() -> Self {
        Self::new(0, RigidTransform::identity())
    }

    /// Index of the body that carries the frame: 0 for the base, 1–6 for the bodies that joints 1–6 move.
    #[must_use]
    pub fn body(&self) -> usize {
        self.body
    }

    /// Pose on the folded joint frame of its body, `T_body_frame`.
    #[must_use]
    pub fn on_body(&self) -> &RigidTransform {
        &self.offset
    }

    /// Angle between its z axis and the axis of the joint that moves its body \[rad\].
    #[must_use]
    pub fn tilt_rad(&self) -> f64 {
        let z = self.offset.rotation.column(2);
        atan2(z.xy().norm(), z.z)
    }

    /// Returns an invalid frame: its coordinates are NaN, so that nothing can be proved of it.
    #[must_use]
    pub fn invalid() -> Self {
        let rotation = Matrix3::repeat(f64::NAN);
        let translation = Vector3::repeat(f64::NAN);
        Self::new(0, RigidTransform { rotation, translation })
    }

    /// Returns a frame fixed to this one, at `T_this_new`.
    #[must_use]
    pub fn offset(&self, relative: &RigidTransform) -> Self {
        Self::new(self.body, self.offset.then(relative))
    }
}

/// Poses of the seven bodies at one configuration, in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPoses {
    /// `T_base_body`; index 0 is the identity, index i the folded frame of joint i (z = its axis).
    pub(crate) bodies: [RigidTransform; AXES + 1],
}

impl BodyPoses {
    /// `T_base_body`: the identity for the base, then for each joint a frame on its axis, z along it.
    #[must_use]
    pub fn bodies(&self) -> &[RigidTransform; AXES + 1] {
        &self.bodies
    }

    /// Directions of the six joint axes, base frame, unit length.
    #[must_use]
    pub fn joint_axes(&self) -> [Vector3<f64>; AXES] {
        std::array::from_fn(|i| self.bodies[i + 1].rotation.column(2).into_owned())
    }

    /// `T_base_frame` as matrix and vector.
    #[must_use]
    pub fn rigid(&self, frame: &Frame) -> RigidTransform {
        run_exact(Placement {
            body: &self.bodies[frame.body],
            frame,
        })
    }

    /// `T_base_frame`.
    #[must_use]
    pub fn pose(&self, frame: &Frame) -> Pose {
        Pose::from(&self.rigid(frame))
    }
}

impl RobotModel {
    /// Poses of all bodies at the joint positions `q` \[rad\]. Limits are not checked; NaN in, NaN out.
    #[must_use]
    pub fn fk(&self, q: &JointVector) -> BodyPoses {
        run_exact(Forward { robot: self, q })
    }

    /// Pose `T_base_frame` of one frame at `q` \[rad\].
    #[must_use]
    pub fn pose(&self, q: &JointVector, frame: &Frame) -> Pose {
        self.fk(q).pose(frame)
    }
}

/// Forward kinematics at `q`.
#[derive(Clone)]
struct Forward<'a> {
    robot: &'a RobotModel,
    q: &'a JointVector,
}

impl Kernel for Forward<'_> {
    type Output = BodyPoses;

    #[inline(always)]
    fn run<V: Vector>(self) -> BodyPoses {
        let [first, second, third, fourth, fifth, sixth] =
            moved_bodies::<V>(self.robot, self.q).map(|body| body.rigid());
        BodyPoses {
            bodies: [RigidTransform::identity(), first, second, third, fourth, fifth, sixth],
        }
    }
}

/// Pose of a frame on a body.
struct Placement<'a> {
    body: &'a RigidTransform,
    frame: &'a Frame,
}

impl Kernel for Placement<'_> {
    type Output = RigidTransform;

    #[inline(always)]
    fn run<V: Vector>(self) -> RigidTransform {
        Columns::<V>::load(self.body).then(&self.frame.offset).rigid()
    }
}

/// `T_base_body` of the bodies that the joints move, at the positions `q` \[rad\].
#[inline(always)]
pub(crate) fn moved_bodies<V: Vector>(robot: &RobotModel, q: &JointVector) -> [Columns<V>; AXES] {
    let (s, c) = sin_cos_vector(V::from_array([q[0], q[1], q[2], q[3]]));
    // The last two are no joints'.
    let (t, d) = sin_cos_vector(V::from_array([q[4], q[5], 0.0, 0.0]));
    let ([s1, s2, s3, s4], [s5, s6, ..]) = (s.to_array(), t.to_array());
    let ([c1, c2, c3, c4], [c5, c6, ..]) = (c.to_array(), d.to_array());
    let folded = &robot.folded;
    let first = Columns::identity().then(&folded[0]).turned_about_z(s1, c1);
    let second = first.then(&folded[1]).turned_about_z(s2, c2);
    let third = second.then(&folded[2]).turned_about_z(s3, c3);
    let fourth = third.then(&folded[3]).turned_about_z(s4, c4);
    let fifth = fourth.then(&folded[4]).turned_about_z(s5, c5);
    let sixth = fifth.then(&folded[5]).turned_about_z(s6, c6);
    [first, second, third, fourth, fifth, sixth]
}

/// Geometric Jacobian: maps joint speeds \[rad/s\] to the twist (linear m/s, angular rad/s) of a frame.
pub type Jacobian = Matrix6<f64>;

/// The axes in which a twist is expressed. The point whose velocity it is stays the frame's origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// Axes of the base frame.
    Base,
    /// Axes of the frame itself.
    Local,
}

impl BodyPoses {
    /// Geometric Jacobian of `frame`, twist of its origin in the given axes.
    ///
    /// Column i is `(z_i × (p − p_i), z_i)` for the joints between the base and the frame's body, and zero
    /// for the joints beyond it (Siciliano et al., *Robotics*, eq. 3.30).
    #[must_use]
    pub fn jacobian(&self, frame: &Frame, axes: Axes) -> Jacobian {
        let tip = self.rigid(frame);
        let mut jacobian = Jacobian::zeros();
        for (i, joint) in self.bodies[1..=frame.body()].iter().enumerate() {
            let z = joint.rotation.column(2).into_owned();
            let linear = z.cross(&(tip.translation - joint.translation));
            let (linear, angular) = match axes {
                Axes::Base => (linear, z),
                Axes::Local => (tip.rotation.tr_mul(&linear), tip.rotation.tr_mul(&z)),
            };
            jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&linear);
            jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&angular);
        }
        jacobian
    }
}

/// Manipulability `√det(J Jᵀ) = |det J|` (Yoshikawa 1985) \[m³, as three rows are lengths\]; 0 exactly at a singularity.
#[must_use]
pub fn manipulability(jacobian: &Jacobian) -> f64 {
    jacobian.determinant().abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::tests::portable_and_exact;
    use crate::trig::sin_cos;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn poses_have_the_bits_of_the_products_one_by_one(
            q in prop::array::uniform6(prop_oneof![-7.0..7.0f64, Just(0.0), Just(-0.0), -3e5..3e5f64]),
        ) {
            let robot = RobotModel::irb120().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let mut body = RigidTransform::identity();
            let expected = q.iter().zip(&robot.folded).map(|(q, folded)| {
                let (s, c) = sin_cos(*q);
                body = body.then(folded).turned_about_z(s, c);
                body
            });
            let bits = |body: &RigidTransform| body.rotation.iter().chain(&body.translation).map(|x| x.to_bits()).collect();
            let expected: Vec<Vec<u64>> = expected.map(|body| bits(&body)).collect();
            for poses in portable_and_exact(&Forward { robot: &robot, q: &q.into() }) {
                let found: Vec<Vec<u64>> = poses.bodies[1..].iter().map(bits).collect();
                prop_assert_eq!(&found, &expected);
            }
        }
    }
}
