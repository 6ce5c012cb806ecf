//! The `<limit>` elements of the six axes.

use super::error::UrdfError;
use super::numbers::finite;
use super::tree::Tree;
use crate::limits::JointLimits;
use crate::{AXES, JointVector};
use urdf_rs::JointType;

/// Largest position limit that is believed \[rad\]; beyond it the file is probably in degrees.
const LARGEST_POSITION_LIMIT_RAD: f64 = 100.0;

/// Limits of the axes in series; a continuous joint has none on its position, whatever the file says.
pub(super) fn limits(tree: &Tree<'_>) -> Result<JointLimits, UrdfError> {
    let mut limits = JointLimits {
        lower: JointVector::repeat(f64::NEG_INFINITY),
        upper: JointVector::repeat(f64::INFINITY),
        velocity: JointVector::zeros(),
        effort: [None; AXES],
    };
    for (i, joint) in tree.axes.iter().enumerate() {
        let limit = &joint.limit;
        if [limit.lower, limit.upper, limit.velocity, limit.effort] == [0.0; 4] {
            return Err(missing(joint));
        }
        if joint.joint_type == JointType::Revolute {
            [limits.lower[i], limits.upper[i]] = positions(joint)?;
        }
        limits.velocity[i] = velocity(joint)?;
        limits.effort[i] = effort(joint)?;
    }
    Ok(limits)
}

fn missing(joint: &urdf_rs::Joint) -> UrdfError {
    let name = joint.name.clone();
    match joint.joint_type {
        JointType::Continuous => UrdfError::MissingVelocity { joint: name },
        _ => UrdfError::MissingLimit { joint: name },
    }
}

fn positions(joint: &urdf_rs::Joint) -> Result<[f64; 2], UrdfError> {
    let (lower, upper) = (joint.limit.lower, joint.limit.upper);
    let at = format!("joint '{}'", joint.name);
    finite(&at, "limit (lower, upper)", &[lower, upper])?;
    if lower >= upper {
        return Err(UrdfError::LimitOrder {
            joint: joint.name.clone(),
            lower,
            upper,
        });
    }
    if lower.abs().max(upper.abs()) > LARGEST_POSITION_LIMIT_RAD {
        return Err(UrdfError::LimitSize {
            joint: joint.name.clone(),
            lower,
            upper,
            limit_rad: LARGEST_POSITION_LIMIT_RAD,
        });
    }
    Ok([lower, upper])
}

fn velocity(joint: &urdf_rs::Joint) -> Result<f64, UrdfError> {
    let found = joint.limit.velocity;
    if found.is_finite() && found > 0.0 {
        return Ok(found);
    }
    let joint = joint.name.clone();
    Err(UrdfError::Velocity { joint, found })
}

/// Zero means "unknown" by custom, infinity means "no limit" since URDF 1.2: neither is a limit.
fn effort(joint: &urdf_rs::Joint) -> Result<Option<f64>, UrdfError> {
    let found = joint.limit.effort;
    if found >= 0.0 {
        return Ok(Some(found).filter(|effort| *effort > 0.0 && effort.is_finite()));
    }
    let joint = joint.name.clone();
    Err(UrdfError::Effort { joint, found })
}
