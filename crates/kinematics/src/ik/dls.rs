//! Damped least squares: `Δq = (JᵀJ + λI)⁻¹ Jᵀ e`.
//!
//! Damping of the least-squares step.
//!
//! The 6 × 6 symmetric positive definite system of every damped step, by LDLᵀ without square roots.
//!
//! The pose error and its Jacobian at one configuration.

#![allow(clippy::needless_range_loop)] // a row's or a joint's number indexes several arrays at once

use crate::ik::settings::IkSettings;
use crate::joints::{AXES, JointVector};
use crate::lanes::{Kernel, LANES, Vector, run_exact};
use crate::model::RobotModel;
use crate::model::{Axes, Frame, Jacobian, moved_bodies};
use crate::rotation::{Columns, RigidTransform, rotation_vector};
use nalgebra::{Matrix3, Vector6};

/// Damping of a step as a share of the squared error ‖e‖² (in m and rad): the λ of `(JᵀJ + λI) Δq = Jᵀe` is strong far from the target and
/// vanishes at it, so that convergence is quadratic (Sugihara, *IEEE Trans. Robotics* 2011). A step that does not reduce the error raises it
/// tenfold, and accepted steps let it fall again (Levenberg–Marquardt).
pub(crate) const DAMPING_GAIN: f64 = 0.3;
/// Smallest damping: keeps the normal matrix definite at an exact singularity without slowing convergence.
pub(crate) const LEAST_DAMPING: f64 = 1e-11;
/// Ratio of squared errors above which the descent stagnates: the error norm fell by less than 10 % (its square by less than 19 %) within
/// [`STAGNATION_WINDOW`] iterations.
const STAGNATION_RATIO: f64 = 0.81;
/// Number of iterations over which stagnation is judged.
const STAGNATION_WINDOW: usize = 8;
/// Number of accepted steps in a row that were clamped, from which on a limit counts as active.
pub(crate) const CLAMPED_IN_A_ROW: usize = 3;

/// Joints that may move; the others keep their positions.
pub(crate) type FreeJoints = [bool; AXES];

/// Every joint may move.
pub(crate) const ALL_FREE: FreeJoints = [true; AXES];

/// Descends from `start` (within the limits) moving the free joints only.
pub(crate) fn descend(task: &Task<'_>, start: JointVector, free: &FreeJoints, settings: &IkSettings) -> Descent {
    descend_below(f64::INFINITY, task, start, free, settings)
}

/// The same, unless the squared error at the start is above `coldest`: then the descent stops there.
pub(crate) fn descend_below(
    coldest: f64,
    task: &Task<'_>,
    start: JointVector,
    free: &FreeJoints,
    settings: &IkSettings,
) -> Descent {
    run_exact(Descending {
        coldest,
        task,
        start,
        free,
        settings,
    })
}

/// Descent, compiled for several instruction sets.
#[derive(Clone)]
struct Descending<'a> {
    coldest: f64,
    task: &'a Task<'a>,
    start: JointVector,
    free: &'a FreeJoints,
    settings: &'a IkSettings,
}

impl Kernel for Descending<'_> {
    type Output = Descent;

    #[inline(always)]
    fn run<V: Vector>(self) -> Descent {
        let (task, settings, limits) = (self.task, self.settings, self.task.robot.limits());
        let (mut here, mut lines) = task.evaluate::<V>(self.start);
        let mut boost = 1.0;
        let mut clamped = 0;
        let mut milestone = here.cost;
        let mut iterations = 0;
        let stop = loop {
            if here.cost > self.coldest && iterations == 0 {
                break Stop::Cold;
            }
            if task.solved(&here) {
                break Stop::Solved;
            }
            if iterations >= settings.max_iterations {
                break Stop::Iterations;
            }
            if clamped >= CLAMPED_IN_A_ROW {
                break Stop::ActiveLimit;
            }
            if iterations > 0 && iterations % STAGNATION_WINDOW == 0 {
                if here.cost > milestone * STAGNATION_RATIO {
                    break Stop::Stagnation;
                }
                milestone = here.cost;
            }
            let lambda = (DAMPING_GAIN * here.cost).max(LEAST_DAMPING);
            let jacobian = lines.jacobian().only(self.free);
            let Some(step) = jacobian.step(&here.error, lambda * boost) else {
                break Stop::Stagnation;
            };
            let aim = here.q + bounded(step, settings.step_bound_rad);
            let (next, next_lines) = task.evaluate::<V>(limits.clamp(&aim));
            if next.cost < here.cost {
                clamped = if next.q == aim { 0 } else { clamped + 1 };
                boost = f64::max(boost * 0.1, 1.0);
                (here, lines) = (next, next_lines);
            } else {
                boost *= 10.0;
            }
            iterations += 1;
        };
        Descent {
            best: here,
            iterations,
            stop,
        }
    }
}

/// Returns the step shortened so that no joint moves more than `bound` \[rad\]; its direction is kept.
#[inline(always)]
fn bounded(step: JointVector, bound: f64) -> JointVector {
    let largest = step.amax();
    if largest > bound {
        step * (bound / largest)
    } else {
        step
    }
}

const N: usize = 6;

/// Solves `A x = b` for symmetric positive definite `A` (column by column; its lower triangle is read); `None` when a pivot is not positive
/// (an indefinite matrix, or NaN).
///
/// `A = L D Lᵀ` column by column, then two triangular solves (Golub & Van Loan, *Matrix Computations*, §4.1.2). One
/// division per pivot; the bounds are constants, so that the compiler unrolls everything.
#[inline(always)]
fn solve_spd(a: &[[f64; 2 * LANES]; N], b: [f64; N]) -> Option<[f64; N]> {
    let mut l = *a;
    let mut inverse = [0.0; N];
    for j in 0..N {
        let pivot = l[j][j];
        // Written so that NaN fails too.
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        inverse[j] = 1.0 / pivot;
        for i in j + 1..N {
            let scaled = l[j][i] * inverse[j];
            for k in j + 1..i + 1 {
                l[k][i] -= scaled * l[j][k];
            }
        }
    }
    // Column j of `l` below the diagonal now holds L times the pivot.
    let mut x = b;
    for j in 0..N {
        let y = x[j] * inverse[j];
        for i in j + 1..N {
            x[i] -= l[j][i] * y;
        }
    }
    for j in (0..N).rev() {
        let mut sum = x[j];
        for i in j + 1..N {
            sum -= l[j][i] * x[i];
        }
        x[j] = sum * inverse[j];
    }
    Some(x)
}

/// Distance from a limit below which a joint counts as standing on it \[rad\].
pub(crate) const ON_LIMIT_RAD: f64 = 1e-6;

/// Inverse-kinematics problem: an arm, a frame on it, and the target pose of that frame.
pub(crate) struct Task<'a> {
    pub robot: &'a RobotModel,
    pub frame: Frame,
    pub target: RigidTransform,
    /// Tolerances on position \[m\] and orientation \[rad\].
    pub tolerance: [f64; 2],
}

/// Configuration with its error.
#[derive(Clone, Copy)]
pub(crate) struct Iterate {
    pub q: JointVector,
    /// Error `e = (p* − p, log(R* Rᵀ))`, metres and radians in base axes.
    pub error: Vector6<f64>,
    /// Squared error `‖e‖²`.
    pub cost: f64,
}

/// Evaluation of the error, compiled for several instruction sets.
struct Evaluation<'a> {
    task: &'a Task<'a>,
    q: JointVector,
}

impl Kernel for Evaluation<'_> {
    type Output = Iterate;

    #[inline(always)]
    fn run<V: Vector>(self) -> Iterate {
        self.task.evaluate::<V>(self.q).0
    }
}

impl Task<'_> {
    pub fn at(&self, q: JointVector) -> Iterate {
        run_exact(Evaluation { task: self, q })
    }

    /// Returns the error at `q` and the lines of the joints.
    #[inline(always)]
    fn evaluate<V: Vector>(&self, q: JointVector) -> (Iterate, JointLines<V>) {
        let (tip, lines) = JointLines::<V>::with_pose(self.robot, &self.frame, &q);
        let (position, rotation) = (&self.target.translation, self.target.rotation.as_slice());
        let [x, y, z] = [
            [rotation[0], rotation[1], rotation[2], 0.0],
            [rotation[3], rotation[4], rotation[5], 0.0],
            [rotation[6], rotation[7], rotation[8], 0.0],
        ];
        let (x, y, z) = (V::from_array(x), V::from_array(y), V::from_array(z));
        let linear = (V::from_array([position.x, position.y, position.z, 0.0]) - tip.origin).to_array();
        let (a, b, c) = (tip.axes[0].to_array(), tip.axes[1].to_array(), tip.axes[2].to_array());
        // `R* Rᵀ`, column by column.
        let d = (x * V::splat(a[0]) + y * V::splat(b[0]) + z * V::splat(c[0])).to_array();
        let e = (x * V::splat(a[1]) + y * V::splat(b[1]) + z * V::splat(c[1])).to_array();
        let f = (x * V::splat(a[2]) + y * V::splat(b[2]) + z * V::splat(c[2])).to_array();
        let angular = rotation_vector(&Matrix3::new(d[0], e[0], f[0], d[1], e[1], f[1], d[2], e[2], f[2]));
        let error = Vector6::new(linear[0], linear[1], linear[2], angular.x, angular.y, angular.z);
        let cost = error.norm_squared();
        (Iterate { q, error, cost }, lines)
    }

    pub fn jacobian(&self, iterate: &Iterate) -> Jacobian {
        self.robot.fk(&iterate.q).jacobian(&self.frame, Axes::Base)
    }

    #[inline(always)]
    pub fn solved(&self, iterate: &Iterate) -> bool {
        iterate.position_error() <= self.tolerance[0] && iterate.orientation_error() <= self.tolerance[1]
    }
}

impl Iterate {
    /// Distance from the target \[m\].
    #[inline(always)]
    pub fn position_error(&self) -> f64 {
        self.error.fixed_rows::<3>(0).norm_squared().sqrt()
    }

    /// Angle from the target \[rad\].
    #[inline(always)]
    pub fn orientation_error(&self) -> f64 {
        self.error.fixed_rows::<3>(3).norm_squared().sqrt()
    }
}

/// Axes of the joints, a point on each, and the tip that they move \[m\]; zero for joints that do not move it.
#[derive(Clone, Copy)]
struct JointLines<V> {
    axes: [V; AXES],
    points: [V; AXES],
    tip: V,
}

impl<V: Vector> JointLines<V> {
    /// Returns the pose of `frame` at `q` and the lines of the joints between it and the base.
    #[inline(always)]
    fn with_pose(robot: &RobotModel, frame: &Frame, q: &JointVector) -> (Columns<V>, Self) {
        let bodies = moved_bodies::<V>(robot, q);
        let mut body = Columns::<V>::identity();
        let (mut axes, mut points) = ([V::splat(0.0); AXES], [V::splat(0.0); AXES]);
        for (i, moved) in bodies.into_iter().enumerate().take(frame.body()) {
            body = moved;
            (axes[i], points[i]) = (body.axes[2], body.origin);
        }
        let tip = body.then(&frame.offset);
        (
            tip,
            Self {
                axes,
                points,
                tip: tip.origin,
            },
        )
    }

    /// Returns the geometric Jacobian in base axes, as [`BodyPoses::jacobian`](crate::BodyPoses::jacobian) does.
    #[inline(always)]
    fn jacobian(&self) -> Rows<V> {
        let zero = V::splat(0.0);
        let ([a, b, c, d, e, f], [g, h, i, j, k, l]) = (self.axes, self.points);
        let axes = [V::transposed([a, b, c, d]), V::transposed([e, f, zero, zero])];
        let points = [V::transposed([g, h, i, j]), V::transposed([k, l, zero, zero])];
        let tip = self.tip.to_array();
        let mut rows = [[zero; 2]; AXES];
        for half in 0..2 {
            let ([x, y, z, _], p) = (axes[half], points[half]);
            let lever = [
                V::splat(tip[0]) - p[0],
                V::splat(tip[1]) - p[1],
                V::splat(tip[2]) - p[2],
            ];
            rows[0][half] = y * lever[2] - z * lever[1];
            rows[1][half] = z * lever[0] - x * lever[2];
            rows[2][half] = x * lever[1] - y * lever[0];
            (rows[3][half], rows[4][half], rows[5][half]) = (x, y, z);
        }
        Rows(rows)
    }
}

/// Jacobian row by row: four joints in a vector, then two.
#[derive(Clone, Copy)]
struct Rows<V>([[V; 2]; AXES]);

impl<V: Vector> Rows<V> {
    /// Returns one row; the last two entries are no joints'.
    #[inline(always)]
    fn row(&self, k: usize) -> [f64; 2 * LANES] {
        let ([a, b, c, d], [e, f, g, h]) = (self.0[k][0].to_array(), self.0[k][1].to_array());
        [a, b, c, d, e, f, g, h]
    }

    /// Returns the Jacobian with zeros in the columns of joints that are not free.
    #[inline(always)]
    fn only(mut self, free: &FreeJoints) -> Self {
        if *free == ALL_FREE {
            return self;
        }
        let kept = |joint: usize| f64::from_bits(if free[joint] { u64::MAX } else { 0 });
        let low = V::from_array([kept(0), kept(1), kept(2), kept(3)]);
        let high = V::from_array([kept(4), kept(5), 0.0, 0.0]);
        for k in 0..AXES {
            self.0[k] = [self.0[k][0].and(low), self.0[k][1].and(high)];
        }
        self
    }

    /// Returns the damped step; `None` if the normal matrix is not positive definite (NaN).
    #[inline(always)]
    fn step(&self, error: &Vector6<f64>, lambda: f64) -> Option<JointVector> {
        // Row after row, from zero: the order in which `Matrix6::tr_mul` adds.
        let zero = V::splat(0.0);
        let mut entries = [[0.0; 2 * LANES]; AXES];
        for k in 0..AXES {
            entries[k] = self.row(k);
        }
        let mut normal = [[0.0; 2 * LANES]; AXES];
        for joint in 0..AXES {
            let mut column = [zero; 2];
            for k in 0..AXES {
                let entry = V::splat(entries[k][joint]);
                column = [column[0] + self.0[k][0] * entry, column[1] + self.0[k][1] * entry];
            }
            normal[joint][..LANES].copy_from_slice(&column[0].to_array());
            normal[joint][LANES..].copy_from_slice(&column[1].to_array());
        }
        for joint in 0..AXES {
            normal[joint][joint] += lambda;
        }
        let mut gradient = [zero; 2];
        for k in 0..AXES {
            let entry = V::splat(error[k]);
            gradient = [gradient[0] + self.0[k][0] * entry, gradient[1] + self.0[k][1] * entry];
        }
        let ([a, b, c, d], [e, f, ..]) = (gradient[0].to_array(), gradient[1].to_array());
        solve_spd(&normal, [a, b, c, d, e, f]).map(Vector6::from)
    }
}

/// Reason that a descent stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The error is within both tolerances.
    Solved,
    /// The error hardly falls any more.
    Stagnation,
    /// Steps keep being clamped to a limit.
    ActiveLimit,
    /// The iterations ran out.
    Iterations,
    /// The start is too far away.
    Cold,
}

/// Stop of a descent.
pub(crate) struct Descent {
    pub best: Iterate,
    pub iterations: usize,
    pub stop: Stop,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::tests::portable_and_exact;
    use nalgebra::Matrix6;
    use proptest::prelude::*;

    fn solved(a: &Matrix6<f64>, b: &Vector6<f64>) -> Option<Vector6<f64>> {
        let columns = std::array::from_fn(|j| std::array::from_fn(|i| if i < N { a[(i, j)] } else { f64::NAN }));
        solve_spd(&columns, (*b).into()).map(Vector6::from)
    }

    proptest! {
        #[test]
        fn descents_have_the_same_bits_on_all_instructions(
            q in prop::array::uniform6(-1.5..1.5f64),
            off in prop::array::uniform6(-0.2..0.2f64),
            free in prop::array::uniform6(prop_oneof![4 => Just(true), 1 => Just(false)]),
        ) {
            let robot = RobotModel::irb120().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let q = JointVector::from(q);
            let (frame, settings) = (robot.last_link_frame(), IkSettings::default());
            let task = Task { robot: &robot, frame, target: robot.fk(&q).rigid(&frame), tolerance: [1e-9; 2] };
            let start = robot.limits().clamp(&(q + JointVector::from(off)));
            let descending = Descending { coldest: 1.0, task: &task, start, free: &free, settings: &settings };
            let [portable, exact] = portable_and_exact(&descending);
            prop_assert_eq!(portable.best.q, exact.best.q);
            prop_assert_eq!(portable.best.error, exact.best.error);
            prop_assert_eq!((portable.iterations, portable.stop), (exact.iterations, exact.stop));
        }
    }

    proptest! {
        #[test]
        fn agrees_with_a_general_solver(entries in prop::collection::vec(-1.0..1.0f64, 36), b in prop::collection::vec(-1.0..1.0f64, 6)) {
            let m = Matrix6::from_row_slice(&entries);
            let a = m.tr_mul(&m) + Matrix6::from_diagonal_element(1e-3);
            let b = Vector6::from_row_slice(&b);
            let expected = a.lu().solve(&b).ok_or_else(|| TestCaseError::fail("singular"))?;
            let x = solved(&a, &b).ok_or_else(|| TestCaseError::fail("not positive"))?;
            prop_assert!((x - expected).amax() < 1e-9 * (1.0 + expected.amax()));
        }
    }

    #[test]
    fn rejects_matrices_that_are_not_positive_definite() {
        let mut a = Matrix6::identity();
        a[(3, 3)] = -1.0;
        assert_eq!(solved(&a, &Vector6::zeros()), None);
        a[(3, 3)] = f64::NAN;
        assert_eq!(solved(&a, &Vector6::zeros()), None);
    }
}
