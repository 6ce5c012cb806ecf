//! Exceptions of `pyplatewash` by class: made here, and nowhere else.
//!
//! The classes are Python's (`python/pyplatewash/_errors.py`), so that they pickle and can be subclassed; here they are given
//! their fields.

use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyModule};

/// Fault of an argument, in words that follow its name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Input(pub String);

/// A field of an exception.
pub type Field<'py> = (&'static str, Option<Bound<'py, PyAny>>);

static ERRORS: PyOnceLock<Py<PyModule>> = PyOnceLock::new();

/// An exception of the given class with its fields.
pub fn raise(py: Python<'_>, class: &str, message: &str, fields: &[(&str, Option<Bound<'_, PyAny>>)]) -> PyErr {
    let make = || {
        let module = ERRORS.get_or_try_init(py, || Ok::<_, PyErr>(py.import("pyplatewash._errors")?.unbind()))?;
        let keywords = PyDict::new(py);
        for (name, value) in fields {
            keywords.set_item(name, value)?;
        }
        module.bind(py).getattr(class)?.call((message,), Some(&keywords))
    };
    match make() {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

pub fn any<'py, T: IntoPyObject<'py>>(py: Python<'py>, value: T) -> Option<Bound<'py, PyAny>> {
    value.into_bound_py_any(py).ok()
}

/// An argument with a value that makes no sense.
pub fn input(py: Python<'_>, argument: &str, problem: &str) -> PyErr {
    let fields = [("argument", any(py, argument))];
    raise(py, "InputError", &format!("{argument}: {problem}"), &fields)
}

/// An `InputError` whose message already begins with the argument's name.
pub fn keyed(py: Python<'_>, argument: &str, message: &str) -> PyErr {
    raise(py, "InputError", message, &[("argument", any(py, argument))])
}

/// An argument of the wrong shape.
pub fn shape(py: Python<'_>, argument: &str, found: &[usize], wanted: &[String]) -> PyErr {
    let lengths = found.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    let comma = if found.len() == 1 { "," } else { "" };
    let message = format!(
        "{argument}: an array of shape {} is needed; found ({lengths}{comma})",
        wanted.join(" or ")
    );
    let tuple = pyo3::types::PyTuple::new(py, found).ok().map(Bound::into_any);
    let fields = [
        ("argument", any(py, argument)),
        ("found", tuple),
        ("wanted", any(py, wanted)),
    ];
    raise(py, "ShapeError", &message, &fields)
}

/// An argument whose array holds no real numbers.
pub fn dtype(py: Python<'_>, argument: &str, dtype: &str) -> PyErr {
    let message = format!("{argument}: an array of real numbers is needed; found dtype {dtype}");
    raise(py, "InputTypeError", &message, &[("argument", any(py, argument))])
}

/// An argument of a wrong type.
pub fn wrong_type(py: Python<'_>, argument: &str, problem: &str) -> PyErr {
    let fields = [("argument", any(py, argument))];
    raise(py, "InputTypeError", &format!("{argument}: {problem}"), &fields)
}

/// An argument that NumPy makes no array of. What is neither a `TypeError` nor a `ValueError` is passed on as it is.
pub fn not_numbers(py: Python<'_>, argument: &str, error: &PyErr) -> PyErr {
    use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
    let ours = error.is_instance_of::<PyTypeError>(py)
        || error.is_instance_of::<PyValueError>(py)
        || error.is_instance_of::<PyOverflowError>(py);
    if !ours {
        return error.clone_ref(py);
    }
    let message = format!(
        "{argument}: an array of real numbers is needed; NumPy says: {}",
        error.value(py)
    );
    raise(py, "InputTypeError", &message, &[("argument", any(py, argument))])
}

/// An exception of the given class without fields.
pub fn named(py: Python<'_>, class: &'static str, message: &str) -> PyErr {
    raise(py, class, message, &[])
}

/// A plan that is not handed over; the code is stable.
pub fn export(py: Python<'_>, code: &str, message: &str) -> PyErr {
    raise(py, "ExportError", message, &[("code", any(py, code))])
}

/// Something that this installation lacks.
pub fn missing(py: Python<'_>, name: &str, message: &str) -> PyErr {
    raise(py, "MissingError", message, &[("name", any(py, name))])
}

/// A key that is not there.
pub fn no_key(py: Python<'_>, key: &str, known: &[&str]) -> PyErr {
    let fields = [("argument", any(py, "key"))];
    let message = format!("key: one of {} is needed; found '{key}'", known.join(", "));
    raise(py, "NoKeyError", &message, &fields)
}

/// Something that must not happen.
pub fn internal(py: Python<'_>, message: &str) -> PyErr {
    raise(py, "InternalError", message, &[])
}
