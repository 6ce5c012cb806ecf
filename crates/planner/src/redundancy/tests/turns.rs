//! Joints of many turns: those that no motion needs are not looked at, and nothing is lost by it.

use crate::placed_arm::inverse::Sides;
use crate::placed_arm::{Stance, Start, merge_starts};
use crate::redundancy::tests::*;
use platewash_kinematics::ik::analytic::{AnalyticArm, Elbow, Label, Shoulder};
use platewash_kinematics::{Frame, JointLimits, JointVector};
use std::f64::consts::{PI, TAU};

/// The branches of the IRB 120 with other limits.
fn inverse<'a>(robot: &RobotModel, tip: Frame, limits: &'a JointLimits) -> Inverse<'a> {
    let arm = AnalyticArm::recognise(robot).unwrap();
    Inverse::Analytic { arm, tip, limits }
}

/// The starts out of all turns.
fn of_all_turns(inverse: &Inverse<'_>, target: &RigidTransform, near: &JointVector) -> Vec<Start> {
    let Inverse::Analytic { arm, tip, limits } = inverse else {
        panic!("a closed form");
    };
    let target = AnalyticArm::body_target(tip, target).unwrap();
    let all = arm.solve_all(&target, near, limits).unwrap();
    let of = |(label, q): (Label, JointVector)| Start {
        q,
        sides: Some(Sides::from(label)),
    };
    let mut found: Vec<Start> = all.configurations().map(of).collect();
    let rank = |start: &Start| {
        start
            .sides
            .is_none_or(|sides| (sides.shoulder, sides.elbow) != (Shoulder::Front, Elbow::Up))
    };
    let far = |start: &Start| (start.q - near).norm();
    found.sort_by(|a, b| rank(a).cmp(&rank(b)).then(far(a).total_cmp(&far(b))));
    let mut starts = Vec::new();
    merge_starts(&mut starts, found);
    starts
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// The same starts, to the bit and in the same order, as out of all turns, also where a joint is half a turn from the one asked for;
    /// and as many where there are a thousand million combinations of turns.
    #[test]
    fn farther_turns_add_no_start(
        q in prop::array::uniform6(-3.0..3.0f64),
        lower in prop::array::uniform6(-13.0..-4.0f64),
        upper in prop::array::uniform6(3.0..8.0f64),
        near in prop::array::uniform6(-14.0..14.0f64),
        half_turns in prop::array::uniform6(-3..4_i32),
        half_a_turn_off in any::<bool>(),
    ) {
        let robot = RobotModel::irb120().unwrap();
        let tip = robot.tool_mount(None).unwrap();
        let q = JointVector::from(q);
        let target = robot.fk(&q).rigid(&tip);
        let near = if half_a_turn_off {
            q + JointVector::from(half_turns.map(f64::from)) * PI
        } else {
            near.into()
        };
        let mut limits = robot.limits().clone();
        (limits.lower, limits.upper) = (lower.into(), upper.into());
        let arm = inverse(&robot, tip, &limits);
        let starts = arm.starts(&target, &near, Width::Near).unwrap();
        prop_assert_eq!(&starts, &of_all_turns(&arm, &target, &near));
        let mut wide = limits.clone();
        (wide.lower, wide.upper) = (JointVector::repeat(-100.0), JointVector::repeat(100.0));
        let of_many = inverse(&robot, tip, &wide).starts(&target, &near, Width::Near).unwrap();
        prop_assert_eq!(starts.len(), of_many.len());
        prop_assert!(of_many.iter().all(|start| (start.q - near).amax() <= PI + 1e-9));
    }
}

/// Where joint 5 is near 0 the wrist is singular, and near whole turns as well.
#[test]
fn the_wrist_keeps_away_from_whole_turns_too() {
    within(&kitchen_tool(), &[plate_at(0.4, 0.0)], |world| {
        let stance = Stance {
            wrist_rad: Some(0.05),
            ..world.placed.stance
        };
        let placed = world.placed.clone().with_stance(stance);
        let path = path(curve(RADIUS_M), 15.0);
        let task = Task::new(&placed, &path, CLEARANCE_M, &HOME).unwrap();
        let at = |joint_5: f64| JointVector::new(0.0, 0.0, 0.0, 0.0, joint_5, 0.0);
        for turns in [-15.0, -1.0, 0.0, 1.0, 12.0] {
            let by = TAU * turns;
            let kept = [-3.0, -0.1, -0.04, 0.04, 0.1, 3.0].map(|q| task.check_wrist(&at(by + q)).is_ok());
            assert_eq!(kept, [true, true, false, false, true, true], "{turns}");
            let same_side = |a: f64, b: f64| task.check_side(&at(by + a), &at(by + b)).is_ok();
            assert!(same_side(0.1, 0.2) && same_side(-0.2, -0.1) && !same_side(-0.1, 0.1) && !same_side(0.1, -0.1));
        }
    });
}
