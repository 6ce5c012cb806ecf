//! The arm as the stages of a cycle use it: postures by the tilt policy, and what is clear.

use crate::crossing::{Stage, TooNear};
use crate::posture::{Cell, TiltPolicy};
use nalgebra::Vector3;
use platewash_kinematics::ik::{IkSettings, IkSettingsError, IkSolver};
use platewash_kinematics::{JointVector, Pose};

/// Accuracy of all inverse kinematics of a cycle (m, rad): far below what a plan promises.
const TOLERANCE: f64 = 1e-9;

/// The arm, a solver for its tip, and the tilt that suits each place.
pub(super) struct Arm<'a> {
    pub cell: Cell<'a>,
    pub solver: IkSolver<'a>,
    policy: TiltPolicy,
}

impl<'a> Arm<'a> {
    pub fn new(cell: Cell<'a>, tilt_max_rad: f64) -> Result<Self, IkSettingsError> {
        let settings = IkSettings {
            position_tolerance_m: TOLERANCE,
            orientation_tolerance_rad: TOLERANCE,
            ..IkSettings::default()
        };
        Ok(Self {
            solver: IkSolver::new(cell.robot, cell.tip, settings)?,
            policy: TiltPolicy::upright(tilt_max_rad),
            cell,
        })
    }

    /// Pose of the tip at a place \[m\], tilted as the policy says.
    pub fn pose(&self, place: Vector3<f64>) -> Pose {
        self.cell.tip_pose(place, self.policy.tilt(self.cell.distance(&place)))
    }

    /// The configuration for [`Arm::pose`] that is found from `near` \[rad\].
    pub fn configuration(&self, place: Vector3<f64>, near: &JointVector) -> Option<JointVector> {
        self.solver.solve(&self.pose(place), near).ok().map(|answer| answer.q)
    }

    /// Whether a configuration \[rad\] keeps the clearance \[m\]; on the line over a plate the sponge may be
    /// near the plates.
    pub fn keeps_clear(&self, q: &JointVector, stage: Stage, required_m: f64) -> bool {
        match stage {
            Stage::Line { .. } => self.cell.clearance.keeps_washing(q, required_m),
            Stage::Free => self.cell.clearance.keeps(q, required_m),
        }
    }

    /// The two bodies that [`Arm::keeps_clear`] finds too near, with the reserve of crossings on top of the clearance asked
    /// for \[m\].
    pub fn too_near(&self, q: &JointVector, stage: Stage, asked_m: f64) -> Option<TooNear> {
        match stage {
            Stage::Line { .. } => TooNear::on_line(self.cell.clearance, q, asked_m),
            Stage::Free => TooNear::free(self.cell.clearance, q, asked_m),
        }
    }
}
