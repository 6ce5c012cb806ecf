//! The cascade that users call: seed, QP, listed starts, random restarts. See the [module](super) text.

use crate::ik::analytic::{AnalyticArm, AnalyticError, Solutions, StructureMismatch};
use crate::ik::answer::{IkCause, IkError, IkFailure, IkSolution, Method, Start};
use crate::ik::dls::{self, Descent, Iterate, ON_LIMIT_RAD, Stop, Task};
use crate::ik::qp;
use crate::ik::settings::{AnalyticStarts, IkSettings, IkSettingsError, RandomRestarts};
use crate::ik::starts::Starts;
use crate::joints::{AXES, JointVector};
use crate::model::Frame;
use crate::model::RobotModel;
use crate::rotation::Pose;
use crate::rotation::RigidTransform;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::borrow::Cow;

/// Ratio of the gradient to `‖J‖ ‖e‖` below which no joint motion reduces the error.
const STATIONARY: f64 = 1e-3;
/// Smallest singular value below which a direction counts as lost.
const SINGULAR: f64 = 1e-3;
/// Solver for one frame of one arm; build it once and call [`IkSolver::solve`] often.
#[derive(Debug, Clone)]
pub struct IkSolver<'a> {
    pub(crate) robot: Cow<'a, RobotModel>,
    frame: Frame,
    pub(crate) settings: IkSettings,
    pub(crate) starts: Starts,
    analytic: Option<AnalyticArm>,
}

/// Reason that [`IkSolver::solve_all`] has no answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AllBranchesError {
    /// The arm has no closed form.
    #[error("this arm has no analytic inverse kinematics: {0}")]
    NotAnalytic(StructureMismatch),
    /// The frame is not carried by the last link.
    #[error("the frame is not fixed to what joint 6 moves")]
    Frame,
    /// The target or the previous configuration is not finite.
    #[error(transparent)]
    Input(#[from] AnalyticError),
}

impl From<StructureMismatch> for AllBranchesError {
    fn from(reason: StructureMismatch) -> Self {
        Self::NotAnalytic(reason)
    }
}

/// Squared error (m², rad²) at the seed above which the seed is cold.
const COLD: f64 = 0.09;
/// Squared error (m², rad²) below which the QP follows DLS at once.
const NEAR: f64 = 1e-2;
/// Number of stops of the list from which the QP continues.
const QP_FROM_LIST: usize = 6;
/// State of one search: the task, the best iterate over all starts, and the work spent.
struct Search<'t> {
    task: &'t Task<'t>,
    best: Iterate,
    iterations: usize,
    /// Reason that no analytic branch is a solution, once they were tried.
    no_branch: Option<AnalyticError>,
}

impl<'a> IkSolver<'a> {
    /// Prepares the listed starts for `frame`.
    ///
    /// # Errors
    /// [`IkSettingsError`] when a setting is out of range.
    pub fn new(robot: &'a RobotModel, frame: Frame, settings: IkSettings) -> Result<Self, IkSettingsError> {
        settings.validate()?;
        let starts = Starts::new(robot, &frame);
        let analytic = match settings.analytic_starts {
            AnalyticStarts::Used if frame.body() == AXES => AnalyticArm::recognise(robot).ok(),
            _ => None,
        };
        Ok(Self {
            analytic,
            robot: Cow::Borrowed(robot),
            frame,
            settings,
            starts,
        })
    }

    /// Returns the same solver with an arm of its own, for callers that cannot lend one.
    #[must_use]
    pub fn into_owned(self) -> IkSolver<'static> {
        IkSolver {
            robot: Cow::Owned(self.robot.into_owned()),
            frame: self.frame,
            settings: self.settings,
            starts: self.starts,
            analytic: self.analytic,
        }
    }

    /// Returns the arm.
    #[must_use]
    pub fn robot(&self) -> &RobotModel {
        &self.robot
    }

    /// True if a seed with this squared error (m², rad²) is too far away to start from.
    pub(crate) fn is_cold(squared_error: f64) -> bool {
        squared_error > COLD
    }

    /// Returns the settings.
    #[must_use]
    pub fn settings(&self) -> &IkSettings {
        &self.settings
    }

    /// Returns the frame that is moved to the target.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns a configuration within the limits that brings the frame to `target` (`T_base_frame`), found from `seed` \[rad\] (clamped to
    /// the limits first) by the cascade in the [module](super) text.
    ///
    /// # Errors
    /// [`IkError::NotSolved`] with the best configuration and the cause; [`IkError::Target`] and
    /// [`IkError::Seed`] for input that is not finite.
    pub fn solve(&self, target: &Pose, seed: &JointVector) -> Result<IkSolution, IkError> {
        let task = self.task(target)?;
        check_seed(seed)?;
        let start = self.robot.limits().clamp(seed);
        let first = dls::descend_below(COLD, &task, start, &dls::ALL_FREE, &self.settings);
        let mut search = Search {
            task: &task,
            best: first.best,
            iterations: 0,
            no_branch: None,
        };
        let answer = self.search(&mut search, &start, first);
        answer.ok_or_else(|| IkError::NotSolved(self.failure(&search)))
    }

    /// Returns every configuration within the limits that brings the frame to `target`, branch by branch with all wraps, and the reason
    /// that each other branch has none. `previous` \[rad\] decides free joints at singularities.
    ///
    /// # Errors
    /// [`AllBranchesError`] if the arm has no closed form, or for input that is not finite. No solution is no error: see
    /// [`Solutions::rejections`].
    pub fn solve_all(&self, target: &Pose, previous: &JointVector) -> Result<Solutions, AllBranchesError> {
        let target =
            AnalyticArm::body_target(&self.frame, &RigidTransform::from(target)).ok_or(AllBranchesError::Frame)?;
        let solutions = match &self.analytic {
            Some(arm) => arm.solve_all(&target, previous, self.robot.limits()),
            None => AnalyticArm::recognise(&self.robot)?.solve_all(&target, previous, self.robot.limits()),
        };
        Ok(solutions?)
    }

    /// Runs the stages in order, after the first descent from `start`; `None` if all of them fail.
    fn search(&self, search: &mut Search<'_>, start: &JointVector, mut first: Descent) -> Option<IkSolution> {
        let cold = first.stop == Stop::Cold;
        if cold {
            if let Some(answer) = self.try_branches(start, search) {
                return Some(answer);
            }
            first = dls::descend(search.task, *start, &dls::ALL_FREE, &self.settings);
        }
        if let Some(answer) = self.note(&first, Method::Dls, Start::Seed, search) {
            return Some(answer);
        }
        let due = matches!(first.stop, Stop::Stagnation | Stop::ActiveLimit);
        let near = first.best.cost < NEAR;
        if due
            && near
            && let Some(answer) = self.bounded(first.best, Start::Seed, search)
        {
            return Some(answer);
        }
        if !cold && let Some(answer) = self.try_branches(start, search) {
            return Some(answer);
        }
        if search.no_branch.is_some() || self.beyond_reach(&search.task.target) {
            return None;
        }
        let postponed = (due && !near).then_some((first.best, Start::Seed));
        self.try_list(postponed, search).or_else(|| self.try_random(search))
    }

    /// Runs DLS from the analytic branch nearest to `seed`, if the arm has branches.
    fn try_branches(&self, seed: &JointVector, search: &mut Search<'_>) -> Option<IkSolution> {
        let arm = self.analytic.as_ref()?;
        let target = AnalyticArm::body_target(&self.frame, &search.task.target)?;
        match arm.nearest(&target, seed, self.robot.limits()) {
            Ok(nearest) => {
                let descent = dls::descend(search.task, nearest.q, &dls::ALL_FREE, &self.settings);
                self.note(&descent, Method::Dls, Start::Analytic, search)
            }
            Err(reason) => {
                // On a rounded arm the steps that close a branch can fail where the pose is reached: the search goes on.
                search.no_branch = arm.rounding().is_none().then_some(reason);
                None
            }
        }
    }

    /// Runs DLS from the listed starts, then the QP if it is due.
    fn try_list(&self, postponed: Option<(Iterate, Start)>, search: &mut Search<'_>) -> Option<IkSolution> {
        let mut stopped = Vec::new();
        let starts = self.starts.nearest(&search.task.target, self.settings.listed_starts);
        for (k, q) in starts.into_iter().enumerate() {
            let descent = dls::descend(search.task, q, &dls::ALL_FREE, &self.settings);
            if let Some(answer) = self.note(&descent, Method::Dls, Start::Listed(k), search) {
                return Some(answer);
            }
            if descent.stop == Stop::ActiveLimit {
                stopped.push((descent.best, Start::Listed(k)));
            }
        }
        stopped.sort_by(|a, b| a.0.cost.total_cmp(&b.0.cost));
        stopped.truncate(QP_FROM_LIST);
        let mut due = postponed.into_iter().chain(stopped);
        due.find_map(|(from, start)| self.bounded(from, start, search))
    }

    /// Runs random restarts, if the caller asked for any.
    fn try_random(&self, search: &mut Search<'_>) -> Option<IkSolution> {
        let RandomRestarts { seed, count } = self.settings.random_restarts?;
        let mut rng = Pcg64::seed_from_u64(seed);
        (0..count).find_map(|k| {
            let from = self.random_configuration(&mut rng);
            let descent = dls::descend(search.task, from, &dls::ALL_FREE, &self.settings);
            let answer = self.note(&descent, Method::Dls, Start::Random(k), search);
            if answer.is_some() || descent.stop != Stop::ActiveLimit {
                return answer;
            }
            self.bounded(descent.best, Start::Random(k), search)
        })
    }

    /// Runs the QP from the stop of DLS.
    fn bounded(&self, from: Iterate, start: Start, search: &mut Search<'_>) -> Option<IkSolution> {
        let descent = qp::descend(search.task, from, &self.settings);
        self.note(&descent, Method::Qp, start, search)
    }

    pub(crate) fn task(&self, target: &Pose) -> Result<Task<'_>, IkError> {
        let position: [f64; 3] = target.translation.vector.into();
        if position
            .iter()
            .chain(target.rotation.coords.iter())
            .all(|v| v.is_finite())
        {
            return Ok(self.task_unchecked(target));
        }
        Err(IkError::Target { position })
    }

    /// Returns the task for a target that is known to be finite.
    pub(crate) fn task_unchecked(&self, target: &Pose) -> Task<'_> {
        Task {
            robot: &self.robot,
            frame: self.frame,
            target: RigidTransform::from(target),
            tolerance: [
                self.settings.position_tolerance_m,
                self.settings.orientation_tolerance_rad,
            ],
        }
    }

    /// Records a descent. This is the one place where a solution is accepted: within the limits and both tolerances.
    fn note(&self, descent: &Descent, method: Method, start: Start, search: &mut Search<'_>) -> Option<IkSolution> {
        search.iterations += descent.iterations;
        let best = &descent.best;
        if best.cost < search.best.cost {
            search.best = *best;
        }
        let accepted = search.task.solved(best) && self.robot.limits().contain(&best.q);
        accepted.then(|| IkSolution {
            q: best.q,
            iterations: search.iterations,
            method,
            start,
            position_error_m: best.position_error(),
            orientation_error_rad: best.orientation_error(),
        })
    }

    /// True if the target lies beyond [`RobotModel::reach_bound`]: then no start can help.
    pub(crate) fn beyond_reach(&self, target: &RigidTransform) -> bool {
        let (centre, bound) = self.robot.reach_bound(&self.frame);
        (target.translation - centre.coords).norm() > bound + self.settings.position_tolerance_m
    }

    fn failure(&self, search: &Search<'_>) -> IkFailure {
        let best = &search.best;
        let (cause, limit_excess_rad) = match search.no_branch {
            Some(AnalyticError::OutOfReach(_)) => (IkCause::Unreachable, None),
            Some(AnalyticError::Limits { violation, .. }) => {
                let joint = violation.joint;
                (
                    IkCause::Limit { joint },
                    Some((violation.position_rad - violation.limit_rad).abs()),
                )
            }
            _ => (self.cause(search.task, best), None),
        };
        IkFailure {
            q: best.q,
            iterations: search.iterations,
            cause,
            limit_excess_rad,
            position_error_m: best.position_error(),
            orientation_error_rad: best.orientation_error(),
        }
    }

    pub(crate) fn cause(&self, task: &Task<'_>, at: &Iterate) -> IkCause {
        if self.beyond_reach(&task.target) {
            return IkCause::Unreachable;
        }
        let jacobian = task.jacobian(at);
        let gradient = jacobian.tr_mul(&at.error);
        let limits = self.robot.limits();
        let pull = |i: &usize| {
            let limit = if gradient[*i] > 0.0 {
                limits.upper[*i]
            } else {
                limits.lower[*i]
            };
            if (at.q[*i] - limit).abs() <= ON_LIMIT_RAD {
                gradient[*i].abs()
            } else {
                0.0
            }
        };
        let threshold = STATIONARY * jacobian.norm() * at.cost.sqrt();
        let strongest = (0..AXES)
            .max_by(|a, b| pull(a).total_cmp(&pull(b)))
            .filter(|i| pull(i) > threshold);
        if let Some(joint) = strongest {
            return IkCause::Limit { joint };
        }
        if gradient.norm() <= threshold {
            return IkCause::LocalMinimum;
        }
        if jacobian.singular_values().min() < SINGULAR {
            return IkCause::Singular;
        }
        IkCause::Iterations
    }

    fn random_configuration(&self, rng: &mut Pcg64) -> JointVector {
        JointVector::from_fn(|joint, _| {
            let [lower, upper] = self.robot.limits().sampling_range(joint);
            lower + (upper - lower) * rng.random::<f64>()
        })
    }
}

pub(crate) fn check_seed(seed: &JointVector) -> Result<(), IkError> {
    match (0..AXES).find(|&joint| !seed[joint].is_finite()) {
        Some(joint) => Err(IkError::Seed {
            joint,
            found: seed[joint],
        }),
        None => Ok(()),
    }
}
