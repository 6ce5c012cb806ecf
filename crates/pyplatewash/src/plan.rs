//! `Plan`: the plan file.

use crate::errors::{self, FileKind, SystemWord};
use crate::plate::plates;
use crate::robot::Robot;
use crate::trajectory::TrajectoryObject;
use crate::value::{records, to_python, to_record};
use crate::work::ask;
use crate::{argument, arrays, dry_run, exception, export, recovery};
use numpy::PyArrayDyn;
use platewash::export::ros2::{self, Ros2};
use platewash::kinematics::urdf::file;
use platewash::motion::csv::table as csv_table;
use platewash::motion::plan::PlanFileError;
use platewash::motion::trajectory::KnotError;
use platewash::workcell::ArmId;
use platewash::workcell::dry_run::{HEIGHT_M, SPEED_M_S};
use platewash::workcell::wash_path::WashPath;
use platewash::workcell::words::quoted;
use platewash::{Plan, RobotModel};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList, PyString, PyTuple, PyType};
use std::sync::Arc;

/// Python's class of a recovery.
static RECOVERY: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Longest plan file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 30;

/// A plan: everything that a verifier needs besides the URDF, sealed with a hash. Immutable.
///
/// A plan that was made in this process knows its arm (`robot`), so that `prove`, `simulate` and `tune` need no other; a pickle takes
/// the arm along. A plan file holds no arm: a plan that is read from one knows the built-in arm only.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Plan")]
pub struct PlanObject {
    inner: Plan,
    robot: Option<Py<Robot>>,
}

impl PartialEq for PlanObject {
    /// A plan is what its file says.
    fn eq(&self, other: &Self) -> bool {
        self.inner == other.inner
    }
}

/// An unreadable or unwritable plan.
pub fn file_error(py: Python<'_>, error: &PlanFileError) -> PyErr {
    exception::named(py, "PlanFileError", &error.to_string())
}

impl PlanObject {
    /// A plan, with its arm where that is at hand.
    #[must_use]
    pub fn new(inner: Plan, robot: Option<Py<Robot>>) -> Self {
        Self { inner, robot }
    }

    /// The plan of an argument: a plan, what has one, as what `plan` returns, or the path of a plan file.
    ///
    /// # Errors
    /// `InputTypeError`; `FileError`; `PlanFileError` for a file that is no plan.
    pub fn given<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Self>> {
        Self::given_among(name, value, "a Plan, what plan() returns, or the path of a plan file")
    }

    /// The same of an argument that may be something else besides: `needed` names it all.
    ///
    /// # Errors
    /// As [`given`](Self::given).
    pub fn given_among<'py>(name: &str, value: &Bound<'py, PyAny>, needed: &str) -> PyResult<Bound<'py, Self>> {
        if let Ok(plan) = value.cast::<Self>() {
            return Ok(plan.clone());
        }
        if let Some(Ok(plan)) = value.getattr_opt("plan")?.map(|plan| plan.cast_into::<Self>()) {
            return Ok(plan);
        }
        if !(value.is_instance_of::<PyString>() || value.hasattr("__fspath__")?) {
            return Err(argument::wrong_type(name, value, needed));
        }
        Bound::new(value.py(), Self::read(name, value)?)
    }

    fn read(name: &str, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (py, path) = (path.py(), argument::path(name, path)?);
        let text = file::read_text(&path, MAX_BYTES).map_err(|e| errors::unread(py, FileKind::Plan, &path, &e))?;
        let plan = Plan::from_json(&text).map_err(|e| {
            let message = format!("{}: {e}", path.display());
            exception::named(py, "PlanFileError", &message)
        })?;
        Ok(Self::new(plan, None))
    }

    /// The plan.
    #[must_use]
    pub fn inner(&self) -> &Plan {
        &self.inner
    }

    /// The arm to judge the plan with: the one given, else its own.
    ///
    /// # Errors
    /// `ProveError` for a plan from a file that names an arm which is not at hand.
    pub fn arm(&self, py: Python<'_>, given: Option<&Bound<'_, Robot>>) -> PyResult<Arc<RobotModel>> {
        Ok(self.robot_for(py, given)?.get().model().clone())
    }

    /// The same as Python's object.
    ///
    /// # Errors
    /// As [`PlanObject::arm`].
    pub fn robot_for(&self, py: Python<'_>, given: Option<&Bound<'_, Robot>>) -> PyResult<Py<Robot>> {
        match given {
            Some(robot) => Ok(robot.clone().unbind()),
            None => self
                .own_arm(py)?
                .ok_or_else(|| errors::arm_needed(py, &self.inner.job.workcell.arm)),
        }
    }

    /// The arm that the plan was made for, or the built-in one where that is it.
    fn own_arm(&self, py: Python<'_>) -> PyResult<Option<Py<Robot>>> {
        if let Some(robot) = &self.robot {
            return Ok(Some(robot.clone_ref(py)));
        }
        let built_in = Robot::built_in(py)?;
        let is_it = ArmId::new(built_in.get().model()) == self.inner.job.workcell.arm;
        Ok(is_it.then_some(built_in))
    }
}

#[pymethods]
impl PlanObject {
    /// A plan from its file's text. The hash is not checked: see `is_sealed`.
    ///
    /// Raises PlanFileError.
    #[classmethod]
    fn from_json(_class: &Bound<'_, PyType>, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = argument::text("text", text, "a plan file's text")?;
        Ok(Self::new(Plan::from_json(&text).map_err(|e| file_error(py, &e))?, None))
    }

    /// Restores a pickled plan with its arm.
    #[classmethod]
    fn _restore(
        class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        robot: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let Self { inner, .. } = Self::from_json(class, py, text)?;
        let robot = Robot::given(robot)?.map(|robot| robot.clone().unbind());
        Ok(Self { inner, robot })
    }

    /// A plan from its file. The hash is not checked: see `is_sealed`.
    ///
    /// Raises PlanFileError; for a file that cannot be read it is a FileError, too.
    #[classmethod]
    fn load(_class: &Bound<'_, PyType>, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::read("path", path)
    }

    /// Writes the plan file.
    ///
    /// Raises PlanFileError, which is a FileError, too.
    fn save(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let path = argument::path("path", path)?;
        std::fs::write(&path, self.to_json(py)?).map_err(|e| {
            let filename = path.display().to_string();
            let message = format!("{filename}: cannot be written: {e}");
            errors::system_file(py, FileKind::Plan, SystemWord::from(&e), &filename, &message)
        })
    }

    /// The arm that the plan was made for, where it is known; None for a plan from a file that names another arm than the built-in
    /// one.
    #[getter]
    fn robot(&self, py: Python<'_>) -> PyResult<Option<Py<Robot>>> {
        self.own_arm(py)
    }

    /// The plan file's text: canonical JSON, one line.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        self.inner.to_json().map_err(|e| file_error(py, &e))
    }

    /// Everything as plain dictionaries and lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner)
    }

    /// SHA-256 over the contents, None for a plan that was never sealed.
    #[getter]
    fn hash(&self) -> Option<&str> {
        self.inner.hash.as_deref()
    }

    /// True where the hash is that of the contents.
    fn is_sealed(&self) -> bool {
        self.inner.is_sealed()
    }

    /// `"wash"`, or `"paper"` for a run of the paper's program, for which there is no certificate.
    #[getter]
    fn process(&self) -> String {
        self.inner.process.to_string()
    }

    /// The job, resolved: `workcell`, `plates`, `requirements`, `limits`, `home_rad`, `planner`, `seed`, `simulation`.
    #[getter]
    fn job<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.job, None)
    }

    /// Origin of the plan: `scenario`, `version`. Stated, never judged.
    #[getter]
    fn provenance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.provenance, None)
    }

    /// The plates.
    #[getter]
    fn plates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        plates(py, &self.inner.job.plates)
    }

    /// Plate indices in the order of washing.
    #[getter]
    fn order(&self) -> Vec<usize> {
        self.inner.order.clone()
    }

    /// The segments in time: `kind`, `plate`, `t_start_s`, `t_end_s`.
    #[getter]
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.segments)
    }

    /// The wash paths, in the order of washing: `plate`, `curve`, `lift_m`, `cone_rad`; none for the paper's program.
    #[getter]
    fn wash_paths<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.wash_paths)
    }

    /// The wash paths from above, each of shape (N, 2), world frame [m], with chords that leave them by at most `chord_error_m`.
    ///
    /// Raises InputError for a path whose numbers are out of range, or whose plate is not there.
    fn _wash_curves<'py>(&self, py: Python<'py>, chord_error_m: f64) -> PyResult<Vec<Bound<'py, PyArrayDyn<f64>>>> {
        let curve = |path: &WashPath| {
            let plate = self.inner.job.plates.get(path.plate).filter(|_| path.curve.is_sound());
            let problem = "a path is on no plate, or one of its numbers is out of range";
            let plate = plate.ok_or_else(|| exception::keyed(py, "wash_paths", problem))?;
            let theta = path.curve.parameters(&plate.surface, chord_error_m);
            let points = theta.iter().map(|theta| path.contact(plate, *theta).xy());
            let points: Vec<f64> = points.flat_map(<[f64; 2]>::from).collect();
            arrays::array(py, &[theta.len(), 2], &points)
        };
        self.inner.wash_paths.iter().map(curve).collect()
    }

    /// Duration of the motion [s].
    #[getter]
    fn duration_s(&self) -> f64 {
        self.inner.duration_s()
    }

    /// The motion.
    ///
    /// Raises InputError for a file whose knots are no motion.
    #[getter]
    fn trajectory(&self, py: Python<'_>) -> PyResult<TrajectoryObject> {
        let motion = self.inner.knots.motion().map_err(|e| match e {
            KnotError::Count { .. } => exception::keyed(py, "knots", &e.to_string()),
            _ => exception::input(py, "knots", &e.to_string()),
        });
        Ok(motion?.into())
    }

    /// The motion as CSV text, every `dt_s` [s], by default the job's. `robot` is the arm, by default the one that the plan was made
    /// for.
    ///
    /// Raises ProveError for a plan whose arm must be given.
    #[pyo3(signature = (dt_s=None, robot=None))]
    fn to_csv(
        &self,
        py: Python<'_>,
        dt_s: Option<&Bound<'_, PyAny>>,
        robot: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let (plan, arm) = (&self.inner, self.arm(py, Robot::given(robot)?)?);
        let dt_s = dt_s.map(|dt_s| argument::number("dt_s", dt_s)).transpose()?;
        let dt_s = dt_s.unwrap_or(plan.job.simulation.control.dt_s);
        let motion = plan
            .knots
            .motion()
            .map_err(|e| exception::input(py, "knots", &e.to_string()))?;
        let tip = plan.job.workcell.tool.tip_frame(&arm);
        let table = csv_table(&motion, &plan.segments, &arm, &tip, dt_s);
        table
            .map(|table| table.to_string())
            .map_err(|e| exception::input(py, "dt_s", &e.to_string()))
    }

    /// A robot program of the plan, as a dictionary of its files' texts by their names: `"ros2"` and the other targets of the command's
    /// `export`. The plan is proved, the program read back, interpreted and judged; what does not hold is not handed over.
    ///
    /// With `out`, a folder that is there or can be made, the files are written there, all of them or none. The tip may be `tolerance_m` from the
    /// plan [m]. The program runs at `speed_share` of the plan's speed, and corners between its points have the radius `corner_m` [m], where it has
    /// corners. What the certificate waives must be accepted by name: `accept`. `joint_3` is how an ABB controller counts axis 3, `"with-joint-2"`
    /// where a parallel linkage makes it the sum of joints 2 and 3, else `"independent"`; some arms are refused without it. `stands_rad` is where
    /// the arm stands now, shape (6,) [rad], `tip` the tool's tip in the flange's frame as the controller has it, shape (4, 4): both are compared
    /// with the plan. `robot` is the arm, by default the one that the plan was made for.
    ///
    /// Raises ExportError, with `code`, for a plan that is not handed over; InputError; FileError; ProveError for a plan whose arm must
    /// be given.
    #[pyo3(
        signature = (
            to, out=None, *, tolerance_m=None, speed_share=None, corner_m=None, accept=None, joint_3=None, stands_rad=None, tip=None,
            robot=None
        ),
        text_signature = "($self, to, out=None, *, tolerance_m=0.0002, speed_share=1.0, corner_m=0.005, accept=(), joint_3=None, \
                          stands_rad=None, tip=None, robot=None)"
    )]
    #[expect(clippy::too_many_arguments, reason = "Python's keywords")]
    fn export<'py>(
        &self,
        py: Python<'py>,
        to: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        tolerance_m: Option<&Bound<'py, PyAny>>,
        speed_share: Option<&Bound<'py, PyAny>>,
        corner_m: Option<&Bound<'py, PyAny>>,
        accept: Option<&Bound<'py, PyAny>>,
        joint_3: Option<&Bound<'py, PyAny>>,
        stands_rad: Option<&Bound<'py, PyAny>>,
        tip: Option<&Bound<'py, PyAny>>,
        robot: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let given = export::ExportKeywords {
            tolerance_m,
            speed_share,
            corner_m,
            accept,
            joint_3,
            stands_rad,
            tip,
        };
        let (to, settings) = (export::dialect(to)?, given.settings()?);
        let out = out.map(|out| argument::path("out", out)).transpose()?;
        let arm = self.arm(py, Robot::given(robot)?)?;
        let files = PyDict::new(py);
        for file in export::files(py, &self.inner, arm, to, settings)? {
            files.set_item(file.name, file.text)?;
        }
        if let Some(out) = out {
            ask(py, "_files", "save_program", (out, &files))?;
        }
        Ok(files)
    }

    /// The plan as a `trajectory_msgs/JointTrajectory`, in plain dictionaries and lists: what `export("ros2")` has in
    /// `joint_trajectory.json`. `pyplatewash.ros` makes a message of it where ROS 2 is at hand, and writes bags.
    ///
    /// Positions are in rad, speeds in rad/s; the first point is after a lead-in of half a second. Arguments and exceptions are those of
    /// `export`.
    #[pyo3(
        signature = (speed_share=None, *, accept=None, stands_rad=None, robot=None),
        text_signature = "($self, speed_share=1.0, *, accept=(), stands_rad=None, robot=None)"
    )]
    fn to_joint_trajectory<'py>(
        &self,
        py: Python<'py>,
        speed_share: Option<&Bound<'py, PyAny>>,
        accept: Option<&Bound<'py, PyAny>>,
        stands_rad: Option<&Bound<'py, PyAny>>,
        robot: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = export::ExportKeywords {
            tolerance_m: None,
            speed_share,
            corner_m: None,
            accept,
            joint_3: None,
            stands_rad,
            tip: None,
        };
        let (settings, arm) = (given.settings()?, self.arm(py, Robot::given(robot)?)?);
        let files = export::files(py, &self.inner, arm, &Ros2, settings)?;
        let message = files.into_iter().find(|file| file.name == ros2::TRAJECTORY_JSON);
        let message = message.ok_or_else(|| exception::internal(py, "a ROS 2 program without its message"))?;
        py.import("json")?.getattr("loads")?.call1((message.text,))
    }

    /// The motion of the plan in the air, `height_m` above its plates [m] with the tip nowhere faster than `speed_m_s` [m/s]: the same
    /// plates in the same order with the same wash paths, planned as a plan of its own, which names this one by its hash. This plan is
    /// proved first; the one that is made is not: see `prove`. `robot` is the arm, by default the one that the plan was made for.
    ///
    /// Raises PlanError, with the stage `"dry_run"` for a plan that has no dry run, such as one that is not proved, else where no plan is
    /// found at that height; InputError for a height or a speed that is none; ProveError for a plan whose arm must be given.
    #[pyo3(
        signature = (height_m=None, speed_m_s=None, *, robot=None),
        text_signature = "($self, height_m=0.05, speed_m_s=0.1, *, robot=None)"
    )]
    fn dry_run(
        &self,
        py: Python<'_>,
        height_m: Option<&Bound<'_, PyAny>>,
        speed_m_s: Option<&Bound<'_, PyAny>>,
        robot: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let asked = dry_run::DryRunSettings {
            height_m: argument::number_or("height_m", height_m, HEIGHT_M)?,
            speed_m_s: argument::number_or("speed_m_s", speed_m_s, SPEED_M_S)?,
        };
        let robot = self.robot_for(py, Robot::given(robot)?)?;
        let plan = dry_run::planned(py, &self.inner, robot.get().model(), asked)?;
        Ok(Self::new(plan, Some(robot)))
    }

    /// The way on after a stop: a motion from where the arm stands home, and a plan of the plates that are left, as a `Recovery`.
    ///
    /// `stands_rad` is where the arm stands, shape (6,) [rad], `stopped_s` the time in the plan at which it was stopped [s]; without it the
    /// earliest moment at which the plan is about there counts, so that a plate may be washed twice and none is left out. This plan is
    /// proved first; those that are made are not: see `prove`. `robot` is the arm, by default the one that the plan was made for.
    ///
    /// Raises PlanError, with the stage `"recovery"` where bodies touch or no way was found; InputError for a time outside of the plan, or one that
    /// the joints do not fit although they fit the plan at another time;
    /// ProveError for a plan whose arm must be given.
    #[pyo3(signature = (stands_rad, stopped_s=None, *, robot=None))]
    fn recover<'py>(
        &self,
        py: Python<'py>,
        stands_rad: &Bound<'py, PyAny>,
        stopped_s: Option<&Bound<'py, PyAny>>,
        robot: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let stands = arrays::joint_vector("stands_rad", stands_rad)?;
        let stopped_s = stopped_s
            .map(|value| argument::number("stopped_s", value))
            .transpose()?;
        let robot = self.robot_for(py, Robot::given(robot)?)?;
        let found = recovery::recovered(py, &self.inner, robot.get().model(), stands, stopped_s)?;
        let object = |plan| Self::new(plan, Some(robot.clone_ref(py)));
        RECOVERY.import(py, "pyplatewash._records", "Recovery")?.call1((
            object(found.home),
            found.rest.map(object),
            to_record(py, &found.stop, None)?,
            records(py, &found.near)?,
        ))
    }

    fn __repr__(&self) -> String {
        let hash = self.inner.hash.as_deref().and_then(|h| h.get(..8)).unwrap_or("none");
        let (name, seed) = (quoted(&self.inner.provenance.scenario), self.inner.job.seed);
        let duration_s = self.inner.duration_s();
        let dry_run = self.inner.job.dry_run.as_ref();
        let dry_run = dry_run.map_or_else(String::new, |of| format!("dry run of {}…, ", of.parent_short()));
        format!("Plan({name}, {dry_run}seed={seed}, {duration_s:.2} s, hash {hash}…)")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, plan) = (slf.py(), slf.get());
        let arguments = (plan.to_json(py)?, plan.robot.as_ref().map(|robot| robot.clone_ref(py)));
        Ok((slf.get_type().getattr("_restore")?, arguments.into_pyobject(py)?))
    }
}
