//! `Trajectory`: joint motion over time.

use crate::arrays::{self, Count, ExpectedShape, MANY_JOINTS, Numbers};
use crate::work::released;
use crate::{argument, exception};
use numpy::PyArrayDyn;
use platewash::motion::trajectory::{JointState, KnotError, SegmentExtremes};
use platewash::{JointVector, Trajectory};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use rayon::prelude::*;

const TIMES: ExpectedShape = ExpectedShape {
    item: &[],
    count: Count::Any,
};
/// A stack of times.
pub const MANY_TIMES: ExpectedShape = ExpectedShape {
    item: &[],
    count: Count::Stack,
};

/// Positions, speeds and accelerations.
type States<'py> = (
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyArrayDyn<f64>>,
);

/// Joint motion over time: knots with cubic Hermite segments between them, so that extremes are exact.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Trajectory")]
#[derive(PartialEq)]
pub struct TrajectoryObject {
    inner: Trajectory,
}

impl From<Trajectory> for TrajectoryObject {
    fn from(inner: Trajectory) -> Self {
        Self { inner }
    }
}

fn knots(py: Python<'_>, t_s: Vec<f64>, q: &[JointVector], qd: &[JointVector]) -> PyResult<Trajectory> {
    for (name, found) in [("q_rad", q.len()), ("qd_rad_s", qd.len())] {
        if found != t_s.len() {
            let wanted = [format!("({}, 6), a row for each of t_s,", t_s.len())];
            return Err(exception::shape(py, name, &[found, 6], &wanted));
        }
    }
    let finite = |all: &[JointVector], knot: usize| all[knot].iter().all(|v| v.is_finite());
    Trajectory::from_knots(t_s, q.to_vec(), qd.to_vec()).map_err(|e: KnotError| {
        let name = match e {
            KnotError::NotFinite { knot } if !finite(q, knot) => "q_rad",
            KnotError::NotFinite { knot } if !finite(qd, knot) => "qd_rad_s",
            _ => "t_s",
        };
        exception::input(py, name, &e.to_string())
    })
}

#[pymethods]
impl TrajectoryObject {
    /// A motion from its knots: times, shape (N,) [s], strictly ascending from 0; positions and speeds, shape (N, 6) [rad, rad/s].
    ///
    /// Raises InputError with the first knot that does not fit.
    #[new]
    fn new(
        py: Python<'_>,
        t_s: &Bound<'_, PyAny>,
        q_rad: &Bound<'_, PyAny>,
        qd_rad_s: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let t = Numbers::read("t_s", t_s, MANY_TIMES)?;
        let q = Numbers::read("q_rad", q_rad, MANY_JOINTS)?;
        let qd = Numbers::read("qd_rad_s", qd_rad_s, MANY_JOINTS)?;
        Ok(knots(py, t.values()?.to_vec(), q.joints()?, qd.joints()?)?.into())
    }

    /// A motion through positions, shape (N, 6) [rad], at equal time steps [s]: speeds are central differences, zero at both ends.
    #[staticmethod]
    fn through(py: Python<'_>, q_rad: &Bound<'_, PyAny>, dt_s: &Bound<'_, PyAny>) -> PyResult<Self> {
        let dt_s = argument::number("dt_s", dt_s)?;
        let q = Numbers::read("q_rad", q_rad, MANY_JOINTS)?;
        if !(dt_s.is_finite() && dt_s > 0.0) {
            return Err(exception::input(
                py,
                "dt_s",
                &format!("must be a positive number of seconds; found {dt_s}"),
            ));
        }
        let motion = Trajectory::through(q.joints()?.to_vec(), dt_s);
        let (t, q, qd) = (motion.times(), motion.positions(), motion.speeds());
        Ok(knots(py, t.to_vec(), q, qd)?.into())
    }

    /// Times of the knots, shape (N,) [s].
    #[getter]
    fn t_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::array(py, &[self.inner.times().len()], self.inner.times())
    }

    /// Positions at the knots, shape (N, 6) [rad].
    #[getter]
    fn q_rad<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::joint_rows(py, self.inner.positions())
    }

    /// Speeds at the knots, shape (N, 6) [rad/s].
    #[getter]
    fn qd_rad_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::joint_rows(py, self.inner.speeds())
    }

    /// Time of the last knot [s].
    #[getter]
    fn duration_s(&self) -> f64 {
        self.inner.duration_s()
    }

    /// Positions [rad], speeds [rad/s] and accelerations [rad/s²] at a time (shape (6,) each) or at times, shape (N,)
    /// (shape (N, 6) each) [s]. Outside the motion the arm rests at its nearer end: speeds and accelerations are zero.
    fn at<'py>(&self, py: Python<'py>, t_s: &Bound<'py, PyAny>) -> PyResult<States<'py>> {
        let times = Numbers::read("t_s", t_s, TIMES)?;
        let values = times.values()?;
        if self.inner.times().is_empty() {
            return Err(exception::input(py, "t_s", "the motion has no knots"));
        }
        let states: Option<Vec<JointState>> = released(py, || {
            values.par_iter().with_min_len(512).map(|t| self.inner.at(*t)).collect()
        })?;
        let states = states.ok_or_else(|| exception::input(py, "t_s", "times must not be NaN"))?;
        let column = |of: fn(&JointState) -> JointVector| {
            let rows: Vec<_> = states.iter().map(of).collect();
            match times.stacked {
                None => arrays::array(py, &[6], rows[0].as_slice()),
                Some(_) => arrays::joint_rows(py, &rows),
            }
        };
        Ok((column(|s| s.q)?, column(|s| s.qd)?, column(|s| s.qdd)?))
    }

    /// Exact extremes of every segment, N of them: a dictionary with `span_s` (N, 2), `q_min_rad`, `q_max_rad`,
    /// `speed_rad_s` and `acceleration_rad_s2` (N, 6).
    fn extremes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all: Vec<SegmentExtremes> = self.inner.extremes().collect();
        let spans: Vec<f64> = all.iter().flat_map(|s| s.span_s).collect();
        let rows =
            |of: fn(&SegmentExtremes) -> JointVector| arrays::joint_rows(py, &all.iter().map(of).collect::<Vec<_>>());
        let extremes = PyDict::new(py);
        extremes.set_item("span_s", arrays::array(py, &[all.len(), 2], &spans)?)?;
        extremes.set_item("q_min_rad", rows(|s| s.position[0])?)?;
        extremes.set_item("q_max_rad", rows(|s| s.position[1])?)?;
        extremes.set_item("speed_rad_s", rows(|s| s.speed)?)?;
        extremes.set_item("acceleration_rad_s2", rows(|s| s.acceleration)?)?;
        Ok(extremes)
    }

    fn __len__(&self) -> usize {
        self.inner.times().len()
    }

    fn __repr__(&self) -> String {
        format!(
            "Trajectory({} knots, {:.3} s)",
            self.inner.times().len(),
            self.inner.duration_s()
        )
    }

    fn __getnewargs__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.t_s(py)?, self.q_rad(py)?, self.qd_rad_s(py)?).into_pyobject(py)
    }
}
