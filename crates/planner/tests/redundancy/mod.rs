//! Tilts and branches of the arm along wash paths: an answer keeps its promises, and a failure has a reason.

mod input;
mod other_arms;
pub mod turns;
pub mod world;

use nalgebra::{UnitQuaternion, Vector2};
use platewash_bodies::clearance::PairClearance;
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::JointVector;
use platewash_planner::placed_arm;
use platewash_planner::redundancy::places::{MOST_CHECKS, nearest_washable};
use platewash_planner::redundancy::{self, MOST_DEAD_ENDS, RedundancyError};
use platewash_workcell::wash_path::WashCurve;
use proptest::prelude::*;
use world::{RADIUS_M, check, curve, elsewhere, path, plate_at, straight, within};

/// Largest error of a distance that decides a quick answer \[m\].
const QUICK_ERROR_M: f64 = 1e-4;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// With the tool and the margin of the facts every plate of the paper can be washed, at no more than 15 rad of joint travel. Nearer than
    /// 0.27 m the base is within the clearance and the planner's reserve of 0.5 mm at some points.
    #[test]
    fn a_plate_of_the_paper_is_washed(rho in 0.27..0.495f64, azimuth in -110.0..110.0f64, start in -3.0..3.0f64) {
        let plates = [plate_at(rho, azimuth)];
        let path = path(WashCurve { start_angle_rad: start, ..curve(RADIUS_M) }, 15.0);
        within(&kitchen_tool(), &plates, |world| {
            let washing = world.washing(&path).unwrap();
            check(world, &path, &washing);
            assert!(washing.travel_rad() < 15.0, "{}", washing.travel_rad());
            assert!(washing.q.iter().all(|q| q[3].abs() < 1e-9 && q[5].abs() < 1e-9), "joints 4 and 6 rest");
        });
    }

    /// Whatever the plates and the tool: an answer keeps its promises, an error names a place where the exhaustive search
    /// finds nothing either, or nothing within the arm's plane.
    #[test]
    fn an_answer_keeps_its_promises_and_a_failure_has_a_reason(
        places in prop::collection::vec((0.2..0.55f64, -170.0..170.0f64), 1..4),
        tilt in prop::sample::select(vec![0.0, 5.0, 15.0, 30.0]),
        length_m in 0.06..0.2f64,
        radius in 0.05..0.145f64,
    ) {
        let plates: Vec<_> = places.iter().map(|&(rho, azimuth)| plate_at(rho, azimuth)).collect();
        let (tool, path) = (straight(length_m, 0.02), path(curve(radius), tilt));
        within(&tool, &plates, |world| match world.washing(&path) {
            Ok(washing) => check(world, &path, &washing),
            Err(RedundancyError::NoTilt { dead, tried, ends, .. }) => {
                assert!(0 < dead && dead <= tried && !ends.is_empty() && ends.len() <= MOST_DEAD_ENDS);
                for end in &ends {
                    assert!(!end.reasons.is_empty(), "{end:?}");
                }
            }
            Err(RedundancyError::Disconnected { end, .. } | RedundancyError::Between { end, .. }) => {
                assert!(!end.reasons.is_empty(), "{end:?}");
            }
            Err(other) => panic!("{other}"),
        });
    }

    /// The quick answer of the clearance model equals that of all its distances, except where a distance is within the error of
    /// the quick routine of the required one.
    #[test]
    fn fast_and_slow_clearance_agree(q in prop::array::uniform6(-1.9..1.9f64), required in 0.0..0.05f64) {
        let plates = [plate_at(0.3, 10.0), plate_at(0.4, 60.0)];
        within(&kitchen_tool(), &plates, |world| {
            let q = JointVector::from(q);
            let near = |pair: &PairClearance| !(pair.distance_m > 0.0 && pair.distance_m >= required);
            let mut all = world.clearance.all(&q);
            if all.iter().any(|pair| (pair.distance_m - required).abs() <= QUICK_ERROR_M) {
                return;
            }
            assert_eq!(world.clearance.keeps_clearance(&q, required), !all.iter().any(near));
            all.retain(|pair| !(pair.a == "sponge" && pair.b.starts_with("plate")) && near(pair));
            assert_eq!(world.clearance.levels_kept(&q, Some(0), &[required]) == 1, all.is_empty());
            let least = all.iter().map(|pair| pair.distance_m).fold(f64::INFINITY, f64::min);
            match world.clearance.nearest_washing(&q, 0, required) {
                Some(pair) => assert_eq!(pair.distance_m, least),
                None => assert!(all.is_empty()),
            }
        });
    }
}

/// A few points of the last turn decide for any length of the wash path and any number of tilts, and the search does not begin.
#[test]
fn a_long_path_out_of_reach_is_refused_before_it_is_searched() {
    let plates = [plate_at(0.62, 20.0)];
    let curve = WashCurve {
        turns: 100.0,
        ..curve(RADIUS_M)
    };
    within(&kitchen_tool(), &plates, |world| {
        let failed = world.washing(&path(curve, 60.0));
        let Err(RedundancyError::NoTilt { dead, tried, ends, .. }) = &failed else {
            panic!("{failed:?}");
        };
        assert!(0 < *dead && *dead < *tried && *tried < 100, "{dead} of {tried}");
        let turn = curve.end() - std::f64::consts::TAU;
        assert!(
            ends.iter().all(|end| end.theta > turn - 0.1 && !end.reasons.is_empty()),
            "{ends:?}"
        );
    });
}

/// A place that the caller refuses is no answer: the next one is, further out, and none is where all are refused.
#[test]
fn suggests_only_positions_that_the_caller_accepts() {
    let (path, plates) = (path(curve(RADIUS_M), 15.0), [plate_at(0.56, -40.0)]);
    within(&kitchen_tool(), &plates, |world| {
        let search = elsewhere(world, &path);
        let mut asked = Vec::new();
        let third = |place: &Vector2<f64>| {
            asked.push(*place);
            asked.len() == 3
        };
        let found = nearest_washable(&search, &mut { third }, &|_| ()).unwrap().unwrap();
        assert_eq!((asked.len(), asked[2]), (3, found));
        let mut count = 0;
        let none = |_: &Vector2<f64>| {
            count += 1;
            false
        };
        assert_eq!(nearest_washable(&search, &mut { none }, &|_| ()).unwrap(), None);
        assert!(0 < count && count <= MOST_CHECKS, "{count}");
    });
}

/// Wherever its face looks: the tool stands on the plate's own normal, in the cone that the path states.
#[test]
fn a_plate_that_does_not_lie_level_is_washed_too() {
    for (roll, pitch) in [(0.1, 0.0), (-0.05, 0.08), (0.0, -0.1)] {
        let mut plate = plate_at(0.38, 25.0);
        plate.pose.rotation = UnitQuaternion::from_euler_angles(roll, pitch, 0.7);
        plate.pose.translation.z = 0.1;
        within(&kitchen_tool(), &[plate], |world| {
            let path = path(curve(0.1), 15.0);
            let washing = world.washing(&path).unwrap();
            check(world, &path, &washing);
        });
    }
}
