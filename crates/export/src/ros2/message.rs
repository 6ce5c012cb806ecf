//! The messages as data, each part with the line that says it: also such as a controller refuses.

use super::timing;
use crate::program::Program;
use platewash_kinematics::{AXES, JointVector};

/// Where a joint that follows this late would be, at the plan's speeds, is still on the path \[s\].
const LATE_S: f64 = 0.05;

/// Least tolerance of the path \[rad\]: encoders, drives and the start, which may be 0.5° (0.0088 rad) away.
const LEAST_PATH_RAD: f64 = 0.02;

/// Tolerance of the end \[rad\].
const GOAL_RAD: f64 = 0.01;

/// Steps in which tolerances are stated \[1/rad\].
const STEPS_PER_RAD: f64 = 1000.0;

/// Time beyond the last point until the arm stands at its end \[s\].
const GOAL_TIME_S: i64 = 1;

/// Something with the line that says it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct At<T> {
    /// The line, from 1; 0 where nothing was read.
    pub line: usize,
    /// What it says.
    pub value: T,
}

impl<T> At<T> {
    pub(super) fn on(line: usize, value: T) -> Self {
        Self { line, value }
    }

    /// Something that was not read.
    pub(super) fn unread(value: T) -> Self {
        Self::on(0, value)
    }
}

/// `builtin_interfaces/Duration`, in numbers that may be out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Span {
    /// Whole seconds \[s\].
    pub sec: At<i64>,
    /// The rest \[ns\].
    pub nanosec: At<i64>,
}

impl Span {
    /// As nanoseconds \[ns\].
    #[must_use]
    pub fn nanoseconds(&self) -> i128 {
        i128::from(self.sec.value) * i128::from(timing::NS_PER_S) + i128::from(self.nanosec.value)
    }

    pub(super) fn of(nanoseconds: i64) -> Self {
        Self {
            sec: At::unread(nanoseconds / timing::NS_PER_S),
            nanosec: At::unread(nanoseconds % timing::NS_PER_S),
        }
    }
}

/// `trajectory_msgs/JointTrajectoryPoint`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MessagePoint {
    /// The line at which it begins.
    pub line: usize,
    /// Joint positions in the order of the names \[rad\].
    pub positions: At<Vec<f64>>,
    /// Joint speeds \[rad/s\].
    pub velocities: At<Vec<f64>>,
    /// Joint accelerations \[rad/s²\]; empty in what this program writes.
    pub accelerations: At<Vec<f64>>,
    /// Joint efforts \[N·m\]; empty in what this program writes.
    pub effort: At<Vec<f64>>,
    /// When.
    pub time_from_start: Span,
}

/// `control_msgs/JointTolerance`. 0 means the controller's default, −1 none at all.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// The joint.
    pub name: At<String>,
    /// Position \[rad\].
    pub position: At<f64>,
    /// Speed \[rad/s\].
    pub velocity: At<f64>,
    /// Acceleration \[rad/s²\].
    pub acceleration: At<f64>,
}

/// What a `control_msgs/action/FollowJointTrajectory` goal says beside its trajectory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tolerances {
    /// On the path.
    pub path: At<Vec<Tolerance>>,
    /// At the end.
    pub goal: At<Vec<Tolerance>>,
    /// Time beyond the last point.
    pub goal_time: Span,
}

/// `trajectory_msgs/JointTrajectory`, or the goal of `control_msgs/action/FollowJointTrajectory` around one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Message {
    /// When it begins by the clock; zero where at once.
    pub stamp: Span,
    /// Names of the joints.
    pub joint_names: At<Vec<At<String>>>,
    /// The points.
    pub points: At<Vec<MessagePoint>>,
    /// Those of a goal.
    pub tolerances: Option<Tolerances>,
}

impl Message {
    /// The goal for a program: all its points, the first after the lead-in.
    #[must_use]
    pub fn of(program: &Program<'_>) -> Self {
        let names: Vec<String> = program.arm.joints().iter().map(|joint| joint.name.clone()).collect();
        let times = timing::nanoseconds(program.points.iter().map(|point| point.t_s / program.speed_share));
        let points = program.points.iter().zip(times).map(|(point, time)| MessagePoint {
            positions: At::unread(point.q_rad.iter().copied().collect()),
            velocities: At::unread(point.qd_rad_s.iter().map(|v| v * program.speed_share).collect()),
            time_from_start: Span::of(time),
            ..MessagePoint::default()
        });
        Self {
            points: At::unread(points.collect()),
            tolerances: Some(tolerances(program, &names)),
            joint_names: At::unread(names.into_iter().map(At::unread).collect()),
            stamp: Span::default(),
        }
    }
}

fn tolerances(program: &Program<'_>, names: &[String]) -> Tolerances {
    let fastest = fastest(program);
    let each = |position: &dyn Fn(usize) -> f64| {
        let one = |(joint, name): (usize, &String)| Tolerance {
            name: At::unread(name.clone()),
            position: At::unread(position(joint)),
            velocity: At::default(),
            acceleration: At::default(),
        };
        At::unread(names.iter().enumerate().map(one).collect())
    };
    Tolerances {
        path: each(&|joint| path_tolerance_rad(fastest[joint])),
        goal: each(&|_| GOAL_RAD),
        goal_time: Span::of(GOAL_TIME_S * timing::NS_PER_S),
    }
}

/// Greatest speed of each joint at the points, at the program's share of the speed \[rad/s\].
fn fastest(program: &Program<'_>) -> [f64; AXES] {
    let greater = |fastest: JointVector, speeds: &JointVector| fastest.sup(&speeds.abs());
    let speeds = program.points.iter().map(|point| point.qd_rad_s);
    let fastest = speeds.fold(JointVector::zeros(), |fastest, speeds| greater(fastest, &speeds));
    (fastest * program.speed_share).into()
}

/// How far a joint may be from where it shall be \[rad\], for its greatest speed \[rad/s\]: what a delay of `LATE_S` makes of it, at
/// least `LEAST_PATH_RAD`, in whole milliradians.
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

    #[test]
    fn spans_are_exact() {
        let span = Span::of(42_700_000_001);
        assert_eq!((span.sec.value, span.nanosec.value), (42, 700_000_001));
        assert_eq!(span.nanoseconds(), 42_700_000_001);
    }
}
