//! Joint positions as values.

use super::value::{Value, component, part_of_record};
use platewash_kinematics::{AXES, JointVector};

/// What stands for an axis that is not used; also the largest number of a target.
pub const UNUSED: f32 = 9e9;
const ROBOT_AXES: [&str; AXES] = ["rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6"];
const EXTERNAL_AXES: [&str; 6] = ["eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"];

/// Why a target is no position of an arm without external axes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoPosition {
    /// A joint without a position.
    #[error("expected an angle in degrees for joint {joint}, found {found:E}")]
    Joint {
        /// The joint, from 1.
        joint: usize,
        /// What is there.
        found: f32,
    },
    /// An external axis with a position.
    #[error("expected 9E9 for the external axis {axis}, found {found}: external axes are not modelled")]
    External {
        /// Its name.
        axis: &'static str,
        /// What is there.
        found: f32,
    },
    /// No joint target at all.
    #[error("expected a jointtarget")]
    Other,
}

/// Joint positions of a joint target \[rad\].
pub fn from_value(target: &Value) -> Result<JointVector, NoPosition> {
    let robot = part_of_record(target, "robax").ok_or(NoPosition::Other)?;
    let external = part_of_record(target, "extax").ok_or(NoPosition::Other)?;
    let mut q_rad = JointVector::zeros();
    for (index, axis) in ROBOT_AXES.iter().enumerate() {
        let found = component(robot, axis).ok_or(NoPosition::Other)?;
        if found.abs() >= UNUSED {
            return Err(NoPosition::Joint {
                joint: index + 1,
                found,
            });
        }
        q_rad[index] = f64::from(found).to_radians();
    }
    for axis in EXTERNAL_AXES {
        let found = component(external, axis).ok_or(NoPosition::Other)?;
        if found != UNUSED {
            return Err(NoPosition::External { axis, found });
        }
    }
    Ok(q_rad)
}

/// A joint target as an aggregate.
#[must_use]
pub fn as_value(q_rad: &JointVector) -> Value {
    let robot = q_rad.iter().map(|q| Value::Num(q.to_degrees() as f32)).collect();
    let external = vec![Value::Num(UNUSED); EXTERNAL_AXES.len()];
    Value::List(vec![Value::List(robot), Value::List(external)])
}
