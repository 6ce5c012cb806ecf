//! Arms without dynamics, and plans that cannot be simulated.

use crate::arrays;
use crate::exception::{Field, any, input, raise};
use platewash::simulator::ControlError;
use platewash::{DynamicsError, SimulationError};
use pyo3::prelude::*;

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
pub fn simulation(py: Python<'_>, error: &SimulationError, message: &str) -> PyErr {
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
