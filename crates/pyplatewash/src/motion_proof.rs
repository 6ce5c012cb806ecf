//! `prove_motion`: a trajectory of any planner, proved over its whole time.

use crate::argument;
use crate::arrays::{self, MANY_JOINTS, Numbers, ONE_POSE};
use crate::errors;
use crate::exception;
use crate::pose;
use crate::robot::Robot;
use crate::tool::ToolFields;
use crate::trajectory::MANY_TIMES;
use crate::value::{from_mapping, to_record};
use crate::work::patiently;
use platewash::bodies::assembly;
use platewash::motion_proof::{Interpolation, JointPoints, PointsError};
use platewash::scenario::ObstacleText;
use platewash::{Failure, JointVector, Pose, ProveError};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyMapping, PyString, PyTuple};

/// Clearance that is required unless another one is given [m].
const CLEARANCE_M: f64 = 0.005;

/// Proves a motion of an arm, of any planner, at every moment and not at samples: joint limits, and the clearance of every pair of bodies, the
/// arm's own links included.
///
/// `q`, shape (N, 6) [rad], are the points in the order of the arm's joints; `t`, shape (N,) [s], their times, `qd`, shape (N, 6) [rad/s],
/// their speeds, and `qdd`, shape (N, 6) [rad/s²], their accelerations. Between points the motion is `"linear"` (straight in joint space),
/// `"cubic"` (with the positions and speeds of both points) or `"quintic"` (with the accelerations, too), by default the last that `qd` and
/// `qdd` allow. Without `t` positions and clearance are proved for any timing, and speeds are not judged.
/// `obstacles` is the path of a TOML file with `[[obstacle]]`, `[floor]` and `[table]` sections or of a planning scene of MoveIt (`.scene`), a
/// list of dictionaries with the keys of `[[obstacle]]`, or a dictionary of all three sections; nothing else is there. They are in the frame
/// of the world, in which the arm's root link stands at `mount`, a pose of shape (4, 4), by default at its origin. `tool` is a `Tool`.
/// `acceleration_limits`, shape (6,) [rad/s²], are judged where they are given: the arm rests before and behind straight lines, and with
/// speeds it brakes behind the last point at these limits, which is judged, too. Limits that the arm's description states count, too, the lesser
/// one of a joint; where speeds jump they are not judged, which `notes` says.
///
/// Returns a record: `proved`, `verdict` (`"proved"`, `"broken"`, `"not_proved"`), `headline`, `rules` (each with `requirement`, `status`,
/// `measure`, and the `worst` moment with `time_s`, `point`, `share`, `q_rad`), `clearance` pair by pair, `excluded` pairs, `assumptions`,
/// `end_speeds_rad_s` at the first and the last point, and `notes` on what the verdict leaves out, if there are any. Its text is what the
/// command prints.
///
/// Raises InputError for points that are no motion; ScenarioError for obstacles that do not fit.
#[pyfunction]
#[pyo3(signature = (q, t=None, qd=None, qdd=None, *, robot=None, tool=None, mount=None, obstacles=None, clearance_m=None, interpolation=None, acceleration_limits=None),
    text_signature = "(q, t=None, qd=None, qdd=None, *, robot=None, tool=None, mount=None, obstacles=None, clearance_m=0.005, interpolation=None, acceleration_limits=None)")]
#[allow(clippy::too_many_arguments)] // They have names in Python.
pub fn prove_motion<'py>(
    py: Python<'py>,
    q: &Bound<'py, PyAny>,
    t: Option<&Bound<'py, PyAny>>,
    qd: Option<&Bound<'py, PyAny>>,
    qdd: Option<&Bound<'py, PyAny>>,
    robot: Option<&Bound<'py, PyAny>>,
    tool: Option<&Bound<'py, PyAny>>,
    mount: Option<&Bound<'py, PyAny>>,
    obstacles: Option<&Bound<'py, PyAny>>,
    clearance_m: Option<&Bound<'py, PyAny>>,
    interpolation: Option<&Bound<'py, PyAny>>,
    acceleration_limits: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let joints = |name: &str, value: &Bound<'py, PyAny>| -> PyResult<Vec<JointVector>> {
        Ok(Numbers::read(name, value, MANY_JOINTS)?.joints()?.to_vec())
    };
    let times = t.map(|t| -> PyResult<_> { Ok(Numbers::read("t", t, MANY_TIMES)?.values()?.to_vec()) });
    let points = JointPoints {
        q_rad: joints("q", q)?,
        t_s: times.transpose()?,
        qd_rad_s: qd.map(|qd| joints("qd", qd)).transpose()?,
        qdd_rad_s2: qdd.map(|qdd| joints("qdd", qdd)).transpose()?,
        ..JointPoints::default()
    };
    let clearance_m = argument::number_or("clearance_m", clearance_m, CLEARANCE_M)?;
    if !(0.0..=1.0).contains(&clearance_m) {
        let problem = format!("a number from 0 to 1 is needed [m]; found {clearance_m}");
        return Err(exception::input(py, "clearance_m", &problem));
    }
    let words = Interpolation::ALL.map(|choice| (choice.word(), choice));
    let choice = interpolation.map(|word| argument::word("interpolation", word, &words));
    let choice = choice.transpose()?;
    let limits = acceleration_limits
        .map(|limits| read_acceleration_limits(limits, points.t_s.is_some()))
        .transpose()?;
    let robot = match Robot::given(robot)? {
        Some(robot) => robot.clone().unbind(),
        None => Robot::built_in(py)?,
    };
    let (arm, meshes) = (robot.get().model().clone(), robot.get().mesh_places());
    let tool = tool.map(|tool| ToolFields::read(tool)?.tool(py)).transpose()?;
    let mount = mount.map_or_else(|| Ok(Pose::identity()), read_mount)?;
    let text = obstacles.map(obstacle_text).transpose()?;
    let motion = points.motion(&arm, choice);
    let motion = motion.map_err(|error| exception::input(py, argument_of(&error), &error.to_string()))?;
    let judged = patiently(py, move |cancel| -> Result<_, Failure> {
        let mut cell = assembly::workcell_without_tool(&arm, mount, Vec::new())?;
        if let Some(tool) = tool {
            cell.tool = tool;
        }
        if let Some(text) = text {
            cell.obstacles = text.obstacles(&arm, &cell.tool, &meshes)?;
        }
        Ok(platewash::prove_motion(
            &motion,
            &cell,
            &arm,
            clearance_m,
            limits,
            cancel,
        ))
    })?;
    let judged = judged.map_err(|failure| errors::failure(py, &failure))?;
    let report = judged.map_err(|error| match error {
        ProveError::Cancelled(_) => errors::failure(py, &error.into()),
        other => exception::input(py, "q", &other.to_string()),
    })?;
    to_record(py, &report, Some(report.to_string()))
}

/// Pose of the base in the world.
fn read_mount(mount: &Bound<'_, PyAny>) -> PyResult<Pose> {
    let numbers = Numbers::read("mount", mount, ONE_POSE)?;
    pose::pose(numbers.values()?).map_err(|e| exception::input(mount.py(), "mount", &e.0))
}

/// Acceleration limits \[rad/s²\]. They need times to be judged.
fn read_acceleration_limits(limits: &Bound<'_, PyAny>, has_times: bool) -> PyResult<JointVector> {
    let refused = |problem: &str| Err(exception::input(limits.py(), "acceleration_limits", problem));
    let read = arrays::joint_vector("acceleration_limits", limits)?;
    if let Some(found) = read.iter().find(|limit| !(**limit > 0.0 && limit.is_finite())) {
        return refused(&format!("finite numbers above 0 are needed [rad/s²]; found {found}"));
    }
    if !has_times {
        return refused("accelerations cannot be judged without times: give t, or leave the limits out");
    }
    Ok(read)
}

/// Argument that a fault of the points belongs to.
fn argument_of(error: &PointsError) -> &'static str {
    match error {
        PointsError::TimeOrder { .. } | PointsError::Count { what: "times", .. } => "t",
        PointsError::Count {
            what: "accelerations", ..
        }
        | PointsError::Without {
            what: "accelerations", ..
        } => "qdd",
        PointsError::Without { .. } | PointsError::Count { .. } => "qd",
        PointsError::Incomplete { .. } => "interpolation",
        _ => "q",
    }
}

/// Obstacles of a file, of a list of `[[obstacle]]` sections, or of a table of all sections.
fn obstacle_text(obstacles: &Bound<'_, PyAny>) -> PyResult<ObstacleText> {
    let py = obstacles.py();
    let is_list = obstacles.is_instance_of::<PyList>() || obstacles.is_instance_of::<PyTuple>();
    if !is_list && obstacles.cast::<PyMapping>().is_err() {
        if obstacles.is_instance_of::<PyString>() || obstacles.hasattr("__fspath__")? {
            let path = argument::path("obstacles", obstacles)?;
            return ObstacleText::load(&path).map_err(|e| errors::scenario(py, &e));
        }
        let needed = "a path, a list of dictionaries or a dictionary";
        return Err(argument::wrong_type("obstacles", obstacles, needed));
    }
    let table = match is_list {
        true => {
            let table = pyo3::types::PyDict::new(py);
            table.set_item("obstacle", obstacles)?;
            from_mapping("obstacles", &table)?
        }
        false => from_mapping("obstacles", obstacles)?,
    };
    Ok(ObstacleText {
        name: "obstacles".to_owned(),
        text: toml::to_string(&table).map_err(|e| exception::input(py, "obstacles", &e.to_string()))?,
        folder: None,
    })
}
