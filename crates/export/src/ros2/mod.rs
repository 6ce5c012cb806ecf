//! ROS 2: a plan as messages for joint_trajectory_controller, and a player that sends them.
//!
//! Positions and speeds at every knot and nothing else: between two points the controller draws the cubic that has both, which is the
//! plan's own. The first point is [`times::LEAD_IN_S`] after the goal is taken, so that the arm is led to it and does not jump.
//!
//! | concept | module |
//! | --- | --- |
//! | contents of a message; times in it | `message`, `times` |
//! | messages as YAML and JSON; the script that sends a goal | `write`, `play.py` |
//! | numbers as they are written | `number` |
//! | a message, as a tree of values, as a reading | `read`, `platewash_motion_proof::message` |

mod message;
pub(crate) mod number;
pub(crate) mod read;
pub mod times;
pub(crate) mod write;

use crate::dialect::language::{Dialect, Points};
use crate::dialect::start_within::start_within_deg;
use crate::program::{Program, ProgramFile};
use crate::reading::Reading;
use crate::ros2::message::{GOAL_RAD, Message};
use platewash_kinematics::{AXES, RobotModel};
use platewash_motion_proof::ReadError;
use platewash_motion_proof::message::Language;

/// The file that holds the `trajectory_msgs/JointTrajectory` as JSON.
pub const TRAJECTORY_JSON: &str = "joint_trajectory.json";

/// The goal that the player sends.
const SENT: &str = "follow_joint_trajectory.json";

/// The files of a program: the messages, each of which can be sent, and the player, which sends one of them.
pub const FILES: [&str; 5] = [
    "joint_trajectory.yaml",
    TRAJECTORY_JSON,
    "follow_joint_trajectory.yaml",
    SENT,
    write::NAME,
];

/// The dialect `ros2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ros2;

impl Dialect for Ros2 {
    fn name(&self) -> &'static str {
        "ros2"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        write::is_script(file)
            || (Language::from_file_name(&file.name).is_some() && file.text.contains("time_from_start"))
    }

    fn points(&self) -> Points {
        Points::Knots
    }

    fn assumptions(&self) -> &'static [&'static str] {
        &[
            "The controller is joint_trajectory_controller with interpolation_method: splines, which draws the cubic with both points' \
             positions and speeds.",
            "It commands the arm's joints by these names, in radians, and starts where the plan starts: the first point is 0.5 s after \
             the goal is taken, and what the arm does until then is not proved beyond standing within {start_within_deg} degrees of it.",
            "The drives follow what is commanded; how far they may lag behind is the path tolerance, which no clearance is proved for.",
            "Nothing retimes the trajectory on the way: neither MoveIt nor a speed scaling.",
            "Not tried in a ROS installation or on an arm: the controller's rules and its cubic are mirrored from its public source.",
        ]
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        let message = Message::from_program(program);
        let trajectory = |language| write::trajectory(&message, language);
        let goal = |language| write::goal(&message, language);
        let head = write::head(program, &message_notes(program));
        let of_goal = write::head(program, &[message_notes(program), goal_notes(&message)].concat());
        let texts = [
            head + &trajectory(Language::Yaml),
            trajectory(Language::Json),
            of_goal + &goal(Language::Yaml),
            goal(Language::Json),
            write::script(start_within_deg(&program.plan.job)),
        ];
        let file = |(name, text): (&str, String)| ProgramFile {
            name: name.to_owned(),
            text,
        };
        FILES.into_iter().zip(texts).map(file).collect()
    }

    fn read(&self, files: &[ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError> {
        let (players, messages): (Vec<_>, Vec<_>) = files.iter().partition(|file| write::is_script(file));
        // The player compares the start; a message alone cannot.
        let mut start_within_deg = None;
        let is_sent = messages.iter().any(|file| file.name == SENT);
        for player in players {
            let within_deg = write::check(player).map_err(|fault| fault.in_file(&player.name))?;
            start_within_deg = is_sent.then_some(within_deg);
        }
        read::reading(&messages, arm).map(|reading| Reading {
            start_within_deg,
            ..reading
        })
    }
}

/// Notes at the head of a message, besides those of every program.
fn message_notes(program: &Program<'_>) -> Vec<String> {
    let lead_in_s = times::LEAD_IN_S;
    vec![
        "trajectory_msgs/JointTrajectory: positions in rad, velocities in rad/s; no accelerations, no effort."
            .to_owned(),
        format!(
            "time_from_start 0 is the arm as it stands, within {} degrees of the first point; {lead_in_s} s later, at the first point, the \
             plan begins.",
            start_within_deg(&program.plan.job)
        ),
        format!(
            "At a speed share of {} the plan takes {:.3} s, the message {:.3} s.",
            program.speed_share,
            program.duration_s(),
            program.duration_s() + lead_in_s,
        ),
    ]
}

/// Notes at the head of a goal on its tolerances.
fn goal_notes(message: &Message) -> Vec<String> {
    let each = |all: [f64; AXES]| all.map(number::float).join(", ");
    vec![
        "control_msgs/action/FollowJointTrajectory, the goal of the action.".to_owned(),
        format!(
            "path_tolerance {} rad: what a joint that is 0.05 s late is off at its greatest speed, at least 0.02 rad; beyond it the \
             controller aborts.",
            each(message.path_rad)
        ),
        format!("goal_tolerance {} rad.", each([GOAL_RAD; AXES])),
        "A tolerance of 0.0 would mean the controller's own, -1.0 none. None of them is part of the proof.".to_owned(),
    ]
}

#[cfg(test)]
mod tests {

    use crate::ros2::message::path_tolerance_rad;

    #[test]
    fn the_tolerance_of_the_path_is_that_of_a_late_joint() {
        let tolerances = [0.0, 0.39, 0.5, 2.4, 2.401].map(path_tolerance_rad);
        assert_eq!(tolerances, [0.02, 0.02, 0.025, 0.12, 0.121]);
    }
}
