//! Bodies of the tool out of mesh files.

use platewash_kinematics::RobotModel;
use platewash_kinematics::geometry::Shape;
use platewash_scenario::{Failure, Scenario};
use platewash_workcell::tool::Tool;
use std::path::Path;

/// A box of 60 × 20 × 40 units about the origin, as an OBJ file; its inside counts once, whatever is inside of it.
const BOX: &str = "v -30 -10 -20\nv 30 -10 -20\nv 30 10 -20\nv -30 10 -20\nv -30 -10 20\nv 30 -10 20\nv 30 10 20\nv -30 10 20\nv 1 2 3\n\
                   f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 1 2 9\n";

const HEAD: &str = "layout.positions_m = [[0.3, 0]]\n[tool]\nlength_m = 0.15\nhandle = \"none\"\nmass_kg = 0.4\n[wash]\nheight_m = 0\n[job]\nprogram = \"certified\"\n";

const PLACE: &str = "at_m = [0.01, 0, 0.06]\nrpy_deg = [10, 20, 30]\n";

fn of(folder: &Path, body: &str) -> Result<Tool, Failure> {
    let file = folder.join("case.toml");
    std::fs::write(&file, format!("{HEAD}[[tool_body]]\nname = \"bracket\"\n{body}")).unwrap();
    let scenario = Scenario::load(file.to_str().unwrap())?;
    assert_eq!(scenario.validate(), Ok(()));
    scenario.tool_on(&RobotModel::irb120().unwrap())
}

#[test]
fn a_box_from_a_mesh_file_equals_the_box() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("box.obj"), BOX).unwrap();
    let plain = of(
        folder.path(),
        &format!("shape = \"box\"\nsize_m = [0.06, 0.02, 0.04]\n{PLACE}"),
    )
    .unwrap();
    // Mirrored it is the same.
    for scale in ["[0.001, 0.001, 0.001]", "[-0.001, 0.001, 0.001]"] {
        let body = format!("shape = \"mesh\"\nmesh = \"box.obj\"\nmesh_scale = {scale}\n{PLACE}");
        let mesh = of(folder.path(), &body).unwrap();
        assert!(matches!(&mesh.bodies[0].shape, Shape::Hull { points } if points.len() == 8));
        assert_eq!((&mesh.bodies[0].pose, mesh.tip), (&plain.bodies[0].pose, plain.tip));
        let (mesh, plain) = (mesh.mass.unwrap(), plain.mass.unwrap());
        assert_eq!(mesh.mass_kg, 0.4);
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
        assert!(near(&mesh.com_m, &plain.com_m), "{mesh:?} {plain:?}");
        assert!(near(&mesh.inertia_kg_m2, &plain.inertia_kg_m2), "{mesh:?} {plain:?}");
    }
}

#[test]
fn a_job_holds_the_points_of_a_mesh_and_no_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("box.obj"), BOX).unwrap();
    let body = format!("shape = \"mesh\"\nmesh = \"box.obj\"\nmesh_scale = [0.001, 0.001, 0.001]\n{PLACE}");
    of(folder.path(), &body).unwrap();
    let job = Scenario::load(folder.path().join("case.toml").to_str().unwrap()).unwrap();
    let json = serde_json::to_string(job.job().unwrap().terms()).unwrap();
    assert!(!json.contains("box.obj") && json.contains("\"hull\""), "{json}");
}

#[test]
fn meshes_that_make_no_tool_are_refused_by_section_body_and_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("box.obj"), BOX).unwrap();
    std::fs::write(folder.path().join("flat.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let mesh = |file: &str, more: &str| format!("shape = \"mesh\"\nmesh = \"{file}\"\n{more}");
    for (body, words) in [
        (
            mesh("box.obj", ""),
            "tool_body[0].mesh_scale: body of the tool 'bracket'",
        ),
        (mesh("box.obj", ""), "0.001 each is the scale of a file in millimetres"),
        (
            mesh("none.obj", ""),
            "tool_body[0].mesh: body of the tool 'bracket': mesh",
        ),
        (mesh("flat.obj", ""), "it is flat"),
        (
            mesh("box.obj", "mesh_scale = [0.001, 0.001, 0.001]\nat_m = [0, 0, 0.12]"),
            "\"bracket\" of the tool reaches 15.0 mm into the sponge",
        ),
        (
            mesh("box.obj", "mesh_parts = \"hull\""),
            "unknown key 'tool_body[0].mesh_parts'",
        ),
        (
            "shape = \"mesh\"\n".to_owned(),
            "tool_body[0].mesh: is missing; it names the file",
        ),
        (
            mesh("box.obj", "radius_m = 0.1"),
            "tool_body[0].radius_m: is not a size of a mesh",
        ),
        (
            "shape = \"half_space\"\n".to_owned(),
            "tool_body[0].shape must be \"box\"",
        ),
    ] {
        let said = of(folder.path(), &body).unwrap_err().to_string();
        assert!(said.contains(words), "{words}\n{said}");
    }
}
