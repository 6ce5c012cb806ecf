//! A trajectory with its tolerances: the contents of a message.

use crate::program::Program;
use crate::ros2::times;
use platewash_kinematics::{AXES, JointVector};
use platewash_motion_proof::message::NS_PER_S;

/// Delay of a joint beyond which the controller aborts \[s\].
const LATE_S: f64 = 0.05;

/// Least tolerance of the path \[rad\].
const LEAST_PATH_RAD: f64 = 0.02;

/// Tolerance of the goal \[rad\].
pub(crate) const GOAL_RAD: f64 = 0.01;

/// Delay beyond the planned end at which the goal may still be reached \[ns\].
pub(crate) const GOAL_TIME_NS: i64 = NS_PER_S;

/// Tolerances are whole multiples of one radian by this.
const STEPS_PER_RAD: f64 = 1000.0;

/// A point of a trajectory.
#[derive(Debug)]
pub(crate) struct MessagePoint {
    pub(crate) q_rad: JointVector,
    pub(crate) qd_rad_s: JointVector,
    /// Time from the start of the message \[ns\].
    pub(crate) time_ns: i64,
}

/// A trajectory with its tolerances.
#[derive(Debug)]
pub(crate) struct Message {
    pub(crate) joint_names: Vec<String>,
    pub(crate) points: Vec<MessagePoint>,
    /// Tolerance of the path, joint by joint \[rad\].
    pub(crate) path_rad: [f64; AXES],
}

impl Message {
    /// Message of a program.
    pub(crate) fn from_program(program: &Program<'_>) -> Self {
        let share = program.speed_share;
        let times = times::nanoseconds(program.points.iter().map(|point| point.t_s / share));
        let points = program.points.iter().zip(times).map(|(point, time_ns)| MessagePoint {
            q_rad: point.q_rad,
            qd_rad_s: point.qd_rad_s * share,
            time_ns,
        });
        let points: Vec<_> = points.collect();
        let speeds = program.points.iter().map(|point| point.qd_rad_s.abs());
        let fastest = speeds.fold(JointVector::zeros(), |fastest, speeds| fastest.sup(&speeds)) * share;
        Self {
            joint_names: program.arm.joints().iter().map(|joint| joint.name.clone()).collect(),
            points,
            path_rad: <[f64; AXES]>::from(fastest).map(path_tolerance_rad),
        }
    }
}

/// The tolerance of the path for a joint of that greatest speed \[rad\].
pub(crate) fn path_tolerance_rad(speed_rad_s: f64) -> f64 {
    let late = (LATE_S * speed_rad_s).max(LEAST_PATH_RAD);
    (late * STEPS_PER_RAD).ceil() / STEPS_PER_RAD
}
