//! Collision meshes: found as ROS finds them, read whole or refused.

use crate::urdf::{edited, link};
use nalgebra::Point3;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::urdf::{Files, MeshSource, MeshSplitter};
use platewash_kinematics::{RobotModel, UrdfError};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// Corners of a tetrahedron \[m\], exact in single precision.
const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.125]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

type Triangle = [[f32; 3]; 3];

fn tetrahedron() -> Vec<Triangle> {
    FACES.iter().map(|face| face.map(|k| CORNERS[k])).collect()
}

fn binary_stl(header: &str, triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..header.len()].copy_from_slice(header.as_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|v| v.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl(name: &str, triangles: &[Triangle]) -> Vec<u8> {
    let mut text = format!("solid{name}\n");
    for triangle in triangles {
        text += " facet normal 0 0 1\n  outer loop\n";
        for [x, y, z] in triangle {
            writeln!(text, "   vertex {x:e} {y:e} {z:e}").unwrap();
        }
        text += "  endloop\n endfacet\n";
    }
    text += &format!("endsolid{name}\n");
    text.into_bytes()
}

fn obj() -> Vec<u8> {
    let mut text = String::from("# a tetrahedron\nmtllib broken.mtl\no part\n");
    for [x, y, z] in CORNERS {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    text += "vt 0 0\nusemtl paint\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf -4/-1 -1/-1 -2/-1\nf 2/1 3/1 4/1\n";
    text.into_bytes()
}

/// The arm with a mesh as the only collision shape of link 6.
fn with_mesh(attributes: &str) -> String {
    let before = link("link_6");
    let after = before.replacen("<sphere radius=\"0.0255\"/>", &format!("<mesh {attributes}/>"), 1);
    edited(&[(before, &after)])
}

/// Reads the vertices of one mesh file, found beside the URDF.
fn read(name: &str, bytes: &[u8], scale: &str) -> Result<Vec<Point3<f64>>, UrdfError> {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let text = with_mesh(&format!("filename=\"{name}\" {scale}"));
    RobotModel::from_urdf(&text, &MeshSource::new(&[], Some(folder.path()))).map(|robot| vertices(&robot))
}

fn vertices(robot: &RobotModel) -> Vec<Point3<f64>> {
    let link = robot.links().iter().find(|l| l.name == "link_6").unwrap();
    let [primitive] = &link.collision[..] else {
        panic!("one shape")
    };
    match &primitive.shape {
        Shape::Hull { points } => points.clone(),
        other => panic!("{other:?}"),
    }
}

/// The same points in any order, without repetition.
fn assert_points<'a>(found: &[Point3<f64>], expected: impl IntoIterator<Item = &'a [f32; 3]>, scale: [f64; 3]) {
    let bits = |p: [f64; 3]| p.map(f64::to_bits);
    let set: BTreeSet<_> = found.iter().map(|p| bits([p.x, p.y, p.z])).collect();
    assert_eq!(set.len(), found.len(), "repeated vertices");
    let scaled = |p: &[f32; 3]| bits(std::array::from_fn(|k| f64::from(p[k]) * scale[k]));
    assert_eq!(set, expected.into_iter().map(scaled).collect());
}

/// The same points once rounded to single precision, in which the peers read text.
fn assert_same_in_single(found: &[Point3<f64>], expected: &[[f32; 3]]) {
    let bits = |p: &[f32; 3]| p.map(f32::to_bits);
    let rounded: BTreeSet<_> = found
        .iter()
        .map(|p| bits(&[p.x as f32, p.y as f32, p.z as f32]))
        .collect();
    assert_eq!(rounded, expected.iter().map(bits).collect());
}

// ---- what is read ----

/// Binary STL files from some programs begin with `solid`, and some ASCII files have no name after it.
#[test]
fn reads_ascii_and_binary_stl_by_contents() {
    let triangles = tetrahedron();
    let files = [
        binary_stl("made by hand", &triangles),
        binary_stl("solid link_6 exported", &triangles),
        ascii_stl(" link_6", &triangles),
        ascii_stl("", &triangles),
        String::from_utf8(ascii_stl(" crlf", &triangles))
            .unwrap()
            .replace('\n', "\r\n")
            .into_bytes(),
        [ascii_stl(" one", &triangles[..2]), ascii_stl(" two", &triangles[2..])].concat(),
    ];
    for (k, file) in files.iter().enumerate() {
        let points = read("part.stl", file, "").unwrap_or_else(|e| panic!("file {k}: {e}"));
        assert_points(&points, &CORNERS, [1.0; 3]);
    }
    assert_points(&read("PART.STL", &files[0], "").unwrap(), &CORNERS, [1.0; 3]);
}

#[test]
fn reads_obj_without_its_materials() {
    assert_points(&read("part.obj", &obj(), "").unwrap(), &CORNERS, [1.0; 3]);
}

/// Makes a part of each triangle, with a corner more; of three triangles at most.
#[derive(Debug)]
struct ByTriangle(usize);

impl MeshSplitter for ByTriangle {
    fn split(&self, triangles: &[[Point3<f64>; 3]]) -> Result<Vec<Vec<Point3<f64>>>, String> {
        let part = |t: &[Point3<f64>; 3]| [&t[..], &[Point3::new(0.1, 0.1, 0.1)]].concat();
        match triangles.len() <= self.0 {
            true => Ok(triangles.iter().map(part).collect()),
            false => Err("it is too fine".to_owned()),
        }
    }
}

#[test]
fn meshes_of_links_are_split_on_request() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("part.stl"), binary_stl("part", &tetrahedron())).unwrap();
    let text = with_mesh("filename=\"part.stl\" scale=\"2 2 2\"");
    let source = MeshSource::new(&[], Some(folder.path()));
    let split = |links: &[&str], most: usize| {
        let links: Vec<_> = links.iter().map(|name| (*name).to_owned()).collect();
        let source = source.clone().with_split_links(&links, Arc::new(ByTriangle(most)));
        RobotModel::from_urdf(&text, &source)
    };
    let plain = RobotModel::from_urdf(&text, &source).unwrap();
    assert_eq!(split(&[], 9).unwrap(), plain);
    assert_eq!((plain.split_links().len(), plain.links_with_hulls().count()), (0, 1));
    let parts = split(&["link_6"], 9).unwrap();
    assert_eq!(
        (parts.split_links(), parts.links_with_hulls().count()),
        (&["link_6".to_owned()][..], 0)
    );
    for (before, after) in plain.links().iter().zip(parts.links()) {
        let (a, b) = (&before.collision, &after.collision);
        if before.name == "link_6" {
            assert_eq!((a.len(), b.len()), (1, FACES.len()));
            assert!(b.iter().all(|part| part.pose == a[0].pose));
            let (Shape::Hull { points }, [x, y, z]) = (&b[0].shape, CORNERS[FACES[0][1]]) else {
                panic!()
            };
            assert_eq!(points[1], Point3::new(x, y, z).cast::<f64>() * 2.0);
        } else {
            assert_eq!(before, after);
        }
    }
    assert_ne!(plain.sha256(), parts.sha256());
    for (links, most, words) in [
        (
            ["link_6", "link_9"],
            9,
            "link 'link_9' cannot be split: the description has no such link; links with meshes: link_6; leave it out",
        ),
        (
            ["link_5", "link_6"],
            9,
            "link 'link_5' cannot be split: none of its collision shapes is a mesh; leave it out",
        ),
        (
            ["link_6", "link_6"],
            3,
            "link 'link_6' cannot be split: mesh 'part.stl': it is too fine; leave it out",
        ),
    ] {
        let error = split(&links, most).unwrap_err().to_string();
        assert!(
            error.starts_with(words) && error.contains("robot.split_links"),
            "{error}"
        );
    }
}

/// The material file is never opened: a broken one does no harm.
#[test]
fn reads_obj_with_a_broken_material_file() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("part.obj"), obj()).unwrap();
    std::fs::write(folder.path().join("broken.mtl"), "newmtl paint\nKd 0.5\n").unwrap();
    let source = MeshSource::new(&[], Some(folder.path()));
    let robot = RobotModel::from_urdf(&with_mesh("filename=\"part.obj\""), &source).unwrap();
    assert_points(&vertices(&robot), &CORNERS, [1.0; 3]);
}

#[test]
fn scale_is_applied_axis_by_axis() {
    let millimetres = read(
        "part.stl",
        &binary_stl("", &tetrahedron()),
        "scale=\"0.001 0.001 0.001\"",
    )
    .unwrap();
    assert_points(&millimetres, &CORNERS, [0.001; 3]);
    let mirrored = read("part.stl", &binary_stl("", &tetrahedron()), "scale=\"1 -1 2\"").unwrap();
    assert_points(&mirrored, &CORNERS, [1.0, -1.0, 2.0]);
}

// ---- where it is found ----

/// A description as ROS-Industrial publishes them: a package folder with a mesh for every link.
#[test]
fn reads_meshes_of_a_ros_industrial_package() {
    let root = TempDir::new().unwrap();
    let package = root.path().join("abb_irb120_support");
    let meshes = package.join("meshes/collision");
    std::fs::create_dir_all(&meshes).unwrap();
    let mut edits = Vec::new();
    for (k, name) in ["link_1", "link_2", "link_3", "link_4", "link_5", "link_6"]
        .into_iter()
        .enumerate()
    {
        let file = if k % 2 == 0 {
            binary_stl("solid part", &tetrahedron())
        } else {
            ascii_stl(" part", &tetrahedron())
        };
        std::fs::write(meshes.join(format!("{name}.stl")), file).unwrap();
        let mesh = format!("package://abb_irb120_support/meshes/collision/{name}.stl");
        let body = format!(
            "<link name=\"{name}\"><collision><geometry><mesh filename=\"{mesh}\"/></geometry></collision></link>"
        );
        edits.push((link(name), body));
    }
    let edits: Vec<_> = edits.iter().map(|(old, new)| (*old, new.as_str())).collect();
    let text = edited(&edits);
    // Both the folder that holds the package and the package itself may be given; other folders do no harm.
    for folder in [root.path().to_path_buf(), package] {
        let source = MeshSource::new(&[Path::new("/nowhere").to_path_buf(), folder], None);
        let robot = RobotModel::from_urdf(&text, &source).unwrap();
        assert_points(&vertices(&robot), &CORNERS, [1.0; 3]);
        let hulls = robot
            .links()
            .iter()
            .flat_map(|l| &l.collision)
            .filter(|p| matches!(p.shape, Shape::Hull { .. }));
        assert_eq!(hulls.count(), 6);
    }
}

/// Packages are found from the URDF's place, by folder name or manifest, and where they are installed.
#[test]
fn finds_packages_above_the_urdf_and_where_they_are_installed() {
    let text = with_mesh("filename=\"package://support/meshes/part.stl\"");
    let root = TempDir::new().unwrap();
    let mesh_in = |package: &str, size: f32| {
        let meshes = root.path().join(package).join("meshes");
        std::fs::create_dir_all(&meshes).unwrap();
        let scaled: Vec<_> = tetrahedron().iter().map(|t| t.map(|p| p.map(|c| c * size))).collect();
        std::fs::write(meshes.join("part.stl"), ascii_stl("", &scaled)).unwrap();
    };
    let urdf_in = |folder: &str| root.path().join(folder);
    let read = |folder: &str, given: &[PathBuf], installed: Vec<PathBuf>| {
        let files = Files::default().with_installed(installed);
        let source = MeshSource::new(given, Some(&urdf_in(folder))).reading(&files);
        RobotModel::from_urdf(&text, &source).map(|robot| vertices(&robot))
    };
    mesh_in("ws/support", 1.0);
    mesh_in("share/support", 2.0);
    mesh_in("given/support", 3.0);
    // In the package, deep in it, and in a neighbour of it.
    for folder in ["ws/support", "ws/support/urdf/arms", "ws/other/urdf"] {
        assert_points(&read(folder, &[], vec![]).unwrap(), &CORNERS, [1.0; 3]);
    }
    // What is given comes first, what is installed last.
    let (given, installed) = (vec![root.path().join("given")], vec![root.path().join("share")]);
    assert_points(
        &read("ws/support", &given, installed.clone()).unwrap(),
        &CORNERS,
        [3.0; 3],
    );
    assert_points(&read("ws/support", &[], installed.clone()).unwrap(), &CORNERS, [1.0; 3]);
    assert_points(&read("elsewhere", &[], installed).unwrap(), &CORNERS, [2.0; 3]);
    // A folder of another name counts where its manifest states the package's name.
    mesh_in("support-main", 4.0);
    assert!(read("support-main/urdf", &[], vec![]).is_err());
    let manifest = "<package format=\"3\">\n  <name>support</name>\n</package>";
    std::fs::write(root.path().join("support-main/package.xml"), manifest).unwrap();
    assert_points(&read("support-main/urdf", &[], vec![]).unwrap(), &CORNERS, [4.0; 3]);

    let message = read("elsewhere/urdf", &["/given".into()], vec!["/opt/ros/share".into()])
        .unwrap_err()
        .to_string();
    let above = format!("{} and the folders above it", urdf_in("elsewhere/urdf").display());
    for place in [
        "/given/support/meshes/part.stl",
        &above,
        "/opt/ros/share/support/meshes/part.stl",
        "--package-path",
    ] {
        assert!(message.contains(place), "no '{place}' in: {message}");
    }
}

#[test]
fn reads_meshes_by_relative_and_absolute_paths() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("meshes/part.stl");
    std::fs::create_dir(folder.path().join("meshes")).unwrap();
    std::fs::write(&file, ascii_stl("", &tetrahedron())).unwrap();
    let beside = MeshSource::new(&[], Some(folder.path()));
    for (name, source) in [
        ("meshes/part.stl".to_owned(), &beside),
        ("file://meshes/part.stl".to_owned(), &beside),
        (file.display().to_string(), &MeshSource::none()),
        (format!("file://{}", file.display()), &MeshSource::none()),
    ] {
        let robot = RobotModel::from_urdf(&with_mesh(&format!("filename=\"{name}\"")), source).unwrap();
        assert_points(&vertices(&robot), &CORNERS, [1.0; 3]);
    }
}

/// A name is taken as it is where there is such a file, otherwise as an address.
#[test]
fn reads_percent_signs_of_names_as_in_addresses() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, size: f32| {
        let scaled: Vec<_> = tetrahedron().iter().map(|t| t.map(|p| p.map(|c| c * size))).collect();
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, ascii_stl("", &scaled)).unwrap();
    };
    write("arm/my part.stl", 1.0);
    write("arm/tür.stl", 2.0);
    write("arm/50%25.stl", 3.0);
    write("arm/50%.stl", 4.0);
    let source = MeshSource::new(&[folder.path().to_owned()], Some(folder.path()));
    for (name, size) in [
        ("package://arm/my%20part.stl", 1.0),
        ("file://arm/my%20part.stl", 1.0),
        ("arm/my part.stl", 1.0),
        ("arm/t%C3%BCr.stl", 2.0),
        ("arm/50%25.stl", 3.0),
        ("arm/50%.stl", 4.0),
    ] {
        let robot = RobotModel::from_urdf(&with_mesh(&format!("filename=\"{name}\"")), &source).unwrap();
        assert_points(&vertices(&robot), &CORNERS, [size; 3]);
    }
    let error = RobotModel::from_urdf(&with_mesh("filename=\"arm/no%20part.stl\""), &source)
        .unwrap_err()
        .to_string();
    assert!(error.contains("mesh 'arm/no%20part.stl' not found"), "{error}");
}

// ---- what is refused ----

#[test]
fn names_a_missing_mesh() {
    let text = with_mesh("filename=\"package://support/part.stl\"");
    let folder = TempDir::new().unwrap();
    std::fs::create_dir_all(folder.path().join("support/part.stl")).unwrap();
    for (source, looked_in) in [
        (MeshSource::none(), "none".to_owned()),
        (
            MeshSource::new(&["/nowhere".into()], None),
            "/nowhere/support/part.stl".to_owned(),
        ),
        // A folder with the name of the file is not the file.
        (
            MeshSource::new(&[folder.path().to_path_buf()], None),
            folder.path().display().to_string(),
        ),
    ] {
        let error = RobotModel::from_urdf(&text, &source).unwrap_err();
        assert!(matches!(error, UrdfError::MeshNotFound { .. }), "{error:?}");
        let message = error.to_string();
        for word in [
            "link 'link_6'",
            "package://support/part.stl",
            &looked_in,
            "package path",
        ] {
            assert!(message.contains(word), "no '{word}' in: {message}");
        }
    }
}

#[test]
fn names_a_broken_mesh() {
    let triangles = tetrahedron();
    let binary = binary_stl("part", &triangles);
    let ascii = ascii_stl(" part", &triangles);
    let mut too_few_stated = binary.clone();
    too_few_stated[80] = 1;
    let mut billions_stated = binary.clone();
    billions_stated[80..84].fill(0xff);
    let cases: [(&str, Vec<u8>, &str); 15] = [
        ("part.stl", vec![], "0 bytes"),
        ("part.stl", binary[..60].to_vec(), "60 bytes"),
        (
            "part.stl",
            binary[..binary.len() - 50].to_vec(),
            "states 4 triangles and holds 3",
        ),
        ("part.stl", too_few_stated, "states 1 triangles and holds 4"),
        ("part.stl", billions_stated, "states 4294967295 triangles and holds 4"),
        ("part.stl", binary_stl("", &[]), "0 vertices"),
        ("part.stl", binary_stl("", &triangles[..1]), "3 vertices"),
        ("part.stl", ascii[..ascii.len() / 2].to_vec(), "cut off"),
        (
            "part.stl",
            String::from_utf8(ascii)
                .unwrap()
                .replacen("vertex", "vertex one", 1)
                .into(),
            "line 4: 'one'",
        ),
        ("part.obj", b"v 0 0 0\nv 1 0\n".to_vec(), "line 2"),
        ("part.obj", b"v 0 0 zero\n".to_vec(), "line 1: 'zero'"),
        ("part.obj", vec![], "0 vertices"),
        ("part.dae", b"<COLLADA/>".to_vec(), "0 vertices"),
        ("part.step", b"?".to_vec(), "convert it to STL, OBJ or Collada (.dae)"),
        ("part", b"?".to_vec(), "format ''"),
    ];
    for (name, bytes, what) in cases {
        let error = read(name, &bytes, "").unwrap_err();
        assert!(matches!(error, UrdfError::Mesh { .. }), "{error:?}");
        let message = error.to_string();
        assert!(
            message.contains("link 'link_6'") && message.contains(name) && message.contains(what),
            "{message}"
        );
    }
}

#[test]
fn rejects_invalid_mesh_scales() {
    let nan = [[[f32::NAN, 0.0, 0.0], CORNERS[1], CORNERS[2]], tetrahedron()[3]];
    let error = read("part.stl", &binary_stl("", &nan), "").unwrap_err();
    assert!(matches!(error, UrdfError::NotFinite { .. }) && error.to_string().contains("link 'link_6': mesh vertex"));
    let error = read("part.stl", &binary_stl("", &tetrahedron()), "scale=\"1000 1000 1000\"").unwrap_err();
    assert!(matches!(error, UrdfError::TooLong { .. }) && error.to_string().contains("link 'link_6': mesh vertex"));
    for scale in ["1 0 1", "1 NaN 1", "inf 1 1"] {
        let error = read(
            "part.stl",
            &binary_stl("", &tetrahedron()),
            &format!("scale=\"{scale}\""),
        )
        .unwrap_err();
        let message = error.to_string();
        assert!(
            matches!(error, UrdfError::Mesh { .. }) && message.contains("link_6") && message.contains("scale"),
            "{message}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The same vertices as two libraries read, from files that they or we write.
    #[test]
    fn vertices_are_those_of_stl_io_and_tobj(
        triangles in prop::collection::vec(prop::array::uniform3(prop::array::uniform3(-90.0..90.0f32)), 0..20)
    ) {
        // A hull needs four corners, however degenerate the others are.
        let triangles: Vec<_> = tetrahedron().into_iter().chain(triangles).collect();
        let peer: Vec<_> = triangles.iter().map(|t| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0; 3]),
            vertices: t.map(stl_io::Vertex::new),
        }).collect();
        let mut written = Vec::new();
        stl_io::write_stl(&mut written, peer.iter()).unwrap();
        for bytes in [written, ascii_stl(" part", &triangles)] {
            let mesh = stl_io::read_stl(&mut std::io::Cursor::new(&bytes)).unwrap();
            let expected: Vec<_> = mesh.vertices.iter().map(|v| v.0).collect();
            assert_same_in_single(&read("part.stl", &bytes, "").unwrap(), &expected);
        }
        let mut text = String::new();
        for [x, y, z] in triangles.iter().flatten() {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        for k in 0..triangles.len() {
            writeln!(text, "f {} {} {}", 3 * k + 1, 3 * k + 2, 3 * k + 3).unwrap();
        }
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &tobj::LoadOptions::default(), |_| {
            Err(tobj::LoadError::OpenFileFailed)
        }).unwrap();
        let positions: Vec<_> = models.iter().flat_map(|m| m.mesh.positions.as_chunks::<3>().0.to_vec()).collect();
        assert_same_in_single(&read("part.obj", text.as_bytes(), "").unwrap(), &positions);
    }

    #[test]
    fn random_damage_never_panics(
        file in 0..4usize, at in 0.0..1.0f64, length in 0..200usize, filler in prop::collection::vec(any::<u8>(), 0..60)
    ) {
        let triangles = tetrahedron();
        let (name, mut bytes) = match file {
            0 => ("part.stl", binary_stl("part", &triangles)),
            1 => ("part.stl", binary_stl("solid part", &triangles)),
            2 => ("part.stl", ascii_stl(" part", &triangles)),
            _ => ("part.obj", obj()),
        };
        let at = (at * bytes.len() as f64) as usize;
        let end = bytes.len().min(at + length);
        bytes.splice(at..end, filler);
        let _ = read(name, &bytes, "");
    }
}

/// A scan may have more triangles than a body whose surface is cut, and any coordinates.
#[test]
fn scans_have_up_to_two_million_triangles() {
    let folder = TempDir::new().unwrap();
    let corners = [0.0, 0.0, 0.0, 150.0, 0.0, 0.0, 0.0, 150.0, 0.0_f32];
    let triangle: Vec<u8> = [0.0_f32; 3]
        .iter()
        .chain(&corners)
        .flat_map(|c| c.to_le_bytes())
        .chain([0; 2])
        .collect();
    let source = MeshSource::new(&[], Some(folder.path()));
    let write = |count: u32| {
        let mut bytes = vec![0; 80];
        bytes.extend(count.to_le_bytes());
        bytes.extend(triangle.repeat(count as usize));
        std::fs::write(folder.path().join("scan.stl"), bytes).unwrap();
    };
    write(1_500_000);
    let found = source.scan("scan.stl").unwrap().triangles;
    assert_eq!((found.len(), found[0][1].x), (1_500_000, 150.0));
    let why = source.solid("scan.stl", None).unwrap_err().to_string();
    assert!(why.contains("scan.stl"), "{why}");
    write(2_000_001);
    let why = source.scan("scan.stl").unwrap_err().to_string();
    assert!(
        why.contains("too many triangles; from 1 to 2000000 can be measured"),
        "{why}"
    );
    write(0);
    let why = source.scan("scan.stl").unwrap_err().to_string();
    assert!(why.contains("it has no triangles"), "{why}");
}
