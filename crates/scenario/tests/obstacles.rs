//! Floor, table and obstacles of scenario files: what they become, and what is refused, by key, line and name.

use platewash_kinematics::geometry::Shape;
use platewash_scenario::{Draft, Failure, Scenario};
use platewash_workcell::{MOST_BODIES, Obstacle, ObstacleShape};
use std::path::Path;

const LAYOUT: &str = "wash.height_m = 0\ntool.length_m = 0.15\nlayout.positions_m = [[0.35, 0.2], [0.35, -0.2]]\nlayout.min_distance_m = 0.3\n";

/// A certified job with some sections behind it.
fn text(more: &str) -> String {
    format!("{LAYOUT}job.program = \"certified\"\nrobot.start_deg = [0, 0, 0, 0, 90, 0]\n{more}")
}

fn scenario(more: &str) -> Scenario {
    Scenario::parse(&text(more), "case").unwrap()
}

fn obstacles(more: &str) -> Vec<Obstacle> {
    let job = scenario(more).job().unwrap_or_else(|failure| panic!("{failure}"));
    job.terms().workcell.obstacles.clone()
}

fn refused(more: &str) -> String {
    match Scenario::parse(&text(more), "case") {
        Err(error) => error.to_string(),
        Ok(scenario) => scenario.job().unwrap_err().to_string(),
    }
}

fn named(name: &str, more: &str) -> String {
    format!("[[obstacle]]\nname = \"{name}\"\n{more}\n")
}

#[test]
fn every_shape_becomes_an_obstacle() {
    let all = [
        named(
            "a",
            "shape = \"box\"\nsize_m = [0.2, 0.4, 0.6]\nat_m = [0.9, 0, 0.3]\nrpy_deg = [0, 0, 90]",
        ),
        named(
            "b",
            "shape = \"cylinder\"\nradius_m = 0.1\nlength_m = 0.4\nat_m = [0, 1, 0]\nmargin_m = 0.02",
        ),
        named(
            "c",
            "shape = \"capsule\"\nradius_m = 0.1\nlength_m = 0.4\nat_m = [0, -1, 0]",
        ),
        named(
            "d",
            "shape = \"sphere\"\nradius_m = 0.1\nat_m = [-1, 0, 0]\nholds_plates = \"all\"",
        ),
        named(
            "e",
            "shape = \"half_space\"\nat_m = [-0.7, 0, 0]\nrpy_deg = [0, 90, 0]\nholds_plates = [1]",
        ),
    ];
    let found = obstacles(&all.concat());
    assert_eq!(found[0], Obstacle::floor());
    let names: Vec<_> = found.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["floor", "a", "b", "c", "d", "e"]);
    let half_m = [0.1, 0.2, 0.3];
    assert_eq!(found[1].shape, ObstacleShape::Convex(Shape::Box { half_m }));
    let x = found[1].pose.rotation * nalgebra::Vector3::x();
    assert!((x - nalgebra::Vector3::y()).norm() < 1e-12);
    assert_eq!((found[2].margin_m, found[1].margin_m), (0.02, 0.0));
    assert_eq!(
        (&found[4].holds_plates[..], &found[5].holds_plates[..]),
        (&[0, 1][..], &[1][..])
    );
    // All behind a wall: its normal leads towards the arm.
    let out = found[5].pose.rotation * nalgebra::Vector3::z();
    assert!((out - nalgebra::Vector3::x()).norm() < 1e-12);
}

#[test]
fn floors_and_tables_become_obstacles() {
    let found = obstacles(
        "[floor]\nheight_m = -0.7\nmargin_m = 0.1\n[table]\nsize_m = [1.2, 1.4]\nat_m = [0.3, 0]\nthickness_m = 0.04\n",
    );
    assert_eq!((found[0].pose.translation.z, found[0].margin_m), (-0.7, 0.1));
    assert_eq!((found[1].name.as_str(), found[1].pose.translation.z), ("table", -0.02));
    assert_eq!(obstacles("[floor]\npresent = false\n"), []);
}

/// A scenario without any is written as before, and one with all of it is read back the same.
#[test]
fn obstacles_survive_writing_and_reading() {
    let all = named(
        "a",
        "shape = \"box\"\nsize_m = [0.2, 0.4, 0.6]\nat_m = [0.9, 0, 0.3]\nholds_plates = [0]",
    );
    let with = scenario(&format!(
        "{all}{}",
        named(
            "b",
            "shape = \"sphere\"\nradius_m = 0.1\nat_m = [-1, 0, 0]\nholds_plates = \"all\""
        )
    ));
    let written = toml::to_string(&with).unwrap();
    assert_eq!(Scenario::parse(&written, "case").unwrap(), with);
    assert_eq!(with.validate(), Ok(()));
    let json = serde_json::to_string(&scenario("").job().unwrap().terms()).unwrap();
    assert!(!json.contains("margin_m") && !json.contains("holds_plates"), "{json}");
}

#[test]
fn errors_name_key_and_line() {
    let cases = [
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"cube\"\n",
            "line 9: obstacle[0].shape must be \"box\" or",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nsise_m = [1, 1, 1]\n",
            "line 9: unknown key 'obstacle[0].sise_m'; did you mean 'obstacle[0].size_m'?",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"box\"\nsize_m = [1, -1, 1]\n",
            "line 10: obstacle[0].size_m must be three numbers above 0",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"box\"\nsize_m = [nan, 1, 1]\n",
            "obstacle[0].size_m must be three numbers",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 1e300\n",
            "obstacle[0].radius_m must be a number above 0",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nmargin_m = -0.1\n",
            "obstacle[0].margin_m must be a number from 0",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nholds_plates = [1, 0]\n",
            "obstacle[0].holds_plates must be \"all\" or a list",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nholds_plates = \"some\"\n",
            "obstacle[0].holds_plates must be \"all\" or a list",
        ),
        ("[[obstacle]]\nname = \"a\"\n", "obstacle[0].shape: is missing"),
        ("[[obstacle]]\nshape = \"box\"\n", "obstacle[0].name: is missing"),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"box\"\n",
            "obstacle[0].size_m: is missing; a box has one",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 1\nlength_m = 1\n",
            "obstacle[0].length_m: is not a size of a sphere",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"half_space\"\nradius_m = 1\n",
            "obstacle[0].radius_m: is not a size of a half-space",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"box\"\nsize_m = [1, 1, 1]\nmesh = \"a.stl\"\n",
            "obstacle[0].mesh: is for shape = \"mesh\" alone",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"mesh\"\n",
            "obstacle[0].mesh: is missing",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"half_space\"\n",
            "obstacle[0].at_m: is missing; every obstacle has its place",
        ),
        (
            "[[obstacle]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 0.1\nat_m = [1, 1, 1]\nholds_plates = [5]\n",
            "obstacle[0].holds_plates: it holds the plate with index 5; there are 2 plates, counted from 0",
        ),
        (
            "[table]\nheight_m = 0\n",
            "table.size_m: is missing; table.height_m is stated",
        ),
        (
            "[table]\nat_m = [0, 0]\n",
            "table.size_m: is missing; table.at_m is stated",
        ),
        (
            "[floor]\npresent = false\nmargin_m = 0.05\n",
            "floor.margin_m: says nothing where there is no floor",
        ),
        (
            "[floor]\nheight_m = 0\npresent = false\n",
            "floor.height_m: says nothing where there is no floor",
        ),
        (
            "[obstacle]\nname = \"a\"\n",
            "obstacle must be a list of at most 1000 sections: write [[obstacle]] for each",
        ),
        ("[[table]]\nsize_m = [1, 1]\n", "table must be a section"),
        (
            "[floor]\nheight_m = 700\n",
            "floor.height_m must be a number from -10 to 10",
        ),
    ];
    for (more, words) in cases {
        let said = refused(more);
        assert!(said.contains(words), "{words}\n{said}");
    }
}

#[test]
fn rejects_a_name_of_two_bodies() {
    let far = "shape = \"sphere\"\nradius_m = 0.1\nat_m = [-1, 0, 0]";
    let twice = format!("{}{}", named("a", far), named("a", far));
    assert!(refused(&twice).contains("obstacle[1].name: 'a' is the name of obstacle[0] already"));
    for (name, of) in [
        ("floor", "the floor"),
        ("sponge", "the sponge"),
        ("handle", "a body of the tool"),
        ("link_3", "a link of the arm"),
        ("plate 1", "a plate"),
        ("real plate 7", "a plate"),
    ] {
        let said = refused(&named(name, far));
        assert!(
            said.contains(&format!("obstacle[0].name: '{name}' is the name of {of}")),
            "{said}"
        );
    }
    assert_eq!(obstacles(&named("plate rack", far)).len(), 2);
    assert!(
        refused(&format!(
            "[table]\nsize_m = [0.1, 0.1]\nat_m = [2, 2]\n{}",
            named("table", far)
        ))
        .contains("the table")
    );
}

#[test]
fn rejects_an_obstacle_in_a_plate_or_the_base_by_both_names() {
    let rack = "shape = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nat_m = [0.35, 0.2, 0.05]";
    let said = refused(&named("rack", rack));
    assert!(
        said.contains("obstacle 'rack' reaches") && said.contains("into plate 1"),
        "{said}"
    );
    let said = refused(&named(
        "rack",
        "shape = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nat_m = [0, 0, 0.05]",
    ));
    assert!(
        said.contains("obstacle 'rack' reaches") && said.contains("into base_link"),
        "{said}"
    );
    assert_eq!(
        obstacles(&named("rack", &rack.replace("0.05]", "-0.04]\nholds_plates = [0]"))).len(),
        2
    );
    let said = refused(&named("rack", &format!("{rack}\nholds_plates = [2]")));
    assert!(said.contains("it holds the plate with index 2; there are 2"), "{said}");
}

/// One more than can be judged, with floor and tool, is refused wherever a scenario is checked; as many as can be are none too many.
#[test]
fn more_bodies_than_can_be_judged_are_refused_by_their_key() {
    let ball = |k: usize| {
        let far = format!(
            "shape = \"sphere\"\nradius_m = 0.005\nat_m = [2, 2, {}]",
            0.01 * (k + 1) as f64
        );
        named(&format!("o{k}"), &far)
    };
    let crowd = |count: usize| scenario(&(0..count).map(ball).collect::<String>());
    let others = crowd(0).job().unwrap().terms().workcell.bodies();
    let words = format!("obstacle must be a list of at most {} sections", MOST_BODIES - others);
    let many = crowd(MOST_BODIES - others + 1);
    for failure in [many.check().unwrap_err(), many.job().map(|_| ()).unwrap_err()] {
        assert!(failure.to_string().contains(&words), "{failure}");
    }
    assert_eq!(
        crowd(MOST_BODIES - others).job().unwrap().terms().workcell.bodies(),
        MOST_BODIES
    );
}

/// The arm at home, in an obstacle: named with what it is in.
#[test]
fn a_home_in_an_obstacle_is_refused_by_the_pair() {
    let post = "shape = \"cylinder\"\nradius_m = 0.03\nlength_m = 0.2\nat_m = [0.374, 0, 0.6]";
    let failure = scenario(&named("post", post)).check().unwrap_err();
    let said = failure.to_string();
    assert!(said.contains("robot.start_deg") && said.contains("post"), "{said}");
}

fn with_mesh(folder: &Path, file: &str, content: &[u8], more: &str) -> Result<Scenario, Failure> {
    std::fs::write(folder.join(file), content).unwrap();
    let mesh = named(
        "thing",
        &format!("shape = \"mesh\"\nmesh = \"{file}\"\nat_m = [0.9, 0, 0.1]\n{more}"),
    );
    let path = folder.join("cell.toml");
    std::fs::write(&path, text(&mesh)).unwrap();
    let scenario = Scenario::load(&path.to_string_lossy())?;
    scenario.job().map(|_| scenario)
}

/// Lines of an OBJ file for a box between two corners, behind some other boxes.
fn box_obj(others: usize, low: [f64; 3], high: [f64; 3]) -> String {
    let mut text = String::new();
    for k in 0..8 {
        let [x, y, z] = std::array::from_fn(|bit| if k >> bit & 1 == 1 { high[bit] } else { low[bit] });
        text += &format!("v {x} {y} {z}\n");
    }
    for face in [
        [1, 3, 4, 2],
        [5, 6, 8, 7],
        [1, 2, 6, 5],
        [3, 7, 8, 4],
        [1, 5, 7, 3],
        [2, 4, 8, 6],
    ] {
        let face = face.map(|corner| (corner + 8 * others).to_string());
        text += &format!("f {}\n", face.join(" "));
    }
    text
}

/// An L of two boxes, as an OBJ file.
fn angle() -> String {
    let mut text = String::new();
    for (index, [x, y]) in [[0.2, 0.02], [0.02, 0.2]].iter().enumerate() {
        text += &box_obj(index, [0.0; 3], [*x, *y, 0.1]);
    }
    text
}

#[test]
fn meshes_are_hulls_or_parts_and_a_job_has_their_points() {
    let folder = tempfile::tempdir().unwrap();
    let shape = |more: &str| {
        let scenario = with_mesh(folder.path(), "angle.obj", angle().as_bytes(), more).unwrap();
        let job = scenario.job().unwrap();
        let json = serde_json::to_string(job.terms()).unwrap();
        assert!(!json.contains("angle.obj"), "{json}");
        job.terms().workcell.obstacles[1].shape.clone()
    };
    assert!(matches!(shape(""), ObstacleShape::Convex(Shape::Hull { points }) if points.len() == 10));
    let millimetres = shape("mesh_scale = [0.001, 0.001, -0.001]");
    let ObstacleShape::Convex(Shape::Hull { points }) = millimetres else {
        panic!()
    };
    assert!(points.iter().all(|p| p.x <= 2e-4 && p.z <= 0.0 && p.z >= -1e-4));
    assert!(matches!(shape("mesh_parts = \"decomposed\""), ObstacleShape::Parts(parts) if parts.len() >= 2));
}

/// A Collada file of one triangle and its mirror image, with a unit.
fn collada(metres: &str) -> String {
    let places = "0 0 0 100 0 0 0 100 0 0 0 100";
    format!(
        "<COLLADA><asset><unit meter=\"{metres}\"/></asset><library_geometries><geometry id=\"a\"><mesh><source id=\"p\"><float_array id=\"n\" \
         count=\"12\">{places}</float_array><technique_common><accessor source=\"#n\" count=\"4\" stride=\"3\"><param name=\"X\" \
         type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices \
         id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" \
         offset=\"0\"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries></COLLADA>"
    )
}

#[test]
fn a_mesh_is_scaled_once() {
    let folder = tempfile::tempdir().unwrap();
    let millimetres = collada("0.001");
    let reach_m = |text: &str, more: &str| {
        let scenario =
            with_mesh(folder.path(), "a.dae", text.as_bytes(), more).map_err(|failure| failure.to_string())?;
        let job = scenario.job().map_err(|failure| failure.to_string())?;
        Ok::<_, String>(job.terms().workcell.obstacles[1].shape.extent_m().unwrap())
    };
    assert!((reach_m(&millimetres, "").unwrap() - 0.1).abs() < 1e-12);
    assert!((reach_m(&collada("1"), "mesh_scale = [0.001, 0.001, 0.001]").unwrap() - 0.1).abs() < 1e-12);
    for unit in ["0.001", "0.0254", "1000"] {
        let said = reach_m(&collada(unit), "mesh_scale = [0.001, 0.001, 0.001]").unwrap_err();
        let unit: f64 = unit.parse().unwrap();
        let expected = format!(
            "it states its unit, {unit} m, and the scale [0.001, 0.001, 0.001] is stated, too: leave out mesh_scale"
        );
        assert!(said.contains(&expected), "{said}");
    }
    let said = reach_m(&collada("10"), "").unwrap_err();
    assert!(said.contains("these may be millimetres"), "{said}");
}

#[test]
fn bodies_of_unusual_sizes_are_named() {
    let notes = |more: &str| {
        let scenario = scenario(more);
        let all = scenario.notes_on_bodies(&scenario.arm().unwrap());
        all.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let edges = |m: f64| {
        named(
            "thing",
            &format!("shape = \"box\"\nsize_m = [{m}, {m}, {m}]\nat_m = [30, 0, 0]"),
        )
    };
    assert_eq!(notes(&edges(0.0011)), Vec::<String>::new());
    assert_eq!(notes(&edges(9.9)), Vec::<String>::new());
    assert!(notes(&edges(9e-4))[0].contains("\"thing\" is 0.90 mm long at most; its numbers may be scaled twice"));
    assert!(notes(&edges(20.0))[0].contains("\"thing\" is 20.0 m long at most; its numbers may be in millimetres"));
}

/// Four walls of a room as one mesh: its hull holds the arm, its parts do not.
#[test]
fn a_hull_in_which_bodies_stand_is_named_and_a_decomposition_tried() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = String::new();
    for (index, [low, high]) in [
        [[-2.0, -2.0], [2.0, -1.9]],
        [[-2.0, 1.9], [2.0, 2.0]],
        [[-2.0, -1.9], [-1.9, 1.9]],
        [[1.9, -1.9], [2.0, 1.9]],
    ]
    .into_iter()
    .enumerate()
    {
        text += &box_obj(index, [low[0], low[1], 0.0], [high[0], high[1], 1.0]);
    }
    std::fs::write(folder.path().join("room.obj"), &text).unwrap();
    let said = |more: &str| {
        let mesh = named(
            "room",
            &format!("shape = \"mesh\"\nmesh = \"room.obj\"\nat_m = [0, 0, 0.01]\n{more}"),
        );
        let path = folder.path().join("cell.toml");
        std::fs::write(&path, self::text(&mesh)).unwrap();
        let scenario = Scenario::load(&path.to_string_lossy()).unwrap();
        scenario.check().map(|_| ()).map_err(|failure| failure.to_string())
    };
    let hull = said("").unwrap_err();
    assert!(
        hull.contains("obstacle 'room' counts as the convex hull of its mesh")
            && hull.contains("with mesh_parts = \"decomposed\" nothing stands in it (tried)"),
        "{hull}"
    );
    assert_eq!(said("mesh_parts = \"decomposed\""), Ok(()));
    let near = "mesh_parts = \"hull\"\n[[obstacle]]\nname = \"post\"\nshape = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nat_m = [0, 0, 0.3]";
    let both = said(near).unwrap_err();
    assert!(
        both.contains("mesh_parts = \"decomposed\" alone does not mend it (tried)"),
        "{both}"
    );
}

#[test]
fn rejects_invalid_meshes_by_obstacle_and_file() {
    let folder = tempfile::tempdir().unwrap();
    let million = {
        let mut stl = vec![0_u8; 84 + 50 * 1_000_000];
        stl[80..84].copy_from_slice(&1_000_000_u32.to_le_bytes());
        stl
    };
    let flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    let cases: [(&str, &[u8], &str, &str); 9] = [
        ("million.stl", &million, "", "too many triangles"),
        ("empty.obj", b"", "", "no triangles"),
        ("points.obj", b"v 0 0 0\nv 1 0 0\n", "", "no triangles"),
        ("flat.obj", flat.as_bytes(), "", "it is flat"),
        ("flat.obj", flat.as_bytes(), "mesh_parts = \"decomposed\"", "it is flat"),
        (
            "nan.obj",
            b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "",
            "coordinates must be numbers",
        ),
        (
            "far.obj",
            b"v 1e9 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "",
            "coordinates must be numbers",
        ),
        ("a.dae", b"<COLLADA/>", "", "no triangles"),
        (
            "cut.stl",
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
            "",
            "cut off",
        ),
    ];
    for (file, content, more, words) in cases {
        let said = with_mesh(folder.path(), file, content, more).unwrap_err().to_string();
        assert!(
            said.contains("obstacle[0].mesh: obstacle 'thing'") && said.contains(file),
            "{said}"
        );
        assert!(said.contains(words), "{words}\n{said}");
    }
    let said = with_mesh(folder.path(), "a.obj", angle().as_bytes(), "mesh_scale = [1, 0, 1]");
    let said = said.unwrap_err().to_string();
    assert!(
        said.contains("obstacle[0].mesh_scale must be three numbers") && said.contains("none of them 0"),
        "{said}"
    );
    std::fs::write(
        folder.path().join("b.toml"),
        text(&named(
            "thing",
            "shape = \"mesh\"\nmesh = \"none.stl\"\nat_m = [1, 0, 0]",
        )),
    )
    .unwrap();
    let absent = Scenario::load(&folder.path().join("b.toml").to_string_lossy()).unwrap();
    let said = absent.job().unwrap_err().to_string();
    assert!(
        said.contains("'thing'") && said.contains("none.stl' was not found"),
        "{said}"
    );
}

#[test]
fn meshes_in_packages_and_by_file_address_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("kitchenware");
    std::fs::create_dir(&package).unwrap();
    std::fs::write(package.join("angle.obj"), angle()).unwrap();
    let urdf = folder.path().join("arm.urdf");
    std::fs::write(&urdf, platewash_kinematics::irb120::IRB120_URDF).unwrap();
    let by = |mesh: &str| {
        let robot = "[robot]\nurdf = \"arm.urdf\"\npackage_path = [\".\"]\nstart_deg = [0, 0, 0, 0, 90, 0]\n";
        let thing = named(
            "thing",
            &format!("shape = \"mesh\"\nmesh = \"{mesh}\"\nat_m = [0.9, 0, 0.1]"),
        );
        let path = folder.path().join("cell.toml");
        std::fs::write(&path, format!("{LAYOUT}job.program = \"certified\"\n{robot}{thing}")).unwrap();
        Scenario::load(&path.to_string_lossy()).unwrap().job().unwrap()
    };
    let address = format!("file://{}", package.join("angle.obj").display());
    for mesh in ["package://kitchenware/angle.obj", "kitchenware/angle.obj", &address] {
        assert_eq!(by(mesh).terms().workcell.obstacles.len(), 2, "{mesh}");
    }
}

/// Keys of other sections change; what is said of obstacles stays byte for byte.
#[test]
fn drafts_leave_obstacles_as_they_are() {
    let before = text(&named(
        "a",
        "shape = \"sphere\"   # a ball\nradius_m = 0.1\nat_m = [-1, 0, 0]",
    ));
    let mut draft = Draft::new(&before).unwrap();
    draft.set("wash.clearance_m", Some(&0.02.into())).unwrap();
    draft.set("seed", Some(&7.into())).unwrap();
    draft.set("floor.height_m", Some(&(-0.5).into())).unwrap();
    draft.set("table.size_m", Some(&serde_json::json!([1.0, 2.0]))).unwrap();
    let listed = &before[before.find("[[obstacle]]").unwrap()..];
    assert!(draft.text().contains(listed), "{}", draft.text());
    let scenario = draft.scenario("case", None).unwrap();
    assert_eq!(
        (scenario.seed, scenario.obstacle.len(), scenario.floor.height_m),
        (7, 1, Some(-0.5))
    );
    assert_eq!(
        (scenario.wash.clearance_m, scenario.table.size_m),
        (0.02, Some([1.0, 2.0]))
    );
}

/// An edit that would fall into a section of a list is none: the top level ends where sections begin.
#[test]
fn keys_never_fall_into_a_section_of_a_list() {
    let before = "[[obstacle]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 0.1\n";
    let mut draft = Draft::new(before).unwrap();
    draft.set("name", Some(&"cell".into())).unwrap();
    draft.set("seed", Some(&3.into())).unwrap();
    draft.set("floor.margin_m", Some(&0.01.into())).unwrap();
    let stated = draft.stated();
    assert_eq!((&stated["name"], &stated["seed"]), (&"cell".into(), &3.into()));
    assert!(draft.text().contains(before), "{}", draft.text());
}
