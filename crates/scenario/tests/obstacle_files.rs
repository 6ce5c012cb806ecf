//! Files of obstacles or of a tool alone.

use platewash_kinematics::RobotModel;
use platewash_scenario::{MeshPlaces, ObstacleText};
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::{Obstacle, ObstacleShape};

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

const BOX: &str = "[[obstacle]]\nname = \"box\"\nshape = \"box\"\nsize_m = [0.1, 0.2, 0.3]\nat_m = [0.5, 0.0, 0.1]\n";

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
