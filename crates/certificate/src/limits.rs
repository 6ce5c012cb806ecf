//! The limits that count in judging a plan: those of its job and of the arm.

use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::job::JobTerms;

/// What must not be exceeded.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    /// Lowest and highest joint positions \[rad\]; infinite for a continuous joint.
    pub position_rad: [JointVector; 2],
    /// Joint speeds \[rad/s\].
    pub speed_rad_s: JointVector,
    /// Joint accelerations \[rad/s²\]: an assumption.
    pub acceleration_rad_s2: JointVector,
    /// Speed of the tip anywhere \[m/s\].
    pub tip_speed_m_s: f64,
    /// Acceleration of the tip anywhere \[m/s²\].
    pub tip_acceleration_m_s2: f64,
    /// Speed of the tip while it washes \[m/s\].
    pub wash_speed_m_s: f64,
    /// Acceleration of the tip while it washes \[m/s²\].
    pub wash_acceleration_m_s2: f64,
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats \[rad\].
    pub tilt_rad: f64,
    /// Clearance \[m\].
    pub clearance_m: f64,
    /// Share of a plate's face.
    pub coverage: f64,
}

impl Limits {
    /// Those of a job and its arm.
    pub fn new(job: &JobTerms, robot: &RobotModel) -> Self {
        let joints = robot.limits();
        Self {
            position_rad: [joints.lower, joints.upper],
            speed_rad_s: joints.velocity,
            acceleration_rad_s2: JointVector::from(job.limits.joint_acceleration_rad_s2),
            tip_speed_m_s: job.limits.tip_speed_m_s,
            tip_acceleration_m_s2: job.limits.tip_acceleration_m_s2,
            wash_speed_m_s: job.wash_speed_m_s(),
            wash_acceleration_m_s2: job.wash_acceleration_m_s2(),
            tilt_rad: job.tilt_max_rad(),
            clearance_m: job.requirements.clearance_m,
            coverage: job.requirements.coverage,
        }
    }
}
