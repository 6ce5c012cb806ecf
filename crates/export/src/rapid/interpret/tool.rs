//! Tools as data of a program.

use super::value::{Value, component, part_of_record};
use crate::reading::ReadTool;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use platewash_kinematics::Pose;

/// Least mass that a controller takes \[kg\].
pub const LEAST_KG: f64 = 0.001;
/// How far the length of a quaternion may be from 1: that of four singles, rounded.
const UNIT: f64 = 1e-4;

/// Why a tool cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ToolFault {
    /// It does not hang on the arm.
    #[error("expected a tool that the arm holds (robhold TRUE), found one that stands still")]
    Stationary,
    /// It weighs nothing.
    #[error("expected a tool's mass of at least {LEAST_KG} kg, found {0}: the controller refuses it")]
    Mass(f64),
    /// Its centre of mass is where none can be.
    #[error("expected a centre of mass away from the flange, found [0, 0, 0]: the controller refuses it")]
    Com,
    /// An orientation that is none.
    #[error("expected a quaternion of length 1 in the tool's {what}, found length {length}")]
    Quaternion {
        /// Of what.
        what: &'static str,
        /// Its length.
        length: f64,
    },
    /// A moment of inertia below 0.
    #[error("expected moments of inertia of 0 kg·m² or more, found {0}")]
    Inertia(f64),
    /// Another one than before.
    #[error("expected the tool of the motions before, found another one")]
    Another,
    /// No tool at all.
    #[error("expected a tooldata")]
    Other,
}

/// A tool as a program states it, in SI units.
pub fn tool_of(value: &Value) -> Result<ReadTool, ToolFault> {
    let of = |value: &Value, key: &str| part_of_record(value, key).cloned().ok_or(ToolFault::Other);
    if of(value, "robhold")? != Value::Truth(true) {
        return Err(ToolFault::Stationary);
    }
    let (frame, load) = (of(value, "tframe")?, of(value, "tload")?);
    let tip_m = vector(&of(&frame, "trans")?)?.map(|mm| mm / 1e3);
    let rotation = rotation(&of(&frame, "rot")?, "frame")?;
    let mass_kg = number(&load, "mass")?;
    // The least mass as a `num` is a little off.
    if mass_kg < LEAST_KG * (1.0 - 1e-6) {
        return Err(ToolFault::Mass(mass_kg));
    }
    let com_m = vector(&of(&load, "cog")?)?.map(|mm| mm / 1e3);
    if com_m == [0.0; 3] {
        return Err(ToolFault::Com);
    }
    let axes = self::rotation(&of(&load, "aom")?, "axes of inertia")?;
    let moments = [number(&load, "ix")?, number(&load, "iy")?, number(&load, "iz")?];
    if let Some(moment) = moments.into_iter().find(|moment| *moment < 0.0) {
        return Err(ToolFault::Inertia(moment));
    }
    Ok(ReadTool {
        tip: Some(Pose::from_parts(Translation3::from(tip_m), rotation)),
        mass_kg,
        com_m,
        inertia: Some((moments, axes)),
    })
}

fn number(value: &Value, key: &str) -> Result<f64, ToolFault> {
    component(value, key).map(f64::from).ok_or(ToolFault::Other)
}

fn vector(value: &Value) -> Result<[f64; 3], ToolFault> {
    Ok([number(value, "x")?, number(value, "y")?, number(value, "z")?])
}

fn rotation(value: &Value, what: &'static str) -> Result<UnitQuaternion<f64>, ToolFault> {
    let part = |key: &str| number(value, key);
    let quaternion = Quaternion::new(part("q1")?, part("q2")?, part("q3")?, part("q4")?);
    let length = quaternion.norm();
    if (length - 1.0).abs() > UNIT {
        return Err(ToolFault::Quaternion { what, length });
    }
    Ok(UnitQuaternion::from_quaternion(quaternion))
}
