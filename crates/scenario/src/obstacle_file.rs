//! Obstacles alone, out of a TOML text: the sections `[[obstacle]]`, `[floor]` and `[table]` of a scenario, and nothing else.

use crate::error::{Problem, ScenarioError};
use crate::failure::Failure;
use crate::keys::fits::{byte_of, line_at};
use crate::load::{MAX_BYTES, check_table, unread};
use crate::scenario::Scenario;
use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::file;
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::workcell::Obstacle;
use std::path::{Path, PathBuf};
use toml::de::DeTable;

/// Sections that a text of obstacles may have.
const SECTIONS: [&str; 3] = ["obstacle", "floor", "table"];

/// Text with obstacles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ObstacleText {
    /// Name of the text in messages.
    pub name: String,
    /// TOML text.
    pub text: String,
    /// Folder to which names of meshes are relative; `None` to leave them as they are.
    pub folder: Option<PathBuf>,
}

impl ObstacleText {
    /// Reads the text of a file.
    ///
    /// # Errors
    /// [`ScenarioError`] for a file that cannot be read, or is longer than 1 MiB.
    pub fn load(path: &Path) -> Result<Self, ScenarioError> {
        let name = path.display().to_string();
        let text = file::read_text(path, MAX_BYTES).map_err(|e| ScenarioError::new(&name, None, unread(e)))?;
        let folder = Some(path.parent().unwrap_or(Path::new("")).to_owned());
        Ok(Self { name, text, folder })
    }

    /// Returns the obstacles around a bare arm whose base is the origin of the world. There is a floor only where the text has a section
    /// `[floor]`. `package://` names of meshes are looked up in `package_path`.
    ///
    /// # Errors
    /// [`Failure`] with the line and the key: another section, a value out of range, a mesh that cannot be read or is no body, a name that
    /// a link has.
    pub fn obstacles(&self, arm: &RobotModel, package_path: &[PathBuf]) -> Result<Vec<Obstacle>, Failure> {
        let (name, text) = (&self.name, &self.text);
        let syntax = |e: toml::de::Error| ScenarioError::syntax(name, text, &e);
        let table = DeTable::parse(text).map_err(syntax)?;
        let refused = |at: Option<usize>, problem| {
            let line = at.map(|at| line_at(text, at));
            ScenarioError::new(name, line, problem)
        };
        let mut keys = table.get_ref().keys();
        if let Some(key) = keys.find(|key| !SECTIONS.contains(&key.get_ref().as_ref())) {
            let at = Some(key.span().start);
            let (key, hint) = (
                key.get_ref().to_string(),
                "a file of obstacles has the sections [[obstacle]], [floor] and [table]".to_owned(),
            );
            return Err(refused(at, Problem::UnknownKey { key, hint }).into());
        }
        check_table(table.get_ref(), "").map_err(|(at, problem)| refused(Some(at), problem))?;
        let mut scenario: Scenario = toml::from_str(text).map_err(syntax)?;
        scenario.name.clone_from(name);
        scenario.floor.present &= table.get_ref().contains_key("floor");
        let held = scenario
            .obstacle
            .iter()
            .position(|section| section.holds_plates.is_some());
        let sound = match held {
            None => scenario.check_surroundings(),
            Some(index) => Err(Problem::Conflict {
                keys: format!("obstacle[{index}].holds_plates"),
                detail: "there are no plates here; leave it out".to_owned(),
            }),
        };
        sound.map_err(|problem| refused(problem.key().and_then(|key| byte_of(table.get_ref(), key)), problem))?;
        if let Some(folder) = &self.folder {
            scenario.resolve_paths(folder);
        }
        scenario.robot.package_path = package_path.to_vec();
        let obstacles = scenario.obstacles(arm, &Tool::from(StraightTool::default()), 0)?;
        Ok(obstacles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::workcell::ObstacleShape;

    fn read(text: &str) -> Result<Vec<Obstacle>, String> {
        let text = ObstacleText {
            name: "around.toml".to_owned(),
            text: text.to_owned(),
            folder: None,
        };
        let arm = RobotModel::irb120().unwrap();
        text.obstacles(&arm, &[]).map_err(|e| e.to_string())
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
            assert!(found.contains(line) && found.contains(words), "{line} {words}: {found}");
        }
    }
}
