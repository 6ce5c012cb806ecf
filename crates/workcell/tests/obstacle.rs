//! Obstacles: faults with their reasons, and files that read back.

use nalgebra::Point3;
use platewash_kinematics::Pose;
use platewash_workcell::obstacle::*;

type Change = fn(&mut Obstacle);

#[test]
fn invalid_obstacles_state_the_reason() {
    let cases: [(&str, Change); 10] = [
        ("pose", |o| o.pose.translation.x = f64::NAN),
        ("pose", |o| o.pose.translation.z = f64::INFINITY),
        ("pose", |o| {
            o.pose.rotation = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(2.0, 0.0, 0.0, 0.0))
        }),
        ("margin_m", |o| o.margin_m = -1e-9),
        ("margin_m", |o| o.margin_m = f64::NAN),
        ("margin_m", |o| o.margin_m = 1.1),
        ("no parts", |o| o.shape = ObstacleShape::Parts(Vec::new())),
        ("without points", |o| o.shape = ObstacleShape::Parts(vec![Vec::new()])),
        ("it holds the plate with index 2; there are 2", |o| {
            o.holds_plates = vec![0, 2]
        }),
        ("once each", |o| o.holds_plates = vec![1, 1]),
    ];
    for (words, change) in cases {
        let mut obstacle = Obstacle::floor();
        assert_eq!(obstacle.fault(2), None);
        change(&mut obstacle);
        let said = obstacle.fault(2).unwrap().to_string();
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn files_state_only_non_default_fields_and_read_back() {
    let plain = serde_json::to_string(&Obstacle::floor()).unwrap();
    assert!(
        !plain.contains("margin_m") && !plain.contains("holds_plates"),
        "{plain}"
    );
    let corner = |x: f64| Point3::new(x, 0.5, -0.25);
    let parts = ObstacleShape::Parts(vec![vec![corner(0.0)], vec![corner(1.0), corner(2.0)]]);
    let mut rack = Obstacle::new("rack", parts, Pose::translation(1.0, 2.0, 3.0));
    (rack.margin_m, rack.holds_plates) = (0.01, vec![0, 3]);
    for obstacle in [Obstacle::floor(), rack] {
        let text = serde_json::to_string(&obstacle).unwrap();
        assert_eq!(serde_json::from_str::<Obstacle>(&text).unwrap(), obstacle);
    }
}
