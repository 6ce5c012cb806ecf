//! The sponge on a plate.

use crate::dynamics::DynamicsModel;
use nalgebra::Vector3;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_workcell::plan::Plan;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::Sponge;

/// Tip and plates.
#[derive(Debug, Clone)]
pub(super) struct Contact<'a> {
    tip: Frame,
    sponge: &'a Sponge,
    plates: &'a [Plate],
}

impl<'a> Contact<'a> {
    pub fn new(plan: &'a Plan, robot: &RobotModel) -> Self {
        let tool = &plan.job.workcell.tool;
        Self {
            tip: tool.tip_frame(robot),
            sponge: &tool.sponge,
            plates: &plan.job.plates,
        }
    }

    /// The frame of the tip.
    pub fn tip(&self) -> &Frame {
        &self.tip
    }

    /// Torques of the plate's force \[N\] on the sponge, where it touches \[N·m\].
    pub fn push(&self, model: &DynamicsModel, q: &JointVector, plate: usize, force_n: f64) -> JointVector {
        let plate = &self.plates[plate];
        let tip: Vector3<f64> = model.position(q, &self.tip).coords;
        if plate.height_of(&tip) > self.sponge.compression_m {
            return JointVector::zeros();
        }
        model.torque_of_force(q, &self.tip, &(plate.axis() * force_n))
    }
}
