//! Recovery from a stop of a plan.

use crate::errors;
use crate::work::patiently;
use platewash::certificate::certify_with;
use platewash::planner::{Recovered, RecoveryError, Watch, recover};
use platewash::{CancelToken, JointVector, Plan, RobotModel};
use pyo3::prelude::*;
use std::sync::Arc;

/// Plans the recovery from a stop of a plan, which is proved first.
///
/// # Errors
/// `PlanError`; `InputError` for a time or positions that are none; `ProveError`.
pub fn recovered(
    py: Python<'_>,
    plan: &Plan,
    arm: &Arc<RobotModel>,
    at: JointVector,
    stopped_s: Option<f64>,
) -> PyResult<Recovered> {
    let (plan, arm) = (plan.clone(), arm.clone());
    let work = move |cancel: &CancelToken| {
        let (plan, _) = certify_with(plan, &arm, cancel)
            .map_err(|error| Err(error.to_string()))?
            .into_parts();
        recover(&plan, &arm, &at, stopped_s, &Watch::silent(cancel)).map_err(Ok)
    };
    let found: Result<Recovered, Result<RecoveryError, String>> = patiently(py, work)?;
    found.map_err(|failure| match failure {
        Ok(error) => errors::recovery(py, error),
        Err(unproved) => errors::no_recovery(py, &format!("a recovery is one of a proved plan; {unproved}")),
    })
}
