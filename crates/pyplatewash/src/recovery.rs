//! Recovery from a stop of a plan.

use crate::errors;
use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::value::{records, to_record};
use crate::work::patiently;
use platewash::certificate::certify_with;
use platewash::planner::{Recovered, RecoveryError, Watch, recover};
use platewash::{CancelToken, JointVector, Plan};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

/// Python's class of a recovery.
static RECOVERY: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// The recovery from a stop of a plan, which is proved first, as Python's `Recovery`.
///
/// # Errors
/// `PlanError`; `InputError` for a time or positions that are none; `ProveError`.
pub fn recovered<'py>(
    py: Python<'py>,
    plan: &Plan,
    robot: Py<Robot>,
    at: JointVector,
    stopped_s: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let (plan, arm) = (plan.clone(), robot.get().model().clone());
    let work = move |cancel: &CancelToken| {
        let (plan, _) = certify_with(plan, &arm, cancel)
            .map_err(|error| Err(error.to_string()))?
            .into_parts();
        recover(&plan, &arm, &at, stopped_s, &Watch::silent(cancel)).map_err(Ok)
    };
    let found: Result<Recovered, Result<RecoveryError, String>> = patiently(py, work)?;
    let Recovered { stop, near, home, rest } = found.map_err(|failure| match failure {
        Ok(error) => errors::recovery(py, error),
        Err(unproved) => errors::no_recovery(py, &format!("a recovery is one of a proved plan; {unproved}")),
    })?;
    let object = |plan| PlanObject::new(plan, Some(robot.clone_ref(py)));
    let class = RECOVERY.import(py, "pyplatewash._records", "Recovery")?;
    class.call1((
        object(home),
        rest.map(object),
        to_record(py, &stop, None)?,
        records(py, &near)?,
    ))
}
