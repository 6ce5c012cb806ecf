mod anywhere;
mod aside;
mod held;
mod scale;
mod turns;
#[path = "../../../tests/redundancy/world.rs"]
mod world;

use self::anywhere::anywhere;
use self::world::*;
use crate::placed_arm::{Contact, Filter, Hindrance, Inverse, PlacedArm, TiltPolicy, Width, tilt_policy};
use crate::redundancy::places::{MovedPlate, nearest_washable, on_grid};
use crate::redundancy::search::Graph;
use crate::redundancy::task::Profile;
use crate::redundancy::washability::{Cause, Points, WashablePart, washable_part};
use crate::redundancy::washing::{by_policy, by_search, policies, search_starts};
use crate::redundancy::*;
use crate::{placed_arm, redundancy};
use nalgebra::Vector3;
use platewash_bodies::clearance::ClearanceModel;
use platewash_fixtures::{kitchen_tool, workcell};
use platewash_kinematics::RobotModel;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::urdf::MeshSource;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::ReachBorders;
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::wash_path::{WashCurve, WashPath};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The last turn alone gives the same answer as the whole search, on every branch.
    #[test]
    fn early_checks_agree_with_the_search(
        places in prop::collection::vec((0.2..0.62f64, -170.0..170.0f64), 1..3),
        tilt in prop::sample::select(vec![0.0, 5.0, 15.0]),
        radius in 0.03..0.08f64,
    ) {
        let plates: Vec<_> = places.iter().map(|&(rho, azimuth)| plate_at(rho, azimuth)).collect();
        let path = path(WashCurve { turns: 1.5, ..curve(radius) }, tilt);
        within(&kitchen_tool(), &plates, |world| {
            let task = world.task(&path);
            let graph = Graph::new(&task);
            let known = is_blocked(&task).unwrap();
            let starts = search_starts(&task, &graph).unwrap();
            let found = starts.iter().any(|start| graph.cheapest(&task, start).unwrap().is_ok());
            assert!(!(known && found), "{places:?}");
        });
    }

    /// The search alone, without the policies, keeps the same promises.
    #[test]
    fn the_search_washes_every_plate_that_policies_wash(rho in 0.27..0.48f64, azimuth in -90.0..90.0f64) {
        let plates = [plate_at(rho, azimuth)];
        let path = path(curve(RADIUS_M), 15.0);
        within(&kitchen_tool(), &plates, |world| {
            let task = world.task(&path);
            let washing = by_search(&task).unwrap();
            check(world, &path, &washing);
            assert!(washing.travel_rad() < 15.0, "{}", washing.travel_rad());
            let rates = washing.tilt_rad.windows(2).zip(task.samples.length_m.windows(2));
            for (tilts, lengths) in rates {
                assert!((tilts[1] - tilts[0]).abs() <= 1.05 * tilt_policy::FASTEST_RAD_M * (lengths[1] - lengths[0]) + 1e-12);
            }
        });
    }

    #[test]
    fn the_tool_leans_away_from_axis_1(x in -0.6..0.6f64, y in -0.6..0.6f64, tilt in -0.6..0.6f64) {
        prop_assume!(x.abs() + y.abs() > 1e-6);
        within(&kitchen_tool(), &[], |world| {
            let contact = Contact::level(Vector3::new(x, y, 0.03));
            let pose = world.placed.tip_pose(&contact, tilt);
            let out = Vector3::new(x, y, 0.0).normalize();
            let (s, c) = sin_cos(tilt);
            assert!((pose.rotation * Vector3::z() + Vector3::z() * c + out * s).norm() < 1e-12);
            let side = pose.rotation * Vector3::x();
            assert!(side.dot(&Vector3::z().cross(&out)).abs() < 1e-12, "x of the tip lies in the arm's plane");
            assert!((pose.translation.vector - contact.point).norm() == 0.0);
            let leaning = world.placed.tip_leaning(&contact, &(out * tilt));
            assert!((leaning.rotation - RigidTransform::from(&pose).rotation).norm() < 1e-12);
        });
    }

    /// `ω` and the slopes of the profiles against differences of the exact map.
    #[test]
    fn slopes_are_those_of_the_exact_map(rho in 0.27..0.48f64, azimuth in -90.0..90.0f64, share in 0.05..0.95f64) {
        let plates = [plate_at(rho, azimuth)];
        let path = path(curve(RADIUS_M), 15.0);
        within(&kitchen_tool(), &plates, |world| {
            let (task, placed) = (world.task(&path), &world.placed);
            let policy = policies(&task)[0];
            let profile = Profile::Policy(policy);
            let tilts = task.tilts(&profile);
            let k = (share * tilts.len() as f64) as usize;
            let first = placed.tip_rigid(&task.samples.contact[0], tilts[0]);
            let start = placed.inverse.starts(&first, &HOME, Width::Near).unwrap()[0];
            let at = |theta: f64| {
                let contact = task.samples.at(theta);
                placed.inverse.continuing(&placed.tip_rigid(&contact, task.tilt(&profile, &contact, 0.0)), &start).unwrap()
            };
            let (theta, h) = (task.samples.theta[k], 1e-5);
            let slope = task.slope(&profile, k, &at(theta)).unwrap();
            let difference = (at(theta + h) - at(theta - h)) / (2.0 * h);
            assert!((slope - difference).amax() < 1e-7, "{slope} {difference}");
        });
    }
}

/// Plates too near, too far or behind are refused with their obstruction, and where no other branch of the arm would do the
/// exhaustive search agrees at every dead end.
#[test]
fn failures_name_obstructions_of_the_arm_itself() {
    let cases = [
        (0.2, 0.0, 15.0, [Filter::Limit, Filter::Clearance], 0.0),
        (0.25, 45.0, 30.0, [Filter::Limit, Filter::Clearance], 0.0),
        (0.6, 20.0, 15.0, [Filter::Reach, Filter::Reach], 0.0),
        (0.4, 179.0, 15.0, [Filter::Limit, Filter::Limit], 1.0),
    ];
    for (rho, azimuth, tilt, expected, elsewhere) in cases {
        let plates = [plate_at(rho, azimuth)];
        within(&kitchen_tool(), &plates, |world| {
            let task = world.task(&path(curve(0.145), tilt));
            let failed = washing(&task);
            let Err(RedundancyError::NoTilt { ends, .. }) = &failed else {
                panic!("{rho} {azimuth}: {failed:?}");
            };
            let anywhere = |end: &&DeadEnd| anywhere(&task, end.theta).unwrap().is_some();
            let feasible = ends.iter().filter(anywhere).count() as f64 / ends.len() as f64;
            assert!(feasible <= elsewhere, "{rho} {azimuth}: {feasible}");
            let Some(WashablePart { share, causes, points }) = washable_part(&task).unwrap() else {
                panic!("{rho} {azimuth}: washable");
            };
            assert!(0.4 < share && share < 1.0, "{share}");
            let Points { free_m, dead_m } = points;
            let graph = Graph::new(&task);
            assert_eq!(free_m.len() + dead_m.len(), graph.surveyed().len());
            let all = free_m.len() + dead_m.len();
            assert!((share - free_m.len() as f64 / all as f64).abs() < 1e-12, "{share}");
            let surveyed = |place: &[f64; 3]| {
                let mut layers = graph.surveyed();
                layers.any(|k| <[f64; 3]>::from(task.samples.at(graph.theta[k]).point) == *place)
            };
            assert!(free_m.iter().chain(&dead_m).all(surveyed));
            assert!(free_m.iter().all(|place| !dead_m.contains(place)));
            for place in &dead_m {
                let from_axis_m = world.placed.distance(&Vector3::from(*place));
                let within = |cause: &Cause| {
                    let [least, most] = cause.from_axis_m;
                    (least..=most).contains(&from_axis_m)
                };
                assert!(causes.iter().any(within), "{from_axis_m}");
            }
            let all = causes.iter().flat_map(|cause| &cause.worst);
            let filters: Vec<_> = all.map(Hindrance::filter).collect();
            assert!(expected.iter().all(|filter| filters.contains(filter)), "{causes:?}");
            // Every dead point is in one part.
            let parts: f64 = causes.iter().map(|cause| cause.share).sum();
            assert!((parts + share - 1.0).abs() < 1e-9, "{parts} {share}");
            let worst_of = |filter: Filter| {
                let all = causes.iter().flat_map(|cause| &cause.worst);
                let of_filter = all.filter(|worst| worst.filter() == filter);
                of_filter
                    .max_by(|a, b| a.shortfall().total_cmp(&b.shortfall()))
                    .unwrap()
            };
            for worst in filters.into_iter().map(worst_of) {
                // The largest shortfall, not the least, which lies at the edge of the washable part.
                let of_kind = ends.iter().flat_map(|end| &end.reasons);
                let of_kind = of_kind.filter(|reason| reason.least.filter() == worst.filter());
                assert!(of_kind.clone().next().is_none() || worst.shortfall() > 0.0);
                if expected == [Filter::Reach, Filter::Reach] {
                    for reason in of_kind {
                        assert!(reason.least.shortfall() <= worst.shortfall() + 1e-12, "{worst}");
                    }
                }
            }
            for Cause { from_axis_m, share, .. } in &causes {
                let [least, most] = from_axis_m;
                assert!(least <= most && rho - 0.146 <= *least && *most <= rho + 0.146 && *share > 0.0);
            }
        });
    }
}

#[test]
fn a_better_position_is_near_and_washable() {
    let path = path(curve(RADIUS_M), 15.0);
    for (rho, azimuth, furthest) in [(0.2, 30.0, 0.065), (0.56, -40.0, 0.055), (0.36, 0.0, 0.0)] {
        let plates = [plate_at(rho, azimuth), plate_at(0.4, 120.0)];
        let found = within(&kitchen_tool(), &plates, |world| {
            let search = elsewhere(world, &path);
            nearest_washable(&search, &mut |_| true, &|_| ()).unwrap().unwrap()
        });
        let moved = [plates[0].moved_to(found.into()), plates[1]];
        assert!(
            (moved[0].centre() - plates[0].centre()).norm() <= furthest + 2e-3,
            "{found}"
        );
        assert_eq!(found, on_grid(&found));
        let printed: [f64; 2] = [found.x, found.y].map(|at| format!("{at:.3}").parse().unwrap());
        assert_eq!(printed, [found.x, found.y], "to the bit");
        within(&kitchen_tool(), &moved, |world| {
            let washing = world.washing(&path).unwrap();
            check(world, &path, &washing);
        });
    }
}

/// Every search ends at once when it is cancelled, whether it would succeed or not.
#[test]
fn a_cancelled_search_returns_cancelled() {
    let cancel = CancelToken::new();
    cancel.cancel();
    for rho in [0.36, 0.62] {
        let plates = [plate_at(rho, 20.0)];
        within(&kitchen_tool(), &plates, |world| {
            let placed = world.placed.clone().with_cancel(&cancel);
            let path = path(curve(RADIUS_M), 15.0);
            let task = Task::new(&placed, &path, CLEARANCE_M, &HOME).unwrap();
            let cancelled = cancel.check().unwrap_err();
            assert_eq!(by_search(&task), Err(RedundancyError::Cancelled(cancelled)));
            assert_eq!(is_blocked(&task), Err(cancelled));
            assert_eq!(anywhere(&task, 1.0), Err(cancelled));
            assert_eq!(washability::washable_part(&task), Err(cancelled));
            let search = MovedPlate {
                placed: &placed,
                ..elsewhere(world, &path)
            };
            assert_eq!(
                nearest_washable(&search, &mut |_| true, &|_| ()),
                Err(RedundancyError::Cancelled(cancelled))
            );
        });
    }
}

/// An arm without a spherical wrist has no named branches: the branch is the one that the path follows.
#[test]
fn an_arm_without_a_closed_form_washes_too() {
    let offset = r#"<origin xyz="0.072 0 0"/>"#;
    assert!(IRB120_URDF.contains(offset));
    let text = IRB120_URDF.replace(offset, r#"<origin xyz="0.072 0 0.012"/>"#);
    let robot = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let robot = robot
        .with_disabled_pairs(RobotModel::irb120().unwrap().disabled_pairs().unwrap().clone())
        .unwrap();
    with_arm(&robot, &kitchen_tool(), &[plate_at(0.36, 30.0)], |world| {
        assert!(matches!(*world.placed.inverse, Inverse::Numeric(_)));
        let path = path(curve(0.1), 15.0);
        let washing = world.washing(&path).unwrap();
        check(world, &path, &washing);
        assert!(washing.travel_rad() < 15.0, "{}", washing.travel_rad());
    });
}
