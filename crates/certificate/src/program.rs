//! A motion that a controller is assumed to make of a certified plan: judged again, as the motion that it is.
//!
//! Such a motion is near the plan and not the plan: it is straight between points, its corners are rounded, its speed may jump. What is
//! proved of it, at every moment: where the tip is, against the plan; joint positions and speeds; clearance of every pair; contact with
//! each plate, and the share of it that is swept. Accelerations and rest are the controller's to time: what the motion implies of them is
//! measured and nothing is proved of it.

use crate::certified::Certified;
use crate::check::{Check, Status, Unit};
use crate::clearances::{self, PairBound, Work};
use crate::deviation;
use crate::error::ProveError;
use crate::exclusions::Exclusions;
use crate::joints;
use crate::piece::{self, Piece};
use crate::prove;
use crate::requirement::Requirement;
use crate::schedule::Schedule;
use crate::subject::Subject;
use crate::swept::{self, PlateCoverage};
use crate::tip::Arm;
use crate::tip_limits::{self, Tips};
use crate::wash_paths;
use crate::world::World;
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::PATH_TOLERANCE_M;
use platewash_workcell::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_workcell::plan::Plan;

/// What a program's motion must keep, besides what its plan's job requires.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramLimits {
    /// How far the tip may be from where the plan has it at that time \[m\].
    pub deviation_m: f64,
    /// Share of the arm's joint speeds that may be used.
    pub joint_speed_share: f64,
    /// Share of the plan's speed at which the program runs, above 0 and at most 1. The motion is given in the plan's time; only speeds
    /// depend on it.
    pub speed_share: f64,
}

/// What is proved of a program's motion.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramProof {
    /// What it must keep: joint positions and speeds, contact height, deviation from the plan, clearance, coverage, tilt.
    pub checks: Vec<Check>,
    /// What it implies besides, in the plan's time, beside the limits of the plan: speed of the tip. Not required of it.
    pub implied: Vec<Check>,
    /// Coverage, plate by plate in the order of washing.
    pub swept: Vec<PlateCoverage>,
    /// Clearance, pair by pair and rule by rule.
    pub clearance: Vec<PairBound>,
}

/// How near two times are one \[s\]: programs state times in microseconds.
const NEAR_S: f64 = 2e-6;

/// How far a program may tilt the tool beyond what the plan may \[rad\]: what a deviation within the tolerance turns it by.
const TILT_RAD: f64 = 0.01;

/// What the height over a plate may be off the plan's at most, however far the tip may be from the plan along the face \[m\].
const CONTACT_M: f64 = 2e-4;

impl ProgramProof {
    /// Whether everything that the motion must keep is kept.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.checks.iter().all(|check| check.status.is_kept())
    }

    /// What is violated or not proved.
    pub fn broken(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.status.is_kept())
    }
}

/// Judges a motion against a certified plan of an arm. Motion and plan are compared at the same times; where one ends before the other, it
/// rests.
///
/// # Errors
/// [`ProveError`] for a motion that cannot be judged, and when it is given up.
pub fn prove_program(
    certified: &Certified<Plan>,
    motion: &PiecewiseMotion,
    arm: &RobotModel,
    limits: &ProgramLimits,
    cancel: &CancelToken,
) -> Result<ProgramProof, ProveError> {
    let world = World::of(&certified.plan().job.workcell.mount);
    let plan = &*certified.plan().seen_from_base();
    let ends_s = plan.segments.iter().map(|segment| segment.t_end_s);
    let motion = motion.clone().resting_until(plan.duration_s()).cut_at(ends_s, NEAR_S);
    let pieces: Vec<Piece> = motion.pieces().iter().map(Piece::from).collect();
    let planned = planned(plan, motion.duration_s())?;
    let timeline = prove::timeline(&pieces, pieces.len())?;
    let ends_s: Vec<_> = pieces.iter().map(|piece| piece.start_s + piece.length_s).collect();
    let schedule = Schedule::along(plan, &ends_s, NEAR_S);

    let mut subject = Subject::new(&plan.job, arm, wash_paths::by_plate(plan));
    // Speeds are those of the plan's time: what is left of a limit at a share of the speed is more.
    subject.limits.tilt_rad += TILT_RAD;
    subject.limits.speed_rad_s *= limits.joint_speed_share / limits.speed_share;
    let tip = Arm::new(arm, &plan.job.workcell.tool, cancel);
    let tips = Tips::new(&tip, &subject, &pieces, Some(&schedule));
    let [position, speed, _] = joints::checks(&pieces, &subject.limits, Some(&schedule));
    let rates = tips.checks(&subject, &pieces, Some(&schedule));
    let (tilt, rates): (Vec<_>, _) = rates
        .into_iter()
        .partition(|check| check.requirement == Requirement::Tilt);
    let washes = swept::washes(&tip, &subject, (&pieces, &schedule), &tips, cancel)?;
    let swept: Vec<_> = washes.into_iter().map(|wash| wash.swept).collect();

    let exclusions = Exclusions::of(&subject)?;
    let model = exclusions.model(&subject)?;
    let waived = exclusions.waived_in(&model);
    let work = Work::Scheduled(&schedule);
    let mut clearance = clearances::judge(&subject, (&model, &waived), &timeline, work, cancel)?;
    let judged = deviation::check(&tip, (&pieces, &schedule), &planned, limits.deviation_m);
    let mut checks = vec![
        position,
        in_program_time(speed, limits.speed_share),
        contact(&tips, &pieces, &schedule, limits.deviation_m),
        judged,
        clearances::check(subject.limits.clearance_m, &clearance),
        swept::check(&subject, &swept),
    ];
    // A tip is where it should be at any tilt, and the sponge is not.
    checks.extend(tilt);
    cancel.check()?;
    world.tell_checks(&mut checks);
    world.tell_pairs(&mut clearance);
    let is_implied = |check: &Check| {
        use Requirement::{TipSpeed, WashSpeed};
        matches!(check.requirement, TipSpeed | WashSpeed)
    };
    Ok(ProgramProof {
        checks,
        implied: rates.into_iter().filter(is_implied).collect(),
        swept,
        clearance,
    })
}

/// The pieces of a plan, and its rest at the end until a time \[s\] that is later.
fn planned(plan: &Plan, end_s: f64) -> Result<Vec<Piece>, ProveError> {
    let mut pieces = piece::pieces(&plan.knots)?;
    let (from, there) = (plan.duration_s(), plan.knots.q_rad.last());
    if let Some(there) = there.filter(|_| end_s > from) {
        pieces.push(Piece::from(&MotionPiece::line([from, end_s], [*there; 2])));
    }
    Ok(pieces)
}

/// A check of speeds in the time of a program that runs at a share of the plan's speed.
fn in_program_time(mut check: Check, speed_share: f64) -> Check {
    if let Some(measure) = &mut check.measure {
        measure.limit *= speed_share;
        measure.bound = measure.bound.map(|v| v * speed_share);
        measure.seen = measure.seen.map(|v| v * speed_share);
    }
    check
}

/// Height of the tip over or under the face while it washes: what the plan may have, and what the program may deviate by, but no more than
/// [`CONTACT_M`], or what is swept would not be touched.
fn contact(tips: &Tips, pieces: &[Piece], schedule: &Schedule, deviation_m: f64) -> Check {
    let height = tip_limits::greatest(&tips.height);
    let worst = tip_limits::worst(&height, pieces, Some(schedule));
    let limit = (PATH_TOLERANCE_M + deviation_m.min(CONTACT_M), Unit::Metre);
    let check = tip_limits::check(Requirement::ContactHeight, &height, limit, worst);
    if tips.height.is_empty() {
        return Check {
            status: Status::NotProved,
            ..check
        };
    }
    check
}
