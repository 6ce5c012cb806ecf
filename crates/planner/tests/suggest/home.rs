//! Homes over the plates, clear of everything, from which jobs are planned.

use nalgebra::Vector3;
use platewash_bodies::job::WashJob;
use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{JointVector, Pose};
use platewash_planner::suggest::{SuggestedHome, suggest_home};
use platewash_planner::{PlanError, plan};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::JobTerms;
use platewash_workcell::{Obstacle, ObstacleShape};
use std::f64::consts::{FRAC_PI_6, PI, TAU};

fn home(terms: &JobTerms) -> Result<SuggestedHome, PlanError> {
    suggest_home(kitchen().arm(), terms, &CancelToken::new())
}

/// The home of a job is of no account, and the one found is one for the job: it can be planned from there.
#[test]
fn the_home_is_clear_points_down_and_is_the_same_again() {
    let job = kitchen();
    let mut terms = job.terms().clone();
    let found = home(&terms).unwrap();
    terms.home_rad = [JointVector::zeros(); 2];
    assert_eq!(home(&terms).unwrap(), found);
    // The handle is never farther than 24 mm from the forearm's shape.
    let nearest = found.nearest.as_ref().unwrap();
    assert!(
        [&*nearest.a, &*nearest.b] == ["link_4", "handle"] && nearest.distance_m > 0.019,
        "{found:?}"
    );
    assert!(found.tilt_rad < 0.05 && found.margin_rad > 0.25, "{found:?}");
    terms.home_rad = [found.q_rad(); 2];
    plan(&WashJob::new(job.shared_arm(), terms).unwrap()).unwrap();
}

/// Plates behind the arm turn it round.
#[test]
fn the_home_is_over_the_plates() {
    let mut terms = kitchen().terms().clone();
    for [x, y] in [[0.3, 0.0], [-0.05, 0.35], [-0.05, -0.35]] {
        terms.plates = vec![kitchen_plate([x, y])];
        let q = home(&terms).unwrap().q_rad();
        let job = kitchen();
        let tip = job
            .arm()
            .fk(&q)
            .rigid(&terms.workcell.tool.tip_frame(job.arm()))
            .translation;
        let between = (tip.y * x - tip.x * y).atan2(tip.x * x + tip.y * y);
        assert!(between.abs() < FRAC_PI_6 + 0.1, "{x} {y}: {tip}");
    }
}

/// A box around all that the arm can reach.
#[test]
fn returns_no_home_where_nothing_is_clear() {
    let mut terms = kitchen().terms().clone();
    let block = ObstacleShape::Convex(Shape::Box { half_m: [2.0; 3] });
    terms
        .workcell
        .obstacles
        .push(Obstacle::new("block", block, Pose::identity()));
    let refused = home(&terms).unwrap_err();
    assert!(matches!(refused, PlanError::NoHome { .. }));
    let said = refused.to_string();
    assert!(said.contains(" and block, in 4000 of them"), "{said}");
}

/// The same home for joints of ±1 turn and of ±16, and, up to whole turns, where 0 is the end of the joints or far beyond it: but for the two
/// ways to bend the wrist, which are alike.
#[test]
fn the_home_does_not_depend_on_how_far_the_joints_turn() {
    let terms = kitchen().terms().clone();
    let home = |limits: [f64; 2]| {
        let robot = crate::redundancy::turns::arm_between(limits);
        suggest_home(&robot, &terms, &CancelToken::new()).unwrap()
    };
    let once = home([-TAU, TAU]);
    assert_eq!(home([-100.0, 100.0]).q_deg, once.q_deg);
    for limits in [[0.0, 100.0], [-100.0, -85.0], [-7.0, 90.0]] {
        let found = home(limits);
        assert_eq!(found.clear, once.clear, "{limits:?}");
        let off = |joint: usize| (found.q_deg[joint] - once.q_deg[joint]).rem_euclid(360.0);
        assert_eq!([0, 1, 2].map(off), [0.0; 3], "{limits:?}");
        assert!(found.margin_rad > 0.5 * PI, "{found:?}");
    }
}

/// A block over the plates: the home is elsewhere, and no turns away.
#[test]
fn a_home_that_is_not_over_the_plates_is_within_a_turn_of_0() {
    let mut terms = kitchen().terms().clone();
    terms.plates = vec![kitchen_plate([0.3, 0.0])];
    let block = ObstacleShape::Convex(Shape::Box {
        half_m: [0.5, 1.0, 1.0],
    });
    let place = Pose::new(Vector3::new(0.7, 0.0, 0.0), Vector3::zeros());
    terms.workcell.obstacles.push(Obstacle::new("block", block, place));
    let robot = crate::redundancy::turns::arm_between([-100.0, 100.0]);
    let found = suggest_home(&robot, &terms, &CancelToken::new()).unwrap();
    assert!(found.tilt_rad > 0.1, "over the plates: {found:?}");
    assert!(found.q_deg.iter().all(|deg| deg.abs() <= 180.0), "{found:?}");
}
