//! What is certified, and by which certificate.

use crate::error::ProveError;
use crate::prove::prove_with;
use crate::report::certificate::Certificate;
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::plan::Plan;

/// Something that a certificate holds for. There is no other way to make one than [`certify`] and [`certify_with`].
#[derive(Debug, Clone, PartialEq)]
pub struct Certified<P> {
    plan: P,
    certificate: Certificate,
}

/// Why a plan is not certified.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CertifyError {
    /// It cannot be judged.
    #[error(transparent)]
    Prove(#[from] ProveError),
    /// It is judged, and does not hold.
    #[error("{}", .0.headline)]
    Fails(Box<Certificate>),
}

/// A plan for an arm with the certificate that holds for it. Requirements that the job waives are named in
/// [`Certificate::waived`]: whoever needs them kept looks there.
///
/// # Errors
/// [`CertifyError`]: the plan cannot be judged, or its certificate fails.
pub fn certify(plan: Plan, arm: &RobotModel) -> Result<Certified<Plan>, CertifyError> {
    certify_with(plan, arm, &CancelToken::new())
}

/// [`certify`], to be given up half-way.
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
    /// What is certified.
    #[must_use]
    pub fn plan(&self) -> &P {
        &self.plan
    }

    /// What is proved about it.
    #[must_use]
    pub fn certificate(&self) -> &Certificate {
        &self.certificate
    }

    /// Both, no longer tied to each other.
    #[must_use]
    pub fn into_parts(self) -> (P, Certificate) {
        (self.plan, self.certificate)
    }
}
