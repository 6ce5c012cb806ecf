//! Scenarios that are refused, and jobs that cannot be carried out.

use super::{FileOf, SystemWord, any, input, keyed, named, raise, system_file};
use crate::arrays;
use platewash::planner::crossing::CrossingError;
use platewash::planner::cycle::CycleError;
use platewash::planner::scenario::{Problem, ScenarioError};
use platewash::planner::tracking::TrackingError;
use platewash::workcell::layout::LayoutError;
use platewash::{PlanError, VerifyError};
use pyo3::prelude::*;

/// A refused scenario.
pub fn scenario(py: Python<'_>, error: &ScenarioError) -> PyErr {
    let unread = match &error.problem {
        Problem::NotFound { .. } => Some(SystemWord::NotFound),
        Problem::Unreadable { .. } => Some(SystemWord::Refused(None)),
        _ => None,
    };
    if let Some(word) = unread {
        return system_file(py, FileOf::Scenario, word, &error.source_name, &error.to_string());
    }
    let (key, expected, found) = match &error.problem {
        Problem::Value { key, expected, found } => (any(py, key), any(py, expected), any(py, found)),
        Problem::UnknownKey { key, .. } => (any(py, key), None, None),
        Problem::Conflict { keys, .. } => (any(py, keys), None, None),
        _ => (None, None, None),
    };
    let fields = [
        ("source", any(py, &error.source_name)),
        ("line", error.line.and_then(|line| any(py, line))),
        ("key", key),
        ("expected", expected),
        ("found", found),
    ];
    raise(py, "ScenarioError", &error.to_string(), &fields)
}

/// A job that could not be carried out.
pub fn plan(py: Python<'_>, error: &PlanError) -> PyErr {
    let message = error.to_string();
    let (stage, waypoint, joint) = match error {
        PlanError::Scenario(error) => return scenario(py, error),
        PlanError::Layout(error) => return layout(py, error),
        PlanError::Robot(_) => ("robot", None, None),
        PlanError::IkSettings(_) | PlanError::Ik(_) => ("ik", None, None),
        PlanError::Tracking(TrackingError::Ik { waypoint, .. }) => ("tracking", Some(*waypoint), None),
        PlanError::Tracking(TrackingError::Divergence { waypoint, joint, .. }) => {
            ("tracking", Some(*waypoint), Some(*joint))
        }
        PlanError::Clearance(_) => ("clearance", None, None),
        PlanError::Coverage(_) => ("coverage", None, None),
        PlanError::Cycle(error) => return cycle(py, error),
        _ => ("plan", None, None),
    };
    let fields = [
        ("stage", any(py, stage)),
        ("waypoint", waypoint.and_then(|v| any(py, v))),
        ("joint", joint.and_then(|v| any(py, v))),
    ];
    raise(py, "PlanError", &message, &fields)
}

/// Plates that could not be placed.
pub fn layout(py: Python<'_>, error: &LayoutError) -> PyErr {
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
            let problem = format!("the centre of plate {plate} is not finite");
            return input(py, "positions_m", &problem);
        }
        LayoutError::InvalidInput { key, problem } => return input(py, key, &problem.to_string()),
        _ => Vec::new(),
    };
    raise(py, "LayoutError", &format!("layout: {error}"), &fields)
}

/// A cycle that could not be planned.
fn cycle(py: Python<'_>, error: &CycleError) -> PyErr {
    let mut fields = vec![("stage", any(py, "cycle"))];
    match error {
        CycleError::NoContact { .. } => return keyed(py, "wash.height_m", &error.to_string()),
        CycleError::NoTool => return keyed(py, "tool.length_m", &error.to_string()),
        CycleError::Unwashable(plate) => {
            let cause = if plate.conclusion.is_proved() {
                "unwashable"
            } else {
                "not_found"
            };
            fields.extend([("cause", any(py, cause)), ("plate", any(py, plate.plate))]);
            fields.push(("share", plate.share.and_then(|share| any(py, share))));
            let nearest = plate.nearest_m.and_then(|at| arrays::array(py, &[2], &at).ok());
            fields.push(("nearest_m", nearest.map(Bound::into_any)));
        }
        CycleError::Line { plate, .. } => fields.extend([("cause", any(py, "line")), ("plate", any(py, *plate))]),
        CycleError::Crossing(CrossingError::NoWay { from, to, .. }) => {
            let plate = to.or(*from);
            fields.extend([("cause", any(py, "no_way")), ("plate", plate.and_then(|p| any(py, p)))]);
        }
        CycleError::Crossing(CrossingError::Line { plate, .. }) => {
            fields.extend([("cause", any(py, "line")), ("plate", any(py, *plate))]);
        }
        CycleError::Tilt { plate, .. } => fields.extend([("cause", any(py, "tilt")), ("plate", any(py, *plate))]),
        CycleError::Home(violation) => {
            fields.extend([("cause", any(py, "home")), ("joint", any(py, violation.joint))]);
        }
        _ => (),
    }
    raise(py, "PlanError", &error.to_string(), &fields)
}

/// A plan that cannot be judged.
pub fn verify(py: Python<'_>, error: &VerifyError) -> PyErr {
    let VerifyError::NoDescription { file } = error else {
        return named(py, "VerifyError", &error.to_string());
    };
    let message = format!(
        "robot: the plan is for the arm of \"{file}\", which a plan file names but does not hold; give the arm as \
         robot=Robot.load(...)"
    );
    raise(py, "VerifyError", &message, &[("argument", any(py, "robot"))])
}
