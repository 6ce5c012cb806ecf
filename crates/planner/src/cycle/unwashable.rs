//! A plate that cannot be washed whole: which part of it, why, and where it could be.

use super::Stages;
use super::arm::Arm;
use crate::posture::PostureError;
use crate::posture::washable::{self, Cause, Move, Washable};
use crate::stroke::Stroke;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use std::fmt;

/// What is known of a plate that cannot be washed whole.
#[derive(Debug, Clone, PartialEq)]
pub struct UnwashablePlate {
    /// The plate.
    pub plate: usize,
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// Where the planning of its posture ended.
    pub error: PostureError,
    /// Share of the stroke that can be washed, point by point.
    pub share: Option<f64>,
    /// What keeps the rest from being washed, the most frequent first.
    pub causes: Vec<Cause>,
    /// The nearest centre at which it can be washed whole, for a plate whose position was given \[m\].
    pub nearest_m: Option<[f64; 2]>,
}

impl Stages<'_> {
    /// Looks into a plate whose posture could not be planned.
    pub(super) fn unwashable(
        &self,
        arm: &Arm<'_>,
        plate: usize,
        (centre, stroke): (Vector3<f64>, &Stroke),
        near: &JointVector,
        error: PostureError,
    ) -> UnwashablePlate {
        let part = washable::washable(&arm.cell, stroke, centre, plate, &self.posture, near);
        let (share, causes) = match part {
            Ok(Washable::Part { share, causes }) => (Some(share), causes),
            _ => (None, Vec::new()),
        };
        let given = self.scenario.layout.positions_m.is_some();
        let elsewhere = Move {
            robot: self.robot,
            tool: &self.scenario.tool,
            plates: self.plates,
            plate,
            stroke,
            height_m: self.scenario.wash.height_m,
            settings: &self.posture,
            near,
        };
        let nearest = given.then(|| elsewhere.nearest_washable().ok().flatten()).flatten();
        UnwashablePlate {
            plate,
            centre_m: [centre.x, centre.y],
            error,
            share,
            causes,
            nearest_m: nearest.map(Into::into),
        }
    }
}

impl fmt::Display for UnwashablePlate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.centre_m;
        write!(f, "plate {} at ({x:.3}, {y:.3}) m cannot be washed whole", self.plate)?;
        match self.share {
            Some(share) => write!(f, ": {:.1} % of its stroke can", 100.0 * share)?,
            None => write!(f, ": {}", self.error)?,
        }
        for cause in &self.causes {
            let [near, far] = cause.from_axis_m;
            let (share, least) = (100.0 * cause.share, &cause.least);
            write!(
                f,
                "; {share:.1} %, {near:.3} to {far:.3} m from axis 1, cannot ({least})"
            )?;
        }
        match self.nearest_m {
            Some([x, y]) => write!(f, "; the nearest position where it can is about ({x:.3}, {y:.3}) m"),
            None => Ok(()),
        }
    }
}
