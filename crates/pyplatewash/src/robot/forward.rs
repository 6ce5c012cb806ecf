//! Forward kinematics and Jacobians, one at a time or in batches.

use crate::arrays::{JOINTS, Numbers};
use crate::made;
use crate::work::{STRETCH, released};
use nalgebra::Matrix6;
use numpy::{PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn};
use platewash::kinematics::batch::{self, Backend};
use platewash::kinematics::model::manipulability as manipulability_of;
use platewash::{Axes, Frame, Jacobian, RobotModel};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use rayon::prelude::*;

/// Matrices to a unit of work.
const CHUNK: usize = 512;

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
        return made::array(py, &[4, 4], &rows);
    };
    let poses = made::zeros::<f64>(py, &[count, 4, 4]);
    let mut writable: PyReadwriteArrayDyn<'_, f64> = poses.readwrite();
    let (matrices, _) = writable.as_slice_mut()?.as_chunks_mut::<16>();
    for (q, matrices) in q.chunks(STRETCH).zip(matrices.chunks_mut(STRETCH)) {
        let done = released(py, || {
            batch::fk_matrices_into(robot, frame, q, matrices, Backend::Detected)
        })?;
        done.map_err(|e| crate::errors::internal(py, &e.to_string()))?;
        py.check_signals()?;
    }
    drop(writable);
    Ok(poses)
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
        return made::array(py, &[6, 6], jacobian.transpose().as_slice());
    };
    let result = made::zeros::<f64>(py, &[count, 6, 6]);
    let mut writable: PyReadwriteArrayDyn<'_, f64> = result.readwrite();
    let jacobians: &mut [Jacobian] = bytemuck::cast_slice_mut(writable.as_slice_mut()?);
    for (q, jacobians) in q.chunks(STRETCH).zip(jacobians.chunks_mut(STRETCH)) {
        let done = released(py, || {
            batch::jacobian_into(robot, frame, q, axes, jacobians, Backend::Detected)?;
            // Rust's matrices lie column by column, NumPy's row by row.
            jacobians
                .par_chunks_mut(CHUNK)
                .for_each(|chunk| chunk.iter_mut().for_each(Matrix6::transpose_mut));
            Ok::<_, batch::BatchError>(())
        })?;
        done.map_err(|e| crate::errors::internal(py, &e.to_string()))?;
        py.check_signals()?;
    }
    drop(writable);
    Ok(result)
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
    Ok(made::line(py, all).into_any())
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
        None => made::array(py, &[6], margins[0].as_slice()),
        Some(_) => made::joint_rows(py, &margins),
    }
}
