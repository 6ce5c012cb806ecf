//! A scenario: everything that a file states, section by section.

use crate::error::Problem;
use crate::sections::holder::HolderSection;
use crate::sections::layout::{LayoutSection, PlateSection};
use crate::sections::motion::{IkSection, JobSection, LimitsSection, Program, TransitionSection};
use crate::sections::obstacle::ObstacleSection;
use crate::sections::robot::{ReducedClearanceSection, RobotSection};
use crate::sections::room::{FloorSection, TableSection};
use crate::sections::simulation::{ControlSection, PlantSection};
use crate::sections::tool::{ToolBodySection, ToolSection};
use crate::sections::wash::WashSection;
use crate::to_job::plate_files::PlateFiles;
use crate::to_job::solids::Solids;
use platewash_keys::Section;
use platewash_kinematics::urdf::Files;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::job::MAX_SEED;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A job in full: all values of a scenario file, with defaults filled in. Ranges are checked by
/// [`Scenario::parse`] and [`Scenario::validate`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("")]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Name, for reports.
    #[key(domain = Text, default = "unnamed".to_owned())]
    pub name: String,
    /// Seed of every random stream; the same seed gives the same bytes. Larger ones are no JSON numbers of their own.
    #[key(domain = Integer(0, MAX_SEED as i64), default = 1)]
    pub seed: u64,
    /// Program, order of the plates and coverage of the job.
    pub job: JobSection,
    /// The arm.
    pub robot: RobotSection,
    /// Pairs of bodies of arm and tool that keep less clearance than all others.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reduced_clearance: Vec<ReducedClearanceSection>,
    /// Tool that the arm holds.
    pub tool: ToolSection,
    /// Further bodies of it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tool_body: Vec<ToolBodySection>,
    /// The floor of the room.
    pub floor: FloorSection,
    /// A table.
    pub table: TableSection,
    /// Further obstacles.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub obstacle: Vec<ObstacleSection>,
    /// Positions of the plates.
    pub layout: LayoutSection,
    /// Plates one by one, or kinds of them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub plate: Vec<PlateSection>,
    /// The path on a plate.
    pub wash: WashSection,
    /// Holder of the plates.
    pub holder: HolderSection,
    /// Inverse kinematics along the path.
    pub ik: IkSection,
    /// The way between plates.
    pub transition: TransitionSection,
    /// Limits beyond those of the arm's description.
    pub limits: LimitsSection,
    /// Control of the arm in the simulation.
    pub control: ControlSection,
    /// The arm as a physical system.
    pub plant: PlantSection,
    /// Cache of meshes that were cut before, for scenarios that name the same; it is no part of the file.
    #[serde(skip)]
    pub solids: Solids,
    /// Plates and soils out of the files that it names, once they were read.
    #[serde(skip)]
    pub plate_files: PlateFiles,
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

    /// Every file and folder that the scenario names: descriptions of the arm, folders of packages, meshes, plates and soils.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let robot = &self.robot;
        let of_arm = [&robot.urdf, &robot.srdf]
            .into_iter()
            .flatten()
            .chain(&robot.package_path);
        let of_tool = self.tool_body.iter().map(|section| &section.body);
        let bodies = of_tool.chain(self.obstacle.iter().map(|section| &section.body));
        let meshes = bodies.filter_map(|body| body.mesh.as_ref());
        let read = self.plate_files.paths();
        let of_plates = self.plate_paths().into_iter().chain(read);
        of_arm.chain(meshes).chain(of_plates).map(PathBuf::as_path)
    }

    /// The files of plates and soils that the text names.
    pub(crate) fn plate_paths(&self) -> Vec<&PathBuf> {
        let layout = &self.layout;
        let of_layout = [
            &layout.plate_mesh,
            &layout.plate_points,
            &layout.plate_file,
            &self.wash.soil_file,
        ];
        let of_sections = self.plate.iter().flat_map(|row| [&row.mesh, &row.points]);
        of_layout.into_iter().chain(of_sections).flatten().collect()
    }

    /// Same as [`Self::plate_paths`], to change them.
    pub(crate) fn plate_paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let layout = &mut self.layout;
        let of_layout = [
            &mut layout.plate_mesh,
            &mut layout.plate_points,
            &mut layout.plate_file,
            &mut self.wash.soil_file,
        ];
        let of_sections = self.plate.iter_mut().flat_map(|row| [&mut row.mesh, &mut row.points]);
        of_layout.into_iter().chain(of_sections).flatten()
    }
}

/// Refuses a seed above [`MAX_SEED`], by the name of the key that states it.
///
/// # Errors
/// [`Problem::Value`].
pub fn check_seed(key: &str, seed: u64) -> Result<(), Problem> {
    if seed <= MAX_SEED {
        return Ok(());
    }
    Err(Problem::Value {
        key: key.to_owned(),
        expected: format!("a whole number from 0 to {MAX_SEED} (2^53 − 1)"),
        found: seed.to_string(),
    })
}
