//! Bounds of distances between the moments of a motion.

use nalgebra::Vector3;
use platewash_bodies::clearance::part_pair::*;
use platewash_bodies::clearance::{ClearanceModel, ITERATIVE_ERROR_M};
use platewash_fixtures::{kitchen_plate, kitchen_tool, workcell};
use platewash_kinematics::{JointVector, RobotModel};
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = JointVector> {
    prop::array::uniform6(-size..size).prop_map(JointVector::from)
}

proptest! {
    /// Along an even motion, at any moment and for every pair of parts: both bounds hold, and so does the gap along any
    /// direction.
    #[test]
    fn bounds_hold_between_moments(q in vector(1.5), v in vector(0.4), at in -1.0..1.0f64, n in prop::array::uniform3(-1.0..1.0f64)) {
        let robot = RobotModel::irb120().unwrap();
        let world = workcell(&robot, kitchen_tool());
        let model = ClearanceModel::new(&robot, &world, &[kitchen_plate([0.3, 0.1])]).unwrap();
        let poses = |t: f64| robot.fk(&(q + v * t));
        let [start, middle, there, end] = [-1.0, 0.0, at, 1.0].map(poses);
        prop_assume!(Vector3::from(n).norm() > 0.1);
        let n = Vector3::from(n).normalize().into();
        let pairs: Vec<_> = (0..model.pair_count()).map(|pair| model.parts_of(pair)).collect();
        for pair in pairs.iter().flat_map(PartPairs::parts) {
            let [here, later] = [&middle, &there].map(|poses| pair.mover(poses));
            let measured = pair.measure(&here);
            let found = pair.measure(&later).distance_m;
            let levers = pair.levers(&here, &v.abs());
            prop_assert!(measured.at_least_m - levers.dot(&v.abs()) <= found + ITERATIVE_ERROR_M);
            prop_assert!(pair.sphere_gap(&later) <= found + ITERATIVE_ERROR_M);
            if let Some(normal) = measured.normal.filter(|_| found > 0.0) {
                let sag = 0.5 * pair.acceleration(&levers, &v.abs(), &JointVector::zeros());
                let ends = [start, end].map(|poses| pair.gap_along(normal, &poses));
                prop_assert!(ends[0].min(ends[1]) - sag <= found + ITERATIVE_ERROR_M);
                // Little is lost at the moment itself, where the nearest points are not on top of each other.
                let gap = pair.gap_along(normal, &middle);
                prop_assert!(measured.distance_m < 1e-3 || (gap - measured.distance_m).abs() < 1e-4, "{gap} {measured:?}");
                prop_assert!(pair.gap_along(n, &there) <= found + ITERATIVE_ERROR_M);
            }
        }
    }
}
