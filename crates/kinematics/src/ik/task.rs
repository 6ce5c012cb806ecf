//! The pose error and its Jacobian at one configuration.

use crate::fk::BodyPoses;
use crate::frame::Frame;
use crate::jacobian::{Axes, Jacobian};
use crate::rotation::{Rigid, rotation_vector};
use crate::{JointVector, RobotModel};
use nalgebra::Vector6;

/// A joint this close to a limit counts as standing on it \[rad\].
pub(super) const ON_LIMIT_RAD: f64 = 1e-6;

/// One inverse-kinematics problem: an arm, a frame on it, and where that frame shall be.
pub(super) struct Task<'a> {
    pub robot: &'a RobotModel,
    pub frame: Frame,
    pub target: Rigid,
    /// Tolerances on position \[m\] and orientation \[rad\].
    pub tolerance: [f64; 2],
}

/// A configuration with its error.
#[derive(Clone, Copy)]
pub(super) struct Iterate {
    pub q: JointVector,
    bodies: BodyPoses,
    /// `e = (p* − p, log(R* Rᵀ))`, metres and radians in base axes.
    pub error: Vector6<f64>,
    /// `‖e‖²`.
    pub cost: f64,
}

impl Task<'_> {
    pub fn at(&self, q: JointVector) -> Iterate {
        let bodies = self.robot.fk(&q);
        let tip = bodies.rigid(&self.frame);
        let linear = self.target.translation - tip.translation;
        let angular = rotation_vector(&(self.target.rotation * tip.rotation.transpose()));
        let error = Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z);
        Iterate {
            q,
            bodies,
            error,
            cost: error.norm_squared(),
        }
    }

    pub fn jacobian(&self, iterate: &Iterate) -> Jacobian {
        iterate.bodies.jacobian(&self.frame, Axes::Base)
    }

    pub fn solved(&self, iterate: &Iterate) -> bool {
        iterate.position_error() <= self.tolerance[0] && iterate.orientation_error() <= self.tolerance[1]
    }
}

impl Iterate {
    /// Distance from the target \[m\].
    pub fn position_error(&self) -> f64 {
        self.error.fixed_rows::<3>(0).norm()
    }

    /// Angle from the target \[rad\].
    pub fn orientation_error(&self) -> f64 {
        self.error.fixed_rows::<3>(3).norm()
    }
}

/// Why a descent stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    /// Within both tolerances.
    Solved,
    /// The error hardly falls any more.
    Stagnation,
    /// Steps keep being clamped to a limit.
    ActiveLimit,
    /// Iterations ran out.
    Iterations,
}

/// Where and why a descent stopped.
pub(super) struct Descent {
    pub best: Iterate,
    pub iterations: usize,
    pub stop: Stop,
}
