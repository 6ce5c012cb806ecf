//! Judgement of a motion of an arm alone: no plates, no sponge, no job. Any planner may have made it.
//!
//! Requirements 12–14 and 24 of `docs/certificate.md`. The motion is made of cubics and quintics that meet in position, not necessarily in speed: a jump
//! of speed is part of the bound of the clearance (24.3), and no acceleration limit holds where a speed jumps.

use crate::clearance::exclusions::{bodies_named_twice, bodies_without_shape};
use crate::clearance::pairs::{self, PairBound, PairRule};
use crate::error::ProveError;
use crate::judged_job::{self, JointLimits};
use crate::motion::joints;
use crate::motion::piece::Piece;
use crate::prove::{long_enough, timeline};
use crate::report::certificate::World;
use crate::report::check::{Check, Measure, Sense, Status, WorstCase};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use platewash_bodies::assembly;
use platewash_bodies::clearance::{ClearanceModel, FixedOverlap, standing_overlaps};
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::TermsError;
use platewash_workcell::job::check_workcell;
use platewash_workcell::{Exclusion, ExclusionReason, Workcell, is_pair};

/// Rules that a motion of an arm must keep, besides the limits of the arm's description.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionRules {
    /// Required clearance of every pair of bodies \[m\], 0 to 1. With 0 the bodies must not touch.
    pub clearance_m: f64,
    /// Greatest joint accelerations \[rad/s²\]; `None` to judge only those that the arm's description limits, and these only in a motion
    /// whose speeds do not jump.
    pub acceleration_rad_s2: Option<JointVector>,
    /// True if the arm rests before the motion and after it: a speed at either end is a jump, and no acceleration limit holds.
    pub rests_outside: bool,
    /// Meaning of the motion's times.
    pub timing: Timing,
}

/// Meaning of the times of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Timing {
    /// The arm moves at these times. Speeds are judged.
    Stated,
    /// The times only order the positions. Neither speeds nor accelerations are judged; positions and clearance hold for any timing.
    Free,
}

/// Error of the length of a piece as a part of the time at its end: each of two times is rounded when it is read and when it is counted from
/// the first.
const TIME_ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Proof about a motion of an arm.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmMotionProof {
    /// Checks of joint positions, of joint speeds unless the timing is free, of joint accelerations where they are limited and can be judged
    /// ([`MotionRules::acceleration_rad_s2`]), and of the clearance.
    pub checks: Vec<Check>,
    /// Clearance of each pair.
    pub clearance: Vec<PairBound>,
    /// Pairs of bodies that no moment need be judged for, with the reason of each. Of those that do not move, none overlap.
    pub excluded: Vec<Exclusion>,
    /// Pairs of links that the SRDF leaves out and that meet in this motion, although they share no joint, do not touch in every
    /// configuration, and the SRDF does not say that they touch by default; each with a moment at which they do \[s\].
    pub disabled_meeting: Vec<([String; 2], f64)>,
    /// Obstacles that reach into the base. None may, and each has a line in the clearance.
    pub in_base: Vec<FixedOverlap>,
    /// Names of the links of the arm that keep clear of nothing, as neither they nor the links that move with them have a shape.
    pub shapeless: Vec<String>,
    /// Least distance at the knots of the motion \[m\], where the clearance is violated: a check of these alone finds no less.
    pub least_at_knots_m: Option<f64>,
}

impl ArmMotionProof {
    /// Returns the status of the whole: violated if a check is, not proved if a check is not proved or a link has no shape.
    #[must_use]
    pub fn status(&self) -> Status {
        let has = |status| self.checks.iter().any(|check| check.status == status);
        if has(Status::Violated) {
            Status::Violated
        } else if has(Status::Proved)
            && self.checks.iter().all(|check| check.status.is_kept())
            && self.shapeless.is_empty()
        {
            Status::Proved
        } else {
            Status::NotProved
        }
    }

    /// Returns the check of a requirement, if it was judged.
    #[must_use]
    pub fn check(&self, requirement: Requirement) -> Option<&Check> {
        self.checks.iter().find(|check| check.requirement == requirement)
    }
}

/// Judges a motion of an arm in a workcell: joint limits, and the clearance of every pair of bodies at all times. Pairs that follow from
/// the arm, its SRDF and the tool are left out; exclusions that the workcell states are ignored.
///
/// ```
/// use platewash_bodies::assembly;
/// use platewash_certificate::{MotionRules, Status, Timing, prove_arm_motion};
/// use platewash_kinematics::{JointVector, Pose, RobotModel};
/// use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
/// use platewash_workcell::cancel::CancelToken;
///
/// let arm = RobotModel::irb120()?;
/// let cell = assembly::workcell_without_tool(&arm, Pose::identity(), Vec::new())?;
/// let ends = [JointVector::zeros(), JointVector::repeat(0.5)];
/// let motion = PiecewiseMotion::new(vec![MotionPiece::line([0.0, 1.0], ends)])?;
/// let rules = MotionRules { clearance_m: 0.005, acceleration_rad_s2: None, rests_outside: false, timing: Timing::Stated };
/// let proof = prove_arm_motion(&motion, &cell, &arm, &rules, &CancelToken::new())?;
/// assert_eq!(proof.status(), Status::Proved);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ProveError`] for a motion, a workcell or rules that cannot be judged, and when it is given up. A motion that breaks a rule is no error.
pub fn prove_arm_motion(
    motion: &PiecewiseMotion,
    workcell: &Workcell,
    arm: &RobotModel,
    rules: &MotionRules,
    cancel: &CancelToken,
) -> Result<ArmMotionProof, ProveError> {
    check_rules(rules)?;
    check_workcell(workcell, 0).map_err(ProveError::Rules)?;
    judged_job::check(workcell)?;
    if let Some(name) = bodies_named_twice(arm, workcell, 0).into_iter().next() {
        return Err(ProveError::NameTwice { name });
    }
    let world = World::from_mount(&workcell.mount);
    let seen = workcell.seen_from_base().into_owned();
    let excluded = assembly::own_exclusions(&seen, arm)?;
    // Pairs that should not meet are looked at, too.
    let (suspects, others): (Vec<_>, Vec<_>) = excluded.iter().cloned().partition(|pair| may_not_meet(arm, pair));
    let seen = Workcell {
        exclusions: others,
        ..seen
    };
    let model = ClearanceModel::new(arm, &seen, &[])?;
    let is_suspect = |(_, pair): &(usize, (&str, &str))| suspects.iter().any(|other| is_pair(&other.pair, *pair));
    let (watched, judged): (Vec<_>, Vec<_>) = model.pair_names().into_iter().enumerate().partition(is_suspect);
    let [watched, judged] = [watched, judged].map(|all| all.into_iter().map(|(index, _)| index).collect::<Vec<_>>());
    let piece = |piece: &MotionPiece| Piece::from(piece).with_length_within(TIME_ROUNDING * piece.t_s[1]);
    let pieces = long_enough(motion.pieces().iter().map(piece).collect())?;
    let timeline = timeline(&pieces, pieces.len())?;
    let mut clearance = pairs::judge_some(arm, rules.clearance_m, &model, &judged, &timeline, cancel)?;
    let disabled_meeting = pairs::meeting(arm, &model, &watched, &timeline, cancel)?;
    clearance.extend(pairs::judge_still(rules.clearance_m, &model));
    let standing = standing_overlaps(arm, &seen, &[], None)?;
    clearance.extend(standing.iter().map(reaching));
    cancel.check()?;
    let mut checks = joint_checks(arm, &pieces, rules);
    checks.extend(pairs::checks(rules.clearance_m, &clearance));
    let is_violated = checks.last().is_some_and(|check| check.status == Status::Violated);
    let least_at_knots_m = if is_violated {
        let judged = Workcell {
            exclusions: excluded.clone(),
            ..seen.clone()
        };
        let at_knots_m = least_at_knots_m(&ClearanceModel::new(arm, &judged, &[])?, motion.pieces());
        // Pairs that no joint moves apart are as near there as elsewhere.
        let still_m = model.still_pairs().into_iter().map(|still| still.pair.distance_m);
        let all_m = at_knots_m
            .into_iter()
            .chain(still_m)
            .chain(standing.iter().map(|overlap| -overlap.by_m));
        all_m.min_by(f64::total_cmp)
    } else {
        None
    };
    let excluded = excluded.into_iter();
    let not_judged = excluded.filter(|left_out| !clearance.iter().any(|line| is_pair_of(left_out, line)));
    let excluded = not_judged.collect();
    world.move_to_world(&mut checks, &mut clearance, &mut []);
    Ok(ArmMotionProof {
        checks,
        clearance,
        excluded,
        disabled_meeting,
        in_base: standing,
        shapeless: bodies_without_shape(arm)
            .into_iter()
            .flatten()
            .map(str::to_owned)
            .collect(),
        least_at_knots_m,
    })
}

/// Reasons of an SRDF for pairs that touch by the shapes of their links, as MoveIt's assistant writes them.
const TOUCHING: [&str; 3] = ["Adjacent", "Default", "Always"];

/// True for a pair of links that the SRDF leaves out although nothing tells that they touch by design.
fn may_not_meet(arm: &RobotModel, Exclusion { pair: [a, b], reason }: &Exclusion) -> bool {
    let stated = arm.disabled_pairs().and_then(|disabled| disabled.reason(a, b));
    *reason == ExclusionReason::Srdf
        && !arm.share_a_joint(a, b)
        && stated.is_some_and(|stated| !TOUCHING.contains(&stated))
}

/// Returns the line of an obstacle that reaches into the base.
fn reaching(FixedOverlap { body, other, by_m }: &FixedOverlap) -> PairBound {
    PairBound {
        pair: [other.clone(), body.name()],
        rule: PairRule::Clearance,
        working_on: Vec::new(),
        required_m: None,
        status: Status::Violated,
        at_least_m: Some(-by_m),
        seen_m: Some(-by_m),
        time_s: Some(0.0),
        place_m: None,
    }
}

/// Checks that the rules are numbers to compare with.
fn check_rules(rules: &MotionRules) -> Result<(), ProveError> {
    let refused = |name, expected: &str, found| {
        let expected = expected.to_owned();
        Err(ProveError::Rules(TermsError::Number { name, expected, found }))
    };
    if !(0.0..=1.0).contains(&rules.clearance_m) {
        return refused("the required clearance", "from 0 to 1 m", rules.clearance_m);
    }
    let stated = rules.acceleration_rad_s2.iter().flatten().copied();
    match stated.into_iter().find(|limit| !(*limit > 0.0 && limit.is_finite())) {
        Some(found) => refused("an acceleration limit", "finite and above 0", found),
        None => Ok(()),
    }
}

/// Checks positions, speeds and accelerations, as far as the rules ask for them.
fn joint_checks(arm: &RobotModel, pieces: &[Piece], rules: &MotionRules) -> Vec<Check> {
    let stated = rules.acceleration_rad_s2.filter(|_| rules.timing == Timing::Stated);
    let limits = JointLimits::new(arm, stated.unwrap_or_else(|| JointVector::repeat(f64::INFINITY)));
    let accelerations = limits.acceleration_rad_s2;
    let is_limited = rules.timing == Timing::Stated && accelerations.iter().any(|limit| limit.is_finite());
    let [position, speed, acceleration] = joints::checks(pieces, &limits, None);
    let mut checks = vec![position];
    if rules.timing == Timing::Stated {
        checks.push(speed);
    }
    if is_limited {
        match jump(pieces, &accelerations, rules.rests_outside) {
            Some(jump) if stated.is_some() => checks.push(jump),
            // Where speeds jump, the description's limits can be broken, not kept.
            Some(_) => checks.extend(Some(acceleration).filter(|check| check.status == Status::Violated)),
            None => checks.push(acceleration),
        }
    }
    checks
}

/// Returns the violated check of accelerations at the first knot where the speed of a joint with an acceleration limit jumps by more than its
/// rounding, if there is one. Where the arm rests outside of the motion, the ends count, too.
fn jump(pieces: &[Piece], limits: &JointVector, rests_outside: bool) -> Option<Check> {
    let inside = pieces.windows(2).map(|pair| {
        let rounding = pair[0].rounding().speed + pair[1].rounding().speed;
        (pair[1].start_s, pair[0].jump_to(&pair[1]), rounding)
    });
    let outside = |piece: Option<&Piece>, end: usize| {
        let piece = piece.filter(|_| rests_outside)?;
        let time_s = piece.start_s + if end == 0 { 0.0 } else { piece.length_s };
        Some((time_s, piece.end_speeds()[end].abs(), piece.rounding().speed))
    };
    let jumps = outside(pieces.first(), 0)
        .into_iter()
        .chain(inside)
        .chain(outside(pieces.last(), 1));
    let mut jumps = jumps.map(|(time_s, by, rounding)| {
        let joint = (0..AXES).find(|&joint| limits[joint].is_finite() && by[joint] > rounding[joint])?;
        let worst = WorstCase {
            time_s: Some(time_s),
            joint: Some(joint),
            ..WorstCase::default()
        };
        let measure = Measure::new(Sense::AtMost, limits[joint], Unit::RadianPerSecondSquared, [None; 2]);
        Some(Check {
            status: Status::Violated,
            ..Check::measured(Requirement::JointAcceleration, measure, worst)
        })
    });
    jumps.find_map(|jump| jump)
}

/// True if a line is of the two bodies of an exclusion.
fn is_pair_of(excluded: &Exclusion, PairBound { pair: [a, b], .. }: &PairBound) -> bool {
    is_pair(&excluded.pair, (a, b))
}

/// Least distance over all pairs at the ends of the pieces \[m\].
fn least_at_knots_m(model: &ClearanceModel, pieces: &[MotionPiece]) -> Option<f64> {
    let first = pieces.iter().take(1).map(|piece| piece.q_rad[0]);
    let knots = first.chain(pieces.iter().map(|piece| piece.q_rad[1]));
    let distances = knots.filter_map(|q| Some(model.smallest(&q, &[])?.distance_m));
    distances.min_by(f64::total_cmp)
}
