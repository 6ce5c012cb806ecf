use crate::clearance::ClearanceModel;
use crate::clearance::body::obstacle_body;
use crate::clearance::crowd::*;
use nalgebra::Vector3;
use platewash_fixtures::{kitchen_plate, kitchen_tool, workcell};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::{Obstacle, ObstacleShape, Workcell};
use proptest::prelude::*;

fn turned_box(half: [f64; 3], at: [f64; 3], turn: [f64; 3], margin_m: f64) -> Obstacle {
    let turn = nalgebra::UnitQuaternion::from_scaled_axis(Vector3::from(turn));
    Obstacle {
        shape: ObstacleShape::Convex(Shape::Box { half_m: half }),
        pose: Pose::from_parts(Vector3::from(at).into(), turn),
        margin_m,
        ..Obstacle::floor()
    }
}

#[test]
fn a_half_space_has_no_bounding_body() {
    let poses = RobotModel::irb120().unwrap().fk(&JointVector::zeros());
    let floor = obstacle_body(&Obstacle::floor()).unwrap();
    assert!(around(&floor, &poses).is_none());
}

proptest! {
    /// A box turned any way reaches along each axis as far as one of its corners; of those none is outside.
    #[test]
    fn the_hull_holds_all_points_and_no_more(
        half in prop::array::uniform3(0.01..0.3f64), at in prop::array::uniform3(-1.0..1.0f64), turn in prop::array::uniform3(-2.0..2.0f64),
        margin_m in 0.0..0.05f64,
    ) {
        let obstacle = turned_box(half, at, turn, margin_m);
        let poses = RobotModel::irb120().unwrap().fk(&JointVector::zeros());
        let around = around(&obstacle_body(&obstacle).unwrap(), &poses).unwrap();
        let rotation = obstacle.pose.rotation.to_rotation_matrix();
        for axis in 0..3 {
            let reach: f64 = (0..3).map(|k| (rotation[(axis, k)] * half[k]).abs()).sum();
            prop_assert!((around.maxs[axis] - (at[axis] + reach + margin_m)).abs() < 1e-12);
            prop_assert!((around.mins[axis] - (at[axis] - reach - margin_m)).abs() < 1e-12);
        }
        let aside = around.maxs + Vector::new(0.3, 0.0, 0.4);
        prop_assert!((gap_m(&around, &Aabb::new(aside, aside)) - 0.5).abs() < 1e-12);
        prop_assert_eq!(gap_m(&around, &around), 0.0);
    }

    /// Passing over many at once answers as looking at each pair does, whatever is asked for and whatever it stands among.
    #[test]
    fn grouped_pairs_give_the_answers_of_single_pairs(
        q in prop::array::uniform6(-2.0..2.0f64), required_m in 0.0..0.2f64,
        boxes in prop::collection::vec(
            (prop::array::uniform3(0.01..0.1f64), prop::array::uniform3(-0.8..0.8f64), prop::array::uniform3(-2.0..2.0f64), 0.0..0.02f64), 0..12,
        ),
    ) {
        let robot = RobotModel::irb120().unwrap();
        let boxes = boxes.into_iter().enumerate();
        let named = boxes.map(|(k, (half, at, turn, margin_m))| Obstacle { name: format!("box {k}"), ..turned_box(half, at, turn, margin_m) });
        let obstacles = named.chain([Obstacle::floor()]).collect();
        let workcell = Workcell { obstacles, ..workcell(&robot, kitchen_tool()) };
        let model = ClearanceModel::new(&robot, &workcell, &[kitchen_plate([0.3, 0.1])]).unwrap();
        let q = JointVector::from(q);
        let least = model.all(&q).into_iter().map(|pair| pair.distance_m).fold(f64::INFINITY, f64::min);
        // What is right to rounding may be told either way at the limit.
        prop_assume!((least - required_m).abs() > 1e-5);
        prop_assert_eq!(model.keeps_clearance(&q, required_m), least > required_m);
    }
}
