//! Leaning away from obstacles beside the arm.

use crate::placed_arm::Stance;
use crate::redundancy::tests::*;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::{Obstacle, ObstacleShape};

/// A plate with a wall beside it, along the direction from axis 1 at this azimuth.
fn beside_a_wall<T>(azimuth_deg: f64, act: impl FnOnce(&World<'_>) -> T) -> T {
    let (robot, tool) = (RobotModel::irb120().unwrap(), kitchen_tool());
    let mut cell = workcell(&robot, tool.clone());
    let half_m = [0.2, 0.011, 0.136];
    let (s, c) = sin_cos(azimuth_deg.to_radians());
    let pose = Pose::new(
        Vector3::new(0.45 * c, 0.45 * s, half_m[2]),
        azimuth_deg.to_radians() * Vector3::z(),
    );
    let wall = ObstacleShape::Convex(Shape::Box { half_m });
    cell.obstacles.push(Obstacle::new("wall", wall, pose));
    let plates = [plate_at(0.359, -17.8)];
    let clearance = ClearanceModel::new(&robot, &cell, &plates).unwrap();
    act(&World {
        placed: PlacedArm::new(&robot, &tool, &clearance, &plates, ReachBorders::IRB_120).unwrap(),
        clearance: &clearance,
    })
}

/// Towards the wall there is nothing to be had, away from it there is: upright where it stands far enough off, leaning where it does not, and
/// not at all where it is too near.
#[test]
fn the_tool_leans_away_from_a_wall_only_where_needed() {
    let (mut upright, mut leant, mut failed) = (0, 0, 0);
    for k in 0..12 {
        beside_a_wall(10.0 + f64::from(k), |world| {
            let path = path(curve(RADIUS_M), 15.0);
            let task = world.task(&path);
            match world.washing(&path) {
                Ok(washing) => {
                    check(world, &path, &washing);
                    // Leaning towards n × ρ̂ would bring it nearer.
                    assert!(washing.aside_rad <= 0.0, "{}", washing.aside_rad);
                    let is_upright = washing.aside_rad == 0.0;
                    assert!(is_upright || is_blocked_upright(&task));
                    assert!(!is_blocked(&task).unwrap());
                    *if is_upright { &mut upright } else { &mut leant } += 1;
                }
                Err(error) => {
                    assert!(error.to_string().contains("wall"), "{error}");
                    failed += 1;
                }
            }
        });
    }
    assert!(upright > 0 && leant > 0 && failed > 0, "{upright} {leant} {failed}");
}

/// Checks that neither a policy of tilts in the arm's plane nor the search among them finds anything.
fn is_blocked_upright(task: &Task<'_>) -> bool {
    by_policy(task, Width::Everywhere).unwrap().is_none() && by_search(task).is_err()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// By both together, towards where they say, about the contact point.
    #[test]
    fn a_tool_that_leans_aside_tilts_as_before(
        tilt in -0.3..0.3f64,
        aside in prop_oneof![Just(0.0), -0.3..0.3f64],
        rho in 0.2..0.5f64,
        azimuth in -3.0..3.0f64,
    ) {
        within(&kitchen_tool(), &[plate_at(0.4, 0.0)], |world| {
            let point = Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), 0.03);
            let contact = Contact::level(point);
            let placed = world.placed.clone().leaning_aside(aside);
            let tip = placed.tip_rigid(&contact, tilt);
            prop_assert_eq!(tip.translation, point);
            let stance = Stance { aside_rad: aside, ..Stance::default() };
            let lean = stance.lean_rad(tilt);
            let up = -tip.rotation.column(2);
            prop_assert!((up.dot(&contact.normal) - lean.cos()).abs() < 1e-12);
            let out = placed.outward_direction(&contact);
            let [along, across] = [out, contact.normal.cross(&out)].map(|direction| up.dot(&direction));
            let per_rad = if lean > 0.0 { lean.sin() / lean } else { 1.0 };
            prop_assert!((along - tilt * per_rad).abs() < 1e-12);
            prop_assert!((across - aside * per_rad).abs() < 1e-12);
            prop_assert!((stance.tilt_rad(lean) - tilt.abs()).abs() < 1e-7);
            if aside == 0.0 {
                prop_assert_eq!(tip, world.placed.tip_rigid(&contact, tilt));
            }
            Ok(())
        })?;
    }
}
