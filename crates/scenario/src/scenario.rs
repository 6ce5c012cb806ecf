//! A scenario: everything that a file states, section by section.

use crate::control::ControlSection;
use crate::ik::IkSection;
use crate::job::{JobSection, Program};
use crate::layout::LayoutSection;
use crate::limits::LimitsSection;
use crate::obstacle::ObstacleSection;
use crate::plant::PlantSection;
use crate::plate::PlateSection;
use crate::robot::RobotSection;
use crate::room::{FloorSection, TableSection};
use crate::solids::Solids;
use crate::tool::ToolSection;
use crate::tool_body::ToolBodySection;
use crate::transition::TransitionSection;
use crate::wash::WashSection;
use platewash_kinematics::urdf::Files;
use platewash_kinematics::{AXES, JointVector};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

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
    /// Further bodies of it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tool_body: Vec<ToolBodySection>,
    /// The floor of the room.
    pub floor: FloorSection,
    /// A table.
    pub table: TableSection,
    /// What else stands around.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub obstacle: Vec<ObstacleSection>,
    /// Where the plates lie.
    pub layout: LayoutSection,
    /// Plates one by one, or kinds of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plate: Vec<PlateSection>,
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
    /// No part of what is stated: meshes that were cut before, for scenarios that name the same.
    #[serde(skip)]
    pub solids: Solids,
    /// No part of it either: where the files that it names come from.
    #[serde(skip)]
    pub files: Files,
}

impl Scenario {
    /// Joint positions at the start and at the end \[rad\]; `None` where a certified job leaves them to be found.
    #[must_use]
    pub fn homes(&self) -> [Option<JointVector>; 2] {
        let of_paper = (self.job.program == Program::Paper).then_some([0.0; AXES]);
        let start = self.robot.start_deg.or(of_paper);
        let radians = |deg: [f64; AXES]| JointVector::from(deg).map(f64::to_radians);
        [start, self.robot.home_deg.or(start)].map(|deg| deg.map(radians))
    }

    /// Every file and folder that the scenario names: descriptions of the arm, folders of packages, meshes.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let robot = &self.robot;
        let of_arm = [&robot.urdf, &robot.srdf]
            .into_iter()
            .flatten()
            .chain(&robot.package_path);
        let of_tool = self.tool_body.iter().map(|section| &section.body);
        let bodies = of_tool.chain(self.obstacle.iter().map(|section| &section.body));
        let meshes = bodies.filter_map(|body| body.mesh.as_ref());
        of_arm.chain(meshes).map(PathBuf::as_path)
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
            tool_body: Vec::new(),
            floor: FloorSection::default(),
            table: TableSection::default(),
            obstacle: Vec::new(),
            layout: LayoutSection::default(),
            plate: Vec::new(),
            wash: WashSection::default(),
            ik: IkSection::default(),
            transition: TransitionSection::default(),
            limits: LimitsSection::default(),
            control: ControlSection::default(),
            plant: PlantSection::default(),
            solids: Solids::default(),
            files: Files::default(),
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
