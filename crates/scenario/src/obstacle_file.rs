//! Obstacles alone, out of a TOML text or a planning scene of MoveIt, and a tool alone: the sections of a scenario that belong to them, and
//! nothing else.

use crate::error::{Problem, ScenarioError, TextKind};
use crate::failure::Failure;
use crate::keys::fits::{byte_of, line_at};
use crate::load::{MAX_BYTES, check_table, unread};
use crate::planning_scene;
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::{Files, file};
use platewash_workcell::tool::Tool;
use platewash_workcell::workcell::Obstacle;
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
            let all = planning_scene::read(&self.name, &self.text).map_err(of_bodies)?;
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
            Some(index) => Err(Problem::Conflict {
                keys: format!("obstacle[{index}].holds_plates"),
                detail: "there are no plates here; leave it out".to_owned(),
            }),
        }
        .map_err(at)?;
        scenario
            .obstacles(arm, tool, 0)
            .map_err(|failure| self.of_failure(failure))
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

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::tool::StraightTool;
    use platewash_workcell::workcell::ObstacleShape;

    fn read(text: &str) -> Result<Vec<Obstacle>, String> {
        let text = ObstacleText {
            name: "around.toml".to_owned(),
            text: text.to_owned(),
            folder: None,
        };
        let arm = RobotModel::irb120().unwrap();
        let tool = Tool::from(StraightTool::default());
        text.obstacles(&arm, &tool, &MeshPlaces::default())
            .map_err(|e| e.to_string())
    }

    const BOX: &str =
        "[[obstacle]]\nname = \"box\"\nshape = \"box\"\nsize_m = [0.1, 0.2, 0.3]\nat_m = [0.5, 0.0, 0.1]\n";

    #[test]
    fn a_floor_is_there_only_where_it_is_stated() {
        let names = |text: &str| read(text).unwrap().into_iter().map(|o| o.name).collect::<Vec<_>>();
        assert_eq!(names(""), [""; 0]);
        assert_eq!(names(BOX), ["box"]);
        assert_eq!(names(&format!("[floor]\n{BOX}")), ["floor", "box"]);
        assert_eq!(
            names("[floor]\npresent = false\n[table]\nsize_m = [1.0, 1.0]\n"),
            ["table"]
        );
        let [found] = &read(BOX).unwrap()[..] else { panic!() };
        assert!(matches!(found.shape, ObstacleShape::Convex(_)));
    }

    #[test]
    fn faults_name_line_and_key() {
        let cases = [
            (
                "[wash]\nturns = 3\n".to_owned(),
                "line 1",
                "[[obstacle]], [floor] and [table]",
            ),
            (BOX.replace("size_m", "sizes_m"), "line 4", "size_m"),
            (BOX.replace("0.5,", "nan,"), "line 5", "obstacle[0].at_m"),
            (
                BOX.replace("\"box\"\nshape", "\"link_2\"\nshape"),
                "a link of the arm",
                "obstacle[0].name",
            ),
            (
                format!("{BOX}holds_plates = \"all\"\n"),
                "line 6",
                "there are no plates",
            ),
            (format!("{BOX}{BOX}"), "line 7", "already"),
            ("[[obstacle]\n".to_owned(), "line 1", "TOML"),
            (
                BOX.replace(
                    "shape = \"box\"\nsize_m = [0.1, 0.2, 0.3]",
                    "shape = \"mesh\"\nmesh = \"none.stl\"",
                ),
                "none.stl",
                "obstacle[0].mesh",
            ),
        ];
        for (text, line, words) in cases {
            let found = read(&text).unwrap_err();
            assert!(
                found.starts_with("around.toml") && found.contains(line) && found.contains(words),
                "{line} {words}: {found}"
            );
        }
    }

    #[test]
    fn a_tool_comes_from_its_own_sections() {
        let arm = RobotModel::irb120().unwrap();
        let read = |text: &str| {
            let (name, text, folder) = ("tool.toml".to_owned(), text.to_owned(), None);
            let text = ObstacleText { name, text, folder };
            text.tool(&arm, &MeshPlaces::default()).map_err(|e| e.to_string())
        };
        assert_eq!(read("[tool]\nlength_m = 0.2\n").unwrap().bodies.len(), 1);
        for (text, words) in [
            (
                "[floor]\n",
                "tool.toml, line 1: unknown key 'floor'; a file of a tool has",
            ),
            ("[tool]\nlength_m = 20.0\n", "tool.toml, line 2: tool.length_m must be"),
            ("[tool]\nmounted_on = \"hand\"\n", "tool.toml: tool.mounted_on"),
        ] {
            let found = read(text).unwrap_err();
            assert!(found.contains(words), "{words}: {found}");
        }
    }

    #[test]
    fn a_planning_scene_is_read_by_its_name() {
        let scene = |object: &str| {
            let text = format!("s\n* {object}\n1\nsphere\n0.1\n1 0 0\n0 0 0 1\n0 0 0 0\n.\n");
            let (name, folder) = ("cell.scene".to_owned(), None);
            let text = ObstacleText { name, text, folder };
            let tool = Tool::from(StraightTool::default());
            text.obstacles(&RobotModel::irb120().unwrap(), &tool, &MeshPlaces::default())
        };
        assert_eq!(scene("ball").unwrap()[0].name, "ball");
        assert!(
            scene("link_3")
                .unwrap_err()
                .to_string()
                .contains("cell.scene: object 'link_3' has the name of a link")
        );
    }
}
