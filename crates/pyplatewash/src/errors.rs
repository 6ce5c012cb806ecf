//! What goes wrong, as the exceptions of `pyplatewash`.
//!
//! The classes are Python's (`python/pyplatewash/_errors.py`), so that they pickle and can be subclassed; here they are given
//! their fields.

use crate::arrays;
use platewash::kinematics::ik::{IkCause, IkPathError, PathBreak};
use platewash::planner::scenario::{Problem, ScenarioError};
use platewash::planner::tracking::TrackingError;
use platewash::{IkError, IkFailure, PlanError};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyModule};

/// What is wrong with an argument, in words that follow its name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Input(pub String);

static ERRORS: PyOnceLock<Py<PyModule>> = PyOnceLock::new();

/// An exception of the given class with its fields.
fn raise(py: Python<'_>, class: &str, message: &str, fields: &[(&str, Option<Bound<'_, PyAny>>)]) -> PyErr {
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

fn any<'py, T: IntoPyObject<'py>>(py: Python<'py>, value: T) -> Option<Bound<'py, PyAny>> {
    value.into_bound_py_any(py).ok()
}

/// An argument with a value that makes no sense.
pub fn input(py: Python<'_>, argument: &str, problem: &str) -> PyErr {
    let fields = [("argument", any(py, argument))];
    raise(py, "InputError", &format!("{argument}: {problem}"), &fields)
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

/// Something that must not happen.
pub fn internal(py: Python<'_>, message: &str) -> PyErr {
    raise(py, "InternalError", message, &[])
}

/// A refused scenario.
pub fn scenario(py: Python<'_>, error: &ScenarioError) -> PyErr {
    let (key, expected, found) = match &error.problem {
        Problem::Value { key, expected, found } => (any(py, key), any(py, expected), any(py, found)),
        Problem::UnknownKey { key, .. } => (any(py, key), None, None),
        Problem::Conflict { keys, .. } => (any(py, keys), None, None),
        _ => (None, None, None),
    };
    let fields = [
        ("source", any(py, &error.source_name)),
        ("line", error.line.and_then(|line| any(py, line))),
        ("key", key),
        ("expected", expected),
        ("found", found),
    ];
    raise(py, "ScenarioError", &error.to_string(), &fields)
}

/// The word for a cause, and the joint at fault.
#[must_use]
pub fn cause(cause: &IkCause) -> (&'static str, Option<usize>) {
    match cause {
        IkCause::Unreachable => ("unreachable", None),
        IkCause::LocalMinimum => ("local_minimum", None),
        IkCause::Limit { joint } => ("limit", Some(*joint)),
        IkCause::Singular => ("singular", None),
        IkCause::Iterations => ("iterations", None),
        _ => ("other", None),
    }
}

/// An unanswered inverse-kinematics call.
pub fn ik(py: Python<'_>, error: &IkError) -> PyErr {
    match error {
        IkError::NotSolved(failure) => raise(py, "IkError", &error.to_string(), &failure_fields(py, failure)),
        IkError::Seed { .. } => input(py, "seed", &error.to_string()),
        _ => input(py, "target", &error.to_string()),
    }
}

fn failure_fields<'py>(py: Python<'py>, failure: &IkFailure) -> Vec<(&'static str, Option<Bound<'py, PyAny>>)> {
    let (cause, joint) = cause(&failure.cause);
    vec![
        ("cause", any(py, cause)),
        ("joint", joint.and_then(|joint| any(py, joint))),
        (
            "q",
            arrays::array(py, &[6], failure.q.as_slice()).ok().map(Bound::into_any),
        ),
        ("iterations", any(py, failure.iterations)),
        ("limit_excess_rad", failure.limit_excess_rad.and_then(|v| any(py, v))),
        ("position_error_m", any(py, failure.position_error_m)),
        ("orientation_error_rad", any(py, failure.orientation_error_rad)),
    ]
}

/// A path that breaks off.
pub fn ik_path(py: Python<'_>, error: &IkPathError) -> PyErr {
    let message = error.to_string();
    let solved = |q: &[_]| arrays::joint_rows(py, q).ok().map(Bound::into_any);
    match error {
        IkPathError::Waypoint { waypoint, error } => {
            let mut fields = match error {
                IkError::NotSolved(failure) => failure_fields(py, failure),
                _ => {
                    return input(
                        py,
                        if *waypoint == 0 {
                            "seed or targets[0]"
                        } else {
                            "targets"
                        },
                        &message,
                    );
                }
            };
            fields.extend([("waypoint", any(py, *waypoint)), ("solved", solved(&[]))]);
            raise(py, "IkPathError", &message, &fields)
        }
        IkPathError::Broken {
            waypoint,
            reason,
            solved: q,
        } => {
            let (cause, joint) = path_break(reason);
            let fields = [
                ("waypoint", any(py, *waypoint)),
                ("cause", any(py, cause)),
                ("joint", joint.and_then(|joint| any(py, joint))),
                ("solved", solved(q)),
            ];
            raise(py, "IkPathError", &message, &fields)
        }
        _ => raise(py, "IkPathError", &message, &[]),
    }
}

fn path_break(reason: &PathBreak) -> (&'static str, Option<usize>) {
    match reason {
        PathBreak::Limit { joint } => ("limit", Some(*joint)),
        PathBreak::Singularity { .. } => ("singular", None),
        PathBreak::BranchEnd { .. } => ("branch_end", None),
        _ => ("other", None),
    }
}

/// A job that could not be carried out.
pub fn plan(py: Python<'_>, error: &PlanError) -> PyErr {
    let message = error.to_string();
    let (stage, waypoint, joint) = match error {
        PlanError::Scenario(error) => return scenario(py, error),
        PlanError::Layout(error) => return layout(py, error),
        PlanError::Robot(_) => ("robot", None, None),
        PlanError::IkSettings(_) | PlanError::Ik(_) => ("ik", None, None),
        PlanError::Tracking(TrackingError::Ik { waypoint, .. }) => ("tracking", Some(*waypoint), None),
        PlanError::Tracking(TrackingError::Divergence { waypoint, joint, .. }) => {
            ("tracking", Some(*waypoint), Some(*joint))
        }
        PlanError::Clearance(_) => ("clearance", None, None),
        PlanError::Coverage(_) => ("coverage", None, None),
        _ => ("plan", None, None),
    };
    let fields = [
        ("stage", any(py, stage)),
        ("waypoint", waypoint.and_then(|v| any(py, v))),
        ("joint", joint.and_then(|v| any(py, v))),
    ];
    raise(py, "PlanError", &message, &fields)
}

/// Plates that could not be placed.
pub fn layout(py: Python<'_>, error: &platewash::planner::layout::LayoutError) -> PyErr {
    use platewash::planner::layout::LayoutError;
    let fields = match error {
        LayoutError::NoRoom {
            count,
            most_placed,
            upper_bound,
            ..
        } => vec![
            ("cause", any(py, "no_room")),
            ("count", any(py, *count)),
            ("most_placed", any(py, *most_placed)),
            ("upper_bound", upper_bound.and_then(|v| any(py, v))),
        ],
        LayoutError::EmptyRegion { .. } => vec![("cause", any(py, "empty_region"))],
        LayoutError::InvalidPosition { plate } => {
            let problem = format!("the centre of plate {plate} is not finite");
            return input(py, "positions_m", &problem);
        }
        LayoutError::InvalidInput { key, problem } => return input(py, key, &problem.to_string()),
        _ => Vec::new(),
    };
    raise(py, "LayoutError", &format!("layout: {error}"), &fields)
}
