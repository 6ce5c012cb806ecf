//! Link that a mount and touched places count from, where the controller's base lies apart from the root link.

use crate::error::{Problem, ScenarioError};
use crate::scenario::Scenario;
use crate::sections::robot::{OriginLink, RobotSection};
use platewash_kinematics::words::fixed;
use platewash_kinematics::{Pose, RobotModel};

impl Scenario {
    /// Refuses a mount that does not say which link stands there, on an arm whose controller does not count from the root link.
    pub(crate) fn check_mount(&self, arm: &RobotModel) -> Result<(), ScenarioError> {
        let robot = &self.robot;
        let is_open = robot.mount_link.is_none() && robot.stated_mount() != Pose::identity();
        let Some(base) = arm.controller_base().filter(|_| is_open) else {
            return Ok(());
        };
        let [as_root, as_base] = OriginLink::ALL.map(|link| {
            let stated = RobotSection {
                mount_link: Some(link),
                ..robot.clone()
            };
            pose_words(&stated.mount(arm))
        });
        let detail = format!(
            "the controller counts from {base}; found a mount that does not say for which of the two links it is. With robot.mount_link = \"root\" link \
             '{root}' stands at {as_root} in the world, with \"base\" at {as_base}; state one of them",
            root = base.root
        );
        let keys = "robot.mount_m, robot.mount_rpy_deg, robot.mount_link".to_owned();
        Err(ScenarioError::new(&self.name, None, Problem::Conflict { keys, detail }))
    }
}

/// A place \[m\], and its roll, pitch and yaw \[°\] where it is turned.
fn pose_words(pose: &Pose) -> String {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let turned = [roll, pitch, yaw].map(|angle| fixed(angle.to_degrees(), 3));
    let place = place_words(pose.translation.vector.into());
    match turned.iter().all(|angle| angle == "0.000") {
        true => place,
        false => format!("{place} with roll, pitch, yaw = ({})°", turned.join(", ")),
    }
}

/// A place in the world \[m\].
pub(crate) fn place_words(at_m: [f64; 3]) -> String {
    format!("({}) m", at_m.map(|v| fixed(v, 4)).join(", "))
}
