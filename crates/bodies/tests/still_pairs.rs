//! Pairs whose distance no joint changes.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_bodies::assembly;
use platewash_bodies::clearance::{ClearanceModel, StillPair, still_pairs};
use platewash_bodies::job::{JobError, WashJob};
use platewash_fixtures::{kitchen_plate, kitchen_terms, kitchen_tool};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::tool::{Tool, ToolBody};
use platewash_workcell::{Obstacle, ObstacleShape, ReducedClearance, Workcell};
use proptest::prelude::*;
use std::sync::Arc;

const REQUIRED_M: f64 = 0.01;

/// The arm with a mast on link 1, whose top is 0.95 m over the floor.
fn with_mast() -> RobotModel {
    let mast = r#"<link name="link_1">
    <collision name="mast"><origin xyz="-0.16 0 0.6"/><geometry><cylinder radius="0.015" length="0.7"/></geometry></collision>"#;
    let text = IRB120_URDF.replace(r#"<link name="link_1">"#, mast);
    RobotModel::from_urdf(&text, &MeshSource::none()).unwrap()
}

/// The half-space over a height, with its normal turned from straight down by some angle.
fn ceiling(height_m: f64, angle: f64) -> Obstacle {
    let turned = UnitQuaternion::from_scaled_axis(Vector3::new(std::f64::consts::PI - angle, 0.0, 0.0));
    let pose = Pose::from_parts(Vector3::new(0.0, 0.0, height_m).into(), turned);
    Obstacle::new("ceiling", ObstacleShape::HalfSpace, pose)
}

fn floor(height_m: f64) -> Obstacle {
    Obstacle::new("floor", ObstacleShape::HalfSpace, Pose::translation(0.0, 0.0, height_m))
}

fn cell(arm: &RobotModel, tool: Tool, obstacles: Vec<Obstacle>) -> Workcell {
    assembly::workcell(arm, tool, Pose::identity(), obstacles).unwrap()
}

fn of(found: &[StillPair], a: &str, b: &str) -> StillPair {
    let is_it = |still: &&StillPair| still.pair.a == a && still.pair.b == b;
    found.iter().find(is_it).unwrap().clone()
}

/// By hand: the top of the mast is at 0.95 m, the lowest point of link 1 at least 0.1 m over the floor.
#[test]
fn a_link_over_a_level_half_space_keeps_the_required_clearance() {
    let arm = with_mast();
    let judged = |obstacle: Obstacle| {
        let cell = cell(&arm, Tool::none(&arm), vec![obstacle.clone()]);
        let found = still_pairs(&arm, &cell).unwrap();
        let model = ClearanceModel::new(&arm, &cell, &[]).unwrap();
        assert_eq!(model.still_pairs(), found);
        of(&found, "link_1", &obstacle.name)
    };
    for (height_m, kept_m) in [(0.961, 0.011), (0.951, 0.001), (0.85, -0.1)] {
        let still = judged(ceiling(height_m, 0.0));
        assert!((still.at_least_m - kept_m).abs() < 1e-9, "{still:?}");
        assert_eq!(still.is_clear(REQUIRED_M), kept_m >= REQUIRED_M);
    }
    // A margin counts as for any moving body.
    let mut near = ceiling(0.965, 0.0);
    assert!(judged(near.clone()).is_clear(REQUIRED_M));
    near.margin_m = 0.0051;
    assert!(!judged(near).is_clear(REQUIRED_M));
    // The arm stands on the floor at height 0 of its base by intent: only contact counts.
    let ground = judged(floor(0.0));
    assert!(
        ground.only_contact && ground.is_clear(0.5) && ground.at_least_m < 0.5,
        "{ground:?}"
    );
    assert!(!judged(floor(1e-3)).is_clear(0.5));
    assert!(!judged(floor(0.3)).is_clear(REQUIRED_M));
}

#[test]
fn a_job_with_such_a_pair_too_near_is_refused() {
    let arm = Arc::new(with_mast());
    let job = |height_m: f64| {
        let mut terms = kitchen_terms(&arm, vec![kitchen_plate([0.3, 0.2])]);
        terms.workcell = cell(&arm, kitchen_tool(), vec![floor(0.0), ceiling(height_m, 0.0)]);
        WashJob::new(arm.clone(), terms)
    };
    assert!(job(0.97).is_ok());
    let refused = job(0.951).unwrap_err();
    assert!(matches!(&refused, JobError::StillNear { pairs, .. } if pairs.len() == 1));
    assert_eq!(
        refused.to_string(),
        "link_1 keeps 1.0 mm from ceiling at every configuration, and 10.0 mm are required: no motion changes that"
    );
    let refused = job(0.85).unwrap_err().to_string();
    assert!(refused.starts_with("link_1 reaches 100.0 mm into ceiling"), "{refused}");
}

/// The tool with one more body about axis 6, a cylinder between two heights over the flange.
fn with_ring(radius_m: f64, [from_m, to_m]: [f64; 2]) -> Tool {
    let mut tool = kitchen_tool();
    tool.bodies.push(ToolBody {
        name: "ring".to_owned(),
        shape: Shape::Cylinder {
            radius_m,
            half_length_m: 0.5 * (to_m - from_m),
        },
        pose: Pose::translation(0.0, 0.0, 0.5 * (from_m + to_m)),
    });
    tool
}

/// A round tool stands in front of the flange, or it keeps clear of the link behind.
#[test]
fn a_round_tool_that_reaches_behind_the_flange_keeps_clear() {
    let arm = RobotModel::irb120().unwrap();
    let found = |tool: Tool| still_pairs(&arm, &cell(&arm, tool, Vec::new())).unwrap();
    // The shape of link 5 holds the middle of the flange, and no other part of the link is near.
    assert_eq!(found(with_ring(0.08, [0.0, 0.03])), []);
    let behind = found(with_ring(0.08, [-0.04, 0.03]));
    let ring = of(&behind, "link_5", "ring");
    assert!(!ring.only_contact && !ring.is_clear(REQUIRED_M), "{ring:?}");
    assert!(ring.at_least_m <= 0.0, "{ring:?}");
    // Less clearance may be stated for it, but contact is never allowed.
    let mut less = cell(&arm, with_ring(0.08, [-0.04, 0.03]), Vec::new());
    less.reduced_clearances.push(ReducedClearance {
        pair: ["link_5".to_owned(), "ring".to_owned()],
        by_m: 0.009,
        at_stop: false,
    });
    assert!(ClearanceModel::new(&arm, &less, &[]).is_ok());
    let less = of(&still_pairs(&arm, &less).unwrap(), "link_5", "ring");
    assert!((less.pair.reduced_by_m - 0.009).abs() < 1e-15 && !less.is_clear(REQUIRED_M));
}

/// A link 5 with a fork that reaches past the flange, beside it.
#[test]
fn a_round_tool_in_front_of_the_flange_does_not_touch_the_link_behind() {
    let fork = r#"<link name="link_5">
    <collision name="fork"><origin xyz="0.1 0 0.1"/><geometry><box size="0.2 0.01 0.01"/></geometry></collision>"#;
    let text = IRB120_URDF.replace(r#"<link name="link_5">"#, fork);
    let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let found = |radius_m: f64| {
        let cell = cell(&arm, with_ring(radius_m, [0.0, 0.05]), Vec::new());
        of(&still_pairs(&arm, &cell).unwrap(), "link_5", "ring")
    };
    // By hand: the fork begins 95 mm beside axis 6. Nearer than the clearance is fine, contact is not.
    let near = found(0.09);
    assert!(near.only_contact && (near.at_least_m - 0.005).abs() < 1e-5, "{near:?}");
    assert!(near.is_clear(REQUIRED_M));
    assert!(!found(0.1).is_clear(REQUIRED_M));
}

/// A frame within the link behind the flange, or one that faces it, is no flange: the tool is not in front of anything.
#[test]
fn a_tool_within_the_link_is_in_the_way_whatever_its_frame_says() {
    let inner = r#"<link name="inner"/><joint name="inner_joint" type="fixed"><parent link="link_6"/><child link="inner"/>
      <origin xyz="-0.02 0 0" rpy="0 1.5707963267948966 0"/></joint></robot>"#;
    let text = IRB120_URDF.replace("</robot>", inner);
    let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let worst = |mount: &str| {
        let mut tool = with_ring(0.03, [0.0, 0.05]);
        tool.mounted_on = Some(mount.to_owned());
        let found = still_pairs(&arm, &cell(&arm, tool, Vec::new())).unwrap();
        found.into_iter().find(|still| still.pair.b == "ring")
    };
    assert_eq!(worst("tool0"), None);
    let within = worst("inner").unwrap();
    assert!(!within.is_clear(REQUIRED_M), "{within:?}");
    let back = worst("tool0:-z").unwrap();
    assert!(!back.only_contact && !back.is_clear(REQUIRED_M), "{back:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    /// The stated bound holds at any configuration, also for a half-space that is not quite level and a ring that is not quite on axis 6.
    #[test]
    fn the_distance_is_at_least_the_bound_everywhere(
        q in prop::array::uniform6(-1.5..1.5f64),
        height_m in 0.3..1.2f64,
        angle in -1.4e-6..1.4e-6f64,
        away in prop::array::uniform2(-6e-5..6e-5f64),
        tilt in -9e-5..9e-5f64,
        behind_m in 0.01..0.06f64,
    ) {
        let arm = with_mast();
        let mut tool = with_ring(0.15, [-behind_m, 0.03]);
        let ring = tool.bodies.last_mut().unwrap();
        let turned = UnitQuaternion::from_scaled_axis(Vector3::new(tilt, 0.0, 0.0));
        ring.pose = Pose::from_parts((ring.pose.translation.vector + Vector3::new(away[0], away[1], 0.0)).into(), turned);
        let mut cell = cell(&arm, tool, vec![ceiling(height_m, angle)]);
        let found = still_pairs(&arm, &cell).unwrap();
        // With nothing left out these pairs are measured at each configuration.
        cell.exclusions.clear();
        let model = ClearanceModel::new(&arm, &cell, &[]).unwrap();
        prop_assert_eq!(model.still_pairs(), vec![]);
        let all = model.all(&JointVector::from(q));
        for (a, b) in [("link_1", "ceiling"), ("link_5", "ring")] {
            let still = of(&found, a, b);
            let here = all.iter().find(|pair| pair.a == a && pair.b == b).unwrap();
            prop_assert!(here.distance_m >= still.at_least_m - 1e-12, "{:?} {:?}", here, still);
            prop_assert!(here.distance_m.max(0.0) <= still.at_least_m.max(0.0) + 4e-4, "{:?} {:?}", here, still);
        }
    }
}
