//! Scenarios that are refused, and jobs that cannot be carried out.

use crate::arrays;
use crate::errors::file::FileKind;
use crate::errors::file::SystemWord;
use crate::errors::file::system_file;
use crate::errors::simulation::simulation;
use crate::exception::{Field, any, input, keyed, named, raise};
use platewash::bodies::job::JobError;
use platewash::motion::dry_run::DryRunError;
use platewash::paper::PaperError;
use platewash::paper::tracking::TrackingError;
use platewash::planner::transit::TransitError;
use platewash::planner::{RecoveryError, UnwashablePlate};
use platewash::scenario::Problem;
use platewash::workcell::ArmId;
use platewash::workcell::job::TermsError;
use platewash::workcell::layout::LayoutError;
use platewash::workcell::words::plate_name;
use platewash::{Failure, PlanError, ScenarioError};
use pyo3::prelude::*;

/// A refused scenario.
pub fn scenario(py: Python<'_>, error: &ScenarioError) -> PyErr {
    let unread = match &error.problem {
        Problem::NotFound { .. } => Some(SystemWord::NotFound),
        Problem::Unreadable { .. } => Some(SystemWord::Refused(None)),
        _ => None,
    };
    if let Some(word) = unread {
        return system_file(py, FileKind::Scenario, word, &error.source_name, &error.to_string());
    }
    let (key, expected, found) = match &error.problem {
        Problem::Value { key, expected, found } => (any(py, key), any(py, expected), any(py, found)),
        Problem::UnknownKey { key, .. } => (any(py, key), None, None),
        Problem::Conflict { keys, .. } => (any(py, keys), None, None),
        _ => (None, None, None),
    };
    let fields = [
        ("source", any(py, &*error.source_name)),
        ("line", error.line.and_then(|line| any(py, line))),
        ("key", key),
        ("expected", expected),
        ("found", found),
    ];
    raise(py, "ScenarioError", &error.to_string(), &fields)
}

/// A scenario, a job or a plan that could not be carried out, with the keys of scenarios that decide it.
pub fn failure(py: Python<'_>, error: &Failure) -> PyErr {
    let message = error.to_string();
    match error.cause() {
        Failure::Scenario(error) => scenario(py, error),
        Failure::Arm(_) => staged(py, "robot", &message, Vec::new()),
        Failure::Layout(error) => layout(py, error, &message),
        Failure::NoContact { .. } => keyed(py, "wash.height_m", &message),
        Failure::Body(error) => keyed(py, error.section.name(), &message),
        Failure::Job(error) => job(py, error, &message),
        Failure::Plan(error) => plan(py, error, &message),
        Failure::Paper(error) => paper(py, error, &message),
        Failure::Prove(_) => named(py, "ProveError", &message),
        Failure::Simulation(error) => simulation(py, error, &message),
        Failure::File(_) => named(py, "PlanFileError", &message),
        _ => named(py, "PlanError", &message),
    }
}

/// A plan that has no dry run of the kind that is asked for.
pub fn dry_run(py: Python<'_>, error: &DryRunError) -> PyErr {
    let message = error.to_string();
    match error {
        DryRunError::Height { .. } | DryRunError::TooLow { .. } => keyed(py, "height_m", &message),
        DryRunError::Speed { .. } => keyed(py, "speed_m_s", &message),
        DryRunError::Job(error) => job(py, error, &message),
        _ => no_dry_run(py, &message),
    }
}

/// A stop from which there is no recovery.
pub fn recovery(py: Python<'_>, error: RecoveryError) -> PyErr {
    let message = error.to_string();
    match error {
        RecoveryError::Time { .. } | RecoveryError::OtherTime { .. } => input(py, "stopped_s", &message),
        RecoveryError::NotFinite => input(py, "stands_rad", &message),
        RecoveryError::Plan(error) => failure(py, &error.into()),
        _ => no_recovery(py, &message),
    }
}

/// A plan from which there is no recovery at all.
pub fn no_recovery(py: Python<'_>, message: &str) -> PyErr {
    staged(py, "recovery", message, Vec::new())
}

/// A plan that has no dry run at all.
pub fn no_dry_run(py: Python<'_>, message: &str) -> PyErr {
    staged(py, "dry_run", message, Vec::new())
}

/// A job that failed at a stage.
fn staged<'py>(py: Python<'py>, stage: &str, message: &str, fields: Vec<Field<'py>>) -> PyErr {
    let fields = [vec![("stage", any(py, stage))], fields].concat();
    raise(py, "PlanError", message, &fields)
}

/// Plates that could not be placed.
fn layout(py: Python<'_>, error: &LayoutError, message: &str) -> PyErr {
    let fields = match error {
        LayoutError::NoRoom {
            count,
            most_placed,
            upper_bound,
            ..
        } => vec![
            (
                "cause",
                any(py, if error.is_proven() { "no_room" } else { "not_found" }),
            ),
            ("count", any(py, *count)),
            ("most_placed", any(py, *most_placed)),
            ("upper_bound", upper_bound.and_then(|v| any(py, v))),
        ],
        LayoutError::EmptyRegion { .. } => vec![("cause", any(py, "empty_region"))],
        LayoutError::InvalidPosition { plate } => {
            let problem = format!("the centre of {} is not finite", plate_name(*plate));
            return input(py, "positions_m", &problem);
        }
        LayoutError::InvalidInput { key, problem } => return input(py, key, &problem.to_string()),
        _ => Vec::new(),
    };
    raise(py, "LayoutError", message, &fields)
}

/// Terms that are no job.
fn job(py: Python<'_>, error: &JobError, message: &str) -> PyErr {
    match error {
        JobError::Home { violation, .. } => {
            let fields = vec![("cause", any(py, "home")), ("joint", any(py, violation.joint))];
            staged(py, "job", message, fields)
        }
        JobError::Clearance(_) => staged(py, "clearance", message, Vec::new()),
        JobError::Terms(TermsError::PlateCount { .. } | TermsError::NoPlate { .. }) => keyed(py, "plates", message),
        JobError::Terms(TermsError::Obstacle { .. }) | JobError::Standing(_) => keyed(py, "obstacle", message),
        _ => keyed(py, "job", message),
    }
}

/// A washing that could not be planned.
fn plan(py: Python<'_>, error: &PlanError, message: &str) -> PyErr {
    let cause = |word: &str| ("cause", any(py, word));
    let at = |plate: usize| ("plate", any(py, plate));
    let fields = match error {
        PlanError::Job(error) => return job(py, error, message),
        PlanError::Layout(error) => return layout(py, error, message),
        PlanError::NoTool => return keyed(py, "tool.length_m", message),
        PlanError::Clearance(_) => return staged(py, "clearance", message, Vec::new()),
        PlanError::IkSettings(_) => return staged(py, "ik", message, Vec::new()),
        PlanError::Unwashable(plate) => unwashable(py, plate),
        PlanError::Overlap(overlaps) => {
            let plate = overlaps.first().and_then(|overlap| any(py, overlap.plate));
            vec![cause("overlap"), ("plate", plate)]
        }
        PlanError::NoneWashable { .. } => vec![cause("not_found")],
        PlanError::Line { plate, .. } | PlanError::Transit(TransitError::Line { plate, .. }) => {
            vec![cause("line"), at(*plate)]
        }
        PlanError::Transit(TransitError::NotFound { from, to, .. }) => {
            vec![cause("no_transit"), ("plate", to.or(*from).and_then(|p| any(py, p)))]
        }
        PlanError::Tilt { plate, .. } => vec![cause("tilt"), at(*plate)],
        PlanError::Home { violation, .. } => vec![cause("home"), ("joint", any(py, violation.joint))],
        PlanError::HomeNotClear { .. } | PlanError::Transit(TransitError::Home { .. }) => vec![cause("home")],
        _ => Vec::new(),
    };
    staged(py, "plan", message, fields)
}

/// A plate that cannot be washed, or for which no way to was found.
fn unwashable<'py>(py: Python<'py>, plate: &UnwashablePlate) -> Vec<Field<'py>> {
    let cause = match plate.is_proved() {
        true => "unwashable",
        false => "not_found",
    };
    let nearest = plate.nearest_m.and_then(|at| arrays::array(py, &[2], &at).ok());
    vec![
        ("cause", any(py, cause)),
        ("plate", any(py, plate.plate)),
        ("share", plate.share.and_then(|share| any(py, share))),
        ("nearest_m", nearest.map(Bound::into_any)),
    ]
}

/// A run of the paper's program that could not be carried out.
fn paper(py: Python<'_>, error: &PaperError, message: &str) -> PyErr {
    let (stage, fields) = match error {
        PaperError::Job(error) => return job(py, error, message),
        PaperError::Layout(error) => return layout(py, error, message),
        PaperError::Tracking(TrackingError::Ik { waypoint, .. } | TrackingError::Torque { waypoint }) => {
            ("tracking", vec![("waypoint", any(py, *waypoint))])
        }
        PaperError::Tracking(TrackingError::Divergence { waypoint, joint, .. }) => (
            "tracking",
            vec![("waypoint", any(py, *waypoint)), ("joint", any(py, *joint))],
        ),
        PaperError::IkSettings(_) => ("ik", Vec::new()),
        PaperError::Clearance(_) => ("clearance", Vec::new()),
        PaperError::Coverage(_) => ("coverage", Vec::new()),
        _ => ("paper", Vec::new()),
    };
    staged(py, stage, message, fields)
}

/// A plan whose arm is not at hand.
pub fn arm_needed(py: Python<'_>, arm: &ArmId) -> PyErr {
    let hash = arm.urdf_sha256.get(..8).unwrap_or(&arm.urdf_sha256);
    let message = format!(
        "robot: the plan is for the arm \"{}\" (description {hash}…), which a plan file names but does not hold; give the arm as \
         robot=Robot.load(...)",
        arm.name
    );
    raise(py, "ProveError", &message, &[("argument", any(py, "robot"))])
}
