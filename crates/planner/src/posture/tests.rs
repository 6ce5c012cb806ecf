use super::elsewhere::{Move, on_grid};
use super::exhaustive::posture_anywhere;
use super::inverse::Width;
use super::search::Graph;
use super::task::{Profile, Task};
use super::washable::{Cause, Washable, washable};
use super::washing::{by_search, policies, search_starts};
use super::*;
use crate::trig::sin_cos;
use nalgebra::{Vector2, Vector3};
use platewash_kinematics::{JointVector, RobotModel, rotation::Rigid};
use platewash_workcell::clearance::{ClearanceModel, PairClearance};
use platewash_workcell::layout::Plate;
use platewash_workcell::stroke::Stroke;
use platewash_workcell::tool::Tool;
use proptest::prelude::*;

mod input;
mod other_arms;
mod scale;

const TOOL: Tool = Tool {
    length_m: 0.15,
    radius_m: 0.02,
    sponge_radius_m: 0.025,
    sponge_height_m: 0.025,
    sponge_compression_m: 0.005,
    mass_kg: 0.3,
    com_m: None,
    inertia_kg_m2: None,
};
const RADIUS_M: f64 = 0.12385;
/// What a distance that decides a quick answer may be wrong by \[m\].
const QUICK_ERROR_M: f64 = 1e-4;
const HOME: JointVector = JointVector::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

fn stroke(radius_m: f64) -> Stroke {
    Stroke {
        radius_m,
        turns: 3.5,
        start_angle_rad: 0.3,
        closing_ring: true,
    }
}

fn plate_at(rho: f64, azimuth_deg: f64) -> Plate {
    let (s, c) = sin_cos(azimuth_deg.to_radians());
    Plate {
        x_m: rho * c,
        y_m: rho * s,
        z_m: 0.03,
        radius_m: 0.145,
        thickness_m: 0.02,
    }
}

fn centre(plate: &Plate) -> Vector3<f64> {
    Vector3::new(plate.x_m, plate.y_m, plate.z_m)
}

fn settings(tilt_deg: f64) -> PostureSettings {
    PostureSettings {
        tilt_max_rad: tilt_deg.to_radians(),
        clearance_m: 0.01,
    }
}

/// Does something in the cell of some plates.
fn within<T>(tool: &Tool, plates: &[Plate], act: impl FnOnce(&Cell<'_>) -> T) -> T {
    let robot = RobotModel::irb120().unwrap();
    let clearance = ClearanceModel::new(&robot, tool, plates).unwrap();
    act(&Cell::new(&robot, tool, &clearance, plates).unwrap())
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

/// Everything that a washing promises, looked at from outside.
fn check(cell: &Cell<'_>, stroke: &Stroke, plate: usize, settings: &PostureSettings, washing: &Washing) {
    let (centre, limits) = (centre(&cell.plates[plate]), cell.robot.limits());
    assert_eq!(washing.theta, stroke.parameters(settings::CHORD_ERROR_M));
    assert_eq!([washing.q.len(), washing.tilt_rad.len()], [washing.theta.len(); 2]);
    for (k, (&theta, q)) in washing.theta.iter().zip(&washing.q).enumerate() {
        let (tip, contact) = (cell.robot.fk(q).rigid(&cell.tip), stroke.at(theta).position);
        let contact = centre + Vector3::new(contact.x, contact.y, 0.0);
        assert!((tip.translation - contact).norm() < 1e-9, "point {k}");
        let tool = tip.rotation.column(2);
        let lean = (tool.x * tool.x + tool.y * tool.y).sqrt().atan2(-tool.z);
        assert!(
            (lean - washing.tilt_rad[k].abs()).abs() < 1e-9,
            "tilt at {k}: {lean} {}",
            washing.tilt_rad[k]
        );
        assert!(lean <= settings.tilt_max_rad + 1e-9);
        assert!(limits.contain(q), "point {k}");
        for pair in cell.clearance.all(q) {
            let sponge_on_plate = pair.a == "sponge" && pair.b.starts_with("plate");
            let kept = pair.distance_m > 0.0 && pair.distance_m >= settings.clearance_m;
            assert!(sponge_on_plate || kept, "point {k}: {pair:?}");
        }
    }
    check_between(cell, stroke, &centre, washing);
}

/// The clamped spline through the answer stays near the stroke and keeps the answer's slopes.
fn check_between(cell: &Cell<'_>, stroke: &Stroke, centre: &Vector3<f64>, washing: &Washing) {
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
            let tip = cell.robot.pose(&q, &cell.tip).translation.vector;
            // Distance from the curve: to the point at this θ, less what is along the curve.
            let point = stroke.at(x[k] + share * h);
            let off = tip - centre - Vector3::new(point.position.x, point.position.y, 0.0);
            let along = Vector3::new(point.first.x, point.first.y, 0.0).normalize();
            worst = worst.max((off - along * along.dot(&off)).norm());
        }
    }
    assert!(worst < 2e-5, "the spline leaves the stroke by {worst} m");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// With the tool and the margin of the facts every plate of the paper can be washed, at no more than 15 rad of joint travel.
    #[test]
    fn a_plate_of_the_paper_is_washed(rho in 0.25..0.495f64, azimuth in -110.0..110.0f64, start in -3.0..3.0f64) {
        let plates = [plate_at(rho, azimuth)];
        let stroke = Stroke { start_angle_rad: start, ..stroke(RADIUS_M) };
        within(&TOOL, &plates, |cell| {
            let washing = washing(cell, &stroke, centre(&plates[0]), 0, &settings(15.0), &HOME).unwrap();
            check(cell, &stroke, 0, &settings(15.0), &washing);
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
        let (tool, stroke, settings) = (Tool { length_m, ..TOOL }, stroke(radius), settings(tilt));
        within(&tool, &plates, |cell| match washing(cell, &stroke, centre(&plates[0]), 0, &settings, &HOME) {
            Ok(washing) => check(cell, &stroke, 0, &settings, &washing),
            Err(PostureError::NoTilt { dead, tried, ends, .. }) => {
                assert!(0 < dead && dead <= tried && !ends.is_empty() && ends.len() <= MOST_DEAD_ENDS);
                for end in &ends {
                    assert!(!end.reasons.is_empty(), "{end:?}");
                }
            }
            Err(PostureError::Disconnected { end, .. } | PostureError::Between { end, .. }) => {
                assert!(!end.reasons.is_empty(), "{end:?}");
            }
            Err(other) => panic!("{other}"),
        });
    }

    /// What the last turn alone tells is what the whole search finds, on every branch.
    #[test]
    fn what_is_known_before_the_search_is_what_the_search_finds(
        places in prop::collection::vec((0.2..0.62f64, -170.0..170.0f64), 1..3),
        tilt in prop::sample::select(vec![0.0, 5.0, 15.0]),
        radius in 0.03..0.08f64,
    ) {
        let plates: Vec<_> = places.iter().map(|&(rho, azimuth)| plate_at(rho, azimuth)).collect();
        let (stroke, settings) = (Stroke { turns: 1.5, ..stroke(radius) }, settings(tilt));
        within(&TOOL, &plates, |cell| {
            let task = Task::new(cell, &stroke, centre(&plates[0]), 0, &settings, &HOME).unwrap();
            let graph = Graph::new(&task, &settings);
            let known = is_blocked(cell, &stroke, centre(&plates[0]), 0, &settings, &HOME).unwrap();
            let found = search_starts(&task, &graph, &HOME).iter().any(|start| graph.cheapest(&task, start).is_ok());
            assert!(!(known && found), "{places:?}");
        });
    }

    /// The search alone, without the policies, keeps the same promises.
    #[test]
    fn the_search_washes_what_the_policies_wash(rho in 0.27..0.48f64, azimuth in -90.0..90.0f64) {
        let plates = [plate_at(rho, azimuth)];
        let (stroke, settings) = (stroke(RADIUS_M), settings(15.0));
        within(&TOOL, &plates, |cell| {
            let task = Task::new(cell, &stroke, centre(&plates[0]), 0, &settings, &HOME).unwrap();
            let washing = by_search(&task, 0, &settings, &HOME).unwrap();
            check(cell, &stroke, 0, &settings, &washing);
            assert!(washing.travel_rad() < 15.0, "{}", washing.travel_rad());
            let rates = washing.tilt_rad.windows(2).zip(task.samples.length_m.windows(2));
            for (tilts, lengths) in rates {
                assert!((tilts[1] - tilts[0]).abs() <= 1.05 * policy::FASTEST_RAD_M * (lengths[1] - lengths[0]) + 1e-12);
            }
        });
    }

    /// The quick answer of the clearance model is that of all its distances, but where one is what is required to the quick routine's
    /// error.
    #[test]
    fn the_quick_clearance_is_the_slow_one(q in prop::array::uniform6(-1.9..1.9f64), required in 0.0..0.05f64) {
        let plates = [plate_at(0.3, 10.0), plate_at(0.4, 60.0)];
        within(&TOOL, &plates, |cell| {
            let q = JointVector::from(q);
            let near = |pair: &PairClearance| !(pair.distance_m > 0.0 && pair.distance_m >= required);
            let mut all = cell.clearance.all(&q);
            if all.iter().any(|pair| (pair.distance_m - required).abs() <= QUICK_ERROR_M) {
                return;
            }
            assert_eq!(cell.clearance.keeps(&q, required), !all.iter().any(near));
            all.retain(|pair| !(pair.a == "sponge" && pair.b.starts_with("plate")) && near(pair));
            assert_eq!(cell.clearance.keeps_washing(&q, required), all.is_empty());
            let least = all.iter().map(|pair| pair.distance_m).fold(f64::INFINITY, f64::min);
            match cell.clearance.nearest_washing(&q, required) {
                Some(pair) => assert_eq!(pair.distance_m, least),
                None => assert!(all.is_empty()),
            }
        });
    }

    #[test]
    fn the_tool_leans_away_from_axis_1(x in -0.6..0.6f64, y in -0.6..0.6f64, tilt in -0.6..0.6f64) {
        prop_assume!(x.abs() + y.abs() > 1e-6);
        within(&TOOL, &[], |cell| {
            let contact = Vector3::new(x, y, 0.03);
            let pose = cell.tip_pose(contact, tilt);
            let out = Vector3::new(x, y, 0.0).normalize();
            let (s, c) = sin_cos(tilt);
            assert!((pose.rotation * Vector3::z() + Vector3::z() * c + out * s).norm() < 1e-12);
            let side = pose.rotation * Vector3::x();
            assert!(side.dot(&Vector3::z().cross(&out)).abs() < 1e-12, "x of the tip lies in the arm's plane");
            assert!((pose.translation.vector - contact).norm() == 0.0);
            let leaning = cell.tip_leaning(&contact, &(out * tilt));
            assert!((leaning.rotation - Rigid::from(&pose).rotation).norm() < 1e-12);
        });
    }

    /// `ω` and the slopes of the profiles against differences of the exact map.
    #[test]
    fn slopes_are_those_of_the_exact_map(rho in 0.27..0.48f64, azimuth in -90.0..90.0f64, share in 0.05..0.95f64) {
        let plates = [plate_at(rho, azimuth)];
        let (stroke, settings) = (stroke(RADIUS_M), settings(15.0));
        within(&TOOL, &plates, |cell| {
            let task = Task::new(cell, &stroke, centre(&plates[0]), 0, &settings, &HOME).unwrap();
            let policy = policies(&task, &settings)[0];
            let profile = Profile::Policy(policy);
            let tilts = task.tilts(&profile);
            let k = (share * tilts.len() as f64) as usize;
            let first = cell.tip_rigid(&task.samples.contact[0], tilts[0]);
            let start = cell.inverse.starts(&first, &HOME, Width::Near).unwrap()[0];
            let at = |theta: f64| {
                let contact = task.samples.at(theta);
                cell.inverse.continuing(&task.cell.tip_rigid(&contact, task.tilt(&profile, &contact, 0.0)), &start).unwrap()
            };
            let (theta, h) = (task.samples.theta[k], 1e-5);
            let slope = task.slope(&profile, k, &at(theta)).unwrap();
            let difference = (at(theta + h) - at(theta - h)) / (2.0 * h);
            assert!((slope - difference).amax() < 1e-7, "{slope} {difference}");
        });
    }
}

/// However long the stroke and however many the tilts: a few points of the last turn tell, and the search is not begun.
#[test]
fn a_long_stroke_out_of_reach_is_refused_before_it_is_searched() {
    let plates = [plate_at(0.62, 20.0)];
    let stroke = Stroke {
        turns: 100.0,
        ..stroke(RADIUS_M)
    };
    within(&TOOL, &plates, |cell| {
        let failed = washing(cell, &stroke, centre(&plates[0]), 0, &settings(60.0), &HOME);
        let Err(PostureError::NoTilt { dead, tried, ends, .. }) = &failed else {
            panic!("{failed:?}");
        };
        assert!(0 < *dead && *dead < *tried && *tried < 100, "{dead} of {tried}");
        let turn = stroke.end() - std::f64::consts::TAU;
        assert!(
            ends.iter().all(|end| end.theta > turn - 0.1 && !end.reasons.is_empty()),
            "{ends:?}"
        );
    });
}

/// Plates too near, too far or behind are refused for what stands in the way, and where no other branch of the arm would do the
/// exhaustive search agrees at every dead end.
#[test]
fn a_failure_is_the_arms_own() {
    let cases = [
        (0.2, 0.0, 15.0, [Filter::Limit, Filter::Clearance], 0.0),
        (0.25, 45.0, 30.0, [Filter::Limit, Filter::Clearance], 0.0),
        (0.6, 20.0, 15.0, [Filter::Reach, Filter::Reach], 0.0),
        (0.4, 179.0, 15.0, [Filter::Limit, Filter::Limit], 1.0),
    ];
    for (rho, azimuth, tilt, expected, elsewhere) in cases {
        let plates = [plate_at(rho, azimuth)];
        within(&TOOL, &plates, |cell| {
            let (stroke, settings, at) = (stroke(0.145), settings(tilt), centre(&plates[0]));
            let failed = washing(cell, &stroke, at, 0, &settings, &HOME);
            let Err(PostureError::NoTilt { ends, .. }) = &failed else {
                panic!("{rho} {azimuth}: {failed:?}");
            };
            let anywhere = |end: &&DeadEnd| {
                let found = posture_anywhere(cell, (&stroke, end.theta), at, 0, &settings, &HOME);
                found.unwrap().is_some()
            };
            let feasible = ends.iter().filter(anywhere).count() as f64 / ends.len() as f64;
            assert!(feasible <= elsewhere, "{rho} {azimuth}: {feasible}");
            let Washable::Part {
                share,
                causes,
                conclusion,
            } = washable(cell, &stroke, at, 0, &settings, &HOME).unwrap()
            else {
                panic!("{rho} {azimuth}: washable");
            };
            // Where nothing would do anywhere on the way, that is known.
            assert!(
                conclusion.is_proved() || elsewhere > 0.0,
                "{rho} {azimuth}: {conclusion:?}"
            );
            assert!(0.4 < share && share < 1.0, "{share}");
            let filters: Vec<_> = causes.iter().map(|cause| cause.worst.filter()).collect();
            assert!(expected.iter().all(|filter| filters.contains(filter)), "{causes:?}");
            for Cause {
                from_axis_m: [least, most],
                share,
                worst,
            } in causes
            {
                // The largest shortfall, not the least, which lies at the edge of what can be washed.
                let of_kind = ends.iter().flat_map(|end| &end.reasons);
                let of_kind = of_kind.filter(|reason| reason.least.filter() == worst.filter());
                assert!(of_kind.clone().next().is_none() || worst.shortfall() > 0.0);
                if expected == [Filter::Reach, Filter::Reach] {
                    for reason in of_kind {
                        assert!(reason.least.shortfall() <= worst.shortfall() + 1e-12, "{worst}");
                    }
                }
                assert!(least <= most && rho - 0.146 <= least && most <= rho + 0.146 && share > 0.0);
            }
        });
    }
}

#[test]
fn a_better_position_is_near_and_does() {
    let robot = RobotModel::irb120().unwrap();
    let (stroke, settings) = (stroke(RADIUS_M), settings(15.0));
    for (rho, azimuth, furthest) in [(0.2, 30.0, 0.065), (0.56, -40.0, 0.055), (0.36, 0.0, 0.0)] {
        let plates = [plate_at(rho, azimuth), plate_at(0.4, 120.0)];
        let search = Move {
            robot: &robot,
            tool: &TOOL,
            plates: &plates,
            plate: 0,
            stroke: &stroke,
            height_m: 0.0,
            settings: &settings,
            near: &HOME,
        };
        let found = search.nearest_washable(&mut |_| true).unwrap().unwrap();
        let moved = [
            Plate {
                x_m: found.x,
                y_m: found.y,
                ..plates[0]
            },
            plates[1],
        ];
        assert!(
            (centre(&moved[0]) - centre(&plates[0])).norm() <= furthest + 2e-3,
            "{found}"
        );
        assert_eq!(found, on_grid(&found));
        let printed: [f64; 2] = [found.x, found.y].map(|at| format!("{at:.3}").parse().unwrap());
        assert_eq!(printed, [found.x, found.y], "to the bit");
        within(&TOOL, &moved, |cell| {
            let washing = washing(cell, &stroke, centre(&moved[0]), 0, &settings, &HOME).unwrap();
            check(cell, &stroke, 0, &settings, &washing);
        });
    }
}

/// A place that the caller refuses is no answer: the next one is, further out, and none is where all are refused.
#[test]
fn a_better_position_is_one_that_the_caller_accepts() {
    let robot = RobotModel::irb120().unwrap();
    let (stroke, settings) = (stroke(RADIUS_M), settings(15.0));
    let plates = [plate_at(0.56, -40.0)];
    let search = Move {
        robot: &robot,
        tool: &TOOL,
        plates: &plates,
        plate: 0,
        stroke: &stroke,
        height_m: 0.0,
        settings: &settings,
        near: &HOME,
    };
    let mut asked = Vec::new();
    let third = |place: &Vector2<f64>| {
        asked.push(*place);
        asked.len() == 3
    };
    let found = search.nearest_washable(&mut { third }).unwrap().unwrap();
    assert_eq!((asked.len(), asked[2]), (3, found));
    let mut count = 0;
    let none = |_: &Vector2<f64>| {
        count += 1;
        false
    };
    assert_eq!(search.nearest_washable(&mut { none }).unwrap(), None);
    assert!(0 < count && count <= elsewhere::MOST_CHECKS, "{count}");
}
