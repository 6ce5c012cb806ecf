//! Robot programs of a plan.

use crate::arrays::{self, Numbers, ONE_POSE};
use crate::pose;
use crate::work::patiently;
use crate::{argument, errors, exception};
use platewash::certificate::{CertifyError, Requirement, certify_with};
use platewash::export::dialect::Dialect;
use platewash::export::dialects::DIALECTS;
use platewash::export::program::ProgramFile;
use platewash::export::{ExportError, ExportSettings, Joint3, Refusal, export};
use platewash::{CancelToken, Plan, Pose, ProveError, RobotModel};
use pyo3::prelude::*;
use std::sync::Arc;

/// Python's keywords of an export, as they are given.
pub struct ExportKeywords<'a, 'py> {
    /// Largest distance of the tip from the plan \[m\].
    pub tolerance_m: Option<&'a Bound<'py, PyAny>>,
    /// Share of the plan's speed.
    pub speed_share: Option<&'a Bound<'py, PyAny>>,
    /// Radius of corners \[m\].
    pub corner_m: Option<&'a Bound<'py, PyAny>>,
    /// Requirements whose waiving is accepted.
    pub accept: Option<&'a Bound<'py, PyAny>>,
    /// Count of axis 3 by the controller.
    pub joint_3: Option<&'a Bound<'py, PyAny>>,
    /// Configuration in which the arm stands now \[rad\].
    pub stands_rad: Option<&'a Bound<'py, PyAny>>,
    /// `T_flange_tip` as the controller has it.
    pub tip: Option<&'a Bound<'py, PyAny>>,
}

impl ExportKeywords<'_, '_> {
    /// The settings.
    ///
    /// # Errors
    /// `InputTypeError`, `InputError`, naming the argument.
    pub fn settings(&self) -> PyResult<ExportSettings> {
        let default = ExportSettings::default();
        let accepted = self
            .accept
            .map(|value| argument::each("accept", value, "a list of names of requirements", accepted));
        let stands = self.stands_rad.map(|value| arrays::joint_vector("stands_rad", value));
        Ok(ExportSettings {
            tolerance_m: argument::number_or("tolerance_m", self.tolerance_m, default.tolerance_m)?,
            speed_share: argument::number_or("speed_share", self.speed_share, default.speed_share)?,
            corner_m: argument::number_or("corner_m", self.corner_m, default.corner_m)?,
            accepted: accepted.transpose()?.unwrap_or_default(),
            joint_3: self.joint_3.map(joint_3).transpose()?,
            stands_rad: stands.transpose()?,
            tip: self.tip.map(tip).transpose()?,
        })
    }
}

fn accepted(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Requirement> {
    const NEEDED: &str = "the name of a requirement, as certificates have it,";
    let found = Requirement::named(&argument::text(name, value, NEEDED)?);
    found.ok_or_else(|| argument::wrong_value(name, value, NEEDED))
}

fn joint_3(value: &Bound<'_, PyAny>) -> PyResult<Joint3> {
    argument::word("joint_3", value, &Joint3::ALL.map(|count| (count.name(), count)))
}

fn tip(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    let numbers = Numbers::read("tip", value, ONE_POSE)?;
    pose::pose(numbers.values()?).map_err(|e| exception::input(value.py(), "tip", &e.0))
}

/// The dialect of the argument called `to`.
///
/// # Errors
/// `InputTypeError`; `InputError` for a name of none.
pub fn dialect(value: &Bound<'_, PyAny>) -> PyResult<&'static dyn Dialect> {
    let words: Vec<_> = DIALECTS.iter().map(|dialect| (dialect.name(), *dialect)).collect();
    argument::word("to", value, &words)
}

/// The files of a program of a plan, which is proved first; the program is judged, too.
///
/// # Errors
/// `ExportError` for a plan that is not handed over, `InputError` for settings that make no sense, `ProveError`.
pub fn files(
    py: Python<'_>,
    plan: &Plan,
    arm: Arc<RobotModel>,
    to: &'static dyn Dialect,
    settings: ExportSettings,
) -> PyResult<Vec<ProgramFile>> {
    let plan = plan.clone();
    let work = move |cancel: &CancelToken| {
        let certified = certify_with(plan, &arm, cancel).map_err(ExportFailure::Plan)?;
        export(&certified, &arm, to, &settings, cancel).map_err(ExportFailure::Program)
    };
    match patiently(py, work)? {
        Ok(exported) => Ok(exported.files),
        Err(refused) => Err(refused.raised(py)),
    }
}

/// Failure to certify a plan, or to write its program.
enum ExportFailure {
    Plan(CertifyError),
    Program(ExportError),
}

impl ExportFailure {
    fn raised(&self, py: Python<'_>) -> PyErr {
        const UNCERTIFIED: &str = "uncertified";
        let unproved = |error: &ProveError| errors::failure(py, &error.clone().into());
        match self {
            Self::Plan(CertifyError::Prove(error @ ProveError::PaperRun)) => {
                exception::export(py, UNCERTIFIED, &error.to_string())
            }
            Self::Plan(CertifyError::Prove(error)) | Self::Program(ExportError::Prove(error)) => unproved(error),
            Self::Plan(error) => exception::export(py, UNCERTIFIED, &format!("{error}; prove says more")),
            Self::Program(ExportError::Refused(Refusal::Setting { name, expected, found })) => {
                exception::input(py, name, &format!("must be {expected}; found {found}"))
            }
            Self::Program(ExportError::Refused(refusal)) => exception::export(py, refusal.code(), &refusal.to_string()),
            Self::Program(error) => exception::internal(py, &error.to_string()),
        }
    }
}
