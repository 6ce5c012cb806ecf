//! Calls of the inverse kinematics without an answer.

use crate::arrays;
use crate::exception::{any, input, raise};
use platewash::kinematics::ik::{IkCause, IkPathError, PathBreak};
use platewash::{IkError, IkFailure};
use pyo3::prelude::*;

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
            let last = q.last().and_then(|q| arrays::array(py, &[6], q.as_slice()).ok());
            let fields = [
                ("waypoint", any(py, *waypoint)),
                ("cause", any(py, cause)),
                ("joint", joint.and_then(|joint| any(py, joint))),
                ("solved", solved(q)),
                ("q", last.map(Bound::into_any)),
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
