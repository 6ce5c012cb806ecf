//! Inverse kinematics: one target, all branches, a path, a batch.

use super::settings::IkSolutionRecord;
use crate::arrays::{self, JOINTS, MANY_POSES, Numbers, ONE_POSE};
use crate::errors::{self, Input};
use crate::work::{alone, patiently, released};
use numpy::PyArrayDyn;
use platewash::kinematics::batch::{self, Path};
use platewash::kinematics::ik::analytic::Label;
use platewash::{IkError, IkSolution, IkSolver, JointVector, Pose};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyType};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Targets of a batch between the first two looks for signals; doubled as long as they take less than [`PATIENCE`].
const FIRST_STRETCH: usize = 1024;
/// Most targets between two looks for signals, so that their answers stay in the processor's caches.
const LAST_STRETCH: usize = 8192;
const PATIENCE: Duration = Duration::from_millis(50);

static BATCH: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static BRANCHES: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// One pose, shape (4, 4).
fn target(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    let numbers = Numbers::read("target", value, ONE_POSE)?;
    arrays::pose(numbers.values()?).map_err(|e| errors::input(value.py(), "target", &e.0))
}

fn seed(value: Option<&Bound<'_, PyAny>>, name: &'static str) -> PyResult<JointVector> {
    value.map_or_else(|| Ok(JointVector::zeros()), |value| arrays::joint_vector(name, value))
}

/// Poses, shape (N, 4, 4); the first that is none is named.
fn poses(matrices: &[[f64; 16]]) -> Result<Vec<Pose>, (usize, Input)> {
    let all = matrices.par_iter().with_min_len(512).enumerate();
    all.map(|(k, m)| arrays::pose(m).map_err(|e| (k, e))).collect()
}

fn no_pose(py: Python<'_>, (k, e): (usize, Input)) -> PyErr {
    errors::input(py, "targets", &format!("in pose {k}: {e}"))
}

/// See `Robot.ik`.
pub fn one(
    solver: &IkSolver<'_>,
    py: Python<'_>,
    to: &Bound<'_, PyAny>,
    from: Option<&Bound<'_, PyAny>>,
) -> PyResult<IkSolutionRecord> {
    let (to, from) = (target(to)?, seed(from, "seed")?);
    let answer = alone(py, || solver.solve(&to, &from))?;
    answer
        .map(|s| IkSolutionRecord::from(&s))
        .map_err(|e| errors::ik(py, &e))
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
    let answer = answer.map_err(|e| errors::input(py, "ik_all", &e.to_string()))?;
    let name = |label: Label| {
        let words = [
            format!("{:?}", label.shoulder),
            format!("{:?}", label.elbow),
            format!("{:?}", label.wrist),
        ];
        words.map(|word| word.to_lowercase()).join(" ")
    };
    let (labels, q): (Vec<_>, Vec<_>) = answer.configurations().map(|(label, q)| (name(label), q)).unzip();
    let rejections = PyDict::new(py);
    for (label, why) in answer.rejections() {
        rejections.set_item(name(label), why.to_string())?;
    }
    let class = BRANCHES.import(py, "pyplatewash._records", "IkBranches")?;
    class.call1((arrays::joint_rows(py, &q)?, labels, rejections))
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

/// What a batch came to, column by column.
#[derive(Default)]
struct Columns {
    q: Vec<JointVector>,
    solved: Vec<bool>,
    iterations: Vec<i64>,
    position_error_m: Vec<f64>,
    orientation_error_rad: Vec<f64>,
    /// Rows that are not solved, with the word for the cause.
    causes: Vec<(usize, &'static str)>,
}

impl Columns {
    fn with_capacity(n: usize) -> Self {
        Self {
            q: Vec::with_capacity(n),
            solved: Vec::with_capacity(n),
            iterations: Vec::with_capacity(n),
            position_error_m: Vec::with_capacity(n),
            orientation_error_rad: Vec::with_capacity(n),
            causes: Vec::new(),
        }
    }

    /// Notes one answer; an input error is given back.
    fn push(&mut self, answer: &Result<IkSolution, IkError>) -> Result<(), IkError> {
        let (q, iterations, position, orientation) = match answer {
            Ok(s) => (s.q, s.iterations, s.position_error_m, s.orientation_error_rad),
            Err(IkError::NotSolved(f)) => {
                self.causes.push((self.q.len(), errors::cause(&f.cause).0));
                (f.q, f.iterations, f.position_error_m, f.orientation_error_rad)
            }
            Err(other) => return Err(other.clone()),
        };
        self.q.push(q);
        self.solved.push(answer.is_ok());
        self.iterations.push(iterations as i64);
        self.position_error_m.push(position);
        self.orientation_error_rad.push(orientation);
        Ok(())
    }

    fn into_python<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let causes = PyDict::new(py);
        for (row, cause) in &self.causes {
            causes.set_item(row, cause)?;
        }
        let class = BATCH.import(py, "pyplatewash._records", "IkBatch")?;
        class.call1((
            arrays::joint_rows(py, &self.q)?,
            arrays::line(py, self.solved),
            arrays::line(py, self.iterations),
            arrays::line(py, self.position_error_m),
            arrays::line(py, self.orientation_error_rad),
            causes,
        ))
    }
}

/// See `Robot.ik_batch`.
pub fn batch<'py>(
    solver: &IkSolver<'_>,
    py: Python<'py>,
    targets: &Bound<'py, PyAny>,
    seeds: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let numbers = Numbers::read("targets", targets, MANY_POSES)?;
    let (matrices, _) = numbers.values()?.as_chunks::<16>();
    let given = seeds.map(|seeds| Numbers::read("seeds", seeds, JOINTS)).transpose()?;
    let one_seed = match &given {
        None => Some(JointVector::zeros()),
        Some(seeds) if seeds.stacked.is_none() => Some(seeds.joints()?[0]),
        Some(seeds) if seeds.stacked == Some(matrices.len()) => None,
        Some(_) => return Err(seed_count(py, &given, matrices.len())),
    };
    let seeds = match &given {
        Some(seeds) if one_seed.is_none() => seeds.joints()?,
        _ => &[],
    };
    let mut columns = Columns::with_capacity(matrices.len());
    let (mut done, mut stretch) = (0, FIRST_STRETCH);
    let mut repeated = Vec::new();
    while done < matrices.len() {
        let next = (done + stretch).min(matrices.len());
        let begun = Instant::now();
        let from = match one_seed {
            Some(seed) => {
                repeated.resize(next - done, seed);
                &repeated[..next - done]
            }
            None => &seeds[done..next],
        };
        let to = &matrices[done..next];
        let answers = released(py, || {
            poses(to).map(|targets| batch::solve(solver, &targets, from, Path::Detected))
        })?;
        let answers = answers.map_err(|(k, e)| no_pose(py, (done + k, e)))?;
        for (k, answer) in answers
            .map_err(|e| errors::internal(py, &e.to_string()))?
            .iter()
            .enumerate()
        {
            let wrong = |e: IkError| errors::input(py, "seeds", &format!("in row {}: {e}", done + k));
            columns.push(answer).map_err(wrong)?;
        }
        py.check_signals()?;
        done = next;
        if begun.elapsed() < PATIENCE {
            stretch = (2 * stretch).min(LAST_STRETCH);
        }
    }
    columns.into_python(py)
}

fn seed_count(py: Python<'_>, seeds: &Option<Numbers<'_>>, targets: usize) -> PyErr {
    let found = seeds.as_ref().and_then(|s| s.stacked).unwrap_or(0);
    errors::shape(
        py,
        "seeds",
        &[found, 6],
        &["(6,)".to_owned(), format!("({targets}, 6)")],
    )
}
