//! Proof of a program that was read back: of its motion under each assumption about corners.
//!
//! Assumed motion of an arm along a program: straight in the joints with rounded corners, or on cubics.
//!
//! At a corner between segments of the speeds v₀ and v₁ the joints are assumed to accelerate evenly, for as long before the point as after
//! it: a parabola that leaves the straight segments where the corner begins and meets them again where it ends. A corner begins no farther
//! from the point than its radius, nor than half-way to either neighbour, measured at the tip. The true size on a controller is
//! not known: programs are judged with no corners, and with corners of half, once and twice their size.

use crate::reading::{ReadPoint, Reading, SegmentShape};
use crate::refusal::Refusal;
use platewash_certificate::{
    Certified, Check, Measure, ProgramLimits, ProgramProof, ProveError, Requirement, Sense, prove_program,
};
use platewash_kinematics::{AXES, Frame, JointVector, RobotModel};
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::KnotError;
use platewash_workcell::cancel::CancelToken;
use serde::Serialize;

/// Share of the arm's joint speeds that a program may use: the rest is left for the controller to keep its time.
pub const JOINT_SPEED_SHARE: f64 = 0.95;

/// Judgement of a program.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramJudgement {
    /// Judgements under each assumption, in the order of [`CORNER_SCALES`] where there are corners.
    pub cases: Vec<Case>,
}

/// Judgement of a program under one assumption.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// Size of its corners relative to the program's text; `None` where it has none.
    pub corner_scale: Option<f64>,
    /// Proof of the motion.
    #[serde(skip)]
    pub proof: ProgramProof,
    /// Demands on the controller.
    #[serde(flatten)]
    pub demands: ControllerDemands,
}

/// Demands of a motion on the controller, which times it: measured, not judged.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ControllerDemands {
    /// The greatest acceleration of a joint at each corner, as a share of the limit of the plan's job: the median of all corners.
    /// `None` where there are none.
    pub acceleration_median: Option<f64>,
    /// The greatest of all; `None` where the motion has neither corners nor curves.
    pub acceleration_most: Option<f64>,
    /// The greatest jump of a joint's speed at a point that is passed without a corner \[rad/s\].
    pub speed_step_rad_s: f64,
}

/// Judges the motion of a program that was read against its plan.
///
/// # Errors
/// [`ProveError`] for points that are no motion, and when it is given up.
pub fn judge(
    certified: &Certified<Plan>,
    reading: &Reading,
    arm: &RobotModel,
    tolerance_m: f64,
    cancel: &CancelToken,
) -> Result<ProgramJudgement, ProveError> {
    let job = &certified.plan().job;
    let tip = job.workcell.tool.tip_frame(arm);
    let limits = ProgramLimits {
        deviation_m: tolerance_m,
        joint_speed_share: JOINT_SPEED_SHARE,
        speed_share: reading.greatest_share(),
    };
    let case = |motion: ProgramMotion| {
        Ok(Case {
            corner_scale: motion.corner_scale,
            proof: prove_program(certified, &motion.motion, arm, &limits, cancel)?,
            demands: ControllerDemands::new(&motion, &job.limits.joint_acceleration_rad_s2),
        })
    };
    let motions = motions(reading, arm, &tip)?;
    Ok(ProgramJudgement {
        cases: motions.into_iter().map(case).collect::<Result<_, ProveError>>()?,
    })
}

impl ProgramJudgement {
    /// Returns true where the program holds under every assumption.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.cases.iter().all(|case| case.proof.holds())
    }

    /// The first thing that is not kept.
    ///
    /// # Errors
    /// [`Refusal::NotKept`].
    pub fn accepted(&self) -> Result<(), Refusal> {
        let mut broken = self
            .cases
            .iter()
            .flat_map(|case| case.proof.broken().map(move |check| (case, check)));
        broken.next().map_or(Ok(()), |(case, check)| {
            Err(Refusal::NotKept {
                requirement: check.requirement,
                assuming: case.assuming(),
                words: format!("{}; {}{}", check.detail(), check.worst, remedy(check.requirement)),
            })
        })
    }

    /// The worst of each requirement over all assumptions, in the order of their checks.
    #[must_use]
    pub fn worst(&self) -> Vec<Check> {
        worst_of(self.cases.iter().map(|case| &case.proof.checks))
    }

    /// Returns the worst of the implied checks, over all assumptions.
    #[must_use]
    pub fn implied(&self) -> Vec<Check> {
        worst_of(self.cases.iter().map(|case| &case.proof.implied))
    }
}

impl Case {
    /// The assumption in words that follow a noun; empty where there is but one.
    #[must_use]
    pub fn assuming(&self) -> String {
        let words = |scale| match scale {
            0.0 => " without corners".to_owned(),
            _ => format!(" with corners of {scale} times their size"),
        };
        self.corner_scale.map_or_else(String::new, words)
    }
}

impl ControllerDemands {
    fn new(motion: &ProgramMotion, limits_rad_s2: &[f64; AXES]) -> Self {
        let pieces = motion.motion.pieces();
        let mut shares: Vec<f64> = Vec::new();
        let mut speed_step_rad_s = 0.0_f64;
        for piece in pieces.iter().filter(|piece| piece.qd_rad_s[0] != piece.qd_rad_s[1]) {
            let ends = piece.accelerations();
            let share = |j: usize| ends[0][j].abs().max(ends[1][j].abs()) / limits_rad_s2[j];
            shares.push((0..AXES).map(share).fold(0.0, f64::max));
        }
        for both in pieces.windows(2) {
            let step = (both[1].qd_rad_s[0] - both[0].qd_rad_s[1]).amax();
            speed_step_rad_s = speed_step_rad_s.max(step);
        }
        shares.sort_unstable_by(f64::total_cmp);
        let corners = motion.corner_scale.is_some();
        Self {
            acceleration_median: shares.get(shares.len() / 2).copied().filter(|_| corners),
            acceleration_most: shares.last().copied(),
            speed_step_rad_s,
        }
    }
}

/// Advice against a requirement that is not kept, as the end of a sentence.
fn remedy(requirement: Requirement) -> &'static str {
    match requirement {
        Requirement::JointSpeed => "; a smaller share of the speed helps",
        Requirement::Clearance | Requirement::ReducedClearance | Requirement::ContactHeight | Requirement::Swept => {
            "; a smaller tolerance may help"
        }
        _ => "",
    }
}

/// Returns, for each requirement, the check with the worst bound.
fn worst_of<'a>(cases: impl Iterator<Item = &'a Vec<Check>>) -> Vec<Check> {
    let mut worst: Vec<Check> = Vec::new();
    for check in cases.flatten() {
        match worst.iter_mut().find(|w| w.requirement == check.requirement) {
            None => worst.push(check.clone()),
            Some(w) if severity(check) > severity(w) => *w = check.clone(),
            Some(_) => {}
        }
    }
    worst
}

/// Sort key of a check: one that is not kept ranks above one that is kept, then the nearer to its limit.
fn severity(check: &Check) -> (bool, f64) {
    let beyond = |measure: &Measure| {
        let bound = measure.bound.unwrap_or(f64::INFINITY);
        match measure.sense {
            Sense::AtMost => bound - measure.limit,
            Sense::AtLeast | Sense::Above => measure.limit - bound,
        }
    };
    (!check.status.is_kept(), check.measure.as_ref().map_or(0.0, beyond))
}

/// Sizes of corners, relative to the program's text, with which its motion is judged.
pub const CORNER_SCALES: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// Shortest line between two corners that counts as a line \[s\].
const NOTHING_S: f64 = 1e-9;

/// The motion of a program under one assumption.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramMotion {
    /// Size of its corners relative to the program's text; `None` where it has none.
    pub corner_scale: Option<f64>,
    /// The motion in the plan's time.
    pub motion: PiecewiseMotion,
}

/// A point of a program in the plan's time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TimedPoint {
    /// \[s\]
    pub t_s: f64,
    /// \[rad\]
    pub q_rad: JointVector,
    /// \[rad/s\]
    pub qd_rad_s: JointVector,
    /// Radius of the corner \[m\]; 0 where the arm stops.
    pub corner_m: f64,
}

/// The motions that a program is assumed to lead to, in the plan's time.
///
/// # Errors
/// [`KnotError`] for points that are no motion: times that do not ascend, numbers that are not finite.
pub fn motions(reading: &Reading, arm: &RobotModel, tip: &Frame) -> Result<Vec<ProgramMotion>, KnotError> {
    let share = reading.share();
    let in_plan_time = |point: &ReadPoint| TimedPoint {
        t_s: point.t_s * share,
        q_rad: point.q_rad,
        qd_rad_s: point.qd_rad_s.unwrap_or_default() / share,
        corner_m: point.corner_m.unwrap_or(0.0),
    };
    let points: Vec<_> = reading.points.iter().map(in_plan_time).collect();
    let piece: fn(&TimedPoint, &TimedPoint) -> MotionPiece = match reading.interpolation {
        SegmentShape::RoundedLines => return rounded_motions(&points, arm, tip),
        SegmentShape::Lines => |a, b| MotionPiece::line([a.t_s, b.t_s], [a.q_rad, b.q_rad]),
        SegmentShape::Cubics => |a, b| MotionPiece::cubic([a.t_s, b.t_s], [a.q_rad, b.q_rad], [a.qd_rad_s, b.qd_rad_s]),
    };
    check(&points)?;
    let pieces = points.windows(2).map(|both| piece(&both[0], &both[1]));
    Ok(vec![ProgramMotion {
        corner_scale: None,
        motion: PiecewiseMotion::new(pieces.collect())?,
    }])
}

/// The motions on straight segments, with corners of each size.
///
/// # Errors
/// As [`motions`].
pub(crate) fn rounded_motions(
    points: &[TimedPoint],
    arm: &RobotModel,
    tip: &Frame,
) -> Result<Vec<ProgramMotion>, KnotError> {
    check(points)?;
    let at = |point: &TimedPoint| arm.fk(&point.q_rad).rigid(tip).translation;
    let places: Vec<_> = points.iter().map(at).collect();
    let reach_m: Vec<_> = places.windows(2).map(|both| (both[1] - both[0]).norm()).collect();
    let motion = |scale| {
        Ok(ProgramMotion {
            corner_scale: Some(scale),
            motion: PiecewiseMotion::new(rounded(points, &reach_m, scale))?,
        })
    };
    CORNER_SCALES.into_iter().map(motion).collect()
}

/// Refuses points that are no motion.
fn check(points: &[TimedPoint]) -> Result<(), KnotError> {
    for (knot, point) in points.iter().enumerate() {
        let t_s = point.t_s;
        let numbers = point.q_rad.iter().chain(&point.qd_rad_s).copied();
        if !numbers.chain([t_s, point.corner_m]).all(f64::is_finite) {
            return Err(KnotError::NotFinite { knot });
        }
        let ascends = match knot {
            0 => t_s == 0.0,
            _ => t_s > points[knot - 1].t_s,
        };
        if !ascends {
            return Err(KnotError::Time { knot, t_s });
        }
    }
    Ok(())
}

/// Straight segments with corners of `scale` times their radius.
fn rounded(points: &[TimedPoint], reach_m: &[f64], scale: f64) -> Vec<MotionPiece> {
    let [first, .., last] = points else {
        return Vec::new();
    };
    let mut pieces = Vec::with_capacity(2 * points.len());
    let (mut t_s, mut q_rad) = (first.t_s, first.q_rad);
    for k in 1..points.len() - 1 {
        let mut corner = corner(points, reach_m, k, scale);
        if corner.t_s[0] - t_s > NOTHING_S {
            pieces.push(MotionPiece::line([t_s, corner.t_s[0]], [q_rad, corner.q_rad[0]]));
        } else {
            (corner.t_s[0], corner.q_rad[0]) = (t_s, q_rad);
        }
        let is_round = corner.length_s() > NOTHING_S;
        pieces.extend(is_round.then_some(corner));
        (t_s, q_rad) = (corner.t_s[usize::from(is_round)], corner.q_rad[usize::from(is_round)]);
    }
    if last.t_s > t_s {
        pieces.push(MotionPiece::line([t_s, last.t_s], [q_rad, last.q_rad]));
    }
    pieces
}

/// The corner at a point.
fn corner(points: &[TimedPoint], reach_m: &[f64], k: usize, scale: f64) -> MotionPiece {
    let [before, after] = [k - 1, k];
    let radius_m = (points[k].corner_m * scale)
        .min(0.5 * reach_m[before])
        .min(0.5 * reach_m[after]);
    let step_s = |segment: usize| points[segment + 1].t_s - points[segment].t_s;
    // The time from where the corner begins to the point, and from the point to where it would end.
    let time_s = |segment: usize| match reach_m[segment] {
        reach if reach > 0.0 => radius_m / reach * step_s(segment),
        _ => 0.0,
    };
    let half_s = time_s(before).min(time_s(after));
    let TimedPoint { t_s: t, q_rad: q, .. } = points[k];
    let qd_rad_s = [before, after].map(|i| (points[i + 1].q_rad - points[i].q_rad) / step_s(i));
    let q_rad = [q - qd_rad_s[0] * half_s, q + qd_rad_s[1] * half_s];
    MotionPiece::cubic([t - half_s, t + half_s], q_rad, qd_rad_s)
}
