//! What links look like: read where it can be, and left out by name where it cannot. The arm is the same either way.

use crate::urdf::{edited, link};
use nalgebra::Point3;
use platewash_kinematics::RobotModel;
use platewash_kinematics::geometry::{Shape, Triangle, Visual, VisualShape};
use platewash_kinematics::urdf::{MAX_TRIANGLES, MAX_VISUALS, MeshSource};
use proptest::prelude::*;
use std::path::Path;
use tempfile::TempDir;

/// The arm with these visuals in front of those that link 6 has.
fn with(visuals: &str) -> String {
    let before = link("link_6");
    edited(&[(before, &before.replacen("<visual", &format!("{visuals}<visual"), 1))])
}

fn load(text: &str, folder: &Path) -> RobotModel {
    RobotModel::from_urdf(text, &MeshSource::new(&[], Some(folder))).unwrap()
}

fn visuals(robot: &RobotModel) -> &[Visual] {
    &robot.links().iter().find(|l| l.name == "link_6").unwrap().visuals
}

/// The arm with one visual mesh more, beside its description.
fn with_file(name: &str, bytes: &[u8], attributes: &str) -> (RobotModel, TempDir) {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let text = with(&format!(
        "<visual><geometry><mesh filename=\"{name}\" {attributes}/></geometry></visual>"
    ));
    (load(&text, folder.path()), folder)
}

fn triangles(visual: &Visual) -> &[Triangle] {
    match &visual.shape {
        VisualShape::Mesh(triangles) => triangles,
        other => panic!("{other:?}"),
    }
}

/// The only finding of a description with one visual that cannot be read.
fn finding(robot: &RobotModel) -> String {
    let [finding] = robot.visual_findings() else {
        panic!("{:?}", robot.visual_findings())
    };
    finding.to_string()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn reads_the_visuals_of_the_built_in_arm() {
    let robot = RobotModel::irb120().unwrap();
    assert!(robot.visual_findings().is_empty());
    let all: Vec<_> = robot.links().iter().flat_map(|link| &link.visuals).collect();
    assert_eq!(all.len(), 35);
    assert!(all.iter().all(|visual| visual.rgba.is_some() && visual.name.is_some()));
}

#[test]
fn solids_have_their_pose_name_and_colour() {
    let folder = TempDir::new().unwrap();
    let text = with(
        "<visual name=\"cap\"><origin xyz=\"0 0 0.1\"/><geometry><sphere radius=\"0.02\"/></geometry>\
         <material name=\"red\"><color rgba=\"1 0 -3 7\"/></material></visual>\
         <visual><geometry><box size=\"0.2 0.4 0.6\"/></geometry><material name=\"red\"/></visual>\
         <visual><geometry><cylinder radius=\"0.1\" length=\"0.4\"/></geometry><material name=\"unknown\"/></visual>\
         <visual><geometry><sphere radius=\"0.1\"/></geometry><material name=\"nan\"><color rgba=\"NaN 0 0 1\"/></material></visual>",
    );
    let robot = load(&text, folder.path());
    assert!(robot.visual_findings().is_empty(), "{:?}", robot.visual_findings());
    let [cap, cube, rod, plain, ..] = visuals(&robot) else {
        panic!()
    };
    assert_eq!((cap.name.as_deref(), cap.pose.translation.z), (Some("cap"), 0.1));
    assert_eq!(cap.rgba, Some([1.0, 0.0, 0.0, 1.0]));
    let half_m = [0.1, 0.2, 0.3];
    assert_eq!(
        (&cube.shape, cube.rgba),
        (&VisualShape::Solid(Shape::Box { half_m }), cap.rgba)
    );
    assert_eq!((rod.rgba, plain.rgba), (None, None));
}

/// Polygons become fans; indices count from 1 or backwards; what follows a slash is not read.
#[test]
fn reads_faces_of_obj() {
    let file = format!("{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -4 -3 -1\n");
    let (robot, _folder) = with_file("part.obj", file.as_bytes(), "scale=\"0.5 2 1\"");
    assert!(robot.visual_findings().is_empty(), "{:?}", robot.visual_findings());
    let at = |x: f32, y: f32| Point3::new(0.5 * x, 2.0 * y, 0.0);
    let expected = [
        [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)],
        [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)],
        [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)],
    ];
    assert_eq!(triangles(&visuals(&robot)[0]), expected);
}

#[test]
fn mirrored_stl_triangles_keep_their_outside() {
    let text = "solid part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid part\n";
    let (robot, _folder) = with_file("part.stl", text.as_bytes(), "scale=\"-1 1 1\"");
    let corners = [[0.0, 0.0], [0.0, 1.0], [-1.0, 0.0]].map(|[x, y]: [f32; 2]| Point3::new(x, y, 0.0));
    assert_eq!(triangles(&visuals(&robot)[0]), [corners]);
}

/// A visual decides nothing: the arm has the same hash, the same shapes and the same limits with it or without.
#[test]
fn names_unreadable_visuals_without_failing() {
    let dae = "<COLLADA version=\"1.4.1\"><asset><unit meter=\"0.001\"/><up_axis>Z_UP</up_axis></asset>\
        <library_visual_scenes><visual_scene id=\"s\"><node><translate>1 2 3</translate></node></visual_scene>\
        </library_visual_scenes></COLLADA>";
    let nothing = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let cases: [(&str, String, &str, &str); 9] = [
        (
            "part.dae",
            dae.to_owned(),
            "",
            "its <scene> does not say which visual scene is shown",
        ),
        (
            "part.obj",
            format!("{SQUARE}f 1 2 5\n"),
            "",
            "line 5: '5' is none of the 4 vertices",
        ),
        ("part.obj", format!("{SQUARE}f 0 1 2\n"), "", "'0' is none"),
        ("part.obj", format!("{SQUARE}f -5 1 2\n"), "", "'-5' is none"),
        ("part.obj", format!("{SQUARE}f 1 2 x/1\n"), "", "'x/1' is none"),
        ("part.obj", nothing.to_owned(), "", "it has 0 triangles"),
        ("part.obj", format!("{SQUARE}f 1 2 3\n"), "scale=\"0 1 1\"", "scale"),
        (
            "part.obj",
            format!("{SQUARE}f 1 2 3\n"),
            "scale=\"1e6 1 1\"",
            "exceeds 100 m",
        ),
        (
            "part.stl",
            "solid cut\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n".to_owned(),
            "",
            "cut off",
        ),
    ];
    for (name, file, attributes, words) in cases {
        let (robot, _folder) = with_file(name, file.as_bytes(), attributes);
        let said = finding(&robot);
        assert!(
            said.starts_with("visual 1 of link 'link_6' is not shown: ") && said.contains(words),
            "{words}: {said}"
        );
        assert_eq!(said.matches("link_6").count(), 1, "{said}");
        // But for the text of the description itself.
        let bare = RobotModel::irb120().unwrap();
        assert_eq!(visuals(&robot), visuals(&bare));
        assert_eq!(robot.limits(), bare.limits());
        let collision = |robot: &RobotModel| robot.links().iter().map(|l| l.collision.clone()).collect::<Vec<_>>();
        assert_eq!(collision(&robot), collision(&bare));
    }
}

#[test]
fn the_hash_of_an_arm_does_not_depend_on_its_visuals() {
    let good = format!("{SQUARE}f 1 2 3\n");
    let hash = |file: &str| with_file("part.obj", file.as_bytes(), "").0.sha256().to_owned();
    assert_eq!(hash(&good), hash("nonsense"));
}

#[test]
fn names_a_missing_mesh_and_an_invalid_scale() {
    let folder = TempDir::new().unwrap();
    let of = |geometry: &str| {
        let text = with(&format!(
            "<visual name=\"cover\"><geometry>{geometry}</geometry></visual>"
        ));
        finding(&load(&text, folder.path()))
    };
    let missing = of("<mesh filename=\"package://nowhere/cover.stl\"/>");
    assert!(
        missing.contains("visual 'cover' of link 'link_6'") && missing.contains("not found"),
        "{missing}"
    );
    let flat = of("<box size=\"0.1 0 0.1\"/>");
    assert!(flat.contains("box needs positive sizes"), "{flat}");
}

/// More than anybody could look at: what comes first is shown, the rest is named.
#[test]
fn bounds_visuals_and_triangles() {
    let folder = TempDir::new().unwrap();
    let many = "<visual><geometry><sphere radius=\"0.01\"/></geometry></visual>".repeat(MAX_VISUALS);
    let robot = load(&with(&many), folder.path());
    // The built-in arm's own come before and after.
    let shown: usize = robot.links().iter().map(|link| link.visuals.len()).sum();
    assert_eq!((shown, robot.visual_findings().len()), (MAX_VISUALS, 35));
    assert!(
        robot.visual_findings()[0]
            .to_string()
            .contains("the most that are read")
    );
    let fan = |triangles: usize| {
        let face: Vec<_> = (0..triangles + 2).map(|k| (k % 4 + 1).to_string()).collect();
        format!("{SQUARE}f {}\n", face.join(" "))
    };
    let (robot, _folder) = with_file("part.obj", fan(MAX_TRIANGLES).as_bytes(), "");
    assert_eq!(triangles(&visuals(&robot)[0]).len(), MAX_TRIANGLES);
    let (robot, _folder) = with_file("part.obj", fan(MAX_TRIANGLES + 1).as_bytes(), "");
    assert!(
        finding(&robot).contains("triangles; from 1 to 100000 are shown"),
        "{}",
        finding(&robot)
    );
}

proptest! {
    /// Whatever stands in a mesh, it is shown or named.
    #[test]
    fn damaged_meshes_never_panic(text in "[vf0-9 /.\\-\n]{0,120}", binary in prop::collection::vec(any::<u8>(), 0..300)) {
        let obj = format!("{SQUARE}f 1 2 3 4\n{text}");
        for (name, bytes) in [("part.obj", obj.as_bytes()), ("part.stl", binary.as_slice()), ("part.stl", text.as_bytes())] {
            let (robot, _folder) = with_file(name, bytes, "");
            let bare = visuals(&RobotModel::irb120().unwrap()).len();
            prop_assert_eq!(visuals(&robot).len() + robot.visual_findings().len(), bare + 1);
        }
    }
}

/// Links that have collision shapes keep them; the hash tells the arms apart, also where the visuals are no meshes.
#[test]
fn visuals_stand_for_missing_collision_shapes_where_asked() {
    let tetrahedron = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("hand.obj"), tetrahedron).unwrap();
    let before = link("link_6");
    let from = before.find("<collision").unwrap();
    let to = before.find("</collision>").unwrap() + "</collision>".len();
    let mesh = "<visual><origin xyz=\"0 0 0.01\"/><geometry><mesh filename=\"hand.obj\"/></geometry></visual>";
    let bare = format!("{}{mesh}{}", &before[..from], &before[to..]);
    let text = edited(&[(before, &bare)]);
    let stated = load(&text, folder.path());
    assert_eq!(stated.links_without_shapes().collect::<Vec<_>>(), ["link_6"]);
    let source = MeshSource::new(&[], Some(folder.path())).with_visual_shapes(true);
    let taken = RobotModel::from_urdf(&text, &source).unwrap();
    assert_eq!(taken.links_with_visual_shapes(), ["link_6"]);
    assert_eq!(taken.links_with_hulls().collect::<Vec<_>>(), ["link_6"]);
    assert_eq!(taken.links_without_shapes().count(), 0);
    let of = |robot: &RobotModel| {
        robot
            .links()
            .iter()
            .find(|l| l.name == "link_6")
            .unwrap()
            .collision
            .clone()
    };
    let [cylinder, hull] = &of(&taken)[..] else {
        panic!("{:?}", of(&taken))
    };
    assert!(matches!(cylinder.shape, Shape::Cylinder { .. }), "{cylinder:?}");
    let Shape::Hull { points } = &hull.shape else {
        panic!("{hull:?}")
    };
    assert!(points.len() == 4 && hull.pose.translation.z == 0.01);
    for (a, b) in stated
        .links()
        .iter()
        .zip(taken.links())
        .filter(|(a, _)| a.name != "link_6")
    {
        assert_eq!(a.collision, b.collision, "{}", a.name);
    }
    let solids = edited(&[(before, &format!("{}{}", &before[..from], &before[to..]))]);
    let hashes = [MeshSource::none(), MeshSource::none().with_visual_shapes(true)]
        .map(|source| RobotModel::from_urdf(&solids, &source).unwrap().sha256().to_owned());
    assert_ne!(hashes[0], hashes[1]);
}
