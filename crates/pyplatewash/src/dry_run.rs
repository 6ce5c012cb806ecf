//! The dry run of a plan.

use crate::errors;
use crate::work::patiently;
use platewash::certificate::{CertifyError, certify_with};
use platewash::motion::dry_run::{DryRunError, check_paths, dry_run_job};
use platewash::planner::{PlanError, Watch, plan_in_order};
use platewash::{CancelToken, Failure, Plan, RobotModel};
use pyo3::prelude::*;
use std::sync::Arc;

/// Settings of a dry run.
#[derive(Debug, Clone, Copy)]
pub struct DryRunSettings {
    /// Height of the motion above the plates \[m\].
    pub height_m: f64,
    /// Largest speed of the tip \[m/s\].
    pub speed_m_s: f64,
}

/// The dry run of a plan, which is proved first.
///
/// # Errors
/// `PlanError`; `InputError` for a height or a speed that is none; `ProveError`.
pub fn planned(py: Python<'_>, parent: &Plan, arm: &Arc<RobotModel>, settings: DryRunSettings) -> PyResult<Plan> {
    let (parent, arm) = (parent.clone(), arm.clone());
    let work = move |cancel: &CancelToken| {
        let job = dry_run_job(&parent, &arm, settings.height_m, settings.speed_m_s).map_err(DryRunFailure::DryRun)?;
        let (parent, _) = certify_with(parent, &arm, cancel)
            .map_err(DryRunFailure::Parent)?
            .into_parts();
        let planned = plan_in_order(&job, &parent.order, &parent.wash_paths, &Watch::silent(cancel))
            .map_err(DryRunFailure::Plan)?;
        check_paths(&parent, &planned.plan).map_err(DryRunFailure::DryRun)?;
        Ok(planned.plan)
    };
    patiently(py, work)?.map_err(|failure: DryRunFailure| failure.raised(py))
}

/// Failure of a dry run: of its job, of its parent's certificate or of its plan.
enum DryRunFailure {
    DryRun(DryRunError),
    Parent(CertifyError),
    Plan(PlanError),
}

impl DryRunFailure {
    fn raised(self, py: Python<'_>) -> PyErr {
        match self {
            Self::DryRun(error) => errors::dry_run(py, &error),
            Self::Parent(CertifyError::Prove(error)) => errors::failure(py, &error.into()),
            Self::Parent(error) => {
                let message = format!("{error}; a dry run is one of a proved plan; prove says more");
                errors::no_dry_run(py, &message)
            }
            Self::Plan(error) => errors::failure(py, &Failure::from(error)),
        }
    }
}
