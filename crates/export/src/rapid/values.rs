//! What a motion is made of: joint targets, zones and tools.

use super::parse::Value;
use crate::reading::ReadTool;
use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use platewash_kinematics::{JointVector, Pose};

/// What stands for an axis that is not used \[°\].
pub(super) const UNUSED: f32 = 9e9;

/// Least mass that a controller takes \[kg\].
pub(super) const LEAST_KG: f64 = 0.001;

/// How far the length of a quaternion of four singles may be from 1.
const UNIT: f64 = 1e-4;

/// How large a zone may be for turning, as a multiple of its radius at the tip: corners are judged up to twice their size.
const MOST_TURNING: f32 = 2.0;

impl Value {
    fn list<const N: usize>(&self) -> Option<[&Self; N]> {
        match self {
            Self::List(values) => values.iter().collect::<Vec<_>>().try_into().ok(),
            _ => None,
        }
    }

    fn number(&self) -> Option<f32> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    fn numbers<const N: usize>(&self) -> Option<[f32; N]> {
        let numbers: Option<Vec<_>> = self.list::<N>()?.into_iter().map(Self::number).collect();
        numbers?.try_into().ok()
    }
}

/// The tool of an arm that holds none.
pub(super) fn tool0() -> Value {
    let list = |numbers: &[f32]| Value::List(numbers.iter().copied().map(Value::Number).collect());
    let (turn, mut load) = (
        list(&[1.0, 0.0, 0.0, 0.0]),
        vec![Value::Number(0.001), list(&[0.0, 0.0, 0.001])],
    );
    load.push(turn.clone());
    load.extend([Value::Number(0.0), Value::Number(0.0), Value::Number(0.0)]);
    let frame = Value::List(vec![list(&[0.0; 3]), turn]);
    Value::List(vec![Value::Truth(true), frame, Value::List(load)])
}

/// Joint positions of a joint target \[rad\].
pub(super) fn target(value: &Value) -> Result<JointVector, String> {
    let parts = value
        .list()
        .and_then(|[robot, external]| Some((robot.numbers::<6>()?, external.numbers::<6>()?)));
    let (robot, external) = parts.ok_or("expected a joint target [[6 angles],[6 external axes]]")?;
    if let Some(joint) = robot.iter().position(|deg| deg.abs() >= UNUSED) {
        return Err(format!(
            "expected an angle in degrees for joint {}, found {:E}",
            joint + 1,
            robot[joint]
        ));
    }
    if external != [UNUSED; 6] {
        return Err("expected 9E9 for every external axis: external axes are not read".to_owned());
    }
    Ok(JointVector::from(robot.map(|deg| f64::from(deg).to_radians())))
}

/// The radius of the corner of a zone \[m\]; `None` for a stop.
pub(super) fn corner(value: &Value) -> Result<Option<f64>, String> {
    let shape = || "expected zone data [FALSE,5,8,8,0.8,8,0.8]".to_owned();
    let [is_stop, rest @ ..] = value.list::<7>().ok_or_else(shape)?;
    let numbers: Option<Vec<_>> = rest.into_iter().map(Value::number).collect();
    match (is_stop, numbers.as_deref()) {
        (Value::Truth(true), Some(_)) => Ok(None),
        (Value::Truth(false), Some([tip, turning, ..])) if *tip >= 0.0 => match *turning <= MOST_TURNING * tip {
            true => Ok(Some(f64::from(*tip) / 1e3)),
            false => Err(format!(
                "expected a zone for turning (pzone_ori) of at most {MOST_TURNING} times its radius at the tip, found {turning} and {tip} \
                 mm: how far from the target the corner begins is judged up to that"
            )),
        },
        _ => Err(shape()),
    }
}

/// Whether a value is speed data: four numbers.
pub(super) fn is_speed(value: &Value) -> bool {
    value.numbers::<4>().is_some()
}

/// A tool, in SI units.
pub(super) fn tool(value: &Value) -> Result<ReadTool, String> {
    let shape = || "expected tool data [TRUE,[[x,y,z],[q1,q2,q3,q4]],[kg,[x,y,z],[q1,q2,q3,q4],ix,iy,iz]]".to_owned();
    let parts = value.list().and_then(|[held, frame, load]: [&Value; 3]| {
        let [trans, rot] = frame.list()?;
        let [mass, cog, aom, ix, iy, iz] = load.list()?;
        let moments = [ix.number()?, iy.number()?, iz.number()?];
        let lengths = [trans.numbers::<3>()?, cog.numbers::<3>()?];
        Some((
            held,
            lengths,
            [rot.numbers::<4>()?, aom.numbers::<4>()?],
            mass.number()?,
            moments,
        ))
    });
    let (held, lengths, rotations, mass, moments) = parts.ok_or_else(shape)?;
    if *held != Value::Truth(true) {
        return Err("expected a tool that the arm holds (robhold TRUE), found one that stands still".to_owned());
    }
    // The least mass as a single is a little off.
    if f64::from(mass) < LEAST_KG * (1.0 - 1e-6) {
        return Err(format!(
            "expected a tool's mass of at least {LEAST_KG} kg, found {mass}: the controller refuses it"
        ));
    }
    let [tip_m, com_m] = lengths.map(|mm| mm.map(|mm| f64::from(mm) / 1e3));
    if com_m == [0.0; 3] {
        return Err(
            "expected a centre of mass away from the flange, found [0, 0, 0]: the controller refuses it".to_owned(),
        );
    }
    if let Some(moment) = moments.into_iter().find(|moment| *moment < 0.0) {
        return Err(format!(
            "expected moments of inertia of 0 kg·m² or more, found {moment}"
        ));
    }
    let [tip, axes] = rotations.map(rotation);
    Ok(ReadTool {
        tip: Some(Pose::from_parts(Translation3::from(tip_m), tip?)),
        mass_kg: f64::from(mass),
        com_m,
        inertia: Some((moments.map(f64::from), axes?)),
    })
}

fn rotation(parts: [f32; 4]) -> Result<UnitQuaternion<f64>, String> {
    let [w, x, y, z] = parts.map(f64::from);
    let quaternion = Quaternion::new(w, x, y, z);
    let length = quaternion.norm();
    match (length - 1.0).abs() <= UNIT {
        true => Ok(UnitQuaternion::from_quaternion(quaternion)),
        false => Err(format!(
            "expected a quaternion of length 1 in the tool, found length {length}"
        )),
    }
}
