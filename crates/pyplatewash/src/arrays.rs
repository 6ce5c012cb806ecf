//! Array-likes in, NumPy arrays out.
//!
//! A contiguous array of doubles is read where it lies. Anything else that NumPy makes an array of real numbers from (lists,
//! integers, strides, other byte orders) is copied once. Wrong shapes are answered with the shape found and the shapes wanted.

use crate::{argument, exception};
use numpy::{
    Element, PyArray, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use platewash::JointVector;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyList, PyString, PyTuple};
use pyo3::{PyTypeInfo, intern};

/// Shapes that an argument may have, as words for a message.
#[derive(Debug, Clone, Copy)]
pub struct ExpectedShape {
    /// Lengths of the trailing axes of one item, e.g. `[4, 4]`.
    pub item: &'static [usize],
    /// Number of items wanted: one, a stack of them, or either.
    pub count: Count,
}

/// Number of items that an argument may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Count {
    /// One item.
    One,
    /// A stack: a leading axis of any length.
    Stack,
    /// Either.
    Any,
}

impl ExpectedShape {
    /// Returns the length of the leading axis of a shape that fits, `Some(None)` for one item without that axis; `None`
    /// where the shape does not fit.
    fn items(&self, shape: &[usize]) -> Option<Option<usize>> {
        match shape {
            item if item == self.item && self.count != Count::Stack => Some(None),
            [n, item @ ..] if item == self.item && self.count != Count::One => Some(Some(*n)),
            _ => None,
        }
    }

    fn words(&self) -> Vec<String> {
        let tail: Vec<_> = self.item.iter().map(ToString::to_string).collect();
        let comma = if tail.len() == 1 { "," } else { "" };
        let one = format!("({}{comma})", tail.join(", "));
        let stack = match tail.len() {
            0 => "(N,)".to_owned(),
            _ => format!("(N, {})", tail.join(", ")),
        };
        match self.count {
            Count::One => vec![one],
            Count::Stack => vec![stack],
            Count::Any => vec![one, stack],
        }
    }
}

/// Deepest nesting of lists in which masked values are looked for: no argument has more axes.
const DEEPEST: usize = 4;

/// The doubles of an argument, with their shape checked.
pub struct Numbers<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    /// Items along the leading axis; `None` for one item without that axis.
    pub stacked: Option<usize>,
}

impl<'py> Numbers<'py> {
    /// The numbers of `value`, the argument called `name`.
    ///
    /// # Errors
    /// `ShapeError`, `InputTypeError` for what holds no real numbers, or whatever a foreign object raises itself.
    pub fn read(name: &str, value: &Bound<'py, PyAny>, expected: ExpectedShape) -> PyResult<Self> {
        let plain = value.get_type().is(PyUntypedArray::type_object(value.py()));
        let array = match value.cast::<PyArrayDyn<f64>>() {
            Ok(array) if plain && array.is_c_contiguous() && array.is_aligned() => array.clone(),
            _ => convert(name, value)?,
        };
        let Some(stacked) = expected.items(array.shape()) else {
            return Err(exception::shape(value.py(), name, array.shape(), &expected.words()));
        };
        let array = array
            .try_readonly()
            .map_err(|e| exception::input(value.py(), name, &e.to_string()))?;
        Ok(Self { array, stacked })
    }

    /// The numbers, row by row.
    ///
    /// # Errors
    /// None in practice: [`Numbers::read`] made sure of it.
    pub fn values(&self) -> PyResult<&[f64]> {
        Ok(self.array.as_slice()?)
    }

    /// Rows of six.
    ///
    /// # Errors
    /// `InputError` unless the items were read as rows of six.
    pub fn joints(&self) -> PyResult<&[JointVector]> {
        let values = self.values()?;
        bytemuck::try_cast_slice(values).map_err(|e| exception::input(self.array.py(), "q", &e.to_string()))
    }
}

/// One configuration or a stack of them.
pub const JOINTS: ExpectedShape = ExpectedShape {
    item: &[6],
    count: Count::Any,
};
/// A stack of configurations.
pub const MANY_JOINTS: ExpectedShape = ExpectedShape {
    item: &[6],
    count: Count::Stack,
};
/// One pose.
pub const ONE_POSE: ExpectedShape = ExpectedShape {
    item: &[4, 4],
    count: Count::One,
};
/// A stack of poses.
pub const MANY_POSES: ExpectedShape = ExpectedShape {
    item: &[4, 4],
    count: Count::Stack,
};

/// A configuration.
///
/// # Errors
/// As [`Numbers::read`].
pub fn joint_vector(name: &str, value: &Bound<'_, PyAny>) -> PyResult<JointVector> {
    Ok(fixed::<6>(name, value)?.into())
}

/// `N` numbers.
///
/// # Errors
/// As [`Numbers::read`].
pub fn fixed<const N: usize>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    let wanted = ExpectedShape {
        item: const { &[N] },
        count: Count::One,
    };
    let numbers = Numbers::read(name, value, wanted)?;
    let mut values = [0.0; N];
    values.copy_from_slice(numbers.values()?);
    Ok(values)
}

/// A stack of rows of `N` numbers.
///
/// # Errors
/// As [`Numbers::read`].
pub fn rows<const N: usize>(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; N]>> {
    let wanted = ExpectedShape {
        item: const { &[N] },
        count: Count::Stack,
    };
    let numbers = Numbers::read(name, value, wanted)?;
    let (rows, _) = numbers.values()?.as_chunks::<N>();
    Ok(rows.to_vec())
}

/// Converts a value with NumPy to an array of contiguous doubles.
fn convert<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = value.py();
    nothing_masked(name, value, 0)?;
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy
        .call_method1(intern!(py, "asarray"), (value,))
        .map_err(|e| exception::not_numbers(py, name, &e))?;
    let kind: Bound<'_, PyString> = array
        .getattr(intern!(py, "dtype"))?
        .getattr(intern!(py, "kind"))?
        .cast_into()?;
    if !matches!(kind.to_str()?, "f" | "i" | "u") {
        let dtype = array.getattr(intern!(py, "dtype"))?.str()?;
        return Err(exception::dtype(py, name, dtype.to_str()?));
    }
    let wanted = (array, intern!(py, "float64"), intern!(py, "CA"));
    let array = numpy
        .call_method1(intern!(py, "require"), wanted)
        .map_err(|e| exception::not_numbers(py, name, &e))?;
    Ok(array.cast_into()?)
}

/// Refuses masked values, in an array or in lists of arrays: NumPy would read what lies under the mask.
fn nothing_masked(name: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<()> {
    if value.is_exact_instance_of::<PyFloat>() || value.is_exact_instance_of::<PyInt>() {
        return Ok(());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return match depth < DEEPEST {
            true => value
                .try_iter()?
                .try_for_each(|item| nothing_masked(name, &item?, depth + 1)),
            false => Ok(()),
        };
    }
    argument::unmasked(name, value)
}

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
