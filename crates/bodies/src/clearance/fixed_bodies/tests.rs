use crate::clearance::fixed_bodies::*;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::ObstacleShape;
use proptest::prelude::*;

proptest! {
    /// A box turned at will, of which one corner is pushed into a box by so much, or kept away.
    #[test]
    fn reports_the_true_depth_of_corners(turn in prop::array::uniform3(-3.0..3.0f64), by in -1e-2..1e-2f64) {
        let pose = Pose::from_parts(Vector3::zeros().into(), UnitQuaternion::from_scaled_axis(turn.into()));
        let half = Vector3::new(0.1, 0.05, 0.07);
        let lowest = (pose.rotation.to_rotation_matrix().matrix().row(2).abs() * half)[0];
        let points: Vec<_> = (0..8).map(|k| {
            let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            Point3::new(sign(0) * half.x, sign(1) * half.y, sign(2) * half.z)
        }).collect();
        let body = |shape, pose| obstacle_body(&Obstacle::new("body", ObstacleShape::Convex(shape), pose)).unwrap();
        let above = Pose::translation(0.0, 0.0, lowest - by) * pose;
        let table = body(Shape::Box { half_m: [1.0, 1.0, 0.2] }, Pose::translation(0.0, 0.0, -0.2));
        let poses = RobotModel::irb120().unwrap().fk(&JointVector::zeros());
        for shape in [Shape::Box { half_m: half.into() }, Shape::Hull { points }] {
            let found = overlap(&body(shape, above), &table, &poses);
            prop_assert!((found - by.max(0.0)).abs() < 1e-9, "{found} {by}");
        }
    }
}
