//! Answers judged by others: a pose is reachable if rs-opw-kinematics or ik-geo has a solution, or the configuration that
//! made the pose is one, that is within the limits and meets the pose by the plain forward kinematics.

use crate::edges::Case;
use crate::plain_fk::PlainArm;
use crate::solvers::{IkGeo, Opw, nearest_within};
use platewash_kinematics::ik::analytic::AnalyticArm;
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{AXES, Frame, JointVector, Pose, RobotModel, ToolFrame};
use platewash_problems::score::errors;
use platewash_problems::{ANALYTIC, NUMERIC, Tolerance};
use std::collections::BTreeMap;
use std::error::Error;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Closer than this to a singularity, the joints that it leaves free decide \[rad, m\].
const SINGULAR: f64 = 1e-5;
/// Joints further beyond a limit than this are outside it for any solver \[rad\].
const AT_A_LIMIT: f64 = 2e-5;
/// Rounding of the judges' forward kinematics and of turning a pose into a quaternion \[m, rad\].
const ROUNDING: f64 = 1e-13;
/// Disagreements written out, of each kind.
const WRITTEN: usize = 3;

/// Which of our calls is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Call {
    /// `IkSolver::solve` with default settings.
    Solve,
    /// `AnalyticArm::nearest`.
    Nearest,
}

impl Call {
    fn tolerance(self) -> Tolerance {
        match self {
            Self::Solve => NUMERIC,
            Self::Nearest => ANALYTIC,
        }
    }
}

/// How often each verdict was found, and the first cases of each disagreement.
#[derive(Debug, Default, Clone)]
pub struct Tally {
    /// By kind of case and verdict.
    pub counts: BTreeMap<(&'static str, &'static str), usize>,
    /// By verdict.
    pub written: BTreeMap<&'static str, Vec<String>>,
}

impl Tally {
    /// Adds another tally.
    pub fn add(&mut self, other: Self) {
        for (key, count) in other.counts {
            *self.counts.entry(key).or_default() += count;
        }
        for (key, mut written) in other.written {
            let all = self.written.entry(key).or_default();
            all.append(&mut written);
            all.truncate(WRITTEN);
        }
    }

    fn note(&mut self, case: &Case, verdict: &'static str, detail: impl FnOnce() -> String) {
        *self.counts.entry((case.kind, verdict)).or_default() += 1;
        if !verdict.starts_with("agreed") {
            let written = self.written.entry(verdict).or_default();
            if written.len() < WRITTEN {
                written.push(detail());
            }
        }
    }
}

/// Our solvers and the judges.
pub struct Court<'a> {
    robot: &'a RobotModel,
    tool0: Frame,
    plain: PlainArm,
    solver: IkSolver<'a>,
    arm: AnalyticArm,
    opw: Opw<'a>,
    ik_geo: IkGeo<'a>,
}

/// The best that the judges have: an answer, or by how much their answers miss.
struct BestAnswer {
    answer: Option<(JointVector, [f64; 2])>,
    /// Least distance beyond a limit of a solution that meets the pose \[rad\].
    beyond_limit_rad: f64,
    /// Whether a solution is within the limits but not within the tolerance.
    inexact: bool,
}

impl<'a> Court<'a> {
    /// Prepares everyone.
    ///
    /// # Errors
    /// None unless the arm was changed.
    pub fn new(robot: &'a RobotModel) -> Result<Self, Box<dyn Error>> {
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        Ok(Self {
            robot,
            tool0,
            plain: PlainArm::default(),
            solver: IkSolver::new(robot, tool0, IkSettings::default())?,
            arm: AnalyticArm::recognise(robot)?,
            opw: Opw::new(robot, &[]),
            ik_geo: IkGeo::spherical(robot, &[])?,
        })
    }

    /// Judges one call on one case.
    pub fn judge(&self, case: &Case, call: Call, tally: &mut Tally) {
        let Ok(ours) = catch_unwind(AssertUnwindSafe(|| self.ours(case, call))) else {
            return tally.note(case, "WRONG: panic", || format!("{case:?}"));
        };
        let judged = self.judged(case, call.tolerance());
        let verdict = match (&ours, &judged.answer) {
            (Ok(q), judge) => self.verdict_on(q, case, call.tolerance(), judge.is_some(), &judged),
            (Err(_), Some((q, [m, rad]))) => self.verdict_on_refusal(q, m.max(*rad)),
            (Err(_), None) => "agreed: no solution",
        };
        tally.note(case, verdict, || {
            let judge = judged.answer.map(|(q, e)| (q.as_slice().to_vec(), e));
            format!(
                "{case:?}\n  ours {ours:?}\n  judges {judge:?}, beyond a limit by {:e}",
                judged.beyond_limit_rad
            )
        });
    }

    fn ours(&self, case: &Case, call: Call) -> Result<JointVector, String> {
        match call {
            Call::Solve => {
                let answer = self.solver.solve(&case.pose, &case.start);
                answer.map(|solution| solution.q).map_err(|e| e.to_string())
            }
            Call::Nearest => self.nearest(&case.pose, &case.start),
        }
    }

    fn nearest(&self, pose: &Pose, start: &JointVector) -> Result<JointVector, String> {
        let target = AnalyticArm::body_target(&self.tool0, &RigidTransform::from(pose)).ok_or("frame")?;
        let answer = self.arm.nearest(&target, start, self.robot.limits());
        answer.map(|nearest| nearest.q).map_err(|e| e.to_string())
    }

    fn verdict_on(
        &self,
        q: &JointVector,
        case: &Case,
        tolerance: Tolerance,
        judged_reachable: bool,
        judged: &BestAnswer,
    ) -> &'static str {
        if !q.iter().all(|angle| angle.is_finite()) {
            return "WRONG: not finite";
        }
        if !self.robot.limits().contain(q) {
            return "WRONG: outside the limits";
        }
        if !within(self.miss(q, &case.pose), tolerance) {
            return "WRONG: pose not met";
        }
        if judged_reachable {
            return "agreed: solved";
        }
        // Ours has just been proven right; what remains is why the judges found nothing.
        if q[4].abs() <= SINGULAR {
            "ours alone, proven: singular wrist, judges split joints 4 and 6 otherwise"
        } else if self.wrist_radius(q) <= SINGULAR {
            "ours alone, proven: singular shoulder, judges turn joint 1 otherwise"
        } else if judged.beyond_limit_rad <= AT_A_LIMIT {
            "ours alone, proven: judges are beyond a limit by less than 2e-5 rad"
        } else if judged.inexact {
            "ours alone, proven: judges miss the pose by more than the tolerance"
        } else if self.stretch(q) <= 5e-6 {
            "ours alone, proven: at full stretch, judges have no branch"
        } else {
            "ours alone, proven: UNEXPLAINED"
        }
    }

    fn verdict_on_refusal(&self, q: &JointVector, miss: f64) -> &'static str {
        if miss > ANALYTIC.position_m {
            "judges alone: off by more than 1e-9, pose itself beyond the border"
        } else if miss > 4e-10 {
            "judges alone: off by 4e-10 to 1e-9, pose itself beyond the border"
        } else if q[4].abs() <= SINGULAR {
            "MISSED at a singular wrist"
        } else if self.wrist_radius(q) <= SINGULAR {
            "MISSED at a singular shoulder"
        } else if self.robot.limits().margins(q).min() <= AT_A_LIMIT {
            "MISSED at a limit"
        } else {
            "MISSED"
        }
    }

    fn judged(&self, case: &Case, tolerance: Tolerance) -> BestAnswer {
        let quiet =
            |solutions: &dyn Fn() -> Vec<[f64; AXES]>| catch_unwind(AssertUnwindSafe(solutions)).unwrap_or_default();
        let mut all = quiet(&|| self.opw.solutions(&case.pose));
        all.extend(quiet(&|| self.ik_geo.solutions(&case.pose)));
        all.extend(case.witness.map(<[f64; AXES]>::from));
        let mut judged = BestAnswer {
            answer: None,
            beyond_limit_rad: f64::INFINITY,
            inexact: false,
        };
        for q in all {
            let miss = self.miss(&q.into(), &case.pose);
            match nearest_within(self.robot.limits(), [q], &case.start) {
                Some(q) if within(miss, tolerance) => {
                    if judged.answer.is_none_or(|(_, best)| worse(best) > worse(miss)) {
                        judged.answer = Some((q, miss));
                    }
                }
                Some(_) => judged.inexact = true,
                None => {
                    let beyond = self.beyond_limits(&q);
                    judged.beyond_limit_rad = judged.beyond_limit_rad.min(beyond);
                }
            }
        }
        judged
    }

    /// How far the solution misses the limits, each joint at its best turn \[rad\].
    fn beyond_limits(&self, q: &[f64; AXES]) -> f64 {
        let turned = |i: usize, turn: f64| {
            let mut all = JointVector::zeros();
            all[i] = q[i] + turn * std::f64::consts::TAU;
            -self.robot.limits().margins(&all)[i]
        };
        let best = |i: usize| {
            [-1.0, 0.0, 1.0]
                .map(|turn| turned(i, turn))
                .into_iter()
                .fold(f64::INFINITY, f64::min)
        };
        (0..AXES).map(best).fold(0.0, f64::max)
    }

    fn miss(&self, q: &JointVector, pose: &Pose) -> [f64; 2] {
        errors(&RigidTransform::from(pose), &self.plain.tool0(q))
    }

    /// Distance of the wrist centre from axis 1 \[m\].
    fn wrist_radius(&self, q: &JointVector) -> f64 {
        self.plain.bodies(q)[5].translation.xy().norm()
    }

    /// How far the wrist centre is from full stretch \[m\].
    fn stretch(&self, q: &JointVector) -> f64 {
        let bodies = self.plain.bodies(q);
        let longest = 0.270 + f64::hypot(0.302, 0.070);
        longest - (bodies[5].translation - bodies[2].translation).norm()
    }

    /// Of each solver, whether it meets the pose to 1e-9 within the limits; and whether ours is as near to the start as
    /// theirs.
    #[must_use]
    pub fn nearest_of_all(&self, case: &Case) -> Nearness {
        let limits = self.robot.limits();
        let met = |q: &JointVector| limits.contain(q) && within(self.miss(q, &case.pose), ANALYTIC);
        let ours = self.nearest(&case.pose, &case.start).ok().filter(met);
        let opw = nearest_within(limits, self.opw.solutions(&case.pose), &case.start).filter(met);
        let ik_geo = nearest_within(limits, self.ik_geo.solutions(&case.pose), &case.start).filter(met);
        let distance = |q: &Option<JointVector>| q.map_or(f64::INFINITY, |q| (q - case.start).norm());
        let theirs = distance(&opw).min(distance(&ik_geo));
        Nearness {
            met: [ours.is_some(), opw.is_some(), ik_geo.is_some()],
            further: distance(&ours) > theirs + 1e-6,
        }
    }
}

/// Outcome of [`Court::nearest_of_all`].
#[derive(Debug, Clone, Copy)]
pub struct Nearness {
    /// Ours, rs-opw-kinematics, ik-geo.
    pub met: [bool; 3],
    /// Ours is further from the start than another's answer that meets the pose.
    pub further: bool,
}

fn within([m, rad]: [f64; 2], tolerance: Tolerance) -> bool {
    m <= tolerance.position_m + ROUNDING && rad <= tolerance.orientation_rad + ROUNDING
}

fn worse([m, rad]: [f64; 2]) -> f64 {
    m.max(rad)
}
