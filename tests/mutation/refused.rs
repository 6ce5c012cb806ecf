//! Edits after which there is no plan to judge: an error that says where, not a certificate.

use crate::mutation::edit::good;
use nalgebra::Point3;
use platewash::certificate::prove;
use platewash::kinematics::geometry::Shape;
use platewash::motion::plan::Process;
use platewash::workcell::{Obstacle, ObstacleShape};
use platewash::{Plan, Pose};

#[track_caller]
fn refused(word: &str, edit: fn(&mut Plan)) {
    let good = &good()[0];
    let mut plan = good.plan.clone();
    edit(&mut plan);
    plan.hash = Some(plan.seal().unwrap());
    let error = prove(&plan, good.robot).unwrap_err().to_string();
    assert!(error.contains(word), "{error}");
}

#[test]
fn rejects_files_that_are_no_plan_with_their_place() {
    refused("knot 0: time 0.001", |p| {
        p.knots.t_s.iter_mut().for_each(|t| *t += 1e-3)
    });
    refused("knot 8", |p| p.knots.t_s.swap(7, 8));
    refused("knot 8", |p| p.knots.t_s[8] = p.knots.t_s[7]);
    refused("as many of each", |p| _ = p.knots.q_rad.pop());
    refused("0 knots", |p| {
        p.knots.t_s.clear();
        p.knots.q_rad.clear();
        p.knots.qd_rad_s.clear();
    });
    refused("joint 3 gets to", |p| p.knots.q_rad[40][2] = 1e6);
    refused("segments", |p| p.segments = vec![p.segments[2]; 200]);
    refused("wash paths", |p| p.wash_paths = vec![p.wash_paths[2]; 200]);
    refused("entries of the order", |p| p.order = vec![0; 200]);
    refused("paper's program", |p| p.process = Process::Paper);
}

#[test]
fn rejects_an_invalid_job_with_its_place() {
    refused("plate 3", |p| {
        p.job.plates[2] = platewash::Plate::level_disc([0.3, 0.0, 0.03], 0.0, 0.02)
    });
    refused("0 plates", |p| p.job.plates.clear());
    refused("clearance_m", |p| p.job.requirements.clearance_m = -0.01);
    refused("coverage", |p| p.job.requirements.coverage = 1.01);
    refused("joint_acceleration_rad_s2", |p| {
        p.job.limits.joint_acceleration_rad_s2[3] = 0.0
    });
    refused("sponge.radius_m", |p| p.job.workcell.tool.sponge.radius_m = 0.0);
    refused("compression_m", |p| p.job.workcell.tool.sponge.compression_m = 0.1);
    refused("\"handle\"", |p| {
        p.job.workcell.tool.bodies[0].shape = Shape::Sphere { radius_m: -0.01 }
    });
    refused("the mount of the arm", |p| p.job.workcell.mount.translation.y = 1e4);
    refused("obstacle 'floor': margin_m", |p| {
        p.job.workcell.obstacles[0].margin_m = -0.01
    });
    refused("obstacle 'floor': it holds the plate with index 4", |p| {
        p.job.workcell.obstacles[0].holds_plates = vec![4]
    });
    refused("\"sheet\"", |p| {
        let corners = [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]];
        let points = corners.map(Point3::from).to_vec();
        let shape = ObstacleShape::Convex(Shape::Hull { points });
        let sheet = Obstacle::new("sheet", shape, Pose::translation(-0.5, 0.0, 0.5));
        p.job.workcell.obstacles.push(sheet);
    });
}

#[test]
fn rejects_values_that_are_no_number() {
    for value in [f64::NAN, f64::INFINITY] {
        let mut plan = good()[1].plan.clone();
        plan.knots.q_rad[100][1] = value;
        assert!(
            prove(&plan, good()[1].robot)
                .unwrap_err()
                .to_string()
                .contains("knot 100")
        );
    }
}
