//! `DynamicsModel`: rigid-body dynamics, one state at a time or in batches.

use crate::argument::{self, ROBOT};
use crate::arrays::{self, JOINTS, Numbers};
use crate::errors;
use crate::exception;
use crate::robot::Robot;
use crate::tool::ToolFields;
use crate::work::{STRETCH, released};
use nalgebra::Vector3;
use numpy::PyArrayDyn;
use platewash::simulator::dynamics::STANDARD_GRAVITY_M_S2;
use platewash::{DynamicsModel, Energy, JointVector};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyTuple, PyType};
use rayon::prelude::*;

/// Number of states in a unit of work.
const CHUNK: usize = 512;

static ENERGY: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// The rigid-body dynamics of an arm, with or without a tool: M(q) q̈ + C(q, q̇) q̇ + g(q) = τ.
///
/// `q` [rad], `qd` [rad/s], `qdd` [rad/s²] and torques [N·m] have shape (6,), or (N, 6) for many states at once; one row beside
/// many counts for all of them. NaN in, NaN out. Gravity is the acceleration of free fall in the base frame, shape (3,) [m/s²].
///
/// Raises DynamicsError for a link that states no mass or cannot exist, naming it.
#[pyclass(frozen, module = "pyplatewash", name = "DynamicsModel")]
pub struct DynamicsObject {
    inner: DynamicsModel,
    arguments: (Py<Robot>, Option<Py<PyAny>>, [f64; 3]),
}

/// Joint vectors of `K` arguments, row by row.
struct States<'py, const K: usize> {
    columns: [Numbers<'py>; K],
    /// Rows; `None` where every argument is one row.
    stacked: Option<usize>,
}

impl<'py, const K: usize> States<'py, K> {
    fn read(py: Python<'py>, names: [&'static str; K], columns: [Numbers<'py>; K]) -> PyResult<Self> {
        let stacked = columns.iter().find_map(|column| column.stacked);
        for (name, column) in names.into_iter().zip(&columns) {
            if let (Some(found), Some(n)) = (column.stacked, stacked)
                && found != n
            {
                let wanted = ["(6,)".to_owned(), format!("({n}, 6)")];
                return Err(exception::shape(py, name, &[found, 6], &wanted));
            }
        }
        Ok(Self { columns, stacked })
    }

    /// `of` every state.
    fn each<T: Send>(&self, py: Python<'py>, of: impl Fn([&JointVector; K]) -> T + Sync) -> PyResult<Vec<T>> {
        // Each column with the step of its index: 1, or 0 where one row counts for all.
        let mut columns: [(&[JointVector], usize); K] = [(&[], 0); K];
        for (place, column) in columns.iter_mut().zip(&self.columns) {
            *place = (column.joints()?, usize::from(column.stacked.is_some()));
        }
        let state = |row: usize| columns.map(|(values, stride)| &values[stride * row]);
        let Some(n) = self.stacked else {
            return Ok(vec![of(state(0))]);
        };
        let mut all = Vec::with_capacity(n);
        for from in (0..n).step_by(STRETCH) {
            let rows = from..n.min(from + STRETCH);
            let work = || {
                rows.into_par_iter()
                    .with_min_len(CHUNK)
                    .map(|row| of(state(row)))
                    .collect()
            };
            let stretch: Vec<T> = released(py, work)?;
            all.extend(stretch);
            py.check_signals()?;
        }
        Ok(all)
    }

    /// Joint vectors computed by `of` for each state, as an array of shape (6,) or (N, 6).
    fn vectors(
        &self,
        py: Python<'py>,
        of: impl Fn([&JointVector; K]) -> JointVector + Sync,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let all = self.each(py, of)?;
        match self.stacked {
            None => arrays::array(py, &[6], bytemuck::cast_slice(&all)),
            Some(_) => arrays::joint_rows(py, &all),
        }
    }
}

fn states<'py, const K: usize>(
    py: Python<'py>,
    named: [(&'static str, &Bound<'py, PyAny>); K],
) -> PyResult<States<'py, K>> {
    let mut columns = Vec::with_capacity(K);
    for (name, value) in named {
        columns.push(Numbers::read(name, value, JOINTS)?);
    }
    let columns = columns.try_into();
    let columns = columns.map_err(|_| exception::internal(py, "as many columns as arguments"))?;
    States::read(py, named.map(|(name, _)| name), columns)
}

#[pymethods]
impl DynamicsObject {
    #[new]
    #[pyo3(signature = (robot, tool=None, *, gravity_m_s2=None))]
    fn new(
        robot: &Bound<'_, PyAny>,
        tool: Option<Bound<'_, PyAny>>,
        gravity_m_s2: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let py = robot.py();
        let robot = argument::object::<Robot>("robot", robot, ROBOT)?;
        let model = robot.get().model();
        let held = tool.as_ref().map(|tool| ToolFields::read(tool)?.on(py, model));
        let held = held.transpose()?;
        let gravity = match gravity_m_s2 {
            Some(given) => arrays::fixed::<3>("gravity_m_s2", given)?,
            None => [0.0, 0.0, -STANDARD_GRAVITY_M_S2],
        };
        let model = DynamicsModel::new(model, held.as_ref());
        let inner = model.and_then(|model| model.with_gravity(Vector3::from(gravity)));
        Ok(Self {
            inner: inner.map_err(|e| errors::dynamics(py, &e))?,
            arguments: (robot.clone().unbind(), tool.map(Bound::unbind), gravity),
        })
    }

    /// Mass of everything that moves [kg].
    #[getter]
    fn moving_mass_kg(&self) -> f64 {
        self.inner.moving_mass_kg()
    }

    /// Torques with which the arm accelerates by `qdd` (Pinocchio's `rnea`): τ = M(q) q̈ + C(q, q̇) q̇ + g(q).
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        qdd: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let states = states(py, [("q", q), ("qd", qd), ("qdd", qdd)])?;
        states.vectors(py, |[q, qd, qdd]| self.inner.inverse_dynamics(q, qd, qdd))
    }

    /// Accelerations under torques (Pinocchio's `aba`): M(q) q̈ = τ − C(q, q̇) q̇ − g(q).
    fn forward_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
        torque: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let states = states(py, [("q", q), ("qd", qd), ("torque", torque)])?;
        states.vectors(py, |[q, qd, torque]| self.inner.forward_dynamics(q, qd, torque))
    }

    /// Mass matrix M(q) [kg·m²] (Pinocchio's `crba`, both triangles): shape (6, 6) or (N, 6, 6).
    fn mass_matrix<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let states = states(py, [("q", q)])?;
        let all = states.each(py, |[q]| self.inner.mass_matrix(q))?;
        // Symmetric, so that rows and columns are the same.
        let values = bytemuck::cast_slice(&all);
        match states.stacked {
            None => arrays::array(py, &[6, 6], values),
            Some(n) => arrays::array(py, &[n, 6, 6], values),
        }
    }

    /// Torques g(q) that hold the arm still (Pinocchio's `computeGeneralizedGravity`).
    fn gravity_torque<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        states(py, [("q", q)])?.vectors(py, |[q]| self.inner.gravity_torque(q))
    }

    /// Centrifugal and Coriolis torques C(q, q̇) q̇.
    fn coriolis_torque<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        states(py, [("q", q), ("qd", qd)])?.vectors(py, |[q, qd]| self.inner.coriolis_torque(q, qd))
    }

    /// Torques C(q, q̇) q̇ + g(q) at which nothing accelerates (Pinocchio's `nonLinearEffects`).
    fn bias_torque<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        states(py, [("q", q), ("qd", qd)])?.vectors(py, |[q, qd]| self.inner.bias_torque(q, qd))
    }

    /// Kinetic and potential energy [J]: numbers for one state, shape (N,) each for many.
    fn energy<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        qd: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let states = states(py, [("q", q), ("qd", qd)])?;
        let all: Vec<Energy> = states.each(py, |[q, qd]| self.inner.energy(q, qd))?;
        let class = ENERGY.import(py, "pyplatewash._records", "Energy")?;
        match (states.stacked, all.first()) {
            (None, Some(one)) => class.call1((one.kinetic_j, one.potential_j)),
            _ => {
                let (kinetic, potential) = all.iter().map(|e| (e.kinetic_j, e.potential_j)).unzip();
                class.call1((arrays::line::<f64>(py, kinetic), arrays::line::<f64>(py, potential)))
            }
        }
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let name = self.arguments.0.bind(py).get().model().name().to_owned();
        format!(
            "DynamicsModel('{name}', {:.3} kg that move)",
            self.inner.moving_mass_kg()
        )
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.inner == other.inner
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let arguments = &slf.get().arguments;
        Ok((slf.get_type().getattr("_restore")?, arguments.into_pyobject(slf.py())?))
    }

    /// Restores a pickled model.
    #[classmethod]
    fn _restore(
        _class: &Bound<'_, PyType>,
        robot: &Bound<'_, PyAny>,
        tool: Option<Bound<'_, PyAny>>,
        gravity_m_s2: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        Self::new(robot, tool, Some(gravity_m_s2))
    }
}
