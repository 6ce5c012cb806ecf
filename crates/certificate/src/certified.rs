//! A certified plan and its certificate.

use crate::error::ProveError;
use crate::prove::prove_with;
use crate::report::certificate::Certificate;
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use platewash_workcell::cancel::CancelToken;

/// A value with the certificate that holds for it. Only [`certify`] and [`certify_with`] make one.
#[derive(Debug, Clone, PartialEq)]
pub struct Certified<P> {
    plan: P,
    certificate: Certificate,
}

/// Reason that a plan is not certified.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CertifyError {
    /// The plan cannot be judged.
    #[error(transparent)]
    Prove(#[from] ProveError),
    /// The plan is judged, and its certificate fails.
    #[error("{}", .0.headline)]
    Fails(Box<Certificate>),
}

/// Certifies a plan for an arm. [`Certificate::waived`] names the requirements that the job waives; a caller who needs them kept must check
/// it.
///
/// # Errors
/// [`CertifyError`]: the plan cannot be judged, or its certificate fails.
pub fn certify(plan: Plan, arm: &RobotModel) -> Result<Certified<Plan>, CertifyError> {
    certify_with(plan, arm, &CancelToken::new())
}

/// Same as [`certify`], with a token that cancels the work.
///
/// # Errors
/// As [`certify`], and [`ProveError::Cancelled`].
pub fn certify_with(plan: Plan, arm: &RobotModel, cancel: &CancelToken) -> Result<Certified<Plan>, CertifyError> {
    let certificate = prove_with(&plan, arm, cancel)?;
    if certificate.passes() {
        Ok(Certified { plan, certificate })
    } else {
        Err(CertifyError::Fails(Box::new(certificate)))
    }
}

impl<P> Certified<P> {
    /// Returns the certified plan.
    #[must_use]
    pub fn plan(&self) -> &P {
        &self.plan
    }

    /// Returns the certificate of the plan.
    #[must_use]
    pub fn certificate(&self) -> &Certificate {
        &self.certificate
    }

    /// Splits the value into plan and certificate, no longer tied to each other.
    #[must_use]
    pub fn into_parts(self) -> (P, Certificate) {
        (self.plan, self.certificate)
    }
}
