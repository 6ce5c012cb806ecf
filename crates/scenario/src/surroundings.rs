//! From the sections of floor, table and obstacles to the bodies that stand around the arm.

use crate::error::{Problem, ScenarioError, conflict};
use crate::failure::Failure;
use crate::obstacle::{MeshPartsName, ObstacleSection, Stated};
use crate::obstacle_error::ObstacleError;
use crate::poses::pose;
use crate::room::TABLE;
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::MeshSource;
use platewash_workcell::clearance::{SolidParts, solid_parts};
use platewash_workcell::tool::Tool;
use platewash_workcell::workcell::{Obstacle, ObstacleShape};
use std::path::{Path, PathBuf};

/// A mesh's path as a file in a folder states it: those of packages stay as they are.
pub(crate) fn in_folder(mesh: &Path, folder: &Path) -> PathBuf {
    let text = mesh.to_string_lossy();
    match text.strip_prefix("file://") {
        _ if text.starts_with("package://") => mesh.to_owned(),
        Some(path) => folder.join(path),
        None => folder.join(mesh),
    }
}

impl Scenario {
    /// Refuses obstacles without a name or with one that another has, and shapes without their sizes.
    pub(crate) fn check_surroundings(&self) -> Result<(), Problem> {
        for (index, obstacle) in self.obstacle.iter().enumerate() {
            let at = format!("obstacle[{index}]");
            let name = &obstacle.name;
            if name.is_empty() {
                conflict(format!("{at}.name"), "is missing; every obstacle has a name of its own")?;
            }
            let taken = self.obstacle[..index].iter().position(|other| other.name == *name);
            if let Some(other) = taken {
                conflict(
                    format!("{at}.name"),
                    format!("'{name}' is the name of obstacle[{other}] already"),
                )?;
            }
            obstacle.stated(&at)?;
        }
        Ok(())
    }

    /// What stands around an arm with its tool, among so many plates.
    ///
    /// # Errors
    /// [`Failure`]: a mesh that cannot be read or is no body, a name that another body has.
    pub(crate) fn obstacles(&self, arm: &RobotModel, tool: &Tool, plates: usize) -> Result<Vec<Obstacle>, Failure> {
        let mut all: Vec<_> = self.floor.obstacle().into_iter().chain(self.table.obstacle()).collect();
        for (index, section) in self.obstacle.iter().enumerate() {
            if let Some(of) = self.owner(&section.name, arm, tool) {
                let name = section.name.clone();
                return Err(ObstacleError::NameTaken { index, name, of }.into());
            }
            all.push(Obstacle {
                name: section.name.clone(),
                shape: self.shape(index, section)?,
                pose: pose(section.at_m, section.rpy_deg),
                margin_m: section.margin_m,
                holds_plates: section.held(plates),
            });
        }
        Ok(all)
    }

    /// Which other body has a name.
    fn owner(&self, name: &str, arm: &RobotModel, tool: &Tool) -> Option<&'static str> {
        let is_plate = |name: &str| {
            let number = name.strip_prefix("plate ").or_else(|| name.strip_prefix("real plate "));
            number.is_some_and(|number| number.parse::<usize>().is_ok())
        };
        match name {
            "floor" if self.floor.present => Some("the floor"),
            TABLE if self.table.size_m.is_some() => Some("the table"),
            "sponge" => Some("the sponge"),
            _ if is_plate(name) => Some("a plate"),
            _ if tool.bodies.iter().any(|body| body.name == name) => Some("a body of the tool"),
            _ if arm.links().iter().any(|link| link.name == name) => Some("a link of the arm"),
            _ => None,
        }
    }

    fn shape(&self, index: usize, section: &ObstacleSection) -> Result<ObstacleShape, Failure> {
        let refused = |problem| ScenarioError::new(&self.name, None, problem);
        let stated = section.stated(&format!("obstacle[{index}]")).map_err(refused)?;
        let (file, scale, parts) = match stated {
            Stated::HalfSpace => return Ok(ObstacleShape::HalfSpace),
            Stated::Convex(shape) => return Ok(ObstacleShape::Convex(shape)),
            Stated::Mesh { file, scale, parts } => (file, scale, parts),
        };
        let name = || section.name.clone();
        let source = MeshSource::new(&self.robot.package_path, None);
        let triangles = source.solid(&file.to_string_lossy(), scale).map_err(|why| {
            let name = name();
            ObstacleError::Mesh { index, name, why }
        })?;
        let parts = match parts {
            MeshPartsName::Hull => SolidParts::Hull,
            MeshPartsName::Decomposed => SolidParts::Decomposed,
        };
        let mut hulls = solid_parts(&triangles, parts).map_err(|why| ObstacleError::Solid {
            index,
            name: name(),
            file: file.display().to_string(),
            why,
        })?;
        if hulls.len() == 1 {
            let points = hulls.swap_remove(0);
            return Ok(ObstacleShape::Convex(platewash_kinematics::geometry::Shape::Hull {
                points,
            }));
        }
        Ok(ObstacleShape::Parts(hulls))
    }
}
