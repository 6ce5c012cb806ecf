//! What a message says.

use super::timing;
use crate::program::Program;
use platewash_kinematics::{AXES, JointVector};

/// How late a joint may be before the controller aborts \[s\].
const LATE_S: f64 = 0.05;

/// Least tolerance of the path \[rad\].
const LEAST_PATH_RAD: f64 = 0.02;

/// Tolerance of the goal \[rad\].
pub(super) const GOAL_RAD: f64 = 0.01;

/// How much later than planned the goal may be reached \[ns\].
pub(super) const GOAL_TIME_NS: i64 = timing::NS_PER_S;

/// Tolerances are whole multiples of one radian by this.
const STEPS_PER_RAD: f64 = 1000.0;

/// A point of a trajectory.
#[derive(Debug)]
pub(super) struct MessagePoint {
    pub(super) q_rad: JointVector,
    pub(super) qd_rad_s: JointVector,
    /// Time from the start of the message \[ns\].
    pub(super) time_ns: i64,
}

/// A trajectory with its tolerances.
#[derive(Debug)]
pub(super) struct Message {
    pub(super) joint_names: Vec<String>,
    pub(super) points: Vec<MessagePoint>,
    /// Tolerance of the path, joint by joint \[rad\].
    pub(super) path_rad: [f64; AXES],
}

impl Message {
    /// That of a program.
    pub(super) fn of(program: &Program<'_>) -> Self {
        let share = program.speed_share;
        let times = timing::nanoseconds(program.points.iter().map(|point| point.t_s / share));
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
fn path_tolerance_rad(speed_rad_s: f64) -> f64 {
    let late = (LATE_S * speed_rad_s).max(LEAST_PATH_RAD);
    (late * STEPS_PER_RAD).ceil() / STEPS_PER_RAD
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tolerance_of_the_path_is_that_of_a_late_joint() {
        let tolerances = [0.0, 0.39, 0.5, 2.4, 2.401].map(path_tolerance_rad);
        assert_eq!(tolerances, [0.02, 0.02, 0.025, 0.12, 0.121]);
    }
}
