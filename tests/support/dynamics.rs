//! Arms and states for the tests.

use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, RobotModel};
use platewash_simulator::DynamicsModel;
use platewash_workcell::tool::StraightTool;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// One arm's reference values.
#[derive(Deserialize)]
pub struct Fixture {
    pub urdf: String,
    pub joints: Vec<String>,
    pub tool: Option<Tool>,
    pub states: Vec<Reference>,
}

#[derive(Deserialize)]
pub struct Tool {
    pub mass_kg: f64,
    pub length_m: f64,
    pub radius_m: f64,
}

/// A state and what is known about it; units as in `fixtures/generate_dynamics.py`.
#[derive(Deserialize)]
pub struct Reference {
    pub q: [f64; AXES],
    pub qd: [f64; AXES],
    pub qdd: [f64; AXES],
    pub tau: [f64; AXES],
    pub inverse: [f64; AXES],
    pub mass: [[f64; AXES]; AXES],
    pub gravity: [f64; AXES],
    pub bias: [f64; AXES],
    pub forward: [f64; AXES],
    pub forward_mujoco: [f64; AXES],
}

/// Names of all fixtures.
pub fn names() -> Vec<String> {
    let ours = ["irb120", "irb120_tool"].map(str::to_owned);
    ours.into_iter().chain((1..=8).map(|k| format!("arm_{k}"))).collect()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

/// A fixture with its arm and its dynamics.
pub fn fixture(name: &str) -> (Fixture, RobotModel, DynamicsModel) {
    let text = std::fs::read_to_string(folder().join(format!("{name}.json"))).unwrap();
    let fixture: Fixture = serde_json::from_str(&text).unwrap();
    let urdf = std::fs::read_to_string(folder().join(&fixture.urdf)).unwrap();
    let robot = RobotModel::from_urdf(&urdf, &MeshSource::none()).unwrap();
    let tool = fixture.tool.as_ref().map(|tool| {
        let straight = StraightTool {
            mass_kg: tool.mass_kg,
            length_m: tool.length_m,
            radius_m: tool.radius_m,
            ..StraightTool::default()
        };
        platewash_workcell::tool::Tool::from(straight)
    });
    let model = DynamicsModel::new(&robot, tool.as_ref()).unwrap();
    (fixture, robot, model)
}

/// All of them.
pub fn fixtures() -> impl Iterator<Item = (String, Fixture, RobotModel, DynamicsModel)> {
    names().into_iter().map(|name| {
        let (fixture, robot, model) = fixture(&name);
        (name, fixture, robot, model)
    })
}
