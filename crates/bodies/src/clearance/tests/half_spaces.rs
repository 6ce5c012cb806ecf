//! Half-spaces anywhere, against heights worked out directly: the lowest of all corners, or the support of the shape along the normal.

use crate::clearance::part_pair::PartPairs;
use crate::clearance::tests::*;
use platewash_workcell::{Obstacle, ObstacleShape};

fn shape() -> impl Strategy<Value = Shape> {
    let size = || 0.01..0.3f64;
    let round = |(radius_m, half_length_m): (f64, f64), capsule: bool| match capsule {
        true => Shape::Capsule {
            radius_m,
            half_length_m,
        },
        false => Shape::Cylinder {
            radius_m,
            half_length_m,
        },
    };
    prop_oneof![
        prop::array::uniform3(size()).prop_map(|half_m| Shape::Box { half_m }),
        ((size(), size()), any::<bool>()).prop_map(move |(sizes, capsule)| round(sizes, capsule)),
        size().prop_map(|radius_m| Shape::Sphere { radius_m }),
        prop::collection::vec(prop::array::uniform3(-0.3..0.3f64).prop_map(Point3::from), 8..20)
            .prop_map(|points| Shape::Hull { points }),
    ]
}

fn half_space(pose: &Isometry3<f64>) -> Part {
    Part::half_space(Frame::base().offset(&RigidTransform::from(pose)))
}

proptest! {
    /// The height over the plane is that of the body's origin less its support towards the plane, whatever is turned.
    #[test]
    fn heights_over_any_plane_are_closed_forms(shape in shape(), pose in iso(), plane in iso(), margin in 0.0..0.1f64) {
        let normal = plane.rotation * Vector3::z();
        let origin = normal.dot(&(pose.translation.vector - plane.translation.vector));
        let expected = origin - shape.support(&(pose.inverse_transform_vector(&-normal)));
        let (body, space) = (part(&shape, &pose), half_space(&plane));
        for (found, towards) in [(gap(&space, &body), 1.0), (gap(&body, &space), -1.0)] {
            prop_assert!((found.distance - expected).abs() < 1e-12, "{} {expected}", found.distance);
            prop_assert!((Vector3::from(found.normal) - normal * towards).norm() < 1e-12);
            // The place is half-way between the lowest point and the plane.
            let place = normal.dot(&(Vector3::from(found.place) - plane.translation.vector));
            prop_assert!((place - 0.5 * expected).abs() < 1e-12, "{place} {expected}");
        }
        // A grown body is nearer by its margin, whichever of the two it is.
        for (space, body) in [(space.clone().grown(margin), body.clone()), (space, body.grown(margin))] {
            prop_assert!((gap(&space, &body).distance - (expected - margin)).abs() < 1e-12);
        }
    }

    /// Cylinders that stand nearly upright on the plane, where the way down across them is lost to rounding.
    #[test]
    fn heights_of_nearly_upright_cylinders_are_closed_forms(plane in iso(), tiny in -18.0..0.0f64, lean in prop::array::uniform2(-1.0..1.0f64), down in any::<bool>()) {
        let lean = UnitQuaternion::from_scaled_axis(Vector3::new(lean[0], lean[1], 0.0) * 10.0_f64.powf(tiny));
        let flip = UnitQuaternion::from_scaled_axis(Vector3::new(if down { std::f64::consts::PI } else { 0.0 }, 0.0, 0.0));
        let pose = plane * Isometry3::from_parts(Translation3::new(0.1, -0.2, 0.7), lean * flip);
        let shape = Shape::Cylinder { radius_m: 0.2, half_length_m: 0.3 };
        let axis = (lean * flip) * Vector3::z();
        let expected = 0.7 - 0.3 * axis.z.abs() - 0.2 * axis.xy().norm();
        let found = gap(&half_space(&plane), &part(&shape, &pose)).distance;
        prop_assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }

    /// The level floor at height 0 takes no part in the numbers: heights are z itself, to the bit.
    #[test]
    fn the_floor_does_not_change_heights(pose in iso(), radius in 0.01..0.3f64) {
        let ball = part(&Shape::Sphere { radius_m: radius }, &pose);
        let found = gap(&half_space(&Isometry3::identity()), &ball);
        let z = pose.translation.z;
        prop_assert_eq!(found.distance.to_bits(), (z - radius).to_bits());
        prop_assert_eq!(found.place.map(f64::to_bits), [pose.translation.x, pose.translation.y, (z - radius) * 0.5].map(f64::to_bits));
    }

    /// All bounds hold over walls and ceilings, along any motion.
    #[test]
    fn bounds_hold_over_any_plane(
        q in prop::array::uniform6(-1.5..1.5f64), v in prop::array::uniform6(-0.4..0.4f64), plane in iso(), at in -1.0..1.0f64, margin in 0.0..0.05f64,
    ) {
        let robot = RobotModel::irb120().unwrap();
        let mut world = workcell(&robot, kitchen_tool());
        world.obstacles = vec![Obstacle::new("wall", ObstacleShape::HalfSpace, plane)];
        world.obstacles[0].margin_m = margin;
        let model = ClearanceModel::new(&robot, &world, &[]).unwrap();
        let (q, v) = (JointVector::from(q), JointVector::from(v));
        let [start, middle, there, end] = [-1.0, 0.0, at, 1.0].map(|t| robot.fk(&(q + v * t)));
        let pairs: Vec<_> = (0..model.pair_count()).map(|pair| model.parts_of(pair)).collect();
        for pair in pairs.iter().flat_map(PartPairs::parts) {
            let [here, later] = [&middle, &there].map(|poses| pair.mover(poses));
            let (measured, found) = (pair.measure(&here), pair.measure(&later).distance_m);
            let levers = pair.levers(&here, &v.abs());
            prop_assert!(measured.at_least_m - levers.dot(&v.abs()) <= found + ITERATIVE_ERROR_M);
            prop_assert!(pair.sphere_gap(&later) <= found + ITERATIVE_ERROR_M);
            prop_assert!(pair.gap_to_sphere(&later) <= found + ITERATIVE_ERROR_M);
            if let Some(normal) = measured.normal.filter(|_| found > 0.0) {
                let sag = 0.5 * pair.acceleration(&levers, &v.abs(), &JointVector::zeros());
                let ends = [start, end].map(|poses| pair.gap_along(normal, &poses));
                prop_assert!(ends[0].min(ends[1]) - sag <= found + ITERATIVE_ERROR_M);
            }
        }
    }
}
