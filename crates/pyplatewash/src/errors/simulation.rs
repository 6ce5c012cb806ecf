//! Arms without dynamics, and plans that cannot be simulated.

use super::{any, input, raise};
use crate::arrays;
use platewash::SimulationError;
use platewash::simulator::{ControlError, DynamicsError};
use pyo3::prelude::*;

/// A field of an exception.
type Field<'py> = (&'static str, Option<Bound<'py, PyAny>>);

/// An arm that has no dynamics.
pub fn dynamics(py: Python<'_>, error: &DynamicsError) -> PyErr {
    let message = error.to_string();
    let (link, joint) = match error {
        DynamicsError::Missing { link } | DynamicsError::Link { link, .. } => (Some(link), None),
        DynamicsError::NoInertia { joint, link } => (Some(link), Some(joint)),
        DynamicsError::Tool { .. } => return input(py, "tool", &message),
        DynamicsError::Gravity { .. } => return input(py, "gravity_m_s2", &message),
        _ => (None, None),
    };
    let fields = [
        ("link", link.and_then(|link| any(py, link))),
        ("joint", joint.and_then(|joint| any(py, joint))),
    ];
    raise(py, "DynamicsError", &message, &fields)
}

/// A plan that cannot be simulated.
pub fn simulation(py: Python<'_>, error: &SimulationError) -> PyErr {
    let fields = match error {
        SimulationError::Dynamics(error) => return dynamics(py, error),
        SimulationError::Control(error) => control(py, error),
        SimulationError::OtherArm { .. } => vec![word(py, "other_arm")],
        SimulationError::Plate { segment, plate, .. } => vec![
            word(py, "plan"),
            ("segment", any(py, *segment)),
            ("plate", any(py, *plate)),
        ],
        SimulationError::Knots(_) | SimulationError::Empty { .. } => vec![word(py, "plan")],
        SimulationError::Setting { key, .. } => vec![word(py, "setting"), ("key", any(py, *key))],
        SimulationError::TooLong { .. } => vec![word(py, "too_long")],
        SimulationError::Divergence { t_s, joint, .. } => {
            vec![word(py, "diverged"), ("t_s", any(py, *t_s)), ("joint", any(py, *joint))]
        }
        SimulationError::Coverage(_) => vec![word(py, "coverage")],
        _ => vec![word(py, "other")],
    };
    raise(py, "SimulationError", &error.to_string(), &fields)
}

fn word<'py>(py: Python<'py>, cause: &'static str) -> Field<'py> {
    ("cause", any(py, cause))
}

fn control<'py>(py: Python<'py>, error: &ControlError) -> Vec<Field<'py>> {
    match error {
        ControlError::Setting { key, .. } => vec![word(py, "setting"), ("key", any(py, format!("control.{key}")))],
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
