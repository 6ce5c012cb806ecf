//! Joints that turn many times.

use super::world::{HOME, RADIUS_M, curve, path, plate_at, with_arm};
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_planner::redundancy::{is_blocked, washing};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// The IRB 120 with joints between two limits \[rad\].
pub fn arm_between(limits: [f64; 2]) -> RobotModel {
    arm(&crate::wide::between(IRB120_URDF, limits))
}

/// The IRB 120 with joints without limits.
pub fn continuous_arm() -> RobotModel {
    arm(&IRB120_URDF.replace("type=\"revolute\"", "type=\"continuous\""))
}

fn arm(urdf: &str) -> RobotModel {
    let robot = RobotModel::from_urdf(urdf, &MeshSource::none()).unwrap();
    let disabled = RobotModel::irb120().unwrap().disabled_pairs().unwrap().clone();
    robot.with_disabled_pairs(disabled).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A plate is washed or refused alike, whichever turns the joints are in at home, and by the same motion.
    #[test]
    fn washing_does_not_depend_on_the_turns_at_home(
        rho in 0.2..0.62f64, azimuth in -170.0..170.0f64, turns in prop::array::uniform6(-14..15_i32),
    ) {
        let path = path(curve(RADIUS_M), 15.0);
        let by = JointVector::from(turns.map(f64::from)) * TAU;
        with_arm(&arm_between([-100.0, 100.0]), &kitchen_tool(), &[plate_at(rho, azimuth)], |world| {
            let [(here_blocked, here), (there_blocked, there)] = [HOME, HOME + by].map(|near| {
                let task = world.task_near(&path, &near);
                (is_blocked(&task).unwrap(), washing(&task))
            });
            assert_eq!(here_blocked, there_blocked);
            assert_eq!(here.is_ok(), there.is_ok());
            if let (Ok(here), Ok(there)) = (here, there) {
                assert!(here.q.iter().zip(&there.q).all(|(a, b)| (a + by - b).amax() < 1e-6));
            }
        });
    }
}
