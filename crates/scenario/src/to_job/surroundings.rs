//! From the sections of floor, table and obstacles to the bodies that stand around the arm.

use crate::body_error::{BodyFault, BodySection};
use crate::error::{Problem, ScenarioError, conflict};
use crate::failure::Failure;
use crate::scenario::Scenario;
use crate::sections::body_shape::{SectionShape, pose};
use crate::sections::obstacle::{MeshPartsName, ObstacleSection};
use crate::sections::room::TABLE;
use crate::sections::tool::ToolBodySection;
use crate::units::{MeshAs, Note};
use platewash_bodies::clearance::SolidParts;
use platewash_kinematics::RobotModel;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::layout::Layout;
use platewash_workcell::tool::Tool;
use platewash_workcell::words::{count_with_noun, printable};
use platewash_workcell::{MOST_BODIES, Obstacle, ObstacleShape, Workcell};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Excess of convex parts over a mesh up to which no note is given \[m\].
pub(crate) const LEAST_EXCESS_M: f64 = 1e-3;

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
    /// Refuses obstacles without a name or with one that another has, without a place, and shapes without their sizes; plates
    /// held that do not exist; and keys of a floor or a table that is not present.
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
            if obstacle.at_m.is_none() {
                conflict(format!("{at}.at_m"), "is missing; every obstacle has its place")?;
            }
            let plates = self.plates();
            if let Some(plate) = obstacle.held(plates).into_iter().find(|plate| *plate >= plates) {
                let there = count_with_noun(plates, "plate");
                let are = if plates == 1 { "is" } else { "are" };
                let found = format!("it holds the plate with index {plate}; there {are} {there}, counted from 0");
                conflict(format!("{at}.holds_plates"), found)?;
            }
        }
        self.floor.check()?;
        self.table.check()
    }

    /// Obstacles around an arm with its tool, for a number of plates.
    ///
    /// # Errors
    /// [`Failure`]: a mesh that cannot be read or is no body, a name that another body has.
    pub(crate) fn obstacles(&self, arm: &RobotModel, tool: &Tool, plates: usize) -> Result<Vec<Obstacle>, Failure> {
        let mut all: Vec<_> = self.floor.obstacle().into_iter().chain(self.table.obstacle()).collect();
        for (index, section) in self.obstacle.iter().enumerate() {
            if let Some(of) = self.owner(&section.name, arm, tool) {
                return Err(BodySection::Obstacle
                    .error(index, &section.name, BodyFault::NameTaken { of })
                    .into());
            }
            all.push(Obstacle {
                name: section.name.clone(),
                shape: self.shape(index, section)?,
                pose: pose(section.at_m.unwrap_or_default(), section.rpy_deg),
                margin_m: section.margin_m,
                holds_plates: section.held(plates),
            });
        }
        Ok(all)
    }

    /// Refuses more bodies than can be judged soon.
    pub(crate) fn check_bodies(&self, world: &Workcell) -> Result<(), ScenarioError> {
        if world.bodies() <= MOST_BODIES {
            return Ok(());
        }
        let found = self.obstacle.len();
        let others = world.bodies().saturating_sub(found);
        let problem = Problem::Value {
            key: "obstacle".to_owned(),
            expected: format!(
                "a list of at most {} sections: {MOST_BODIES} bodies can be judged, and {others} of them are floor, table and tool",
                MOST_BODIES.saturating_sub(others)
            ),
            found: format!("{found} of them"),
        };
        Err(ScenarioError::new(&self.name, None, problem))
    }

    /// Returns the other body that has a name.
    pub(crate) fn owner(&self, name: &str, arm: &RobotModel, tool: &Tool) -> Option<&'static str> {
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

    /// Notes on bodies of the tool and obstacles: sizes that are unusual, convex parts that reach beyond their meshes. Bodies that cannot be
    /// read are left out: the caller that makes the workcell reports them.
    #[must_use]
    pub fn notes_on_bodies(&self, arm: &RobotModel) -> Vec<Note> {
        let tool = self.tool_on(arm).ok();
        let sizes = tool.and_then(|tool| {
            let obstacles = self.obstacles(arm, &tool, self.plates()).ok()?;
            Some(Note::of_sizes(&tool, &obstacles))
        });
        sizes.into_iter().flatten().chain(self.notes_on_meshes()).collect()
    }

    /// Notes on convex parts that reach beyond the meshes of tool and obstacles.
    #[must_use]
    pub(crate) fn notes_on_meshes(&self) -> Vec<Note> {
        let source = self.meshes();
        let note = |name: &str, (file, scale): (&Path, Option<[f64; 3]>), as_what: MeshAs| {
            let parts = match as_what {
                MeshAs::Hull | MeshAs::HullOfTool => SolidParts::Hull,
                MeshAs::Parts => SolidParts::Decomposed,
            };
            let by_m = self.solids.excess_m(&source, file, scale, parts)?;
            let body = name.to_owned();
            (by_m > LEAST_EXCESS_M).then_some(Note::LargerThanMesh { body, by_m, as_what })
        };
        let of_obstacle = |section: &ObstacleSection| match section.stated("obstacle") {
            Ok(SectionShape::Mesh { file, scale }) => {
                let as_what = match solid_parts(section) {
                    SolidParts::Hull => MeshAs::Hull,
                    _ => MeshAs::Parts,
                };
                note(&section.name, (file, scale), as_what)
            }
            _ => None,
        };
        let of_tool = |section: &ToolBodySection| match section.body.stated("tool_body") {
            Ok(SectionShape::Mesh { file, scale }) => note(&section.name, (file, scale), MeshAs::HullOfTool),
            _ => None,
        };
        let of_tools = self.tool_body.iter().filter_map(of_tool);
        of_tools.chain(self.obstacle.iter().filter_map(of_obstacle)).collect()
    }

    /// Returns a failure with advice, if it names obstacles that count as the convex hulls of their meshes: whether a decomposition mends it is
    /// tried.
    #[must_use]
    pub fn with_advice_on_hulls(&self, arm: &Arc<RobotModel>, layout: &Layout, why: Failure) -> Failure {
        let (words, source) = (why.to_string(), self.meshes());
        let is_concerned = |section: &ObstacleSection| {
            let Ok(SectionShape::Mesh { file, scale }) = section.stated("obstacle") else {
                return false;
            };
            let excess_m = || self.solids.excess_m(&source, file, scale, SolidParts::Hull);
            solid_parts(section) == SolidParts::Hull
                && words.contains(&printable(&section.name))
                && excess_m().is_some_and(|by_m| by_m > LEAST_EXCESS_M)
        };
        let mut other = self.clone();
        let mut concerned = Vec::new();
        for section in other.obstacle.iter_mut().filter(|section| is_concerned(section)) {
            section.mesh_parts = Some(MeshPartsName::Decomposed);
            concerned.push(printable(&section.name));
        }
        if concerned.is_empty() {
            return why;
        }
        let stands_clear = |scenario: &Self| scenario.check_as_stated(arm, layout).is_ok();
        if stands_clear(self) {
            return why;
        }
        let tried = match stands_clear(&other) {
            true => "with mesh_parts = \"decomposed\" nothing stands in it",
            false => "mesh_parts = \"decomposed\" alone does not mend it",
        };
        let names = concerned.join("', '");
        let advice =
            format!("obstacle '{names}' counts as the convex hull of its mesh, which fills hollows: {tried} (tried)");
        Failure::Hull {
            why: Box::new(why),
            advice,
        }
    }

    fn shape(&self, index: usize, section: &ObstacleSection) -> Result<ObstacleShape, Failure> {
        let refused = |problem| ScenarioError::new(&self.name, None, problem);
        let stated = section.stated(&format!("obstacle[{index}]")).map_err(refused)?;
        let (file, scale) = match stated {
            SectionShape::HalfSpace => return Ok(ObstacleShape::HalfSpace),
            SectionShape::Convex(shape) => return Ok(ObstacleShape::Convex(shape)),
            SectionShape::Mesh { file, scale } => (file, scale),
        };
        let source = self.meshes();
        let hulls = self.solids.parts(&source, file, scale, solid_parts(section));
        let hulls = hulls.map_err(|why| BodySection::Obstacle.error(index, &section.name, why))?;
        Ok(match hulls.as_slice() {
            [points] => ObstacleShape::Convex(Shape::Hull { points: points.clone() }),
            hulls => ObstacleShape::Parts(hulls.to_vec()),
        })
    }
}

fn solid_parts(section: &ObstacleSection) -> SolidParts {
    match section.mesh_parts.unwrap_or_default() {
        MeshPartsName::Hull => SolidParts::Hull,
        MeshPartsName::Decomposed => SolidParts::Decomposed,
    }
}
