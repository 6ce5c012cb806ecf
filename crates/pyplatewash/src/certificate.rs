//! `Certificate`: the proof of a plan.

use crate::job::PaperJobObject;
use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::value::{records, to_python, to_record};
use crate::work::patiently;
use crate::{argument, errors, exception, scenario};
use platewash::certificate::{self, Verdict};
use platewash::{Certificate, Check};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};

/// The proof of a plan, for its whole motion. `str(certificate)` is the table that the command prints.
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

impl CertificateObject {
    /// The certificate of the argument called `certificate`, if it is given.
    ///
    /// # Errors
    /// `InputTypeError` for what is no certificate.
    pub fn given<'a, 'py>(value: Option<&'a Bound<'py, PyAny>>) -> PyResult<Option<&'a Bound<'py, Self>>> {
        argument::maybe("certificate", value, "a Certificate, as prove gives it,")
    }

    /// The certificate.
    #[must_use]
    pub fn inner(&self) -> &Certificate {
        &self.inner
    }
}

#[pymethods]
impl CertificateObject {
    /// `"pass"` or `"fail"`.
    #[getter]
    fn verdict(&self) -> &'static str {
        match self.inner.verdict {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
        }
    }

    /// The first line: the verdict, what the scenario waives, what is not kept.
    #[getter]
    fn headline(&self) -> &str {
        &self.inner.headline
    }

    /// The names of the requirements that are not kept and that the job waives (`layout.overlap = "report"`).
    #[getter]
    fn waived<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner.waived)
    }

    /// True where every requirement is proved, but for those that are `waived`, and the plan is as it was written.
    #[getter]
    fn proved(&self) -> bool {
        self.inner.passes()
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

    /// Result of the hash check: `stated`, `computed`, `status`.
    #[getter]
    fn hash<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.hash, None)
    }

    /// The requirements one by one, each with its `requirement`, `status` (`"proved"`, `"violated"`, `"not_proved"`, `"waived"`) and
    /// measure.
    #[getter]
    fn checks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.checks)
    }

    /// The checks of requirements that are violated or not proved.
    #[getter]
    fn broken<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let broken: Vec<&Check> = self.inner.broken().collect();
        records(py, &broken)
    }

    /// Basis of the verdict: the job's requirements, limits, plates, tool and world, and the assumptions.
    #[getter]
    fn rests_on<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.rests_on, None)
    }

    /// Number of plates that are proved to be washed.
    #[getter]
    fn plates_washed(&self) -> usize {
        self.inner.plates_washed()
    }

    /// The swept shares, plate by plate in the order of washing.
    #[getter]
    fn swept<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.swept)
    }

    /// Contact, plate by plate in the order of washing, where the job asks for it: `plate`; `pressed`, `time` and `dose`, each with what
    /// is proved (`at_least`), `required`, `threshold` and, where they fall short, the worst place; `strain`, `least_force_n` and
    /// `greatest_force_n`, each with `bound`, `seen`, `time_s` and `place_m`; `friction_torque_nm`; `holder_load`, what holds the plate takes.
    /// Empty where it does not.
    #[getter]
    fn contact<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.contact)
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

    /// The requirements as lines of a table: name, status, bound and limit, where it is worst.
    fn _rows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let row = |check: &Check| {
            let name = check.requirement.words();
            (name, check.status, check.detail(), check.worst.to_string())
        };
        to_python(py, &self.inner.checks.iter().map(row).collect::<Vec<_>>())
    }

    /// The whole report: every requirement, plate, pair of bodies and assumption. `str(certificate)` is one screen of it.
    fn details(&self) -> String {
        format!("{:#}", self.inner)
    }

    fn __str__(&self) -> String {
        self.inner.to_string()
    }

    fn __repr__(&self) -> String {
        let checks = self.inner.checks.len();
        let kept = checks - self.inner.broken().count();
        let dry_run = self.inner.rests_on.dry_run.as_ref();
        let dry_run = dry_run.map_or("", |_| "dry run, ");
        format!(
            "Certificate('{}', {dry_run}{kept} of {checks} requirements kept)",
            self.verdict()
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let text = serde_json::to_string(&slf.get().inner).map_err(|e| exception::internal(py, &e.to_string()))?;
        Ok((slf.get_type().getattr("_restore")?, (text,).into_pyobject(py)?))
    }

    /// Restores a pickled certificate.
    #[classmethod]
    fn _restore(_class: &Bound<'_, PyType>, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = argument::text("text", text, "a pickled certificate")?;
        let inner = serde_json::from_str(&text).map_err(|e| exception::input(py, "text", &e.to_string()))?;
        Ok(Self { inner })
    }
}

/// Judges a plan, or the plan file of that path, for an arm, by default the one that it was made for: what is required is proved
/// for the whole motion, or violated, or not proved. Nothing but the plan and the arm is looked at.
///
/// Raises ProveError for a plan that says nothing that could be judged, for a run of the paper's program, and for a plan whose file
/// names an arm that must be given; a plan that breaks a requirement is no error.
#[pyfunction]
#[pyo3(signature = (plan, robot=None))]
pub fn prove(py: Python<'_>, plan: &Bound<'_, PyAny>, robot: Option<&Bound<'_, PyAny>>) -> PyResult<CertificateObject> {
    let plan = PlanObject::given("plan", plan)?;
    let arm = plan.get().arm(py, Robot::given(robot)?)?;
    let plan = plan.get().inner().clone();
    let judged = patiently(py, move |cancel| certificate::prove_with(&plan, &arm, cancel))?;
    Ok(judged.map_err(|e| errors::failure(py, &e.into()))?.into())
}

/// Every field in which the job of a plan, or of the plan file of that path, is another one than was asked for: one record each with
/// `key`, `found` (in the plan) and `expected` (in `job`), whose text says it in words. None where it is the job that was asked for:
/// a certificate tells that a plan does its job, not whose job it is.
#[pyfunction]
pub fn differences<'py>(
    py: Python<'py>,
    plan: &Bound<'py, PyAny>,
    job: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyList>> {
    let plan = PlanObject::given("plan", plan)?;
    let expected = match job.cast::<PaperJobObject>() {
        Ok(job) => job.get().terms(py)?,
        Err(_) => scenario::wash_job(job, None)?.get().inner().terms().clone(),
    };
    let list = PyList::empty(py);
    for difference in certificate::differences(&plan.get().inner().job, &expected) {
        list.append(to_record(py, &difference, Some(difference.to_string()))?)?;
    }
    Ok(list)
}
