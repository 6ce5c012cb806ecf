//! Jobs: terms that are refused by name, and where the arm has its plates and obstacles.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_bodies::job::WashJob;
use platewash_fixtures::{kitchen, kitchen_terms};
use platewash_kinematics::{Pose, RobotModel};
use platewash_workcell::Obstacle;
use platewash_workcell::job::{JobTerms, MAX_SEED};
use std::borrow::Cow;

type Change = fn(&mut JobTerms);

#[test]
fn rejects_unusable_terms_by_name() {
    let good = kitchen();
    let cases: [(&str, Change); 22] = [
        ("requirements.coverage", |t| t.requirements.coverage = f64::NAN),
        ("requirements.coverage", |t| t.requirements.coverage = 1.1),
        ("requirements.clearance_m", |t| t.requirements.clearance_m = -1e-9),
        ("requirements.tilt_rad", |t| t.requirements.tilt_rad = 2.0),
        ("requirements.wash_speed_m_s", |t| t.requirements.wash_speed_m_s = 0.0),
        ("requirements.wash_acceleration_m_s2", |t| {
            t.requirements.wash_acceleration_m_s2 = f64::INFINITY
        }),
        ("limits.joint_acceleration_rad_s2", |t| {
            t.limits.joint_acceleration_rad_s2[5] = -1.0
        }),
        ("limits.tip_speed_m_s", |t| t.limits.tip_speed_m_s = f64::NAN),
        ("limits.tip_acceleration_m_s2", |t| t.limits.tip_acceleration_m_s2 = 0.0),
        ("home_rad", |t| t.home_rad[1][3] = f64::NAN),
        ("seed", |t| t.seed = MAX_SEED + 1),
        ("0 plates", |t| t.plates.clear()),
        ("plate 3", |t| t.plates[2].thickness_m = 0.0),
        ("plate 2", |t| {
            t.plates[1].pose.rotation = nalgebra::UnitQuaternion::new_unchecked([0.0, 0.0, 0.1, 1.0].into())
        }),
        ("sponge.radius_m", |t| t.workcell.tool.sponge.radius_m = 1000.1),
        ("sponge.radius_m", |t| t.workcell.tool.sponge.radius_m = 0.0),
        ("sponge.height_m", |t| t.workcell.tool.sponge.height_m = 1000.1),
        ("sponge.height_m", |t| t.workcell.tool.sponge.height_m = f64::NAN),
        ("sponge.compression_m", |t| t.workcell.tool.sponge.compression_m = 1.0),
        ("mount", |t| t.workcell.mount.translation.z = f64::NAN),
        ("obstacle 'wall'", |t| {
            let wall = Obstacle {
                name: "wall".to_owned(),
                pose: Pose::translation(0.0, f64::NAN, -1.0),
                ..Obstacle::floor()
            };
            t.workcell.obstacles.push(wall);
        }),
        ("the job is for the arm \"other\"", |t| {
            t.workcell.arm.name = "other".to_owned()
        }),
    ];
    for (words, change) in cases {
        let mut terms = good.terms().clone();
        change(&mut terms);
        let said = WashJob::new(good.shared_arm(), terms).unwrap_err().to_string();
        assert!(said.contains(words), "{words}: {said}");
    }
}

/// By hand: atan(1/2) is 26.6°, less than the 30° asked for.
#[test]
fn a_flat_sponge_allows_less_tilt_than_is_asked_for() {
    let robot = RobotModel::irb120().unwrap();
    let mut terms = kitchen_terms(&robot, Vec::new());
    terms.requirements.tilt_rad = 30_f64.to_radians();
    assert_eq!(terms.tilt_max_rad(), 30_f64.to_radians());
    terms.workcell.tool.sponge.height_m = 0.5 * terms.workcell.tool.sponge.radius_m;
    assert!((terms.tilt_max_rad() - 0.5_f64.atan()).abs() < 1e-15);
}

#[test]
fn a_mounted_job_equals_the_job_in_the_base_frame() {
    assert!(matches!(kitchen().terms().seen_from_base(), Cow::Borrowed(_)));
}

/// By hand: for a base at (1, 2, 0.5), turned by a quarter about z, the point (1.3, 2, 0.53) is at (0, −0.3, 0.03).
#[test]
fn plates_and_obstacles_are_where_the_arm_has_them() {
    let mut terms = kitchen().terms().clone();
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    terms.workcell.mount = Pose::from_parts(Vector3::new(1.0, 2.0, 0.5).into(), quarter);
    terms.plates[0].pose = Pose::translation(1.3, 2.0, 0.53);
    let seen = terms.seen_from_base();
    assert_eq!(seen.workcell.mount, Pose::identity());
    assert!((seen.plates[0].centre() - Vector3::new(0.0, -0.3, 0.03)).norm() < 1e-12);
    assert!((seen.workcell.obstacles[0].pose.translation.vector - Vector3::new(-2.0, 1.0, -0.5)).norm() < 1e-12);
    assert_eq!(seen.home_rad, terms.home_rad);
}

#[test]
fn a_home_beyond_the_limits_is_refused_by_its_joint() {
    let good = kitchen();
    let mut terms = good.terms().clone();
    terms.home_rad[1][2] = 3.0;
    let said = WashJob::new(good.shared_arm(), terms).unwrap_err().to_string();
    assert!(said.contains("end of the motion") && said.contains("joint 3"), "{said}");
}

#[test]
fn accelerations_beyond_the_descriptions_are_refused() {
    let text = platewash_kinematics::irb120::IRB120_URDF.replace("effort=\"0\"", "effort=\"0\" deceleration=\"3.5\"");
    let arm = RobotModel::from_urdf(&text, &platewash_kinematics::urdf::MeshSource::none()).unwrap();
    let mut terms = kitchen_terms(&arm, kitchen().terms().plates.clone());
    let arm = std::sync::Arc::new(arm);
    let error = WashJob::new(arm.clone(), terms.clone()).unwrap_err().to_string();
    for words in [
        "limits.joint_acceleration_rad_s2",
        "at most 3.5 rad/s² for joint_1",
        "found 4",
    ] {
        assert!(error.contains(words), "{error}");
    }
    terms.limits.joint_acceleration_rad_s2 = [3.5; 6];
    WashJob::new(arm, terms).unwrap();
}
