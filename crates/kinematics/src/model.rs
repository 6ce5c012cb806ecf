//! The immutable model of a six-axis arm.

use crate::frame::Frame;
use crate::geometry::{Inertial, Primitive, Visual, VisualFinding};
use crate::limits::JointLimits;
use crate::rotation::Rigid;
use crate::srdf::DisabledPairs;
use crate::{AXES, SrdfError};
use nalgebra::Point3;

/// A revolute joint of the chain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Joint {
    /// Name in the description.
    pub name: String,
    /// Name of the link it moves.
    pub child: String,
}

/// A link of the description, moving or fixed.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Name in the description.
    pub name: String,
    /// The link frame, fixed to the body that carries it.
    pub frame: Frame,
    /// Collision geometry in the link frame; empty for pure frames.
    pub collision: Vec<Primitive>,
    /// What it looks like, in the link frame; visuals that could not be read are left out ([`RobotModel::visual_findings`]).
    pub visuals: Vec<Visual>,
    /// Mass properties, where stated.
    pub inertial: Option<Inertial>,
}

/// An arm with six revolute axes in series, as its URDF describes it. Immutable once built.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotModel {
    pub(crate) name: String,
    pub(crate) sha256: String,
    pub(crate) joints: [Joint; AXES],
    pub(crate) limits: JointLimits,
    pub(crate) folded: [Rigid; AXES],
    pub(crate) links: Vec<Link>,
    pub(crate) last_link: Frame,
    pub(crate) disabled: Option<DisabledPairs>,
    pub(crate) visual_findings: Vec<VisualFinding>,
}

impl RobotModel {
    /// The same model with a list of link pairs that need no collision check.
    ///
    /// # Errors
    /// [`SrdfError::UnknownLink`] when the list names a link that this arm does not have.
    pub fn with_disabled_pairs(mut self, disabled: DisabledPairs) -> Result<Self, SrdfError> {
        disabled.check_links(self.links.iter().map(|l| l.name.as_str()))?;
        self.disabled = Some(disabled);
        Ok(self)
    }

    /// Name in the description.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// SHA-256 of the URDF text and of the vertices of its collision meshes, in lower-case hexadecimal; of the text alone
    /// where there are no meshes.
    #[must_use]
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// The six joints from the base to the tip.
    #[must_use]
    pub fn joints(&self) -> &[Joint; AXES] {
        &self.joints
    }

    /// Limits of the six joints.
    #[must_use]
    pub fn limits(&self) -> &JointLimits {
        &self.limits
    }

    /// Every link of the description, ordered from the root outwards.
    #[must_use]
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// The links that joints move and that have no collision shapes of their own.
    pub fn links_without_shapes(&self) -> impl Iterator<Item = &str> {
        let has_shapes = |name: &str| self.links.iter().any(|l| l.name == name && !l.collision.is_empty());
        let moved = self.joints.iter().map(|joint| joint.child.as_str());
        moved.filter(move |name| !has_shapes(name))
    }

    /// What of the arm's looks could not be read and is left out. Nothing else depends on it.
    #[must_use]
    pub fn visual_findings(&self) -> &[VisualFinding] {
        &self.visual_findings
    }

    /// Frame of the link behind joint 6.
    #[must_use]
    pub fn last_link_frame(&self) -> Frame {
        self.last_link
    }

    /// The arm without its list of link pairs that need no collision check.
    #[must_use]
    pub fn without_disabled_pairs(self) -> Self {
        let disabled = None;
        Self { disabled, ..self }
    }

    /// Link pairs that need no collision check, where a list was given.
    #[must_use]
    pub fn disabled_pairs(&self) -> Option<&DisabledPairs> {
        self.disabled.as_ref()
    }

    /// SHA-256 of the SRDF that the list came from, in lower-case hexadecimal, where one was given.
    #[must_use]
    pub fn srdf_sha256(&self) -> Option<&str> {
        self.disabled.as_ref().map(DisabledPairs::sha256)
    }

    /// Upper bound on the distance of `frame`'s origin from a fixed point, and that point in the base frame \[m\].
    ///
    /// The point is where joint 2's origin projects onto axis 1; the bound is the sum of the constant
    /// distances along the chain from there (triangle inequality). Beyond it nothing can be reached.
    #[must_use]
    pub fn reach_bound(&self, frame: &Frame) -> (Point3<f64>, f64) {
        let second = self.folded[1].translation;
        let off_axis = second.xy().norm();
        let centre = self.folded[0].translation + self.folded[0].rotation.column(2) * second.z;
        let rest: f64 = self.folded[2..].iter().map(|f| f.translation.norm()).sum();
        (centre.into(), off_axis + rest + frame.offset.translation.norm())
    }

    /// `F_i = T_{i−1}_i` at q = 0 between folded joint frames: `T_base_i = T_base_{i−1} · F_i · Rot_z(q_i)`.
    #[must_use]
    pub fn folded(&self) -> &[Rigid; AXES] {
        &self.folded
    }
}
