//! Further bodies of a tool as a scenario states them: what is refused, and where they are on the arm.

use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{Pose, RobotModel};
use platewash_scenario::{BodyFrame, Scenario};

const HEAD: &str = "layout.region = \"appendix\"\n[tool]\nlength_m = 0.15\n";

fn refused(text: &str) -> String {
    Scenario::parse(&format!("{HEAD}{text}"), "case")
        .unwrap_err()
        .to_string()
}

#[test]
fn rejects_invalid_tool_sections_with_index_and_line() {
    let bracket = "[[tool_body]]\nname = \"bracket\"\nshape = \"box\"\nsize_m = [0.06, 0.02, 0.04]\n";
    let more = |text: &str| refused(&format!("{bracket}[[tool_body]]\n{text}"));
    for (said, words) in [
        (
            more("nam = \"a\""),
            "line 9: unknown key 'tool_body[1].nam'; did you mean 'tool_body[1].name'?",
        ),
        (
            more("size_m = [0.1, 0.1]"),
            "line 9: tool_body[1].size_m must be three numbers above 0, up to 2; found [0.1, 0.1]",
        ),
        (more("radius_m = inf"), "tool_body[1].radius_m must be a number above 0"),
        (more("shape = \"cone\""), "tool_body[1].shape must be \"box\" or"),
        (more("shape = \"sphere\""), "tool_body[1].name: is missing"),
        (more("name = \"a\""), "tool_body[1].shape: is missing"),
        (
            more("name = \"a\"\nshape = \"sphere\""),
            "tool_body[1].radius_m: is missing; a sphere has one",
        ),
        (
            more("name = \"a\"\nshape = \"capsule\"\nradius_m = 0.1"),
            "tool_body[1].length_m: is missing; a capsule",
        ),
        (
            more("name = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\nlength_m = 0.1"),
            "tool_body[1].length_m: is not a size of a sphere",
        ),
        (
            more("name = \"a\"\nshape = \"box\"\nradius_m = 0.01"),
            "tool_body[1].radius_m: is not a size of a box",
        ),
        (
            more("name = \"plate 2\"\nshape = \"sphere\"\nradius_m = 0.01"),
            "tool_body[1].name: \"plate 2\" is the name of something else",
        ),
        (
            more("name = \"bracket\"\nshape = \"sphere\"\nradius_m = 0.01"),
            "tool_body.name: two bodies of the tool are named \"bracket\"",
        ),
        (
            more("name = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\nat_m = [0, 0, 0.13]"),
            "body \"a\" of the tool reaches 15.0 mm into the sponge",
        ),
        (
            more("name = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\nmass_kg = 0.4"),
            "tool.mass_kg, tool_body.mass_kg: the bodies of the tool weigh 0.4 kg",
        ),
        (
            refused("handle = \"none\""),
            "tool.handle, [[tool_body]]: nothing holds the sponge",
        ),
        (
            refused("mount_m = [0, 0]"),
            "tool.mount_m must be three numbers from -1 to 1",
        ),
        (refused(&"[[tool_body]]\n".repeat(51)), "found 51 of them"),
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let said = Scenario::parse("tool_body = [1]\nlayout.region = \"text\"", "case").unwrap_err();
    assert!(said.to_string().contains("line 1: tool_body must be a list"), "{said}");
    let none = "[[tool_body]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 0.01\n[layout]\nregion = \"text\"";
    let said = Scenario::parse(none, "case").unwrap_err().to_string();
    assert!(said.contains("tool.length_m is 0"), "{said}");
}

#[test]
fn reads_back_a_tool_chain_and_rejects_names_of_links() {
    let text = "[[tool_body]]\nname = \"link_3\"\nshape = \"capsule\"\nradius_m = 0.01\nlength_m = 0.05\nat_m = [0.03, 0, 0.05]\n\
            rpy_deg = [0, 90, 0]\nmass_kg = 0.1\n";
    let mut scenario = Scenario::parse(&format!("{HEAD}mount_rpy_deg = [30, 0, 0]\n{text}"), "case").unwrap();
    assert_eq!(scenario.validate(), Ok(()));
    let arm = RobotModel::from_urdf(IRB120_URDF, &MeshSource::none()).unwrap();
    let said = scenario.tool_on(&arm).unwrap_err().to_string();
    assert!(
        said.starts_with("tool_body.name: body \"link_3\" of the tool has the name of a link"),
        "{said}"
    );
    scenario.tool_body[0].name = "rod".to_owned();
    let tool = scenario.tool_on(&arm).unwrap();
    assert_eq!(tool.bodies.len(), 2);
    // Placed from the flange, it is there.
    scenario.tool_body[0].frame = BodyFrame::Flange;
    let rod = &scenario.tool_on(&arm).unwrap().bodies[1];
    assert!((rod.pose.translation.vector - Pose::translation(0.03, 0.0, 0.05).translation.vector).norm() < 1e-15);
    // z of the tool turned about x by 30°: (0, −½, √¾).
    let tip = tool.tip.translation.vector;
    assert!(
        (tip.y + 0.075).abs() < 1e-15 && (tip.z - 0.15 * 0.75_f64.sqrt()).abs() < 1e-15,
        "{tip}"
    );
}
