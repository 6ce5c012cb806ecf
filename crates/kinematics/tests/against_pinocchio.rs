//! Forward kinematics and Jacobians against values made with Pinocchio (`fixtures/generate.py`), on the
//! IRB 120 and on generated arms with oblique axes and rotated fixed joints everywhere.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::rotation::rotation_vector;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, Axes, Jacobian, JointVector, RobotModel};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Deserialize)]
struct Fixture {
    urdf: String,
    tip: String,
    joints: Vec<String>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    q: [f64; AXES],
    links: BTreeMap<String, Placement>,
    jacobian_world: [[f64; AXES]; 6],
    jacobian_local: [[f64; AXES]; 6],
}

#[derive(Deserialize)]
#[allow(non_snake_case)]
struct Placement {
    p: [f64; 3],
    R: [[f64; 3]; 3],
}

#[derive(Deserialize)]
struct PublishedSolutions {
    frame: String,
    pose: Placement,
    position_tolerance_m: f64,
    rotation_tolerance_rad: f64,
    solutions: Vec<[f64; AXES]>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

fn read<T: for<'de> Deserialize<'de>>(name: &str) -> T {
    serde_json::from_str(&std::fs::read_to_string(folder().join(name)).unwrap()).unwrap()
}

fn matrix(rows: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

fn jacobian(rows: &[[f64; AXES]; 6]) -> Jacobian {
    Jacobian::from_fn(|i, j| rows[i][j])
}

fn arms() -> Vec<(Fixture, RobotModel)> {
    let names = ["irb120".to_owned()]
        .into_iter()
        .chain((1..=8).map(|k| format!("arm_{k}")));
    names
        .map(|name| {
            let fixture: Fixture = read(&format!("{name}.json"));
            let text = std::fs::read_to_string(folder().join(&fixture.urdf)).unwrap();
            let robot = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
            (fixture, robot)
        })
        .collect()
}

#[test]
fn every_frame_is_where_pinocchio_puts_it() {
    let mut compared = 0;
    for (fixture, robot) in arms() {
        let joints: Vec<_> = robot.joints().iter().map(|j| j.name.clone()).collect();
        assert_eq!(joints, fixture.joints, "{}", fixture.urdf);
        for case in &fixture.cases {
            let poses = robot.fk(&case.q.into());
            for (link, placed) in &case.links {
                let found = poses.rigid(&robot.frame(link).unwrap());
                let position_error = (found.translation - Vector3::from(placed.p)).amax();
                let rotation_error = (found.rotation - matrix(&placed.R)).amax();
                assert!(
                    position_error < 1e-12 && rotation_error < 1e-12,
                    "{} {link}: {position_error:e} {rotation_error:e}",
                    fixture.urdf
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 1900, "only {compared} frames compared");
}

#[test]
fn jacobians_are_pinocchios_in_both_axes() {
    for (fixture, robot) in arms() {
        let tip = robot.frame(&fixture.tip).unwrap();
        for case in &fixture.cases {
            let poses = robot.fk(&case.q.into());
            for (axes, expected) in [(Axes::Base, &case.jacobian_world), (Axes::Local, &case.jacobian_local)] {
                let error = (poses.jacobian(&tip, axes) - jacobian(expected)).amax();
                assert!(error < 1e-10, "{} {axes:?}: {error:e}", fixture.urdf);
            }
        }
    }
}

#[test]
fn jacobians_are_the_derivative_of_the_pose() {
    const H: f64 = 1e-5;
    for (fixture, robot) in arms() {
        // Frames on every body, so that columns beyond a frame's body are seen to be zero.
        for link in robot.links() {
            for case in fixture.cases.iter().step_by(7) {
                let q = JointVector::from(case.q);
                let jacobian = robot.fk(&q).jacobian(&link.frame, Axes::Base);
                for joint in 0..AXES {
                    let mut step = JointVector::zeros();
                    step[joint] = H;
                    let (ahead, behind) = (
                        robot.fk(&(q + step)).rigid(&link.frame),
                        robot.fk(&(q - step)).rigid(&link.frame),
                    );
                    let linear = (ahead.translation - behind.translation) / (2.0 * H);
                    let angular = rotation_vector(&(ahead.rotation * behind.rotation.transpose())) / (2.0 * H);
                    let column = jacobian.column(joint);
                    let error = (column.fixed_rows::<3>(0) - linear)
                        .amax()
                        .max((column.fixed_rows::<3>(3) - angular).amax());
                    // central differences: truncation h²/6 · |p'''| and rounding ε/h stay below this
                    assert!(error < 1e-9, "{} {} joint {joint}: {error:e}", fixture.urdf, link.name);
                }
            }
        }
    }
}

/// The tool0 trap: the solutions published for MATLAB's `tool0` fit the frame behind joint 6, and no other.
#[test]
fn published_matlab_solutions_reach_their_pose_with_matlab_tool0_only() {
    use platewash_kinematics::ToolFrame;
    let published: PublishedSolutions = read("solutions.json");
    assert_eq!((published.frame.as_str(), published.solutions.len()), ("link_6", 3));
    let robot = RobotModel::irb120().unwrap();
    for q in &published.solutions {
        let poses = robot.fk(&(*q).into());
        let errors = |which| {
            let found = poses.rigid(&robot.tool_frame(which).unwrap());
            let turn = rotation_vector(&(matrix(&published.pose.R) * found.rotation.transpose())).norm();
            ((found.translation - Vector3::from(published.pose.p)).norm(), turn)
        };
        let (position, angle) = errors(ToolFrame::MatlabTool0);
        assert!(position < published.position_tolerance_m && angle < published.rotation_tolerance_rad);
        assert!(errors(ToolFrame::Tool0).1 > 1.5, "tool0 must be a quarter turn away");
    }
}

#[test]
fn the_flange_stands_where_the_data_sheet_says() {
    let robot = RobotModel::irb120().unwrap();
    let home = robot.pose(&JointVector::zeros(), &robot.frame("tool0").unwrap());
    assert!((home.translation.vector - Vector3::new(0.374, 0.0, 0.630)).norm() < 1e-12);
    assert!(
        (home.rotation * Vector3::z() - Vector3::x()).norm() < 1e-12,
        "z of tool0 leaves the flange along +x"
    );
}
