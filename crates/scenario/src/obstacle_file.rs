//! Obstacles alone, out of a TOML text or a planning scene of MoveIt, and a tool alone: the sections of a scenario that belong to them, and
//! nothing else.

use crate::error::{Problem, ScenarioError, TextKind, conflict};
use crate::failure::Failure;
use crate::keys::line::{byte_of, line_at};
use crate::load::check_table;
use crate::scenario::Scenario;
use crate::source::{MAX_BYTES, unread};
use crate::to_job::surroundings::LEAST_EXCESS_M;
use crate::units::{MeshAs, Note};
use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::{Files, file};
use platewash_motion_proof::planning_scene;
use platewash_workcell::Obstacle;
use platewash_workcell::tool::Tool;
use std::path::{Path, PathBuf};
use toml::de::DeTable;

/// Longest planning scene that is read \[bytes\]: it holds the meshes themselves.
const MOST_SCENE_BYTES: u64 = 64 << 20;

/// Sections that a text of obstacles may have, and one of a tool.
const OBSTACLES: [&str; 3] = ["obstacle", "floor", "table"];
const TOOL: [&str; 2] = ["tool", "tool_body"];

/// Text with obstacles, or with a tool.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ObstacleText {
    /// Name of the text in messages.
    pub name: String,
    /// TOML text, or a planning scene where the name ends with `.scene`.
    pub text: String,
    /// Folder to which names of meshes are relative; `None` to leave them as they are.
    pub folder: Option<PathBuf>,
}

/// Places in which meshes are looked up.
#[derive(Debug, Clone, Default)]
pub struct MeshPlaces {
    /// Folders that hold the packages of `package://` names.
    pub package_path: Vec<PathBuf>,
    /// Source of the files, with the folders in which packages are installed.
    pub files: Files,
}

impl ObstacleText {
    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`ScenarioError`] for a file that cannot be read, or is too long: 1 MiB of TOML, 64 MiB of a planning scene.
    pub fn load(path: &Path) -> Result<Self, ScenarioError> {
        let name = path.display().to_string();
        let most = if is_scene(&name) { MOST_SCENE_BYTES } else { MAX_BYTES };
        let text = file::read_text(path, most).map_err(|e| refused(&name, None, unread(e)))?;
        let folder = Some(path.parent().unwrap_or(Path::new("")).to_owned());
        Ok(Self { name, text, folder })
    }

    /// Returns the obstacles around an arm with its tool, in the frame of the world. There is a floor only where the text has one.
    ///
    /// # Errors
    /// [`ScenarioError`] with the line and the key: another section, a value out of range, a mesh that cannot be read or is no body, a name
    /// that a link has.
    pub fn obstacles(
        &self,
        arm: &RobotModel,
        tool: &Tool,
        meshes: &MeshPlaces,
    ) -> Result<Vec<Obstacle>, ScenarioError> {
        if is_scene(&self.name) {
            let all = planning_scene::read(&self.name, &self.text).map_err(|error| {
                let detail = error.reason;
                refused(&self.name, Some(error.place.line), Problem::Detail { detail })
            })?;
            let nothing = Scenario::default();
            let taken = all.iter().find_map(|object| {
                let (name, of) = (&object.name, nothing.owner(&object.name, arm, tool)?);
                Some(format!("object '{name}' has the name of {of}; give it another one"))
            });
            return match taken {
                None => Ok(all),
                Some(detail) => Err(refused(&self.name, None, Problem::Detail { detail })),
            };
        }
        let (scenario, table) = self.sections(
            &OBSTACLES,
            "a file of obstacles has the sections [[obstacle]], [floor] and [table]",
            meshes,
        )?;
        let at = |problem: Problem| self.at_key(&table, problem);
        let held = scenario
            .obstacle
            .iter()
            .position(|section| section.holds_plates.is_some());
        match held {
            None => scenario.check_surroundings(),
            Some(index) => conflict(
                format!("obstacle[{index}].holds_plates"),
                "there are no plates here; leave it out",
            ),
        }
        .map_err(at)?;
        scenario
            .obstacles(arm, tool, 0)
            .map_err(|failure| self.of_failure(failure))
    }

    /// Returns notes on obstacles that count as convex parts or hulls, which reach beyond their meshes; none for a text that cannot be read.
    #[must_use]
    pub fn notes_on_meshes(&self, meshes: &MeshPlaces) -> Vec<Note> {
        match is_scene(&self.name) {
            true => {
                let note = |mesh: planning_scene::MeshExcess| Note::LargerThanMesh {
                    body: mesh.obstacle,
                    by_m: mesh.by_m,
                    as_what: MeshAs::Parts,
                };
                let all = planning_scene::mesh_excesses(&self.text).into_iter();
                all.filter(|mesh| mesh.by_m > LEAST_EXCESS_M).map(note).collect()
            }
            false => self
                .sections(&OBSTACLES, "", meshes)
                .map_or_else(|_| Vec::new(), |(scenario, _)| scenario.notes_on_meshes()),
        }
    }

    /// Returns the tool of an arm: sections `[tool]` and `[[tool_body]]`.
    ///
    /// # Errors
    /// As [`ObstacleText::obstacles`], and for a link that carries the tool and is none of the arm.
    pub fn tool(&self, arm: &RobotModel, meshes: &MeshPlaces) -> Result<Tool, ScenarioError> {
        let (scenario, _) = self.sections(
            &TOOL,
            "a file of a tool has the sections [tool] and [[tool_body]]",
            meshes,
        )?;
        scenario.tool_on(arm).map_err(|failure| self.of_failure(failure))
    }

    /// The scenario that has the text's sections, of which only some are allowed.
    fn sections(
        &self,
        allowed: &[&str],
        hint: &str,
        meshes: &MeshPlaces,
    ) -> Result<(Scenario, DeTable<'_>), ScenarioError> {
        let (name, text) = (&self.name, &self.text);
        let syntax = |e: toml::de::Error| of_bodies(ScenarioError::syntax(name, text, &e));
        let table = DeTable::parse(text).map_err(syntax)?.into_inner();
        let at = |at: usize, problem| refused(name, Some(line_at(text, at)), problem);
        if let Some(key) = table.keys().find(|key| !allowed.contains(&key.get_ref().as_ref())) {
            let (key, start) = (key.get_ref().to_string(), key.span().start);
            let hint = hint.to_owned();
            return Err(at(start, Problem::UnknownKey { key, hint }));
        }
        check_table(&table, "").map_err(|(start, problem)| at(start, problem))?;
        let mut scenario: Scenario = toml::from_str(text).map_err(syntax)?;
        scenario.name.clone_from(name);
        scenario.floor.present &= table.contains_key("floor");
        if let Some(folder) = &self.folder {
            scenario.resolve_paths(folder);
        }
        scenario.robot.package_path.clone_from(&meshes.package_path);
        scenario.files = meshes.files.clone();
        Ok((scenario, table))
    }

    /// Error at the key that a problem names.
    fn at_key(&self, table: &DeTable<'_>, problem: Problem) -> ScenarioError {
        let at = problem.key().and_then(|key| byte_of(table, key));
        let line = at.map(|at| line_at(&self.text, at));
        refused(&self.name, line, problem)
    }

    fn of_failure(&self, failure: Failure) -> ScenarioError {
        match failure {
            Failure::Scenario(error) => of_bodies(error),
            other => {
                let detail = other.to_string();
                refused(&self.name, None, Problem::Detail { detail })
            }
        }
    }
}

fn is_scene(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".scene")
}

fn refused(name: &str, line: Option<usize>, problem: Problem) -> ScenarioError {
    of_bodies(ScenarioError::new(name, line, problem))
}

/// The error of a text that is no scenario.
fn of_bodies(error: ScenarioError) -> ScenarioError {
    ScenarioError {
        kind: TextKind::Bodies,
        ..error
    }
}
