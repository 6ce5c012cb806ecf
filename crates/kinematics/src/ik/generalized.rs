//! Generalized inverse kinematics: freedom in the task, bounds on the motion, clearance rows.
//!
//! # What is solved
//!
//! Find `q` within the joint limits, within the given motion from the seed, and with every clearance row kept, whose
//! [deviation](super::freedom) from the target is allowed. Each iteration solves one convex program (clarabel) in the joint step and
//! in the deviation that is taken up:
//!
//! `min ‖D(q) + J_D Δq − (p, s, 0)‖² + λ‖Δq‖²`
//!
//! subject to `q_min ≤ q + Δq ≤ q_max`, `|q + Δq − q_seed| ≤ r`, `|Δq_i| ≤ step`, `|p| ≤ ` the position freedom, `‖s‖ ≤ ` the tilt
//! (a second-order cone) and `d_k + g_k·Δq ≥ d_required` for each clearance row; `D` is the deviation and `J_D` its
//! derivative. The yaw row is left out where yaw is free. When the deviation is nearly allowed, the allowed one next to
//! it is held and damped least squares meets the resulting exact pose to tolerance.
//!
//! # Starts
//!
//! First the seed; then the configurations that [`IkSolver::solve`] finds for the target tilted to 0, ½ and all of the cone in 12
//! directions (and, with free yaw, as many yaws), those that meet the bounds first.

use crate::ik::answer::{IkError, IkFailure};
use crate::ik::cascade::IkSolver;
use crate::ik::dls::{self, ALL_FREE, DAMPING_GAIN, Iterate, Stop, Task};
use crate::ik::freedom::{Deviation, TaskFreedom, TaskFreedomError, Yaw};
use crate::joints::{AXES, JointVector};
use crate::model::Axes;
use crate::rotation::Pose;
use crate::rotation::RigidTransform;
use crate::trig::sin_cos;
use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{self, NonnegativeConeT, SecondOrderConeT, ZeroConeT};
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus};
use nalgebra::{DMatrix, DVector, Vector6};
use std::f64::consts::{PI, TAU};

/// Greatest number of convex programs from one start.
const MAX_PROGRAMS: usize = 40;
/// Squared distance from the allowed deviations (m², rad²) below which the exact pose is tried.
const POLISH_BELOW: f64 = 1e-6;
/// Share of the squared distance that a program must gain at least. Otherwise the search from that start ends.
const LEAST_GAIN: f64 = 1e-4;
/// Smallest damping of a program.
const LEAST_DAMPING: f64 = 1e-9;
/// Number of tilt directions, and of yaws, that give further starts.
const DIRECTIONS: usize = 12;
/// Number of the further starts without an exact solution that are improved by programs.
const IMPROVED: usize = 8;

/// Linear model of a distance that must be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClearanceRow {
    /// Distance at the configuration \[m\].
    pub distance_m: f64,
    /// Derivative of the distance by the joints \[m/rad\].
    pub gradient: JointVector,
    /// Distance that must be kept \[m\].
    pub required_m: f64,
}

/// Clearance rows at a configuration \[rad\].
pub type ClearanceRows<'c> = dyn Fn(&JointVector) -> Vec<ClearanceRow> + 'c;

/// Task besides the target pose.
#[derive(Clone, Copy)]
pub struct GeneralizedTask<'c> {
    /// Allowed deviations of the frame from its target.
    pub freedom: TaskFreedom,
    /// Largest motion of each joint from the seed \[rad\], e.g. speed × time; `None` for no bound.
    pub motion_rad: Option<JointVector>,
    /// Clearance rows at a configuration; `None` for none.
    pub clearance: Option<&'c ClearanceRows<'c>>,
}

/// Configuration that meets a [`GeneralizedTask`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeneralizedSolution {
    /// Joint positions \[rad\].
    pub q: JointVector,
    /// Deviation of the origin, in target axes \[m\].
    pub position_m: [f64; 3],
    /// Angle between the z axes of frame and target \[rad\].
    pub tilt_rad: f64,
    /// Rotation about z once the tilt is undone \[rad\].
    pub yaw_rad: f64,
    /// Number of programs and linear systems solved.
    pub iterations: usize,
}

/// Reason that a [`GeneralizedTask`] was not met.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeneralizedError {
    /// The freedom is invalid.
    #[error(transparent)]
    Freedom(#[from] TaskFreedomError),
    /// A bound on the motion is negative or NaN.
    #[error("motion_rad of joint {} must not be negative; found {found}", .joint + 1)]
    Motion {
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Bound found \[rad\].
        found: f64,
    },
    /// The target or the seed is not finite.
    #[error(transparent)]
    Ik(#[from] IkError),
    /// No start led to an allowed pose; holds the best configuration, with its distance from the allowed deviations.
    #[error("no configuration with an allowed deviation: the best is {:.3e} m and {:.3e} rad beyond it", .0.position_error_m, .0.orientation_error_rad)]
    NotSolved(IkFailure),
}

/// Row of constraints: entries by variable, and the bound.
type Row = (Vec<(usize, f64)>, f64);

/// State of one search.
struct Search<'s> {
    solver: &'s IkSolver<'s>,
    asked: &'s GeneralizedTask<'s>,
    target: RigidTransform,
    lowest: JointVector,
    highest: JointVector,
    best: (f64, JointVector),
    iterations: usize,
}

impl IkSolver<'_> {
    /// Returns a configuration that meets `asked` for the target `T_base_frame`, as near to `seed` \[rad\] as the search finds one.
    ///
    /// # Errors
    /// [`GeneralizedError`]; a failure reports the best configuration and its distance from the allowed deviations.
    pub fn solve_generalized(
        &self,
        target: &Pose,
        seed: &JointVector,
        asked: &GeneralizedTask<'_>,
    ) -> Result<GeneralizedSolution, GeneralizedError> {
        asked.freedom.validate()?;
        let exact = self.task(target)?;
        crate::ik::cascade::check_seed(seed)?;
        let [lowest, highest] = self.motion_bounds(seed, asked)?;
        let start = seed.sup(&lowest).inf(&highest);
        let mut search = Search {
            solver: self,
            asked,
            target: exact.target,
            lowest,
            highest,
            best: (f64::INFINITY, start),
            iterations: 0,
        };
        let answer = search.improve(start).or_else(|| search.try_grid(&start));
        answer.ok_or_else(|| GeneralizedError::NotSolved(search.failure()))
    }

    fn motion_bounds(
        &self,
        seed: &JointVector,
        asked: &GeneralizedTask<'_>,
    ) -> Result<[JointVector; 2], GeneralizedError> {
        let limits = self.robot.limits();
        let Some(motion) = asked.motion_rad else {
            return Ok([limits.lower, limits.upper]);
        };
        if let Some(joint) = (0..AXES).find(|&i| motion[i].is_nan() || motion[i] < 0.0) {
            let found = motion[joint];
            return Err(GeneralizedError::Motion { joint, found });
        }
        let seed = limits.clamp(seed);
        Ok([limits.lower.sup(&(seed - motion)), limits.upper.inf(&(seed + motion))])
    }
}

impl Search<'_> {
    /// Runs programs from one configuration until an allowed pose is met or nothing is gained.
    fn improve(&mut self, start: JointVector) -> Option<GeneralizedSolution> {
        let mut q = start;
        let mut cost = self.cost(&q);
        let mut boost = 1.0;
        for _ in 0..MAX_PROGRAMS {
            if cost < self.best.0 {
                self.best = (cost, q);
            }
            if cost < POLISH_BELOW {
                let met = self.polish(&q);
                if met.is_some() {
                    return met;
                }
            }
            self.iterations += 1;
            let step = self.program(&q, cost, boost)?;
            let next = (q + step).sup(&self.lowest).inf(&self.highest);
            let reached = self.cost(&next);
            if reached < cost * (1.0 - LEAST_GAIN) || reached < POLISH_BELOW && reached < cost {
                (q, cost) = (next, reached);
                boost = f64::max(boost * 0.1, 1.0);
            } else if boost < 1e6 {
                boost *= 10.0;
            } else {
                return None;
            }
        }
        None
    }

    /// Tries further starts: exact solutions for tilted and turned targets.
    fn try_grid(&mut self, seed: &JointVector) -> Option<GeneralizedSolution> {
        let mut starts: Vec<(f64, f64, JointVector)> = Vec::new();
        for deviation in self.grid() {
            let task = self.task(deviation.applied_to(&self.target));
            let pose = Pose::from(&task.target);
            let q = match self.solver.solve(&pose, seed) {
                Ok(answer) => answer.q,
                Err(IkError::NotSolved(failure)) => failure.q,
                Err(_) => continue,
            };
            let q = q.sup(&self.lowest).inf(&self.highest);
            starts.push((self.cost(&q), (q - seed).norm(), q));
        }
        // Starts with an allowed pose come first, and of those the nearest to the seed.
        starts.sort_by(|a, b| {
            a.0.max(POLISH_BELOW)
                .total_cmp(&b.0.max(POLISH_BELOW))
                .then(a.1.total_cmp(&b.1))
        });
        starts.truncate(IMPROVED);
        starts.into_iter().find_map(|(_, _, q)| self.improve(q))
    }

    /// Returns allowed deviations on a coarse grid.
    fn grid(&self) -> Vec<Deviation> {
        let freedom = &self.asked.freedom;
        let circle = |k: usize| TAU * k as f64 / DIRECTIONS as f64;
        let mut tilts = vec![[0.0; 2]];
        if freedom.tilt_rad > 0.0 {
            for share in [0.5, 1.0 - 1e-9] {
                tilts.extend((0..DIRECTIONS).map(|k| {
                    let (s, c) = sin_cos(circle(k));
                    [c, s].map(|v| v * share * freedom.tilt_rad)
                }));
            }
        }
        let yaws = match freedom.yaw {
            Yaw::Fixed => vec![0.0],
            Yaw::Free => (0..DIRECTIONS).map(|k| circle(k) - PI).collect(),
        };
        let at = |[x, y]: [f64; 2], yaw: f64| Deviation(Vector6::new(0.0, 0.0, 0.0, x, y, yaw));
        tilts
            .iter()
            .flat_map(|tilt| yaws.iter().map(move |yaw| at(*tilt, *yaw)))
            .collect()
    }

    fn task(&self, target: RigidTransform) -> Task<'_> {
        let settings = &self.solver.settings;
        Task {
            robot: &self.solver.robot,
            frame: *self.solver.frame(),
            target,
            tolerance: [settings.position_tolerance_m, settings.orientation_tolerance_rad],
        }
    }

    fn deviation(&self, q: &JointVector) -> Deviation {
        Deviation::between(&self.solver.robot.fk(q).rigid(self.solver.frame()), &self.target)
    }

    /// Squared distance from the allowed deviations (m², rad²); missing clearance counts too.
    fn cost(&self, q: &JointVector) -> f64 {
        let beyond = self.beyond(q);
        let missing = |row: ClearanceRow| (row.required_m - row.distance_m).max(0.0);
        let rows: f64 = self.rows(q).into_iter().map(missing).map(|m| m * m).sum();
        beyond.norm_squared() + rows
    }

    /// Deviation less the nearest allowed one.
    fn beyond(&self, q: &JointVector) -> Vector6<f64> {
        let deviation = self.deviation(q);
        deviation.0 - deviation.allowed(&self.asked.freedom).0
    }

    fn rows(&self, q: &JointVector) -> Vec<ClearanceRow> {
        self.asked.clearance.map(|rows| rows(q)).unwrap_or_default()
    }

    /// Meets the exact pose of the allowed deviation next to `q`, within all bounds.
    fn polish(&mut self, q: &JointVector) -> Option<GeneralizedSolution> {
        let held = self.deviation(q).allowed(&self.asked.freedom);
        let task = self.task(held.applied_to(&self.target));
        let descent = dls::descend(&task, *q, &ALL_FREE, &self.solver.settings);
        let iterations = self.iterations + descent.iterations;
        let Iterate { q, .. } = descent.best;
        let within = (0..AXES).all(|i| self.lowest[i] <= q[i] && q[i] <= self.highest[i]);
        let clear = self.rows(&q).iter().all(|row| row.distance_m >= row.required_m);
        self.iterations = iterations;
        let v = held.0;
        (descent.stop == Stop::Solved && within && clear).then(|| GeneralizedSolution {
            q,
            position_m: [v[0], v[1], v[2]],
            tilt_rad: f64::sqrt(v[3] * v[3] + v[4] * v[4]),
            yaw_rad: v[5],
            iterations,
        })
    }

    /// Solves the convex program at `q`. Returns its joint step, or `None` unless it is solved.
    fn program(&self, q: &JointVector, cost: f64, boost: f64) -> Option<JointVector> {
        // Variables: Δq (6), p (3), s (2).
        const N: usize = AXES + 5;
        let bodies = self.solver.robot.fk(q);
        let frame = bodies.rigid(self.solver.frame());
        let jacobian = bodies.jacobian(self.solver.frame(), Axes::Base);
        let slope = Deviation::jacobian(&frame, &self.target, &jacobian);
        let lambda = (DAMPING_GAIN * cost).max(LEAST_DAMPING) * boost;
        let mut here = Deviation::between(&frame, &self.target).0;
        let mut m = DMatrix::zeros(6, N);
        m.view_mut((0, 0), (6, AXES)).copy_from(&slope);
        for i in 0..5 {
            m[(i, AXES + i)] = -1.0;
        }
        if self.asked.freedom.yaw == Yaw::Free {
            m.row_mut(5).fill(0.0);
            here[5] = 0.0;
        }
        let mut hessian = m.tr_mul(&m) * 2.0;
        for i in 0..N {
            hessian[(i, i)] += 2.0 * if i < AXES { lambda } else { 1e-9 };
        }
        let linear: DVector<f64> = m.tr_mul(&here) * 2.0;
        let (a, b, cones) = self.constraints(q, N);
        let settings = DefaultSettings {
            verbose: false,
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        let p = sparse(&hessian.upper_triangle());
        let mut solver = DefaultSolver::new(&p, linear.as_slice(), &sparse(&a), &b, &cones, settings).ok()?;
        solver.solve();
        let x = &solver.solution.x;
        (solver.solution.status == SolverStatus::Solved && x.len() == N)
            .then(|| JointVector::from_column_slice(&x[..AXES]))
    }

    /// Returns the constraints `A x + s = b` with s in the cones: bounds on the step, freedom of position and tilt, clearance.
    fn constraints(&self, q: &JointVector, n: usize) -> (DMatrix<f64>, Vec<f64>, Vec<SupportedConeT<f64>>) {
        let freedom = &self.asked.freedom;
        let step = self.solver.settings.step_bound_rad;
        let (mut equal, mut at_most): (Vec<Row>, Vec<Row>) = (Vec::new(), Vec::new());
        for j in 0..AXES {
            at_most.push((vec![(j, 1.0)], (self.highest[j] - q[j]).clamp(0.0, step)));
            at_most.push((vec![(j, -1.0)], (q[j] - self.lowest[j]).clamp(0.0, step)));
        }
        for (i, most) in freedom.position_m.into_iter().enumerate() {
            if most > 0.0 {
                at_most.push((vec![(AXES + i, 1.0)], most));
                at_most.push((vec![(AXES + i, -1.0)], most));
            } else {
                equal.push((vec![(AXES + i, 1.0)], 0.0));
            }
        }
        for row in self.rows(q) {
            let entries = (0..AXES).map(|j| (j, -row.gradient[j])).collect();
            // A row that is missing already only asks not to get worse: the program stays feasible.
            at_most.push((entries, (row.distance_m - row.required_m).max(0.0)));
        }
        let tilt: Vec<Row> = if freedom.tilt_rad > 0.0 {
            vec![
                (Vec::new(), freedom.tilt_rad),
                (vec![(AXES + 3, -1.0)], 0.0),
                (vec![(AXES + 4, -1.0)], 0.0),
            ]
        } else {
            equal.extend([3, 4].map(|i| (vec![(AXES + i, 1.0)], 0.0)));
            Vec::new()
        };
        let mut cones = vec![ZeroConeT(equal.len()), NonnegativeConeT(at_most.len())];
        cones.extend((!tilt.is_empty()).then_some(SecondOrderConeT(3)));
        let rows: Vec<_> = equal.into_iter().chain(at_most).chain(tilt).collect();
        let mut a = DMatrix::zeros(rows.len(), n);
        for (i, (entries, _)) in rows.iter().enumerate() {
            entries.iter().for_each(|&(j, value)| a[(i, j)] = value);
        }
        (a, rows.into_iter().map(|(_, bound)| bound).collect(), cones)
    }

    fn failure(&self) -> IkFailure {
        let q = self.best.1;
        let beyond = self.beyond(&q);
        let task = self.task(self.deviation(&q).allowed(&self.asked.freedom).applied_to(&self.target));
        IkFailure {
            q,
            iterations: self.iterations,
            cause: self.solver.cause(&task, &task.at(q)),
            limit_excess_rad: None,
            position_error_m: beyond.fixed_rows::<3>(0).norm(),
            orientation_error_rad: beyond.fixed_rows::<3>(3).norm(),
        }
    }
}

fn sparse(m: &DMatrix<f64>) -> CscMatrix<f64> {
    let (rows, columns) = m.shape();
    let mut starts = vec![0];
    let (mut indices, mut values) = (Vec::new(), Vec::new());
    for j in 0..columns {
        for i in (0..rows).filter(|&i| m[(i, j)] != 0.0) {
            indices.push(i);
            values.push(m[(i, j)]);
        }
        starts.push(indices.len());
    }
    CscMatrix::new(rows, columns, starts, indices, values)
}
