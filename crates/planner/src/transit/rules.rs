//! Rules of a transit: its requirements, the kinds that it may be of, and its free part between two tops.

use crate::placed_arm::{PlacedArm, Stretch, TiltPolicy};
use crate::timing::MotionLimits;
use crate::transit::shortfall::ClearanceShortfall;
use platewash_kinematics::JointVector;
use platewash_workcell::arc::Arc;
use serde::Serialize;

/// Requirements of a transit, and the candidates that it may try.
#[derive(Debug, Clone, Copy)]
pub struct TransitRules<'a> {
    /// The arm that moves, with the bodies around it.
    pub placed: &'a PlacedArm<'a>,
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
    /// Checks that a configuration \[rad\] keeps its clearance.
    pub(crate) fn is_clear(&self, q: &JointVector, stretch: Stretch) -> bool {
        let required_m = self.clearance_m + stretch.reserve_m();
        self.placed.surroundings.is_clear(q, stretch, required_m)
    }

    /// The bodies that are too near where it does not.
    pub(crate) fn too_near(&self, q: &JointVector, stretch: Stretch) -> Option<ClearanceShortfall> {
        ClearanceShortfall::at(self.placed.surroundings, q, stretch, self.clearance_m)
    }
}

/// Kind of route of a transit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
pub enum TransitKind {
    /// Quintic from top to top in the joints.
    #[error("straight in joint space")]
    Direct,
    /// The same connection over a raised configuration.
    #[error("in joint space over a raised point")]
    Raised,
    /// Round the base.
    #[error("on an arc around the base")]
    Arc,
    /// Found by random trees.
    #[error("found by sampling")]
    Sampled,
}

/// Largest joint motion between neighbouring configurations that are checked \[rad\].
pub const STEP_RAD: f64 = 0.02;

/// Configurations between two tops, both left out, with the parameter counted from the first top \[m\], and its
/// value at the second.
#[derive(Debug, Clone)]
pub(crate) struct FreePath {
    pub u: Vec<f64>,
    pub q: Vec<JointVector>,
    pub length: f64,
}
