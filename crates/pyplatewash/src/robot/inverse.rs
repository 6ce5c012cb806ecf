//! Inverse kinematics: one target, all branches, a path.

use super::settings::IkSolutionRecord;
use crate::arrays::{self, MANY_POSES, Numbers, ONE_POSE};
use crate::errors::{self, Input};
use crate::work::{alone, patiently, released};
use crate::{made, pose};
use numpy::PyArrayDyn;
use platewash::kinematics::ik::AllBranchesError;
use platewash::kinematics::ik::analytic::{AnalyticError, Label};
use platewash::{IkSolver, JointVector, Pose};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyType};
use rayon::prelude::*;
use std::sync::Arc;

static BRANCHES: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// One pose, shape (4, 4).
fn target(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    let numbers = Numbers::read("target", value, ONE_POSE)?;
    pose::pose(numbers.values()?).map_err(|e| errors::input(value.py(), "target", &e.0))
}

fn seed(value: Option<&Bound<'_, PyAny>>, name: &'static str) -> PyResult<JointVector> {
    value.map_or_else(|| Ok(JointVector::zeros()), |value| arrays::joint_vector(name, value))
}

/// Poses, shape (N, 4, 4); the first that is none is named.
fn poses(matrices: &[[f64; 16]]) -> Result<Vec<Pose>, (usize, Input)> {
    let all = matrices.par_iter().with_min_len(512).enumerate();
    all.map(|(k, m)| pose::pose(m).map_err(|e| (k, e))).collect()
}

/// A target that is no pose.
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
    let answer = answer.map_err(|e| no_branches(py, &e))?;
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
    class.call1((made::joint_rows(py, &q)?, labels, rejections))
}

/// Names the argument for which there are no branches.
fn no_branches(py: Python<'_>, error: &AllBranchesError) -> PyErr {
    let argument = match error {
        AllBranchesError::NotAnalytic(_) => "robot",
        AllBranchesError::Frame => "frame",
        AllBranchesError::Input(AnalyticError::Start { .. }) => "previous",
        _ => "target",
    };
    errors::input(py, argument, &error.to_string())
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
    made::joint_rows(py, &answer.map_err(|e| errors::ik_path(py, &e))?.q)
}
