//! `Certificate`: what is proved about a plan.

use crate::argument;
use crate::errors;
use crate::plan::{PlanObject, records};
use crate::robot::Robot;
use crate::value::{to_python, to_record};
use crate::work::patiently;
use platewash::Certificate;
use platewash::planner::certificate::{self, CertificateVerdict, Promise};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};

/// What is proved about a plan, for its whole motion. `str(certificate)` is the table that the command prints.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Certificate")]
#[derive(PartialEq)]
pub struct CertificateObject {
    inner: Certificate,
}

impl From<Certificate> for CertificateObject {
    fn from(inner: Certificate) -> Self {
        Self { inner }
    }
}

#[pymethods]
impl CertificateObject {
    /// `"pass"` or `"fail"`.
    #[getter]
    fn verdict(&self) -> &'static str {
        match self.inner.verdict {
            CertificateVerdict::Pass => "pass",
            CertificateVerdict::Fail => "fail",
        }
    }

    /// The first line: the verdict, what the scenario waives, what is not kept.
    #[getter]
    fn headline(&self) -> &str {
        &self.inner.headline
    }

    /// The names of the promises that do not hold and that the scenario waives (`layout.overlap = "report"`).
    #[getter]
    fn exempt<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner.exempt)
    }

    /// Whether every promise holds, but for those that are `exempt`, and the plan is as it was sealed.
    #[getter]
    fn proved(&self) -> bool {
        self.inner.verdict == CertificateVerdict::Pass
    }

    /// Name of the scenario.
    #[getter]
    fn scenario(&self) -> &str {
        &self.inner.scenario
    }

    /// Duration of the motion [s].
    #[getter]
    fn duration_s(&self) -> f64 {
        self.inner.duration_s
    }

    /// What the hash says: `stated`, `computed`, `status`.
    #[getter]
    fn hash<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.hash, None)
    }

    /// The promises, each with its `name`, `status` and measure.
    #[getter]
    fn promises<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.promises)
    }

    /// The promises that are broken or not proved.
    #[getter]
    fn broken<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let broken: Vec<&Promise> = self.inner.broken().collect();
        records(py, &broken)
    }

    /// Coverage, plate by plate in the order of washing.
    #[getter]
    fn coverage<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.coverage)
    }

    /// Clearance, pair by pair and rule by rule.
    #[getter]
    fn clearance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.clearance)
    }

    /// Everything as plain dictionaries and lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner)
    }

    fn __str__(&self) -> String {
        self.inner.to_string()
    }

    fn __repr__(&self) -> String {
        let broken = self.inner.broken().count();
        let promises = self.inner.promises.len();
        format!(
            "Certificate('{}', {} of {promises} promises hold)",
            self.verdict(),
            promises - broken
        )
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let text = serde_json::to_string(&slf.get().inner).map_err(|e| errors::internal(py, &e.to_string()))?;
        Ok((slf.get_type().getattr("_restore")?, (text,).into_pyobject(py)?))
    }

    /// Restores a pickled certificate.
    #[classmethod]
    fn _restore(_class: &Bound<'_, PyType>, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = argument::text("text", text, "a pickled certificate")?;
        let inner = serde_json::from_str(&text).map_err(|e| errors::input(py, "text", &e.to_string()))?;
        Ok(Self { inner })
    }
}

/// Judges a plan, or the plan file of that path, for an arm, by default the one that it was made for: what it promises holds for
/// the whole motion, or is broken, or is not proved. Nothing but the plan and the arm is looked at.
///
/// Raises VerifyError for a plan that says nothing that could be judged, or whose file names an arm that must be given; a plan
/// that breaks its promises is no error.
#[pyfunction]
#[pyo3(signature = (plan, robot=None))]
pub fn verify(
    py: Python<'_>,
    plan: &Bound<'_, PyAny>,
    robot: Option<&Bound<'_, PyAny>>,
) -> PyResult<CertificateObject> {
    let plan = PlanObject::given("plan", plan)?;
    let robot = plan.get().arm(Robot::given(robot)?);
    let plan = plan.get().inner().clone();
    let judged = patiently(py, move |_| match robot {
        Some(robot) => certificate::verify(&plan, &robot),
        None => certificate::verify(&plan, &certificate::arm(&plan, None)?),
    })?;
    Ok(judged.map_err(|e| errors::verify(py, &e))?.into())
}
