//! `ClearanceModel`: smallest distances between bodies.

use crate::argument::{self, ANY_COUNT, ROBOT};
use crate::arrays::{self, JOINTS, Numbers};
use crate::errors;
use crate::exception;
use crate::job::{PaperJobObject, WashJobObject};
use crate::plan::PlanObject;
use crate::plate::PlateFields;
use crate::robot::Robot;
use crate::tool::ToolFields;
use crate::value::to_record;
use crate::work::{STRETCH, alone, released};
use nalgebra::Point3;
use numpy::{PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn};
use platewash::bodies::assembly;
use platewash::bodies::job::JobError;
use platewash::workcell::tool::StraightTool;
use platewash::workcell::words::count_with_noun;
use platewash::{ClearanceModel, Failure, JobTerms, JointVector, PairClearance, Pose, RobotModel, Tool};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};
use rayon::prelude::*;
use std::sync::Arc;

/// The bodies and pairs of one workcell: the arm, its tool, what stands around and the plates.
///
/// Made of an arm, a tool and plates, it is the cell whose arm stands on the floor at the origin; `ClearanceModel.of` makes that of a job. Without a tool
/// there is no tool body. Distances are metres, ≤ 0 when two bodies touch; places are in the world, as plates are.
#[pyclass(frozen, module = "pyplatewash", name = "ClearanceModel")]
pub struct ClearanceObject {
    inner: ClearanceModel,
    /// `T_world_base`, where the base is not the world.
    mount: Option<Pose>,
    source: ModelSource,
}

/// Source of a clearance model.
enum ModelSource {
    /// Robot, tool, plates.
    Arguments(Py<Robot>, Option<Py<PyAny>>, Py<PyTuple>),
    /// A job, or a plan.
    Job(Py<PyAny>),
}

const JOB: &str = "a WashJob, a PaperJob, a Plan, what plan() returns, or the path of a plan file";

fn finite(py: Python<'_>, q: &[JointVector]) -> PyResult<()> {
    match q.iter().position(|q| !q.iter().all(|v| v.is_finite())) {
        None => Ok(()),
        Some(row) => Err(exception::input(py, "q", &format!("row {row} is not finite"))),
    }
}

/// Indices of plates.
fn indices(working: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<usize>> {
    let index = |name: &str, value: &Bound<'_, PyAny>| argument::count(name, value, ANY_COUNT);
    let read = |working| argument::each("working", working, "a list of plate indices", index);
    Ok(working.map(read).transpose()?.unwrap_or_default())
}

/// Arm and terms of a job or a plan, and the object that the model keeps.
fn terms_of<'py>(job: &Bound<'py, PyAny>) -> PyResult<(Arc<RobotModel>, JobTerms, Bound<'py, PyAny>)> {
    let py = job.py();
    if let Ok(wash) = job.cast::<WashJobObject>() {
        let inner = wash.get().inner();
        return Ok((inner.shared_arm(), inner.terms().clone(), job.clone()));
    }
    if let Ok(paper) = job.cast::<PaperJobObject>() {
        let paper = paper.get();
        return Ok((paper.inner().arm.clone(), paper.terms(py)?, job.clone()));
    }
    let plan = PlanObject::given_among("job", job, JOB)?;
    let (arm, terms) = (plan.get().arm(py, None)?, plan.get().inner().job.clone());
    Ok((arm, terms, plan.into_any()))
}

impl ClearanceObject {
    fn record<'py>(&self, py: Python<'py>, pair: &PairClearance) -> PyResult<Bound<'py, PyAny>> {
        let text = format!("{} – {}: {:.1} mm", pair.a, pair.b, 1e3 * pair.distance_m);
        let Some(mount) = &self.mount else {
            return to_record(py, pair, Some(text));
        };
        let mut pair = pair.clone();
        pair.place_m = (mount * Point3::from(pair.place_m)).coords.into();
        to_record(py, &pair, Some(text))
    }

    fn one(q: &Bound<'_, PyAny>) -> PyResult<JointVector> {
        let found = arrays::joint_vector("q", q)?;
        finite(q.py(), &[found])?;
        Ok(found)
    }
}

#[pymethods]
impl ClearanceObject {
    #[new]
    #[pyo3(signature = (robot, tool=None, plates=None), text_signature = "(robot, tool=None, plates=())")]
    fn new(
        py: Python<'_>,
        robot: &Bound<'_, PyAny>,
        tool: Option<Bound<'_, PyAny>>,
        plates: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let robot = argument::object::<Robot>("robot", robot, ROBOT)?;
        let read = |name: &str, plate: &Bound<'_, PyAny>| {
            Ok((PlateFields::read(name, plate)?.plate(py)?, plate.clone().unbind()))
        };
        let plates = plates.map(|plates| argument::each("plates", plates, "a list of Plates", read));
        let (plates, given): (Vec<_>, Vec<_>) = plates.transpose()?.unwrap_or_default().into_iter().unzip();
        let model = robot.get().model().clone();
        let held = match &tool {
            Some(tool) => ToolFields::read(tool)?.on(py, &model)?,
            None => Tool::from(StraightTool::default()),
        };
        let inner = alone(py, || {
            let workcell = assembly::workcell_on_floor(&model, held)?;
            ClearanceModel::new(&model, &workcell, &plates)
        })?;
        let inner = inner.map_err(|e| exception::input(py, "robot", &e.to_string()))?;
        let plates = PyTuple::new(py, given)?.unbind();
        Ok(Self {
            inner,
            mount: None,
            source: ModelSource::Arguments(robot.clone().unbind(), tool.map(Bound::unbind), plates),
        })
    }

    /// The model of a job's cell, or of a plan's: its arm where it is mounted, its tool with all its bodies, floor, table, obstacles and plates,
    /// without the pairs that the job leaves out. An obstacle with a margin is as large as it is with that.
    ///
    /// Raises PlanError for a plan whose numbers make no cell, ArmError for one whose arm is not at hand.
    #[classmethod]
    fn of(_class: &Bound<'_, PyType>, job: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = job.py();
        let (arm, terms, job) = terms_of(job)?;
        let made = alone(py, || -> Result<_, Failure> {
            terms.validate().map_err(JobError::from)?;
            let model = ClearanceModel::new(&arm, &terms.workcell, &terms.plates)?;
            let workcell = &terms.workcell;
            Ok((model, (!workcell.is_in_base_frame()).then_some(workcell.mount)))
        })?;
        let (inner, mount) = made.map_err(|e| errors::failure(py, &e))?;
        Ok(Self {
            inner,
            mount,
            source: ModelSource::Job(job.unbind()),
        })
    }

    /// Names of the bodies: links, the tool's, what stands around, plates.
    #[getter]
    fn bodies(&self) -> Vec<&str> {
        self.inner.body_names()
    }

    /// The pairs of bodies that are checked, by name; P of them.
    #[getter]
    fn pairs(&self) -> Vec<(&str, &str)> {
        self.inner.pair_names()
    }

    /// Distances of all pairs [m], in the order of `pairs`: `q` of shape (6,) gives (P,), (N, 6) gives (N, P).
    ///
    /// Raises InputError for configurations that are not finite.
    fn distances<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let numbers = Numbers::read("q", q, JOINTS)?;
        let q = numbers.joints()?;
        finite(py, q)?;
        let pairs = self.inner.pair_names().len();
        let shape = [numbers.stacked.unwrap_or(1), pairs];
        let shape = if numbers.stacked.is_some() {
            &shape[..]
        } else {
            &shape[1..]
        };
        let distances = arrays::zeros::<f64>(py, shape);
        if pairs == 0 {
            return Ok(distances);
        }
        let mut writable: PyReadwriteArrayDyn<'_, f64> = distances.readwrite();
        let stretch = STRETCH / 64;
        for (q, rows) in q
            .chunks(stretch)
            .zip(writable.as_slice_mut()?.chunks_mut(stretch * pairs))
        {
            released(py, || {
                q.par_iter().zip(rows.par_chunks_mut(pairs)).for_each(|(q, row)| {
                    for (cell, pair) in row.iter_mut().zip(self.inner.all(q)) {
                        *cell = pair.distance_m;
                    }
                });
            })?;
            py.check_signals()?;
        }
        drop(writable);
        Ok(distances)
    }

    /// The smallest distance at `q`, shape (6,): a record with the bodies `a` and `b`, `distance_m` and `place_m`. The sponge
    /// may touch the plates in `working`. None when there is nothing to check.
    #[pyo3(signature = (q, working=None), text_signature = "($self, q, working=())")]
    fn smallest<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        working: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        let (q, working) = (Self::one(q)?, indices(working)?);
        let found = alone(py, || self.inner.smallest(&q, &working))?;
        found.map(|pair| self.record(py, &pair)).transpose()
    }

    /// All pairs nearer than `required_m` or in contact at `q`, shape (6,), nearest first. The sponge may touch the plates in
    /// `working`.
    #[pyo3(signature = (q, required_m=None, working=None), text_signature = "($self, q, required_m=0.0, working=())")]
    fn too_near<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        required_m: Option<&Bound<'py, PyAny>>,
        working: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyList>> {
        let (q, working) = (Self::one(q)?, indices(working)?);
        let required_m = required_m.map_or(Ok(0.0), |given| argument::number("required_m", given))?;
        let found = alone(py, || self.inner.too_near(&q, &working, required_m))?;
        let list = PyList::empty(py);
        for pair in &found {
            list.append(self.record(py, pair)?)?;
        }
        Ok(list)
    }

    fn __repr__(&self) -> String {
        let bodies = match self.inner.body_names().len() {
            1 => "1 body".to_owned(),
            count => format!("{count} bodies"),
        };
        format!(
            "ClearanceModel({bodies}, {})",
            count_with_noun(self.inner.pair_names().len(), "pair")
        )
    }

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        let of = |s: &Self| Ok::<_, PyErr>((s.is_of_job(), s.source(py)?));
        let ((job, own), (of_job, theirs)) = (of(self)?, of(other)?);
        Ok(job == of_job && own.eq(theirs)?)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (class, model) = (slf.get_type(), slf.get());
        let make = match model.is_of_job() {
            true => class.getattr("of")?,
            false => class.into_any(),
        };
        Ok((make, model.source(slf.py())?))
    }
}

impl ClearanceObject {
    fn is_of_job(&self) -> bool {
        matches!(self.source, ModelSource::Job(_))
    }

    /// Arguments that make the same model again.
    fn source<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        match &self.source {
            ModelSource::Arguments(robot, tool, plates) => (robot, tool, plates).into_pyobject(py),
            ModelSource::Job(job) => (job,).into_pyobject(py),
        }
    }
}
