//! Errors as exceptions of `pyplatewash`.
//!
//! Also here: files that the system does not give or take; unanswered inverse-kinematics calls; arms without dynamics, and plans
//! that cannot be simulated; studies that are none, and folders that keep something else.
//!
//! The classes are Python's (`python/pyplatewash/_errors.py`), so that they pickle and can be subclassed; here they are given
//! their fields.

mod job;

pub use crate::errors::job::{arm_needed, dry_run, failure, no_dry_run, no_recovery, recovery, scenario};

use crate::arrays;
use platewash::kinematics::ik::{IkCause, IkPathError, PathBreak};
use platewash::kinematics::urdf::file::FileError;
use platewash::simulator::ControlError;
use platewash::study::StudyError;
use platewash::{DynamicsError, IkError, IkFailure, SimulationError};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyModule};
use std::io::ErrorKind;
use std::path::Path;

/// Fault of an argument, in words that follow its name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Input(pub String);

static ERRORS: PyOnceLock<Py<PyModule>> = PyOnceLock::new();

/// An exception of the given class with its fields.
fn raise(py: Python<'_>, class: &str, message: &str, fields: &[(&str, Option<Bound<'_, PyAny>>)]) -> PyErr {
    let make = || {
        let module = ERRORS.get_or_try_init(py, || Ok::<_, PyErr>(py.import("pyplatewash._errors")?.unbind()))?;
        let keywords = PyDict::new(py);
        for (name, value) in fields {
            keywords.set_item(name, value)?;
        }
        module.bind(py).getattr(class)?.call((message,), Some(&keywords))
    };
    match make() {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

fn any<'py, T: IntoPyObject<'py>>(py: Python<'py>, value: T) -> Option<Bound<'py, PyAny>> {
    value.into_bound_py_any(py).ok()
}

/// An argument with a value that makes no sense.
pub fn input(py: Python<'_>, argument: &str, problem: &str) -> PyErr {
    let fields = [("argument", any(py, argument))];
    raise(py, "InputError", &format!("{argument}: {problem}"), &fields)
}

/// An `InputError` whose message already begins with the argument's name.
pub fn keyed(py: Python<'_>, argument: &str, message: &str) -> PyErr {
    raise(py, "InputError", message, &[("argument", any(py, argument))])
}

/// An argument of the wrong shape.
pub fn shape(py: Python<'_>, argument: &str, found: &[usize], wanted: &[String]) -> PyErr {
    let lengths = found.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    let comma = if found.len() == 1 { "," } else { "" };
    let message = format!(
        "{argument}: an array of shape {} is needed; found ({lengths}{comma})",
        wanted.join(" or ")
    );
    let tuple = pyo3::types::PyTuple::new(py, found).ok().map(Bound::into_any);
    let fields = [
        ("argument", any(py, argument)),
        ("found", tuple),
        ("wanted", any(py, wanted)),
    ];
    raise(py, "ShapeError", &message, &fields)
}

/// An argument whose array holds no real numbers.
pub fn dtype(py: Python<'_>, argument: &str, dtype: &str) -> PyErr {
    let message = format!("{argument}: an array of real numbers is needed; found dtype {dtype}");
    raise(py, "InputTypeError", &message, &[("argument", any(py, argument))])
}

/// An argument of a wrong type.
pub fn wrong_type(py: Python<'_>, argument: &str, problem: &str) -> PyErr {
    let fields = [("argument", any(py, argument))];
    raise(py, "InputTypeError", &format!("{argument}: {problem}"), &fields)
}

/// An argument that NumPy makes no array of. What is neither a `TypeError` nor a `ValueError` is passed on as it is.
pub fn not_numbers(py: Python<'_>, argument: &str, error: &PyErr) -> PyErr {
    use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
    let ours = error.is_instance_of::<PyTypeError>(py)
        || error.is_instance_of::<PyValueError>(py)
        || error.is_instance_of::<PyOverflowError>(py);
    if !ours {
        return error.clone_ref(py);
    }
    let message = format!(
        "{argument}: an array of real numbers is needed; NumPy says: {}",
        error.value(py)
    );
    raise(py, "InputTypeError", &message, &[("argument", any(py, argument))])
}

/// An exception of the given class without fields.
pub fn named(py: Python<'_>, class: &'static str, message: &str) -> PyErr {
    raise(py, class, message, &[])
}

/// A plan that is not handed over; the code is stable.
pub fn export(py: Python<'_>, code: &str, message: &str) -> PyErr {
    raise(py, "ExportError", message, &[("code", any(py, code))])
}

/// Something that this installation lacks.
pub fn missing(py: Python<'_>, name: &str, message: &str) -> PyErr {
    raise(py, "MissingError", message, &[("name", any(py, name))])
}

/// A key that is not there.
pub fn no_key(py: Python<'_>, key: &str, known: &[&str]) -> PyErr {
    let fields = [("argument", any(py, "key"))];
    let message = format!("key: one of {} is needed; found '{key}'", known.join(", "));
    raise(py, "NoKeyError", &message, &fields)
}

/// Something that must not happen.
pub fn internal(py: Python<'_>, message: &str) -> PyErr {
    raise(py, "InternalError", message, &[])
}

/// Kind of a file; decides which exceptions its errors raise.
#[derive(Debug, Clone, Copy)]
pub enum FileKind {
    /// A description of an arm.
    Urdf,
    /// A plan.
    Plan,
    /// A scenario.
    Scenario,
    /// A page.
    Page,
    /// A study: its file, or what its folder keeps.
    Study,
}

/// Error of the operating system on a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SystemWord {
    /// The file or its folder does not exist.
    NotFound,
    /// Any other error, with its number where it has one.
    Refused(Option<i32>),
}

/// Number of "no such file or folder".
const ENOENT: i32 = 2;

impl From<&std::io::Error> for SystemWord {
    fn from(error: &std::io::Error) -> Self {
        match error.kind() {
            ErrorKind::NotFound => Self::NotFound,
            _ => Self::Refused(error.raw_os_error()),
        }
    }
}

/// A file that the system does not give or take: an `OSError` too, with the name as `filename`.
pub fn system_file(py: Python<'_>, kind: FileKind, word: SystemWord, filename: &str, message: &str) -> PyErr {
    let (class, number) = match (kind, word) {
        (FileKind::Urdf, SystemWord::NotFound) => ("UrdfNotFoundError", Some(ENOENT)),
        (FileKind::Plan, SystemWord::NotFound) => ("PlanNotFoundError", Some(ENOENT)),
        (FileKind::Scenario, SystemWord::NotFound) => ("ScenarioNotFoundError", Some(ENOENT)),
        (FileKind::Page, SystemWord::NotFound) => ("PageNotFoundError", Some(ENOENT)),
        (FileKind::Study, SystemWord::NotFound) => ("StudyNotFoundError", Some(ENOENT)),
        (FileKind::Urdf, SystemWord::Refused(number)) => ("UrdfAccessError", number),
        (FileKind::Plan, SystemWord::Refused(number)) => ("PlanAccessError", number),
        (FileKind::Scenario, SystemWord::Refused(number)) => ("ScenarioAccessError", number),
        (FileKind::Page, SystemWord::Refused(number)) => ("FileError", number),
        (FileKind::Study, SystemWord::Refused(number)) => ("StudyAccessError", number),
    };
    let fields = [
        ("filename", any(py, filename)),
        ("errno", number.and_then(|number| any(py, number))),
        ("strerror", any(py, message)),
    ];
    raise(py, class, message, &fields)
}

/// An input file that was not read: missing, refused by the system, or no text that is read.
pub fn unread(py: Python<'_>, kind: FileKind, path: &Path, error: &FileError) -> PyErr {
    let filename = path.display().to_string();
    let message = format!("{filename}: cannot be read: {error}");
    match error {
        FileError::System { kind: cause, code, .. } => {
            let word = match cause {
                ErrorKind::NotFound => SystemWord::NotFound,
                _ => SystemWord::Refused(*code),
            };
            system_file(py, kind, word, &filename, &message)
        }
        FileError::NotRegular => system_file(py, kind, SystemWord::Refused(None), &filename, &message),
        _ => match kind {
            FileKind::Urdf => named(py, "UrdfError", &message),
            FileKind::Plan => named(py, "PlanFileError", &message),
            FileKind::Scenario => named(py, "ScenarioError", &message),
            FileKind::Page => named(py, "FileError", &message),
            FileKind::Study => named(py, "StudyError", &message),
        },
    }
}

/// The word for a cause, and the joint at fault.
#[must_use]
pub fn cause(cause: &IkCause) -> (&'static str, Option<usize>) {
    match cause {
        IkCause::Unreachable => ("unreachable", None),
        IkCause::LocalMinimum => ("local_minimum", None),
        IkCause::Limit { joint } => ("limit", Some(*joint)),
        IkCause::Singular => ("singular", None),
        IkCause::Iterations => ("iterations", None),
        _ => ("other", None),
    }
}

/// An unanswered inverse-kinematics call.
pub fn ik(py: Python<'_>, error: &IkError) -> PyErr {
    match error {
        IkError::NotSolved(failure) => raise(py, "IkError", &error.to_string(), &failure_fields(py, failure)),
        IkError::Seed { .. } => input(py, "seed", &error.to_string()),
        _ => input(py, "target", &error.to_string()),
    }
}

fn failure_fields<'py>(py: Python<'py>, failure: &IkFailure) -> Vec<(&'static str, Option<Bound<'py, PyAny>>)> {
    let (cause, joint) = cause(&failure.cause);
    vec![
        ("cause", any(py, cause)),
        ("joint", joint.and_then(|joint| any(py, joint))),
        (
            "q",
            arrays::array(py, &[6], failure.q.as_slice()).ok().map(Bound::into_any),
        ),
        ("iterations", any(py, failure.iterations)),
        ("limit_excess_rad", failure.limit_excess_rad.and_then(|v| any(py, v))),
        ("position_error_m", any(py, failure.position_error_m)),
        ("orientation_error_rad", any(py, failure.orientation_error_rad)),
    ]
}

/// A path that breaks off.
pub fn ik_path(py: Python<'_>, error: &IkPathError) -> PyErr {
    let message = error.to_string();
    let solved = |q: &[_]| arrays::joint_rows(py, q).ok().map(Bound::into_any);
    match error {
        IkPathError::Waypoint { waypoint, error } => {
            let mut fields = match error {
                IkError::NotSolved(failure) => failure_fields(py, failure),
                _ => {
                    return input(
                        py,
                        if *waypoint == 0 {
                            "seed or targets[0]"
                        } else {
                            "targets"
                        },
                        &message,
                    );
                }
            };
            fields.extend([("waypoint", any(py, *waypoint)), ("solved", solved(&[]))]);
            raise(py, "IkPathError", &message, &fields)
        }
        IkPathError::Broken {
            waypoint,
            reason,
            solved: q,
        } => {
            let (cause, joint) = path_break(reason);
            let last = q.last().and_then(|q| arrays::array(py, &[6], q.as_slice()).ok());
            let fields = [
                ("waypoint", any(py, *waypoint)),
                ("cause", any(py, cause)),
                ("joint", joint.and_then(|joint| any(py, joint))),
                ("solved", solved(q)),
                ("q", last.map(Bound::into_any)),
            ];
            raise(py, "IkPathError", &message, &fields)
        }
        _ => raise(py, "IkPathError", &message, &[]),
    }
}

fn path_break(reason: &PathBreak) -> (&'static str, Option<usize>) {
    match reason {
        PathBreak::Limit { joint } => ("limit", Some(*joint)),
        PathBreak::Singularity { .. } => ("singular", None),
        PathBreak::BranchEnd { .. } => ("branch_end", None),
        _ => ("other", None),
    }
}

/// A field of an exception.
type Field<'py> = (&'static str, Option<Bound<'py, PyAny>>);

/// Raises the error of an arm without dynamics.
pub fn dynamics(py: Python<'_>, error: &DynamicsError) -> PyErr {
    no_dynamics(py, error, &error.to_string())
}

fn no_dynamics(py: Python<'_>, error: &DynamicsError, message: &str) -> PyErr {
    let (link, joint) = match error {
        DynamicsError::Missing { link } | DynamicsError::Link { link, .. } => (Some(link), None),
        DynamicsError::NoInertia { joint, link } => (Some(link), Some(joint)),
        DynamicsError::Tool { .. } => return input(py, "tool", message),
        DynamicsError::Gravity { .. } => return input(py, "gravity_m_s2", message),
        _ => (None, None),
    };
    let fields = [
        ("link", link.and_then(|link| any(py, link))),
        ("joint", joint.and_then(|joint| any(py, joint))),
    ];
    raise(py, "DynamicsError", message, &fields)
}

/// A plan that cannot be simulated.
pub(crate) fn simulation(py: Python<'_>, error: &SimulationError, message: &str) -> PyErr {
    let fields = match error {
        SimulationError::Dynamics(error) => return no_dynamics(py, error, message),
        SimulationError::Control(error) => control(py, error),
        SimulationError::OtherArm { .. } => vec![word(py, "other_arm")],
        SimulationError::Plate { segment, plate, .. } => vec![
            word(py, "plan"),
            ("segment", any(py, *segment)),
            ("plate", any(py, *plate)),
        ],
        SimulationError::Job(_) | SimulationError::Knots(_) | SimulationError::Empty { .. } => vec![word(py, "plan")],
        SimulationError::Setting { name, .. } => {
            vec![word(py, "setting"), ("key", any(py, format!("plant.{name}")))]
        }
        SimulationError::Stiffness { .. } => vec![word(py, "setting"), ("key", any(py, "plant.contact_stiffness_pa"))],
        SimulationError::StiffContact {
            least_substeps,
            least_rate_hz,
            ..
        } => vec![
            word(py, "stiff_contact"),
            ("least_substeps", any(py, *least_substeps)),
            ("least_rate_hz", any(py, *least_rate_hz)),
        ],
        SimulationError::TooLong { .. } => vec![word(py, "too_long")],
        SimulationError::Divergence { t_s, joint, .. } => {
            vec![word(py, "diverged"), ("t_s", any(py, *t_s)), ("joint", any(py, *joint))]
        }
        SimulationError::Coverage(_) => vec![word(py, "coverage")],
        _ => vec![word(py, "other")],
    };
    raise(py, "SimulationError", message, &fields)
}

fn word<'py>(py: Python<'py>, cause: &'static str) -> Field<'py> {
    ("cause", any(py, cause))
}

fn control<'py>(py: Python<'py>, error: &ControlError) -> Vec<Field<'py>> {
    match error {
        ControlError::Setting { name, .. } => {
            vec![word(py, "setting"), ("key", any(py, format!("control.{name}")))]
        }
        ControlError::UnstablePaper { .. } => vec![word(py, "unstable")],
        ControlError::Unstable {
            q,
            least_rate_hz,
            highest_frequency_rad_s,
            ..
        } => {
            let at = arrays::array(py, &[6], q.as_slice()).ok().map(Bound::into_any);
            vec![
                word(py, "unstable"),
                ("q", at),
                ("least_rate_hz", least_rate_hz.and_then(|v| any(py, v))),
                (
                    "highest_frequency_rad_s",
                    highest_frequency_rad_s.and_then(|v| any(py, v)),
                ),
            ]
        }
        _ => vec![word(py, "other")],
    }
}

/// A study that was refused, or could not go on.
pub fn study(py: Python<'_>, error: StudyError) -> PyErr {
    let message = error.to_string();
    let of = |source: String, line: Option<usize>| {
        let fields = [
            ("source", any(py, source)),
            ("line", line.and_then(|line| any(py, line))),
        ];
        raise(py, "StudyError", &message, &fields)
    };
    match &error {
        StudyError::Disk { file, cause, .. } => {
            let word = SystemWord::from(cause);
            system_file(py, FileKind::Study, word, &file.display().to_string(), &message)
        }
        StudyError::File { file, line, .. } => of(file.clone(), *line),
        StudyError::Kept { file, line, .. } => of(file.display().to_string(), *line),
        StudyError::Other { folder, .. } | StudyError::Busy { folder } => of(folder.display().to_string(), None),
        StudyError::NoRow { .. } | StudyError::Row { .. } => of("study".to_owned(), None),
        StudyError::Cancelled(_) => PyKeyboardInterrupt::new_err(()),
        _ => internal(py, &message),
    }
}
