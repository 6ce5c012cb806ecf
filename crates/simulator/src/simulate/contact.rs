//! The sponge on a plate.

use crate::dynamics::DynamicsModel;
use nalgebra::Vector3;
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_planner::plan::Plan;
use platewash_workcell::layout::Plate;
use platewash_workcell::tool::Tool;

/// How the sponge stands to the plate that it shall wash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Touch {
    /// It touches.
    On,
    /// The tip is farther above the surface than the sponge is compressed.
    Lifted,
    /// The tip is deeper than the sponge is high: the handle would have to be in the plate.
    Pressed,
}

/// Tip and plates.
#[derive(Debug, Clone)]
pub(super) struct Contact<'a> {
    tip: Frame,
    tool: &'a Tool,
    plates: &'a [Plate],
}

impl<'a> Contact<'a> {
    pub fn new(plan: &'a Plan, robot: &RobotModel) -> Self {
        Self {
            tip: platewash_workcell::tool::tip_frame(robot, &plan.tool),
            tool: &plan.tool,
            plates: &plan.plates,
        }
    }

    /// The frame of the tip.
    pub fn tip(&self) -> &Frame {
        &self.tip
    }

    /// Height of the tip above the washing surface \[m\].
    pub fn lift_m(&self, tip: &Rigid, plate: usize) -> f64 {
        tip.translation.z - self.plates[plate].z_m
    }

    /// How the sponge stands at a lift \[m\].
    pub fn touch(&self, lift_m: f64) -> Touch {
        if lift_m < -self.tool.sponge_height_m {
            Touch::Pressed
        } else if lift_m <= self.tool.sponge_compression_m {
            Touch::On
        } else {
            Touch::Lifted
        }
    }

    /// Torques of the plate's force \[N\] on the sponge, where it touches \[N·m\].
    pub fn push(&self, model: &DynamicsModel, q: &JointVector, plate: usize, force_n: f64) -> JointVector {
        let height = model.position(q, &self.tip).z - self.plates[plate].z_m;
        if height > self.tool.sponge_compression_m {
            return JointVector::zeros();
        }
        model.torque_of_force(q, &self.tip, &Vector3::new(0.0, 0.0, force_n))
    }
}
