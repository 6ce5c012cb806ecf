mod aside;
mod held;
mod input;
mod other_arms;
mod scale;

use crate::redundancy::places::{MOST_CHECKS, MovedPlate, nearest_washable, on_grid};
use crate::redundancy::search::Graph;
use crate::redundancy::stuck::anywhere;
use crate::redundancy::task::Profile;
use crate::redundancy::washability::{Cause, Points, Washability, washable};
use crate::redundancy::washing::{by_policy, by_search, policies, search_starts};
use crate::redundancy::*;
use crate::scene::{Contact, Filter, Hindrance, Inverse, Scene, TiltPolicy, Width, stance};
use crate::trig::sin_cos;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::clearance::{ClearanceModel, PairClearance};
use platewash_workcell::fixtures::{kitchen_tool, workcell};
use platewash_workcell::job::ReachBorders;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::wash_path::{WashCurve, WashPath};
use proptest::prelude::*;

const RADIUS_M: f64 = 0.12385;
const CLEARANCE_M: f64 = 0.01;
/// Largest error of a distance that decides a quick answer \[m\].
const QUICK_ERROR_M: f64 = 1e-4;
const HOME: JointVector = JointVector::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

/// The tool of the kitchen with another length and another handle.
fn straight(length_m: f64, radius_m: f64) -> Tool {
    Tool::from(StraightTool {
        length_m,
        radius_m,
        ..StraightTool::default()
    })
}

fn curve(radius_m: f64) -> WashCurve {
    WashCurve {
        radius_m,
        turns: 3.5,
        start_angle_rad: 0.3,
        closing_ring: true,
        trim_rad: 0.0,
        rings: None,
    }
}

/// The path on the first plate.
fn path(curve: WashCurve, tilt_deg: f64) -> WashPath {
    WashPath {
        plate: 0,
        curve,
        lift_m: 0.03,
        cone_rad: tilt_deg.to_radians(),
    }
}

fn plate_at(rho: f64, azimuth_deg: f64) -> Plate {
    let (s, c) = sin_cos(azimuth_deg.to_radians());
    Plate::level_disc([rho * c, rho * s, 0.03], 0.145, 0.02)
}

/// An arm among some plates.
struct World<'a> {
    scene: Scene<'a>,
    clearance: &'a ClearanceModel,
}

impl World<'_> {
    fn task(&self, path: &WashPath) -> Task<'_> {
        self.task_near(path, &HOME)
    }

    fn task_near(&self, path: &WashPath, near: &JointVector) -> Task<'_> {
        Task::new(&self.scene, path, CLEARANCE_M, near).unwrap()
    }

    fn washing(&self, path: &WashPath) -> Result<Washing, RedundancyError> {
        washing(&self.task(path))
    }
}

/// Does something with an arm among some plates.
fn with_arm<T>(robot: &RobotModel, tool: &Tool, plates: &[Plate], act: impl FnOnce(&World<'_>) -> T) -> T {
    let clearance = ClearanceModel::new(robot, &workcell(robot, tool.clone()), plates).unwrap();
    act(&World {
        scene: Scene::new(robot, tool, &clearance, plates, ReachBorders::IRB_120).unwrap(),
        clearance: &clearance,
    })
}

/// The same with the IRB 120.
fn within<T>(tool: &Tool, plates: &[Plate], act: impl FnOnce(&World<'_>) -> T) -> T {
    with_arm(&RobotModel::irb120().unwrap(), tool, plates, act)
}

/// The second derivatives of the clamped cubic spline through (x, y) (de Boor, ch. IV), by elimination.
fn spline_curvatures(x: &[f64], y: &[f64], ends: [f64; 2]) -> Vec<f64> {
    let n = x.len();
    let h = |k: usize| x[k + 1] - x[k];
    let rise = |k: usize| (y[k + 1] - y[k]) / h(k);
    let (mut upper, mut right) = (vec![0.5; n], vec![3.0 * (rise(0) - ends[0]) / h(0); n]);
    for k in 1..n {
        let below = h(k - 1);
        let (diagonal, above, value) = if k + 1 < n {
            (2.0 * (below + h(k)), h(k), 6.0 * (rise(k) - rise(k - 1)))
        } else {
            (2.0 * below, 0.0, 6.0 * (ends[1] - rise(k - 1)))
        };
        let pivot = diagonal - below * upper[k - 1];
        upper[k] = above / pivot;
        right[k] = (value - below * right[k - 1]) / pivot;
    }
    for k in (0..n - 1).rev() {
        right[k] -= upper[k] * right[k + 1];
    }
    right
}

/// Checks everything that a washing promises, from outside.
fn check(world: &World<'_>, path: &WashPath, washing: &Washing) {
    let scene = &world.scene;
    let (plate, limits) = (&scene.plates[path.plate], scene.robot.limits());
    assert_eq!(
        washing.theta,
        path.curve
            .parameters(&plate.surface, crate::redundancy::task::CHORD_ERROR_M)
    );
    assert_eq!([washing.q.len(), washing.tilt_rad.len()], [washing.theta.len(); 2]);
    let stance = scene.clone().leaning_aside(washing.aside_rad).stance;
    for (k, (&theta, q)) in washing.theta.iter().zip(&washing.q).enumerate() {
        let tip = scene.robot.fk(q).rigid(&scene.tip);
        let contact = plate.pose.rotation * path.curve.at(theta).position.push(0.0) + plate.centre();
        assert!((tip.translation - contact).norm() < 1e-9, "point {k}");
        let tool = tip.rotation.column(2);
        let lean = tool.cross(&plate.axis()).norm().atan2(-tool.dot(&plate.axis()));
        let stated = stance.lean_rad(washing.tilt_rad[k]);
        assert!(
            (lean - stated).abs() < 1e-9,
            "tilt at {k}: {lean} {}",
            washing.tilt_rad[k]
        );
        assert!(lean <= path.cone_rad + 1e-9);
        assert!(limits.contain(q), "point {k}");
        for pair in world.clearance.all(q) {
            let sponge_on_plate = pair.a == "sponge" && pair.b.starts_with("plate");
            let kept = pair.distance_m >= CLEARANCE_M;
            assert!(sponge_on_plate || kept, "point {k}: {pair:?}");
        }
    }
    check_between(scene, &path.curve, plate, washing);
}

/// The clamped spline through the answer stays near the wash path and keeps the answer's slopes.
fn check_between(scene: &Scene<'_>, curve: &WashCurve, plate: &Plate, washing: &Washing) {
    let x = &washing.theta;
    let curvatures: Vec<Vec<f64>> = (0..6)
        .map(|joint| {
            let y: Vec<_> = washing.q.iter().map(|q| q[joint]).collect();
            spline_curvatures(x, &y, washing.end_slopes.map(|slope| slope[joint]))
        })
        .collect();
    let mut worst: f64 = 0.0;
    for k in 0..x.len() - 1 {
        let h = x[k + 1] - x[k];
        for share in [0.2, 0.5, 0.8] {
            let (a, b) = (1.0 - share, share);
            let q = JointVector::from_fn(|joint, _| {
                let m = &curvatures[joint];
                a * washing.q[k][joint]
                    + b * washing.q[k + 1][joint]
                    + ((a * a * a - a) * m[k] + (b * b * b - b) * m[k + 1]) * h * h / 6.0
            });
            let tip = scene.robot.pose(&q, &scene.tip).translation.vector;
            // Distance from the curve: to the point at this θ, less what is along the curve.
            let point = curve.at(x[k] + share * h);
            let off = plate.local(&tip) - point.position.push(0.0);
            let along = point.first.push(0.0).normalize();
            worst = worst.max((off - along * along.dot(&off)).norm());
        }
    }
    assert!(worst < 2e-5, "the spline leaves the wash path by {worst} m");
}

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
                assert!((tilts[1] - tilts[0]).abs() <= 1.05 * stance::FASTEST_RAD_M * (lengths[1] - lengths[0]) + 1e-12);
            }
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

    #[test]
    fn the_tool_leans_away_from_axis_1(x in -0.6..0.6f64, y in -0.6..0.6f64, tilt in -0.6..0.6f64) {
        prop_assume!(x.abs() + y.abs() > 1e-6);
        within(&kitchen_tool(), &[], |world| {
            let contact = Contact::level(Vector3::new(x, y, 0.03));
            let pose = world.scene.tip_pose(&contact, tilt);
            let out = Vector3::new(x, y, 0.0).normalize();
            let (s, c) = sin_cos(tilt);
            assert!((pose.rotation * Vector3::z() + Vector3::z() * c + out * s).norm() < 1e-12);
            let side = pose.rotation * Vector3::x();
            assert!(side.dot(&Vector3::z().cross(&out)).abs() < 1e-12, "x of the tip lies in the arm's plane");
            assert!((pose.translation.vector - contact.point).norm() == 0.0);
            let leaning = world.scene.tip_leaning(&contact, &(out * tilt));
            assert!((leaning.rotation - RigidTransform::from(&pose).rotation).norm() < 1e-12);
        });
    }

    /// `ω` and the slopes of the profiles against differences of the exact map.
    #[test]
    fn slopes_are_those_of_the_exact_map(rho in 0.27..0.48f64, azimuth in -90.0..90.0f64, share in 0.05..0.95f64) {
        let plates = [plate_at(rho, azimuth)];
        let path = path(curve(RADIUS_M), 15.0);
        within(&kitchen_tool(), &plates, |world| {
            let (task, scene) = (world.task(&path), &world.scene);
            let policy = policies(&task)[0];
            let profile = Profile::Policy(policy);
            let tilts = task.tilts(&profile);
            let k = (share * tilts.len() as f64) as usize;
            let first = scene.tip_rigid(&task.samples.contact[0], tilts[0]);
            let start = scene.inverse.starts(&first, &HOME, Width::Near).unwrap()[0];
            let at = |theta: f64| {
                let contact = task.samples.at(theta);
                scene.inverse.continuing(&scene.tip_rigid(&contact, task.tilt(&profile, &contact, 0.0)), &start).unwrap()
            };
            let (theta, h) = (task.samples.theta[k], 1e-5);
            let slope = task.slope(&profile, k, &at(theta)).unwrap();
            let difference = (at(theta + h) - at(theta - h)) / (2.0 * h);
            assert!((slope - difference).amax() < 1e-7, "{slope} {difference}");
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
            let Washability::Part {
                share,
                causes,
                conclusion,
                points,
            } = washable(&task).unwrap()
            else {
                panic!("{rho} {azimuth}: washable");
            };
            // Where nothing would do anywhere on the way, that is known.
            assert!(
                conclusion.is_proved() || elsewhere > 0.0,
                "{rho} {azimuth}: {conclusion:?}"
            );
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
                let from_axis_m = world.scene.distance(&Vector3::from(*place));
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

fn elsewhere<'a>(world: &'a World<'a>, path: &'a WashPath) -> MovedPlate<'a> {
    MovedPlate {
        scene: &world.scene,
        clearance: world.clearance,
        path,
        clearance_m: CLEARANCE_M,
        near: &HOME,
    }
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

/// Every search ends at once when it is cancelled, whether it would succeed or not.
#[test]
fn a_cancelled_search_returns_cancelled() {
    let cancel = CancelToken::new();
    cancel.cancel();
    for rho in [0.36, 0.62] {
        let plates = [plate_at(rho, 20.0)];
        within(&kitchen_tool(), &plates, |world| {
            let scene = world.scene.clone().with_cancel(&cancel);
            let path = path(curve(RADIUS_M), 15.0);
            let task = Task::new(&scene, &path, CLEARANCE_M, &HOME).unwrap();
            let cancelled = cancel.check().unwrap_err();
            assert_eq!(by_search(&task), Err(RedundancyError::Cancelled(cancelled)));
            assert_eq!(is_blocked(&task), Err(cancelled));
            assert_eq!(anywhere(&task, 1.0), Err(cancelled));
            assert_eq!(washability::washable_part(&task), Err(cancelled));
            let search = MovedPlate {
                scene: &scene,
                ..elsewhere(world, &path)
            };
            assert_eq!(
                nearest_washable(&search, &mut |_| true, &|_| ()),
                Err(RedundancyError::Cancelled(cancelled))
            );
        });
    }
}
