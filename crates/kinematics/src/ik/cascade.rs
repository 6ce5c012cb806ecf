//! The cascade that users call: seed, QP, listed starts, random restarts. See the [module](super) text.

use super::starts::Starts;
use super::task::{Descent, Iterate, Stop, Task};
use super::{IkCause, IkError, IkFailure, IkSettings, IkSettingsError, IkSolution, Method, RandomRestarts, Start};
use super::{dls, qp};
use crate::fk::Frame;
use crate::rotation::Rigid;
use crate::{AXES, JointVector, Pose, RobotModel};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A gradient this small against `‖J‖ ‖e‖` is no descent.
const STATIONARY: f64 = 1e-3;
/// A smallest singular value below this is a lost direction.
const SINGULAR: f64 = 1e-3;
/// A joint this close to a limit counts as standing on it \[rad\].
const ON_LIMIT_RAD: f64 = 1e-6;

/// Solves for one frame of one arm; build it once and call [`IkSolver::solve`] often.
#[derive(Debug, Clone)]
pub struct IkSolver<'a> {
    robot: &'a RobotModel,
    frame: Frame,
    settings: IkSettings,
    starts: Starts,
}

/// When the QP follows DLS.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fallback {
    StagnationOrLimit,
    LimitOnly,
}

/// Best iterate over the starts tried so far, and the work spent on them.
struct Search {
    best: Iterate,
    iterations: usize,
}

impl<'a> IkSolver<'a> {
    /// Prepares the listed starts for `frame`.
    ///
    /// # Errors
    /// [`IkSettingsError`] when a setting is out of range.
    pub fn new(robot: &'a RobotModel, frame: Frame, settings: IkSettings) -> Result<Self, IkSettingsError> {
        settings.validate()?;
        let starts = Starts::new(robot, &frame);
        Ok(Self {
            robot,
            frame,
            settings,
            starts,
        })
    }

    /// The settings in force.
    #[must_use]
    pub fn settings(&self) -> &IkSettings {
        &self.settings
    }

    /// The frame that is brought to the target.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// A configuration within the limits that brings the frame to `target` (`T_base_frame`), found from `seed`
    /// \[rad\] (clamped to the limits first) by the cascade in the [module](super) text.
    ///
    /// # Errors
    /// [`IkError::NotSolved`] with the best configuration and the cause; [`IkError::Target`] and
    /// [`IkError::Seed`] for input that is not finite.
    pub fn solve(&self, target: &Pose, seed: &JointVector) -> Result<IkSolution, IkError> {
        let task = self.task(target, seed)?;
        let start = task.at(self.robot.limits().clamp(seed));
        let mut search = Search {
            best: start,
            iterations: 0,
        };
        if let Some(answer) = self.try_start(&task, start, Start::Seed, Fallback::StagnationOrLimit, &mut search) {
            return Ok(answer);
        }
        if self.beyond_reach(&task.target) {
            return Err(IkError::NotSolved(self.failure(&task, &search)));
        }
        for (k, q) in self
            .starts
            .nearest(&task.target, self.settings.listed_starts)
            .into_iter()
            .enumerate()
        {
            let from = task.at(q);
            if let Some(answer) = self.try_start(&task, from, Start::Listed(k), Fallback::LimitOnly, &mut search) {
                return Ok(answer);
            }
        }
        if let Some(RandomRestarts { seed, count }) = self.settings.random_restarts {
            let mut rng = Pcg64::seed_from_u64(seed);
            for k in 0..count {
                let from = task.at(self.random_configuration(&mut rng));
                if let Some(answer) = self.try_start(&task, from, Start::Random(k), Fallback::LimitOnly, &mut search) {
                    return Ok(answer);
                }
            }
        }
        Err(IkError::NotSolved(self.failure(&task, &search)))
    }

    fn task(&self, target: &Pose, seed: &JointVector) -> Result<Task<'a>, IkError> {
        let position: [f64; 3] = target.translation.vector.into();
        if !position
            .iter()
            .chain(target.rotation.coords.iter())
            .all(|v| v.is_finite())
        {
            return Err(IkError::Target { position });
        }
        if let Some(joint) = (0..AXES).find(|&i| !seed[i].is_finite()) {
            let found = seed[joint];
            return Err(IkError::Seed { joint, found });
        }
        Ok(Task {
            robot: self.robot,
            frame: self.frame,
            target: Rigid::from(target),
            tolerance: [
                self.settings.position_tolerance_m,
                self.settings.orientation_tolerance_rad,
            ],
        })
    }

    /// DLS, then QP where it is due; notes the best iterate and the work.
    fn try_start(
        &self,
        task: &Task<'_>,
        from: Iterate,
        start: Start,
        fallback: Fallback,
        search: &mut Search,
    ) -> Option<IkSolution> {
        let descent = dls::descend(task, from, &dls::ALL_FREE, &self.settings);
        if let Some(answer) = self.note(task, &descent, Method::Dls, start, search) {
            return Some(answer);
        }
        let due = match fallback {
            Fallback::StagnationOrLimit => matches!(descent.stop, Stop::Stagnation | Stop::ActiveLimit),
            Fallback::LimitOnly => descent.stop == Stop::ActiveLimit,
        };
        if !due {
            return None;
        }
        let descent = qp::descend(task, descent.best, &self.settings);
        self.note(task, &descent, Method::Qp, start, search)
    }

    /// The one place where a solution is accepted: within the limits and both tolerances.
    fn note(
        &self,
        task: &Task<'_>,
        descent: &Descent,
        method: Method,
        start: Start,
        search: &mut Search,
    ) -> Option<IkSolution> {
        search.iterations += descent.iterations;
        let best = &descent.best;
        if best.cost < search.best.cost {
            search.best = *best;
        }
        (task.solved(best) && self.robot.limits().contain(&best.q)).then(|| IkSolution {
            q: best.q,
            iterations: search.iterations,
            method,
            start,
            position_error_m: best.position_error(),
            orientation_error_rad: best.orientation_error(),
        })
    }

    /// Whether the target lies beyond [`RobotModel::reach_bound`]: then no start can help.
    fn beyond_reach(&self, target: &Rigid) -> bool {
        let (centre, bound) = self.robot.reach_bound(&self.frame);
        (target.translation - centre.coords).norm() > bound + self.settings.position_tolerance_m
    }

    fn failure(&self, task: &Task<'_>, search: &Search) -> IkFailure {
        IkFailure {
            q: search.best.q,
            iterations: search.iterations,
            cause: self.cause(task, &search.best),
            position_error_m: search.best.position_error(),
            orientation_error_rad: search.best.orientation_error(),
        }
    }

    fn cause(&self, task: &Task<'_>, at: &Iterate) -> IkCause {
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
            return IkCause::Unreachable;
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
