//! Arms of other makers: branches in closed form or searched for, and the conclusion where none is found.

use super::world::{World, check, curve, path, with_arm};
use platewash_bodies::clearance::ClearanceModel;
use platewash_fixtures::{kitchen_tool, workcell};
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_planner::placed_arm::TILT_RESERVE_RAD;
use platewash_planner::redundancy::washing;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashCurve;

/// Axes 2, 3 and 4 are parallel.
const UR5: &str = include_str!("../../../kinematics/tests/fixtures/ur5_lengths.urdf");
const KR5: &str = include_str!("../../../kinematics/tests/fixtures/kr5_lengths.urdf");

/// The UR5 with axis 6 beside axis 5, so that there is no closed form.
fn searched() -> String {
    let moved = UR5.replace("xyz=\"0 0 0.09465\"", "xyz=\"0.01 0 0.09465\"");
    assert_ne!(moved, UR5);
    moved
}

const UR5_HOME_DEG: [f64; 6] = [0.0, -90.0, 90.0, -90.0, -90.0, 0.0];

fn plate(x_m: f64, y_m: f64, z_m: f64) -> Plate {
    Plate::level_disc([x_m, y_m, z_m], 0.11, 0.02)
}

/// Does something with an arm and one plate.
fn with<T>(urdf: &str, plate: Plate, act: impl FnOnce(&World<'_>) -> T) -> T {
    let robot = RobotModel::from_urdf(urdf, &MeshSource::none()).unwrap();
    with_arm(&robot, &kitchen_tool(), &[plate], act)
}

fn ur5_home() -> JointVector {
    JointVector::from(UR5_HOME_DEG).map(f64::to_radians)
}

/// The arm is the same from every side: a plate that is washed in one direction is washed in all of them, whichever way joint 1
/// would turn first from home.
#[test]
fn washability_does_not_depend_on_the_angle_about_axis_1() {
    let searched = searched();
    for k in 0..12 {
        let azimuth = -149.999 + 30.0 * f64::from(k);
        let (s, c) = sin_cos(azimuth.to_radians());
        let arm = if k % 2 == 0 { UR5 } else { &searched };
        with(arm, plate(0.509 * c, 0.509 * s, 0.1), |world| {
            let path = path(curve(0.09), 15.0);
            let washing = washing(&world.task_near(&path, &ur5_home()));
            let washing = washing.unwrap_or_else(|error| panic!("{azimuth}: {error}"));
            check(world, &path, &washing);
        });
    }
}

/// The points that are solved keep below the largest tilt: the cubics between them turn the tool a little further.
#[test]
fn the_search_leaves_room_under_the_largest_tilt() {
    with(KR5, plate(0.55, 0.0, 0.2), |world| {
        let near = JointVector::from([0.0, -90.0, 90.0, 0.0, 90.0, 0.0]).map(f64::to_radians);
        let turned = WashCurve {
            turns: 3.0,
            start_angle_rad: std::f64::consts::PI,
            ..curve(0.09)
        };
        let path = path(turned, 15.0);
        let found = washing(&world.task_near(&path, &near)).unwrap();
        check(world, &path, &found);
        let most = found.tilt_rad.iter().fold(0.0, |most: f64, tilt| most.max(tilt.abs()));
        assert!(most > 0.99 * path.cone_rad, "{most}: the limit does not bind here");
        assert!(most <= path.cone_rad - 0.9 * TILT_RESERVE_RAD, "{most}");
    });
}

#[test]
fn moving_plates_reuses_the_arm() {
    let robot = RobotModel::from_urdf(KR5, &MeshSource::none()).unwrap();
    let [before, after] = [
        [plate(0.6, 0.1, 0.2), plate(0.2, -0.6, 0.1)],
        [plate(0.5, 0.3, 0.2), plate(0.1, 0.7, 0.3)],
    ];
    let workcell = workcell(&robot, kitchen_tool());
    let moved = ClearanceModel::new(&robot, &workcell, &before).unwrap().among(&after);
    let made = ClearanceModel::new(&robot, &workcell, &after).unwrap();
    assert_eq!(moved.pair_names(), made.pair_names());
    let q = JointVector::new(0.4, -1.2, 1.4, 0.3, 0.9, 0.1);
    assert_eq!(moved.all(&q), made.all(&q));
}
