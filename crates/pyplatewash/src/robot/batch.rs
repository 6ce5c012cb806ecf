//! Forward kinematics, Jacobians and inverse kinematics, one at a time or in batches, straight into NumPy's arrays.

use crate::arrays::{self, JOINTS, MANY_POSES, Numbers, ONE_POSE};
use crate::errors;
use crate::exception::{self, Input};
use crate::pose;
use crate::robot::settings::origin;
use crate::work::{STRETCH, alone, patiently, released};
use bytemuck::Pod;
use nalgebra::{Matrix6, Quaternion};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn};
use platewash::kinematics::batch::{self, Backend, BatchError};
use platewash::kinematics::ik::AllBranchesError;
use platewash::kinematics::ik::analytic::AnalyticError;
use platewash::kinematics::model::manipulability as manipulability_of;
use platewash::{Axes, Frame, IkError, IkSolution, IkSolver, Jacobian, JointVector, Pose, RobotModel};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyType};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Number of rows before the first check for signals; doubled as long as the rows take less than [`PATIENCE`].
const FIRST_STRETCH: usize = 1 << 13;
const PATIENCE: Duration = Duration::from_millis(20);

static BATCH: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Arrays for the answers.
struct Columns<'py> {
    q: Bound<'py, PyArrayDyn<f64>>,
    solved: Bound<'py, PyArrayDyn<bool>>,
    iterations: Bound<'py, PyArrayDyn<i64>>,
    errors: [Bound<'py, PyArrayDyn<f64>>; 2],
}

/// See `Robot.ik_batch`.
pub fn solve<'py>(
    solver: &IkSolver<'_>,
    py: Python<'py>,
    targets: &Bound<'py, PyAny>,
    seeds: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let numbers = Numbers::read("targets", targets, MANY_POSES)?;
    let (matrices, _) = numbers.values()?.as_chunks::<16>();
    let n = matrices.len();
    let given = seeds.map(|seeds| Numbers::read("seeds", seeds, JOINTS)).transpose()?;
    let seeds = match &given {
        None => Seeds::One(JointVector::zeros()),
        Some(one) if one.stacked.is_none() => Seeds::One(finite(py, one.joints()?[0])?),
        Some(each) if each.stacked == Some(n) => Seeds::Each(each.joints()?),
        Some(other) => {
            let found = other.stacked.unwrap_or(0);
            let wanted = ["(6,)".to_owned(), format!("({n}, 6)")];
            return Err(exception::shape(py, "seeds", &[found, 6], &wanted));
        }
    };
    let columns = Columns {
        q: arrays::zeros(py, &[n, 6]),
        solved: arrays::zeros(py, &[n]),
        iterations: arrays::zeros(py, &[n]),
        errors: [arrays::zeros(py, &[n]), arrays::zeros(py, &[n])],
    };
    let problems = Problems {
        solver,
        matrices,
        seeds,
    };
    let causes = fill(py, &columns, &problems)?;
    let class = BATCH.import(py, "pyplatewash._records", "IkBatch")?;
    let [position, orientation] = columns.errors;
    class.call1((
        columns.q,
        columns.solved,
        columns.iterations,
        position,
        orientation,
        causes,
    ))
}

/// Fills the arrays on all threads, one stretch of rows after the other, with a check for Ctrl-C in between.
fn fill<'py>(py: Python<'py>, columns: &Columns<'py>, problems: &Problems<'_>) -> PyResult<Bound<'py, PyDict>> {
    let mut q: PyReadwriteArrayDyn<'_, f64> = columns.q.readwrite();
    let mut solved: PyReadwriteArrayDyn<'_, bool> = columns.solved.readwrite();
    let mut iterations: PyReadwriteArrayDyn<'_, i64> = columns.iterations.readwrite();
    let [position, orientation] = &columns.errors;
    let mut position: PyReadwriteArrayDyn<'_, f64> = position.readwrite();
    let mut orientation: PyReadwriteArrayDyn<'_, f64> = orientation.readwrite();
    let q: &mut [JointVector] = bytemuck::cast_slice_mut(q.as_slice_mut()?);
    let (solved, iterations) = (solved.as_slice_mut()?, iterations.as_slice_mut()?);
    let (position, orientation) = (position.as_slice_mut()?, orientation.as_slice_mut()?);
    let all = PyDict::new(py);
    let (mut first, mut stretch) = (0, FIRST_STRETCH);
    while first < q.len() {
        let now = first..q.len().min(first + stretch);
        let chunks = (
            q[now.clone()].par_chunks_mut(CHUNK),
            solved[now.clone()].par_chunks_mut(CHUNK),
            iterations[now.clone()].par_chunks_mut(CHUNK),
            position[now.clone()].par_chunks_mut(CHUNK),
            orientation[now.clone()].par_chunks_mut(CHUNK),
        );
        let begun = Instant::now();
        let done: Vec<_> = released(py, || {
            let chunks = chunks.into_par_iter().enumerate();
            let solve = |desk: &mut Desk, (k, (q, solved, iterations, position_error_m, orientation_error_rad))| {
                let mut rows = Rows {
                    first: now.start + k * CHUNK,
                    q,
                    solved,
                    iterations,
                    position_error_m,
                    orientation_error_rad,
                };
                rows.solve(desk, problems)
            };
            chunks.map_init(|| Desk::new(problems), solve).collect()
        })?;
        for causes in done {
            for (row, cause) in causes.map_err(|e| exception::internal(py, &e.to_string()))? {
                all.set_item(row, cause)?;
            }
        }
        py.check_signals()?;
        first = now.end;
        if begun.elapsed() < PATIENCE {
            stretch *= 2;
        }
    }
    Ok(all)
}

/// Returns the seed for all targets; refuses one that is not finite.
fn finite(py: Python<'_>, seed: JointVector) -> PyResult<JointVector> {
    match seed.iter().position(|v| !v.is_finite()) {
        None => Ok(seed),
        Some(joint) => {
            let problem = format!("joint {}: a finite number is needed; found {}", joint + 1, seed[joint]);
            Err(exception::input(py, "seeds", &problem))
        }
    }
}

/// Number of rows in a unit of work; their poses and answers fit in a processor's cache.
const CHUNK: usize = 512;

/// Indices of the rows that are not solved, each with the word for its cause.
pub type Causes = Vec<(usize, &'static str)>;

/// Seeds of a batch.
#[derive(Clone, Copy)]
pub enum Seeds<'a> {
    /// One seed for all targets.
    One(JointVector),
    /// One seed for each target.
    Each(&'a [JointVector]),
}

/// Inverse kinematics problems of one call.
#[derive(Clone, Copy)]
pub struct Problems<'a> {
    /// Solver for every target.
    pub solver: &'a IkSolver<'a>,
    /// Targets `T_base_frame`, row by row.
    pub matrices: &'a [[f64; 16]],
    /// Configurations from which the solver starts.
    pub seeds: Seeds<'a>,
}

/// Buffers of a thread, used again for chunk after chunk.
pub struct Desk {
    room: Vec<Quaternion<f64>>,
    targets: Vec<Pose>,
    seeds: Vec<JointVector>,
    answers: Vec<Result<IkSolution, IkError>>,
}

impl Desk {
    /// Buffers for the problems.
    #[must_use]
    pub fn new(problems: &Problems<'_>) -> Self {
        let not_yet = IkError::Target {
            position: [f64::NAN; 3],
        };
        Self {
            room: Vec::with_capacity(CHUNK),
            targets: Vec::with_capacity(CHUNK),
            seeds: match problems.seeds {
                Seeds::One(seed) => vec![seed; CHUNK],
                Seeds::Each(_) => Vec::new(),
            },
            answers: vec![Err(not_yet); CHUNK],
        }
    }
}

/// Places for the answers of neighbouring rows.
pub struct Rows<'a> {
    /// Index of the first.
    pub first: usize,
    /// Configurations \[rad\].
    pub q: &'a mut [JointVector],
    /// True where the target is reached.
    pub solved: &'a mut [bool],
    /// Linear systems and quadratic programs.
    pub iterations: &'a mut [i64],
    /// Distances \[m\].
    pub position_error_m: &'a mut [f64],
    /// Angles \[rad\].
    pub orientation_error_rad: &'a mut [f64],
}

impl Rows<'_> {
    /// Solves these rows, a unit of work.
    ///
    /// # Errors
    /// Buffers whose lengths do not match, which is a fault of this package.
    pub fn solve(&mut self, desk: &mut Desk, problems: &Problems<'_>) -> Result<Causes, BatchError> {
        let (first, n) = (self.first, self.q.len());
        let matrices = &problems.matrices[first..first + n];
        pose::poses(matrices, &mut desk.room, &mut desk.targets);
        let seeds = match problems.seeds {
            Seeds::One(_) => &desk.seeds[..n],
            Seeds::Each(seeds) => &seeds[first..first + n],
        };
        let answers = &mut desk.answers[..n];
        batch::solve_into(problems.solver, &desk.targets, seeds, answers, Backend::Detected)?;
        let mut causes = Causes::new();
        for (k, answer) in answers.iter().enumerate() {
            if let Some(cause) = self.put(k, answer) {
                causes.push((first + k, cause));
            }
        }
        Ok(causes)
    }

    /// Writes an answer down; the word for why it is none.
    fn put(&mut self, k: usize, answer: &Result<IkSolution, IkError>) -> Option<&'static str> {
        let not_a_number = JointVector::repeat(f64::NAN);
        let (q, iterations, [position, orientation], cause) = match answer {
            Ok(s) => (s.q, s.iterations, [s.position_error_m, s.orientation_error_rad], None),
            Err(IkError::NotSolved(f)) => {
                let missed = [f.position_error_m, f.orientation_error_rad];
                (f.q, f.iterations, missed, Some(errors::cause(&f.cause).0))
            }
            Err(IkError::Seed { .. }) => (not_a_number, 0, [f64::NAN; 2], Some("seed")),
            Err(_) => (not_a_number, 0, [f64::NAN; 2], Some("target")),
        };
        self.solved[k] = answer.is_ok();
        self.q[k] = q;
        self.iterations[k] = iterations as i64;
        (self.position_error_m[k], self.orientation_error_rad[k]) = (position, orientation);
        cause
    }
}

/// See `Robot.fk`.
pub fn fk<'py>(
    robot: &RobotModel,
    py: Python<'py>,
    q: &Bound<'py, PyAny>,
    frame: &Frame,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numbers = Numbers::read("q", q, JOINTS)?;
    let q = numbers.joints()?;
    let Some(count) = numbers.stacked else {
        let r = robot.fk(&q[0]).rigid(frame);
        let (m, t) = (&r.rotation, &r.translation);
        let rows = [
            m.m11, m.m12, m.m13, t.x, m.m21, m.m22, m.m23, t.y, m.m31, m.m32, m.m33, t.z, 0.0, 0.0, 0.0, 1.0,
        ];
        return arrays::array(py, &[4, 4], &rows);
    };
    filled(py, q, [count, 4, 4], |q, matrices: &mut [[f64; 16]]| {
        batch::fk_matrices_into(robot, frame, q, matrices, Backend::Detected)
    })
}

/// An array of a matrix for each configuration, filled stretch by stretch, with a check for Ctrl-C in between.
fn filled<'py, M: Pod + Send>(
    py: Python<'py>,
    q: &[JointVector],
    shape: [usize; 3],
    fill: impl Fn(&[JointVector], &mut [M]) -> Result<(), BatchError> + Sync,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let result = arrays::zeros::<f64>(py, &shape);
    let mut writable: PyReadwriteArrayDyn<'_, f64> = result.readwrite();
    let matrices: &mut [M] = bytemuck::cast_slice_mut(writable.as_slice_mut()?);
    for (q, matrices) in q.chunks(STRETCH).zip(matrices.chunks_mut(STRETCH)) {
        let done = released(py, || fill(q, matrices))?;
        done.map_err(|e| exception::internal(py, &e.to_string()))?;
        py.check_signals()?;
    }
    drop(writable);
    Ok(result)
}

/// See `Robot.jacobian`.
pub fn jacobian<'py>(
    robot: &RobotModel,
    py: Python<'py>,
    q: &Bound<'py, PyAny>,
    frame: &Frame,
    axes: Axes,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numbers = Numbers::read("q", q, JOINTS)?;
    let q = numbers.joints()?;
    let Some(count) = numbers.stacked else {
        let jacobian = robot.fk(&q[0]).jacobian(frame, axes);
        return arrays::array(py, &[6, 6], jacobian.transpose().as_slice());
    };
    filled(py, q, [count, 6, 6], |q, jacobians: &mut [Jacobian]| {
        batch::jacobian_into(robot, frame, q, axes, jacobians, Backend::Detected)?;
        // Rust's matrices lie column by column, NumPy's row by row.
        let chunks = jacobians.par_chunks_mut(CHUNK);
        chunks.for_each(|chunk| chunk.iter_mut().for_each(Matrix6::transpose_mut));
        Ok(())
    })
}

/// See `Robot.manipulability`.
pub fn manipulability<'py>(
    robot: &RobotModel,
    py: Python<'py>,
    q: &Bound<'py, PyAny>,
    frame: &Frame,
) -> PyResult<Bound<'py, PyAny>> {
    let numbers = Numbers::read("q", q, JOINTS)?;
    let q = numbers.joints()?;
    let of = |q| manipulability_of(&robot.fk(q).jacobian(frame, Axes::Base));
    if numbers.stacked.is_none() {
        return of(&q[0]).into_bound_py_any(py);
    }
    let all: Vec<f64> = released(py, || q.par_iter().with_min_len(CHUNK).map(of).collect())?;
    Ok(arrays::line(py, all).into_any())
}

/// See `Robot.limit_margins`.
pub fn limit_margins<'py>(
    robot: &RobotModel,
    py: Python<'py>,
    q: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numbers = Numbers::read("q", q, JOINTS)?;
    let margins: Vec<_> = numbers.joints()?.iter().map(|q| robot.limits().margins(q)).collect();
    match numbers.stacked {
        None => arrays::array(py, &[6], margins[0].as_slice()),
        Some(_) => arrays::joint_rows(py, &margins),
    }
}

static SOLUTION: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static BRANCHES: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// One pose, shape (4, 4).
fn target(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    let numbers = Numbers::read("target", value, ONE_POSE)?;
    pose::pose(numbers.values()?).map_err(|e| exception::input(value.py(), "target", &e.0))
}

fn seed(value: Option<&Bound<'_, PyAny>>, name: &'static str) -> PyResult<JointVector> {
    value.map_or_else(|| Ok(JointVector::zeros()), |value| arrays::joint_vector(name, value))
}

/// Poses from matrices, shape (N, 4, 4); the error has the index of a matrix that is no pose.
fn poses(matrices: &[[f64; 16]]) -> Result<Vec<Pose>, (usize, Input)> {
    let all = matrices.par_iter().with_min_len(512).enumerate();
    all.map(|(k, m)| pose::pose(m).map_err(|e| (k, e))).collect()
}

/// Error for a target that is no pose.
fn no_pose(py: Python<'_>, (k, e): (usize, Input)) -> PyErr {
    exception::input(py, "targets", &format!("in pose {k}: {e}"))
}

/// See `Robot.ik`.
pub fn one<'py>(
    solver: &IkSolver<'_>,
    py: Python<'py>,
    to: &Bound<'py, PyAny>,
    from: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (to, from) = (target(to)?, seed(from, "seed")?);
    let answer = alone(py, || solver.solve(&to, &from))?.map_err(|e| errors::ik(py, &e))?;
    let (method, start) = origin(&answer);
    let errors = (answer.position_error_m, answer.orientation_error_rad);
    let q = arrays::array(py, &[6], answer.q.as_slice())?;
    let class = SOLUTION.import(py, "pyplatewash._records", "IkSolution")?;
    class.call1((q, answer.iterations, method, start, errors.0, errors.1))
}

/// See `Robot.ik_all`.
pub fn all<'py>(
    solver: &IkSolver<'_>,
    py: Python<'py>,
    to: &Bound<'py, PyAny>,
    previous: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (to, previous) = (target(to)?, seed(previous, "previous")?);
    let answer = alone(py, || solver.solve_all(&to, &previous))?;
    let answer = answer.map_err(|e| no_branches(py, &e))?;
    let (labels, q): (Vec<_>, Vec<_>) = answer.configurations().map(|(label, q)| (label.to_string(), q)).unzip();
    let rejections = PyDict::new(py);
    for (label, why) in answer.rejections() {
        rejections.set_item(label.to_string(), why.to_string())?;
    }
    let class = BRANCHES.import(py, "pyplatewash._records", "IkBranches")?;
    class.call1((arrays::joint_rows(py, &q)?, labels, rejections))
}

/// Names the argument for which there are no branches.
fn no_branches(py: Python<'_>, error: &AllBranchesError) -> PyErr {
    let argument = match error {
        AllBranchesError::NotAnalytic(_) => "robot",
        AllBranchesError::Frame => "frame",
        AllBranchesError::Input(AnalyticError::Start { .. }) => "previous",
        _ => "target",
    };
    exception::input(py, argument, &error.to_string())
}

/// See `Robot.ik_path`.
pub fn path<'py>(
    solver: Arc<IkSolver<'static>>,
    py: Python<'py>,
    targets: &Bound<'py, PyAny>,
    from: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numbers = Numbers::read("targets", targets, MANY_POSES)?;
    let (matrices, _) = numbers.values()?.as_chunks::<16>();
    let from = seed(from, "seed")?;
    let targets = released(py, || poses(matrices))?.map_err(|e| no_pose(py, e))?;
    let answer = patiently(py, move |_| solver.solve_path(&targets, &from))?;
    arrays::joint_rows(py, &answer.map_err(|e| errors::ik_path(py, &e))?.q)
}
