//! `ClearanceModel`: smallest distances between bodies.

use crate::argument::{self, ANY_COUNT, ROBOT};
use crate::arrays::{self, JOINTS, Numbers};
use crate::errors;
use crate::made;
use crate::plate::PlateFields;
use crate::robot::Robot;
use crate::tool::ToolFields;
use crate::value::to_record;
use crate::work::{STRETCH, alone, released};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadwriteArrayDyn};
use platewash::workcell::tool::StraightTool;
use platewash::{ClearanceModel, JointVector, PairClearance, Tool, Workcell};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use rayon::prelude::*;

/// The bodies and pairs of one workcell: the arm, its tool, the floor and the plates.
///
/// Without a tool there is no tool body. Distances are metres, ≤ 0 when two bodies touch.
#[pyclass(frozen, module = "pyplatewash", name = "ClearanceModel")]
pub struct ClearanceObject {
    inner: ClearanceModel,
    arguments: (Py<Robot>, Option<Py<PyAny>>, Py<PyTuple>),
}

fn finite(py: Python<'_>, q: &[JointVector]) -> PyResult<()> {
    match q.iter().position(|q| !q.iter().all(|v| v.is_finite())) {
        None => Ok(()),
        Some(row) => Err(errors::input(py, "q", &format!("row {row} is not finite"))),
    }
}

/// Indices of plates.
fn indices(working: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<usize>> {
    let index = |name: &str, value: &Bound<'_, PyAny>| argument::count(name, value, ANY_COUNT);
    let read = |working| argument::each("working", working, "a list of plate indices", index);
    Ok(working.map(read).transpose()?.unwrap_or_default())
}

fn record<'py>(py: Python<'py>, pair: &PairClearance) -> PyResult<Bound<'py, PyAny>> {
    let text = format!("{} – {}: {:.1} mm", pair.a, pair.b, 1e3 * pair.distance_m);
    to_record(py, pair, Some(text))
}

impl ClearanceObject {
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
            Ok((PlateFields::of(name, plate)?.plate(py)?, plate.clone().unbind()))
        };
        let plates = plates.map(|plates| argument::each("plates", plates, "a list of Plates", read));
        let (plates, given): (Vec<_>, Vec<_>) = plates.transpose()?.unwrap_or_default().into_iter().unzip();
        let held = match &tool {
            Some(tool) => ToolFields::of(tool)?.tool(py)?,
            None => Tool::from(StraightTool::default()),
        };
        let model = robot.get().model().clone();
        let inner = alone(py, || {
            let workcell = Workcell::on_floor(&model, held)?;
            ClearanceModel::new(&model, &workcell, &plates)
        })?;
        let inner = inner.map_err(|e| errors::input(py, "robot", &e.to_string()))?;
        let arguments = (
            robot.clone().unbind(),
            tool.map(Bound::unbind),
            PyTuple::new(py, given)?.unbind(),
        );
        Ok(Self { inner, arguments })
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
        let distances = made::zeros::<f64>(py, shape);
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
        found.map(|pair| record(py, &pair)).transpose()
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
            list.append(record(py, pair)?)?;
        }
        Ok(list)
    }

    fn __repr__(&self) -> String {
        format!("ClearanceModel({} pairs)", self.inner.pair_names().len())
    }

    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        let of = |s: &Self| {
            (
                s.arguments.0.clone_ref(py),
                s.arguments.1.as_ref().map(|t| t.clone_ref(py)),
                s.arguments.2.clone_ref(py),
            )
        };
        of(self).into_pyobject(py)?.eq(of(other).into_pyobject(py)?)
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __getnewargs__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let (robot, tool, plates) = &self.arguments;
        (robot, tool, plates).into_pyobject(py)
    }
}
