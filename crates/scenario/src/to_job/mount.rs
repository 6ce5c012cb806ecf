//! Link that a mount and touched places count from, where the controller's base lies apart from the root link.

use crate::error::{Problem, ScenarioError};
use crate::scenario::Scenario;
use crate::sections::robot::{OriginLink, RobotSection};
use platewash_kinematics::words::fixed;
use platewash_kinematics::{Pose, RobotModel};

impl Scenario {
    /// Refuses a mount that does not say which link stands there, on an arm whose controller does not count from the root link.
    pub(crate) fn check_mount(&self, arm: &RobotModel) -> Result<(), ScenarioError> {
        let Some(detail) = self.robot.ambiguous_mount(arm) else {
            return Ok(());
        };
        let keys = "robot.mount_m, robot.mount_rpy_deg, robot.mount_link";
        Err(ScenarioError::new(&self.name, None, Problem::conflict(keys, detail)))
    }
}

impl RobotSection {
    /// Both readings of a mount that does not say which link stands there, on an arm whose controller does not count from the root link.
    #[must_use]
    pub fn ambiguous_mount(&self, arm: &RobotModel) -> Option<String> {
        let is_open = self.mount_link.is_none() && self.stated_mount() != Pose::identity();
        let base = arm.controller_base().filter(|_| is_open)?;
        let [as_root, as_base] = OriginLink::ALL.map(|link| {
            let stated = Self {
                mount_link: Some(link),
                ..self.clone()
            };
            pose_words(&stated.mount(arm))
        });
        Some(format!(
            "the root link '{root}' and the controller's base, '{link}', are in different places; found a mount that does not say for which of them it is. \
             As \"root\" link '{root}' stands at {as_root} in the world, as \"base\" at {as_base}; state one of them",
            root = base.root,
            link = base.link,
        ))
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
