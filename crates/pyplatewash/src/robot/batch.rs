//! Inverse kinematics of many targets, straight into NumPy's arrays.

use super::rows::{Desk, Problems, Rows, Seeds};
use crate::arrays::{JOINTS, MANY_POSES, Numbers};
use crate::work::released;
use crate::{errors, made};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn};
use platewash::{IkSolver, JointVector};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyType};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Rows between the first two looks for signals; doubled as long as they take less than [`PATIENCE`].
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
            return Err(errors::shape(py, "seeds", &[found, 6], &wanted));
        }
    };
    let columns = Columns {
        q: made::zeros(py, &[n, 6]),
        solved: made::zeros(py, &[n]),
        iterations: made::zeros(py, &[n]),
        errors: [made::zeros(py, &[n]), made::zeros(py, &[n])],
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

/// Fills the arrays, stretch by stretch, on all threads; Ctrl-C is looked for in between.
fn fill<'py>(py: Python<'py>, columns: &Columns<'py>, problems: &Problems<'_>) -> PyResult<Bound<'py, PyDict>> {
    let mut q: PyReadwriteArrayDyn<'_, f64> = columns.q.readwrite();
    let mut solved: PyReadwriteArrayDyn<'_, bool> = columns.solved.readwrite();
    let mut iterations: PyReadwriteArrayDyn<'_, i64> = columns.iterations.readwrite();
    let [position, orientation] = &columns.errors;
    let mut position: PyReadwriteArrayDyn<'_, f64> = position.readwrite();
    let mut orientation: PyReadwriteArrayDyn<'_, f64> = orientation.readwrite();
    let mut rest = Rows {
        first: 0,
        q: bytemuck::cast_slice_mut(q.as_slice_mut()?),
        solved: solved.as_slice_mut()?,
        iterations: iterations.as_slice_mut()?,
        position_error_m: position.as_slice_mut()?,
        orientation_error_rad: orientation.as_slice_mut()?,
    };
    let all = PyDict::new(py);
    let mut stretch = FIRST_STRETCH;
    while !rest.q.is_empty() {
        let n = stretch.min(rest.q.len());
        let (now, later) = rest.split(n);
        rest = later;
        let begun = Instant::now();
        let done: Vec<_> = released(py, || {
            let chunks = now.chunks().into_par_iter();
            chunks
                .map_init(|| Desk::new(problems), |desk, mut rows| rows.solve(desk, problems))
                .collect()
        })?;
        for causes in done {
            for (row, cause) in causes.map_err(|e| errors::internal(py, &e.to_string()))? {
                all.set_item(row, cause)?;
            }
        }
        py.check_signals()?;
        if begun.elapsed() < PATIENCE {
            stretch *= 2;
        }
    }
    Ok(all)
}

/// A seed for all targets must be one.
fn finite(py: Python<'_>, seed: JointVector) -> PyResult<JointVector> {
    match seed.iter().position(|v| !v.is_finite()) {
        None => Ok(seed),
        Some(joint) => {
            let problem = format!("joint {}: a finite number is needed; found {}", joint + 1, seed[joint]);
            Err(errors::input(py, "seeds", &problem))
        }
    }
}
