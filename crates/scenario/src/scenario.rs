//! A scenario: everything that a file states, section by section.

use crate::control::ControlSection;
use crate::ik::IkSection;
use crate::job::JobSection;
use crate::layout::LayoutSection;
use crate::limits::LimitsSection;
use crate::plant::PlantSection;
use crate::robot::RobotSection;
use crate::tool::ToolSection;
use crate::transition::TransitionSection;
use crate::wash::WashSection;
use platewash_kinematics::JointVector;
use serde::{Deserialize, Serialize};

/// A job in full: what a scenario file states, with defaults filled in. Ranges are checked by
/// [`Scenario::parse`] and [`Scenario::validate`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Name, for reports.
    pub name: String,
    /// Seed of every random stream.
    pub seed: u64,
    /// What counts as done.
    pub job: JobSection,
    /// The arm.
    pub robot: RobotSection,
    /// What it holds.
    pub tool: ToolSection,
    /// Where the plates lie.
    pub layout: LayoutSection,
    /// The path on a plate.
    pub wash: WashSection,
    /// Inverse kinematics along the path.
    pub ik: IkSection,
    /// The way between plates.
    pub transition: TransitionSection,
    /// Limits beyond those of the arm's description.
    pub limits: LimitsSection,
    /// How the arm follows.
    pub control: ControlSection,
    /// The arm as a physical system.
    pub plant: PlantSection,
}

impl Scenario {
    /// Joint positions at the start and at the end \[rad\].
    #[must_use]
    pub fn homes(&self) -> [JointVector; 2] {
        let start = self.robot.start_deg;
        [start, self.robot.home_deg.unwrap_or(start)].map(|deg| JointVector::from(deg).map(f64::to_radians))
    }
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            name: "unnamed".to_owned(),
            seed: 1,
            job: JobSection::default(),
            robot: RobotSection::default(),
            tool: ToolSection::default(),
            layout: LayoutSection::default(),
            wash: WashSection::default(),
            ik: IkSection::default(),
            transition: TransitionSection::default(),
            limits: LimitsSection::default(),
            control: ControlSection::default(),
            plant: PlantSection::default(),
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::Scenario;
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    #[test]
    fn any_path_of_the_system_is_valid() {
        let mut scenario = Scenario::load("paper-text").unwrap();
        let path = OsStr::from_bytes(b"arm\xff.urdf");
        scenario.robot.urdf = Some(path.into());
        scenario.robot.package_path = vec![path.into()];
        assert_eq!(scenario.validate(), Ok(()));
        assert!(serde_json::to_string(&scenario).unwrap().contains("arm\u{fffd}.urdf"));
    }
}
