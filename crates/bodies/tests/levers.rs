//! Levers of the joints about points of the arm.

use platewash_bodies::clearance::lever::*;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use proptest::prelude::*;

fn configuration() -> impl Strategy<Value = JointVector> {
    prop::array::uniform6(-3.0..3.0f64).prop_map(JointVector::from)
}

proptest! {
    #[test]
    fn levers_bound_distances_in_other_configurations(q in configuration(), r in configuration(), share in 0.0..0.2f64) {
        let robot = RobotModel::irb120().unwrap();
        let frame = robot.last_link_frame();
        let point = |q: &JointVector| robot.pose(q, &frame).translation.vector;
        let greatest = greatest(&robot.fk(&q), 6, &point(&q));
        let near = q + (r - q) * share;
        let here = at(&robot.fk(&q), 6, &point(&q));
        let local = within(&here, &(near - q).abs(), &greatest);
        for i in 0..AXES {
            prop_assert!(at(&robot.fk(&r), 6, &point(&r))[i] <= greatest[i] + 1e-12);
            prop_assert!(at(&robot.fk(&near), 6, &point(&near))[i] <= local[i] + 1e-12);
        }
    }

    #[test]
    fn tuples_equal_the_double_sum_over_the_joints(l in configuration(), a in configuration(), b in configuration(), first in 0..3usize) {
        let mut sum = 0.0;
        for i in first..AXES {
            for j in first..AXES {
                sum += l[i.max(j)] * a[i] * b[j];
            }
        }
        prop_assert!((tuples(&l, first, [&a, &b]) - sum).abs() < 1e-10);
    }
}
