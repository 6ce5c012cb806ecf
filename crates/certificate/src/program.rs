//! Judgement of the motion that a controller is assumed to make of a certified plan.
//!
//! Requirement 34, formula (34.1) in `docs/certificate.md`.
//!
//! Such a motion is near the plan and not the plan: it is straight between points, its corners are rounded, its speed may jump. What is
//! proved of it, at every moment: where the tip is, against the plan; joint positions and speeds; clearance of every pair; contact with
//! each plate, and the share of it that is swept. Accelerations and rest are the controller's to time: what the motion implies of them is
//! measured and nothing is proved of it.
//!
//! The deviation compares the tips of two motions at the same times.
//!
//! Over a stretch in which each motion is one cubic, the deviation e = p₁ − p₂ keeps ‖e‖ ≤ max(‖e(a)‖, ‖e(b)‖) + h²/8 (sup ‖p̈₁‖ + sup ‖p̈₂‖)
//! (`motion/tip.rs`), which halving makes as tight as is needed.

use crate::certified::Certified;
use crate::clearance::exclusions::Exclusions;
use crate::clearance::pairs::{self, PairBound};
use crate::error::ProveError;
use crate::judged_job::JudgedJob;
use crate::motion::bound_tracker::BoundTracker;
use crate::motion::joints;
use crate::motion::piece::{self, Piece};
use crate::motion::tip::{Arm, Stretch, TipPiece};
use crate::motion::tip_limits::{self, Tips};
use crate::plan_statements::schedule::Schedule;
use crate::plan_statements::wash_paths;
use crate::prove;
use crate::report::certificate::World;
use crate::report::check::{Check, Status};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use crate::washing::coverage;
use crate::washing::plate_coverage::PlateCoverage;
use platewash_kinematics::RobotModel;
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_motion::plan::Plan;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::PATH_TOLERANCE_M;

/// Limits for a program's motion, in addition to the requirements of its plan's job.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramLimits {
    /// Greatest distance of the tip from its position in the plan at the same time \[m\].
    pub deviation_m: f64,
    /// Share of the arm's joint speeds that may be used, 0 to 1.
    pub joint_speed_share: f64,
    /// Share of the plan's speed at which the program runs, above 0 and at most 1. The motion is given in the plan's time; only speeds
    /// depend on it.
    pub speed_share: f64,
}

/// Proof about a program's motion.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramProof {
    /// Checks that the motion must keep: joint position, joint speed, contact height, plan deviation, clearance, swept, tilt.
    pub checks: Vec<Check>,
    /// Speed of the tip that the motion implies, in the plan's time, beside the limit of the plan. It is reported and not required.
    pub implied: Vec<Check>,
    /// Coverage, plate by plate in the order of washing.
    pub swept: Vec<PlateCoverage>,
    /// Clearance of each pair under each rule.
    pub clearance: Vec<PairBound>,
}

/// Greatest difference between two times that count as equal \[s\]: programs state times in microseconds.
const NEAR_S: f64 = 2e-6;

/// Tilt allowed to a program beyond that of the plan \[rad\]: a deviation within the tolerance may turn the tool by as much.
const TILT_RAD: f64 = 0.01;

/// Greatest difference between the tip's height over a plate and that of the plan \[m\], even where the deviation along the face may be
/// larger.
const CONTACT_M: f64 = 2e-4;

impl ProgramProof {
    /// True if the motion keeps every check.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.checks.iter().all(|check| check.status.is_kept())
    }

    /// Returns the checks that are violated or not proved.
    pub fn broken(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.status.is_kept())
    }
}

/// Judges a motion against a certified plan of an arm. Motion and plan are compared at the same times; the one that ends first is taken to
/// rest from then on.
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
    let world = World::from_mount(&certified.plan().job.workcell.mount);
    let plan = &*certified.plan().seen_from_base();
    let ends_s = plan.segments.iter().map(|segment| segment.t_end_s);
    let motion = motion.clone().resting_until(plan.duration_s()).cut_at(ends_s, NEAR_S);
    let pieces: Vec<Piece> = motion.pieces().iter().map(Piece::from).collect();
    let planned = planned(plan, motion.duration_s())?;
    let timeline = prove::timeline(&pieces, pieces.len())?;
    let ends_s: Vec<_> = pieces.iter().map(|piece| piece.start_s + piece.length_s).collect();
    let schedule = Schedule::along(plan, &ends_s, NEAR_S);

    let mut judged = JudgedJob::new(&plan.job, arm, wash_paths::by_plate(plan));
    // Speeds are those of the plan's time: what is left of a limit at a share of the speed is more.
    judged.tilt_rad += TILT_RAD;
    judged.joints.speed_rad_s *= limits.joint_speed_share / limits.speed_share;
    let tip = Arm::new(arm, &plan.job.workcell.tool, cancel);
    let along = tip.along(&pieces);
    let tips = Tips::new(&tip, &judged, &along, Some(&schedule));
    let [position, speed, _] = joints::checks(&pieces, &judged.joints, Some(&schedule));
    let rates = tips.checks(&judged, &pieces, Some(&schedule));
    let (tilt, rates): (Vec<_>, _) = rates
        .into_iter()
        .partition(|check| check.requirement == Requirement::Tilt);
    let washes = coverage::washes(&tip, &judged, &along, &schedule, &tips, cancel)?;
    let swept: Vec<_> = washes.into_iter().map(|wash| wash.swept).collect();

    let exclusions = Exclusions::find(&judged)?;
    let model = exclusions.model(&judged)?;
    let waived = exclusions.waived_in(&model);
    let mut clearance = pairs::judge(&judged, &model, &waived, &timeline, Some(&schedule), cancel)?;
    let deviation = check(&tip, &pieces, &schedule, &planned, limits.deviation_m);
    let mut checks = vec![
        position,
        in_program_time(speed, limits.speed_share),
        contact(&tips, &pieces, &schedule, limits.deviation_m),
        deviation,
    ];
    checks.extend(pairs::checks(judged.job.requirements.clearance_m, &clearance));
    checks.push(coverage::check(&judged, &swept));
    // A tip is where it should be at any tilt, and the sponge is not.
    checks.extend(tilt);
    checks.retain(|check| judged.asks_for(check.requirement));
    cancel.check()?;
    world.move_to_world(&mut checks, &mut clearance, &mut []);
    let is_implied = |check: &Check| {
        let is_of_tip = matches!(check.requirement, Requirement::TipSpeed | Requirement::WashSpeed);
        is_of_tip && judged.asks_for(check.requirement)
    };
    Ok(ProgramProof {
        checks,
        implied: rates.into_iter().filter(is_implied).collect(),
        swept,
        clearance,
    })
}

/// Returns the pieces of a plan, with a rest at its end until `end_s` \[s\], if that is later.
fn planned(plan: &Plan, end_s: f64) -> Result<Vec<Piece>, ProveError> {
    let mut pieces = piece::pieces(&plan.knots)?;
    let (from, there) = (plan.duration_s(), plan.knots.q_rad.last());
    if let Some(there) = there.filter(|_| end_s > from) {
        pieces.push(Piece::from(&MotionPiece::line([from, end_s], [*there; 2])));
    }
    Ok(pieces)
}

/// Converts a check of speeds to the time of a program that runs at a share of the plan's speed.
fn in_program_time(mut check: Check, speed_share: f64) -> Check {
    if let Some(measure) = &mut check.measure {
        measure.limit *= speed_share;
        measure.bound = measure.bound.map(|v| v * speed_share);
        measure.seen = measure.seen.map(|v| v * speed_share);
    }
    check
}

/// Checks the height of the tip over or under the face while it washes: the plan's tolerance plus the deviation of the program, but at most
/// [`CONTACT_M`] more. Beyond that the swept area would not be touched.
fn contact(tips: &Tips, pieces: &[Piece], schedule: &Schedule, deviation_m: f64) -> Check {
    let height = tip_limits::greatest(&tips.height);
    let worst = tip_limits::worst_case(&height, pieces, Some(schedule));
    let limit_m = PATH_TOLERANCE_M + deviation_m.min(CONTACT_M);
    let check = tip_limits::check(Requirement::ContactHeight, &height, limit_m, Unit::Metre, worst);
    if tips.height.is_empty() {
        return Check {
            status: Status::NotProved,
            ..check
        };
    }
    check
}

/// Gap allowed between the bound and the greatest deviation found, as a part of the tolerance.
const RESOLUTION: f64 = 5e-3;

/// Same stretch of time in both motions.
struct StretchPair<'a> {
    motion: Stretch<'a>,
    plan: Stretch<'a>,
}

impl<'a> StretchPair<'a> {
    const fn new([motion, plan]: [Stretch<'a>; 2]) -> Self {
        Self { motion, plan }
    }

    /// Deviation ‖p₁ − p₂‖ at both ends \[m\].
    fn ends_m(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.motion.ends[k].position - self.plan.ends[k].position).norm())
    }
}

/// Checks ‖p₁ − p₂‖, the deviation of the tip of a motion from that of a plan, for as long as both last, against a tolerance \[m\]: formula (34.1).
/// Segments are those of the motion.
pub(crate) fn check(arm: &Arm<'_>, motion: &[Piece], schedule: &Schedule, plan: &[Piece], tolerance_m: f64) -> Check {
    let mut tracker = BoundTracker::new(tolerance_m, RESOLUTION * tolerance_m);
    let parts = common(arm, motion, plan);
    let stretches: Vec<_> = parts
        .iter()
        .map(|parts| StretchPair::new(parts.each_ref().map(TipPiece::stretch)))
        .collect();
    tracker.allow_for(stretches.len());
    for both in &stretches {
        for (k, deviation_m) in both.ends_m().into_iter().enumerate() {
            tracker.see(deviation_m, both.motion.times()[k], both.motion.ends[k]);
        }
    }
    stretches.iter().for_each(|both| refine(arm, both, &mut tracker, 0));
    let worst = tip_limits::worst_case(&tracker, motion, Some(schedule));
    tip_limits::check(Requirement::PlanDeviation, &tracker, tolerance_m, Unit::Metre, worst)
}

/// Returns the parts of both motions for the stretches of time in which each is one cubic.
fn common<'a>(arm: &Arm<'_>, motion: &'a [Piece], plan: &'a [Piece]) -> Vec<[TipPiece<'a>; 2]> {
    let mut all = Vec::with_capacity(motion.len() + plan.len());
    let (mut i, mut j, mut from) = (0, 0, 0.0_f64);
    while let (Some(a), Some(b)) = (motion.get(i), plan.get(j)) {
        let ends = [a, b].map(|piece| piece.start_s + piece.length_s);
        let to = ends[0].min(ends[1]);
        // A difference of rounding between two equal ends is no stretch.
        let within = |piece: &Piece| [from, to].map(|t| (t - piece.start_s).clamp(0.0, piece.length_s));
        if to > from {
            all.push([a, b].map(|piece| arm.part(piece, within(piece))));
        }
        from = from.max(to);
        i += usize::from(ends[0] <= to);
        j += usize::from(ends[1] <= to);
    }
    all
}

/// Bounds ‖p₁ − p₂‖ over a stretch by formula (34.1) and, where needed, over its halves.
fn refine(arm: &Arm<'_>, both: &StretchPair<'_>, tracker: &mut BoundTracker, depth: u32) {
    let [from, to] = both.ends_m();
    let greater = if from > to || from.is_nan() { from } else { to };
    let sag = |stretch: &Stretch<'_>| stretch.sag(arm.derivatives(stretch).second());
    let bound = greater + sag(&both.motion) + sag(&both.plan);
    if tracker.accepts(bound) || !tracker.may_split(depth) {
        return tracker.take(bound);
    }
    let Some((motion, plan)) = arm.halves(&both.motion).zip(arm.halves(&both.plan)) else {
        return tracker.take(bound);
    };
    let (motion, plan) = (motion.both(), plan.both());
    let halves = [0, 1].map(|k| StretchPair::new([motion[k], plan[k]]));
    let [_, middle_m] = halves[0].ends_m();
    tracker.see(middle_m, halves[0].motion.times()[1], halves[0].motion.ends[1]);
    halves.iter().for_each(|half| refine(arm, half, tracker, depth + 1));
}
