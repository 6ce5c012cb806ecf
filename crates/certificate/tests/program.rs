//! The motion of a program: what an independent sampler finds is within the bounds, and what leaves the plan is said.

use crate::maker::{good, irb120};
use platewash_certificate::{
    Certified, Check, ProgramLimits, ProgramProof, Requirement, Status, certify, prove_program,
};
use platewash_kinematics::JointVector;
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::cancel::CancelToken;
use proptest::prelude::*;
use std::sync::OnceLock;

const LIMITS: ProgramLimits = ProgramLimits {
    deviation_m: 2e-4,
    joint_speed_share: 0.95,
    speed_share: 1.0,
};

fn certified() -> &'static Certified<Plan> {
    static CERTIFIED: OnceLock<Certified<Plan>> = OnceLock::new();
    CERTIFIED.get_or_init(|| certify(good(), &irb120()).unwrap())
}

/// Lines through every n-th knot and the ends of the segments, changed a little.
fn lines(plan: &Plan, every: usize, change: impl Fn(f64, JointVector) -> JointVector) -> PiecewiseMotion {
    let knots = &plan.knots;
    let is_end = |t: f64| plan.segments.iter().any(|segment| segment.t_end_s == t);
    let kept = |k: &usize| k.is_multiple_of(every) || is_end(knots.t_s[*k]);
    let at = |k: usize| (knots.t_s[k], change(knots.t_s[k], knots.q_rad[k]));
    let points: Vec<_> = (0..knots.t_s.len()).filter(kept).map(at).collect();
    let line = |both: &[(f64, JointVector)]| MotionPiece::line([both[0].0, both[1].0], [both[0].1, both[1].1]);
    PiecewiseMotion::new(points.windows(2).map(line).collect()).unwrap()
}

fn judged(motion: &PiecewiseMotion, limits: &ProgramLimits) -> ProgramProof {
    prove_program(certified(), motion, &irb120(), limits, &CancelToken::new()).unwrap()
}

fn check(proof: &ProgramProof, requirement: Requirement) -> &Check {
    proof
        .checks
        .iter()
        .find(|check| check.requirement == requirement)
        .unwrap()
}

fn bound(proof: &ProgramProof, requirement: Requirement) -> f64 {
    check(proof, requirement).measure.unwrap().bound.unwrap()
}

/// The greatest distance of the tips at moments that no bound knows of.
fn sampled_m(motion: &PiecewiseMotion, plan: &Plan, moments: usize) -> f64 {
    let robot = irb120();
    let (planned, frame) = (plan.knots.motion().unwrap(), plan.job.workcell.tool.tip_frame(&robot));
    let tip = |q: &JointVector| robot.pose(q, &frame).translation.vector;
    let off = |i: usize| {
        let t = motion.duration_s() * (i as f64 + 0.37) / moments as f64;
        (tip(&motion.at(t).unwrap()[0]) - tip(&planned.at(t).unwrap().q)).norm()
    };
    (0..moments).map(off).fold(0.0, f64::max)
}

/// The first wash of a plan.
fn first_wash(plan: &Plan) -> &PlanSegment {
    plan.segments
        .iter()
        .find(|segment| segment.kind == SegmentKind::Wash)
        .unwrap()
}

#[test]
fn a_program_equal_to_its_plan_holds() {
    let plan = good();
    let motion = lines(&plan, 1, |_, q| q);
    let proof = judged(&motion, &LIMITS);
    assert!(proof.holds(), "{:?}", proof.broken().collect::<Vec<_>>());
    let certificate = certified().certificate();
    let least = |check: &Check| check.measure.unwrap().bound.unwrap();
    let own = certificate.check(Requirement::Clearance).map(least).unwrap();
    assert!((bound(&proof, Requirement::Clearance) - own).abs() < 1e-3);
    assert_eq!(proof.swept.len(), plan.order.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    /// The bound of the deviation is above every sample, and no more than the resolution above the worst.
    #[test]
    fn no_sample_exceeds_the_bound(every in 1..7_usize, size in 0.0..2e-4_f64, frequency in 0.5..20.0_f64, joint in 0..6_usize) {
        let plan = good();
        let shaken = |t: f64, mut q: JointVector| {
            q[joint] += size * (frequency * t).sin();
            q
        };
        let motion = lines(&plan, every, shaken);
        let limits = ProgramLimits { deviation_m: 1.0, ..LIMITS };
        let found = bound(&judged(&motion, &limits), Requirement::PlanDeviation);
        let sampled = sampled_m(&motion, &plan, 60_000);
        prop_assert!(sampled <= found && found <= sampled * 1.02 + 5.1e-3, "{sampled} {found}");
        let limits = ProgramLimits { deviation_m: sampled * 1.02 + 1e-6, ..LIMITS };
        let proof = judged(&motion, &limits);
        prop_assert_eq!(check(&proof, Requirement::PlanDeviation).status, Status::Proved);
        prop_assert!(sampled <= bound(&proof, Requirement::PlanDeviation));
        let limits = ProgramLimits { deviation_m: sampled * 0.98, ..LIMITS };
        prop_assert_eq!(check(&judged(&motion, &limits), Requirement::PlanDeviation).status, Status::Violated);
    }
}

#[test]
fn finds_a_bump_in_one_joint_at_its_time() {
    let plan = good();
    let wash = first_wash(&plan);
    let there = 0.5 * (wash.t_start_s + wash.t_end_s);
    let bumped = |t: f64, mut q: JointVector| {
        if (t - there).abs() < 0.03 {
            q[1] += 0.002;
        }
        q
    };
    let proof = judged(&lines(&plan, 1, bumped), &LIMITS);
    let off = check(&proof, Requirement::PlanDeviation);
    assert_eq!(off.status, Status::Violated);
    assert!((off.worst.time_s.unwrap() - there).abs() < 0.05, "{:?}", off.worst);
    assert_eq!(off.worst.segment.map(|(_, kind)| kind), Some(SegmentKind::Wash));
    // Half a millimetre down is more than plan and program may be off the face.
    assert_eq!(check(&proof, Requirement::ContactHeight).status, Status::Violated);
    // A tolerance of the path lets nobody wash without touching, nor at any tilt.
    let wide = ProgramLimits {
        deviation_m: 10.0,
        ..LIMITS
    };
    let proof = judged(&lines(&plan, 1, bumped), &wide);
    assert_eq!(check(&proof, Requirement::PlanDeviation).status, Status::Proved);
    assert_eq!(check(&proof, Requirement::ContactHeight).status, Status::Violated);
    assert_eq!(check(&proof, Requirement::Tilt).status, Status::Proved);
    let tilted = |t: f64, mut q: JointVector| {
        if (t - there).abs() < 0.1 {
            q[4] += 0.6;
        }
        q
    };
    let proof = judged(&lines(&plan, 1, tilted), &wide);
    assert_eq!(check(&proof, Requirement::Tilt).status, Status::Violated);
}

#[test]
fn a_program_without_a_wash_washes_nothing() {
    let plan = good();
    let wash = first_wash(&plan);
    let (from, to) = (wash.t_start_s, wash.t_end_s);
    let motion = plan.knots.motion().unwrap();
    let skipped = |t: f64, q: JointVector| {
        if t > from && t < to {
            let share = (t - from) / (to - from);
            let [a, b] = [from, to].map(|t| motion.at(t).unwrap().q);
            return a + (b - a) * share;
        }
        q
    };
    let proof = judged(
        &lines(&plan, 1, skipped),
        &ProgramLimits {
            deviation_m: 10.0,
            ..LIMITS
        },
    );
    assert_eq!(check(&proof, Requirement::Swept).status, Status::Violated);
    assert!(proof.swept.iter().any(|plate| plate.at_least < 0.6));
}

#[test]
fn finds_joints_beyond_their_limits() {
    let plan = good();
    let proof = judged(
        &lines(&plan, 1, |_, q| q),
        &ProgramLimits {
            joint_speed_share: 1e-3,
            ..LIMITS
        },
    );
    assert_eq!(check(&proof, Requirement::JointSpeed).status, Status::Violated);
    // At a share of the speed as small as the share of the limit it holds again, in the time of the program.
    let slow = ProgramLimits {
        joint_speed_share: 0.95e-3,
        speed_share: 1e-3,
        ..LIMITS
    };
    let proof = judged(&lines(&plan, 1, |_, q| q), &slow);
    let speed = check(&proof, Requirement::JointSpeed);
    assert_eq!(speed.status, Status::Proved);
    let limit = speed.measure.unwrap().limit;
    assert!(
        irb120()
            .limits()
            .velocity
            .iter()
            .any(|v| (v * 0.95e-3 - limit).abs() < 1e-12),
        "{limit}"
    );
    let far = lines(&plan, 1, |_, mut q| {
        q[0] += 3.0;
        q
    });
    assert_eq!(
        check(&judged(&far, &LIMITS), Requirement::JointPosition).status,
        Status::Violated
    );
}

#[test]
fn finds_a_program_that_passes_through_a_body() {
    let plan = good();
    let through = |t: f64, mut q: JointVector| {
        if t > 0.2 && t < 0.4 {
            q[1] += 1.2;
        }
        q
    };
    let proof = judged(
        &lines(&plan, 1, through),
        &ProgramLimits {
            deviation_m: 10.0,
            ..LIMITS
        },
    );
    assert_eq!(check(&proof, Requirement::Clearance).status, Status::Violated);
}

/// A motion that ends early rests where it is; one that ends late is compared with the plan's rest.
#[test]
fn a_motion_may_be_shorter_or_longer_than_the_plan() {
    let plan = good();
    let whole = lines(&plan, 1, |_, q| q);
    let half: Vec<_> = whole.pieces().iter().copied().take(whole.pieces().len() / 2).collect();
    let proof = judged(&PiecewiseMotion::new(half).unwrap(), &LIMITS);
    assert_eq!(check(&proof, Requirement::PlanDeviation).status, Status::Violated);
    assert_eq!(check(&proof, Requirement::Swept).status, Status::Violated);
    let longer = whole.clone().resting_until(plan.duration_s() + 1.0);
    assert!(judged(&longer, &LIMITS).holds());
    let slower = whole.stretched(1.01);
    assert_eq!(
        check(&judged(&slower, &LIMITS), Requirement::PlanDeviation).status,
        Status::Violated
    );
}

#[test]
fn rejects_an_empty_motion() {
    let nothing = PiecewiseMotion::new(Vec::new()).unwrap();
    let judged = prove_program(certified(), &nothing, &irb120(), &LIMITS, &CancelToken::new());
    assert!(judged.is_err());
    let given_up = CancelToken::new();
    given_up.cancel();
    let motion = lines(&good(), 1, |_, q| q);
    assert!(prove_program(certified(), &motion, &irb120(), &LIMITS, &given_up).is_err());
}
