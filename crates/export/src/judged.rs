//! What is proved of a program that was read back: of the motion that it leads to under each assumption about corners.

use crate::interpret::{self, Interpreted};
use crate::reading::Reading;
use crate::refusal::Refusal;
use platewash_certificate::{
    Certified, Check, Measure, ProgramLimits, ProgramProof, ProveError, Requirement, Sense, prove_program,
};
use platewash_kinematics::{AXES, RobotModel};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::plan::Plan;
use serde::Serialize;

/// Share of the arm's joint speeds that a program may use: what a controller needs to keep its time is left.
pub const JOINT_SPEED_SHARE: f64 = 0.95;

/// What came of a program.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// Under each assumption, in the order of [`interpret::CORNER_SCALES`] where there are corners.
    pub cases: Vec<Case>,
}

/// What came of a program under one assumption.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Size of its corners relative to what the program says; `None` where it has none.
    pub corner_scale: Option<f64>,
    /// What is proved.
    pub proof: ProgramProof,
    /// What the controller is asked for.
    pub asked: Asked,
}

/// What a motion asks of the controller, which times it: measured, not judged.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Asked {
    /// The greatest acceleration of a joint at each corner, as a share of what the plan's job allows: the median of all corners. `None`
    /// where there are none.
    pub acceleration_median: Option<f64>,
    /// The greatest of all; `None` where the motion has neither corners nor curves.
    pub acceleration_most: Option<f64>,
    /// The greatest jump of a joint's speed at a point that is passed without a corner \[rad/s\].
    pub speed_step_rad_s: f64,
}

/// Judges what a program that was read does, against the plan that it should be of.
///
/// # Errors
/// [`ProveError`] for points that are no motion, and when it is given up.
pub fn judge(
    certified: &Certified<Plan>,
    reading: &Reading,
    arm: &RobotModel,
    tolerance_m: f64,
    cancel: &CancelToken,
) -> Result<Judged, ProveError> {
    let job = &certified.plan().job;
    let tip = job.workcell.tool.tip_frame(arm);
    let limits = ProgramLimits {
        deviation_m: tolerance_m,
        joint_speed_share: JOINT_SPEED_SHARE,
        speed_share: reading.share(),
    };
    let case = |interpreted: Interpreted| {
        let motion = &interpreted.motion;
        Ok(Case {
            corner_scale: interpreted.corner_scale,
            proof: prove_program(certified, motion, arm, &limits, cancel)?,
            asked: Asked::of(&interpreted, &job.limits.joint_acceleration_rad_s2),
        })
    };
    let motions = interpret::motions(reading, arm, &tip)?;
    Ok(Judged {
        cases: motions.into_iter().map(case).collect::<Result<_, ProveError>>()?,
    })
}

impl Judged {
    /// Whether it holds under every assumption.
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

    /// The worst of what is implied, over all assumptions.
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

impl Asked {
    fn of(interpreted: &Interpreted, limits_rad_s2: &[f64; AXES]) -> Self {
        let pieces = interpreted.motion.pieces();
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
        shares.sort_by(f64::total_cmp);
        let corners = interpreted.corner_scale.is_some();
        Self {
            acceleration_median: shares.get(shares.len() / 2).copied().filter(|_| corners),
            acceleration_most: shares.last().copied(),
            speed_step_rad_s,
        }
    }
}

/// What helps against a requirement that is not kept, as the end of a sentence.
fn remedy(requirement: Requirement) -> &'static str {
    match requirement {
        Requirement::JointSpeed => "; a smaller share of the speed helps",
        Requirement::Clearance | Requirement::ContactHeight | Requirement::Swept => "; a smaller tolerance may help",
        _ => "",
    }
}

/// Of each check the one with the worst bound.
fn worst_of<'a>(cases: impl Iterator<Item = &'a Vec<Check>>) -> Vec<Check> {
    let mut worst: Vec<Check> = Vec::new();
    for check in cases.flatten() {
        match worst.iter_mut().find(|w| w.requirement == check.requirement) {
            None => worst.push(check.clone()),
            Some(w) if badness(check) > badness(w) => *w = check.clone(),
            Some(_) => {}
        }
    }
    worst
}

/// How bad a check is: one that is not kept is worse than one that is, then the nearer to its limit.
fn badness(check: &Check) -> (bool, f64) {
    let beyond = |measure: &Measure| {
        let bound = measure.bound.unwrap_or(f64::INFINITY);
        match measure.sense {
            Sense::AtMost => bound - measure.limit,
            Sense::AtLeast | Sense::Above => measure.limit - bound,
        }
    };
    (!check.status.is_kept(), check.measure.as_ref().map_or(0.0, beyond))
}
