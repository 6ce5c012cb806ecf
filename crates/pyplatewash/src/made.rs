//! NumPy arrays out.

use numpy::{Element, PyArray, PyArray1, PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn};
use platewash::JointVector;
use pyo3::prelude::*;

/// A new array of zeros of the given shape.
#[must_use]
pub fn zeros<'py, T: Element>(py: Python<'py>, shape: &[usize]) -> Bound<'py, PyArrayDyn<T>> {
    PyArray::zeros(py, shape, false)
}

/// A new array of the given shape with these values, row by row.
///
/// # Errors
/// When the shape does not hold as many values.
pub fn array<'py, T: Element + Copy>(
    py: Python<'py>,
    shape: &[usize],
    values: &[T],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let array = zeros::<T>(py, shape);
    let mut writable: PyReadwriteArrayDyn<'_, T> = array.readwrite();
    writable.as_slice_mut()?.copy_from_slice(values);
    drop(writable);
    Ok(array)
}

/// Configurations as an array of shape (N, 6).
///
/// # Errors
/// None in practice.
pub fn joint_rows<'py>(py: Python<'py>, q: &[JointVector]) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    array(py, &[q.len(), 6], bytemuck::cast_slice(q))
}

/// Values as an array of one axis, without a copy.
#[must_use]
pub fn line<'py, T: Element>(py: Python<'py>, values: Vec<T>) -> Bound<'py, PyArray1<T>> {
    PyArray1::from_vec(py, values)
}
