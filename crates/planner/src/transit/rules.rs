//! What a transit must keep, and what it may try.

use super::too_near::TooNear;
use crate::scene::{Scene, Stretch, TiltPolicy};
use crate::timing::MotionLimits;
use platewash_kinematics::JointVector;
use platewash_workcell::arc::Arc;

/// What a transit must keep, and what it may try.
#[derive(Debug, Clone, Copy)]
pub struct TransitRules<'a> {
    /// Where it goes.
    pub scene: &'a Scene<'a>,
    /// Limits of the motion.
    pub limits: &'a MotionLimits,
    /// The clearance asked for \[m\]; [`Stretch::reserve_m`] is kept on top of it.
    pub clearance_m: f64,
    /// The arc round the base, where it may be tried.
    pub arc: Option<BaseArc>,
}

/// The arc round the base, and how the tool stands on it.
#[derive(Debug, Clone, Copy)]
pub struct BaseArc {
    /// Points, radius and height.
    pub arc: Arc,
    /// Tilt of the tool.
    pub policy: TiltPolicy,
}

impl TransitRules<'_> {
    /// Whether a configuration \[rad\] keeps its clearance.
    pub(super) fn is_clear(&self, q: &JointVector, stretch: Stretch) -> bool {
        let required_m = self.clearance_m + stretch.reserve_m();
        self.scene.surroundings.is_clear(q, stretch, required_m)
    }

    /// The bodies that are too near where it does not.
    pub(super) fn too_near(&self, q: &JointVector, stretch: Stretch) -> Option<TooNear> {
        TooNear::at(self.scene.surroundings, q, stretch, self.clearance_m)
    }
}
