//! Pose in files: position in metres and unit quaternion (w, x, y, z).

use nalgebra::{Quaternion, Translation3, UnitQuaternion};
use platewash_kinematics::Pose;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use ts_rs::TS;

/// Greatest difference of a quaternion's norm from 1.
const UNIT: f64 = 1e-9;

/// Checks that a pose is finite and that its quaternion has length 1.
pub(crate) fn is_sound(pose: &Pose) -> bool {
    pose.translation.vector.iter().all(|c| c.is_finite()) && is_unit(pose.rotation.quaternion())
}

/// Checks that a quaternion has length 1; false for NaN.
fn is_unit(q: &Quaternion<f64>) -> bool {
    (q.norm() - 1.0).abs() <= UNIT
}

/// `T_a_b`: pose of b in the frame a.
#[derive(Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
#[ts(rename = "Pose")]
pub struct PoseFields {
    /// Origin of b \[m\].
    position_m: [f64; 3],
    /// Axes of b, as a unit quaternion.
    quaternion_wxyz: [f64; 4],
}

/// Writes a pose.
///
/// # Errors
/// Errors of the serializer.
pub fn serialize<S: Serializer>(pose: &Pose, serializer: S) -> Result<S::Ok, S::Error> {
    let q = pose.rotation.quaternion();
    let in_file = PoseFields {
        position_m: pose.translation.vector.into(),
        quaternion_wxyz: [q.w, q.i, q.j, q.k],
    };
    in_file.serialize(serializer)
}

/// Reads a pose. The numbers are kept to the bit.
///
/// # Errors
/// A value that is not a pose, or a quaternion whose length is not 1.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Pose, D::Error> {
    let PoseFields {
        position_m,
        quaternion_wxyz: [w, x, y, z],
    } = PoseFields::deserialize(deserializer)?;
    let q = Quaternion::new(w, x, y, z);
    if !is_unit(&q) {
        return Err(D::Error::custom(format!(
            "quaternion_wxyz must have length 1; found {}",
            q.norm()
        )));
    }
    // To the bit: what is read is what was written.
    Ok(Pose::from_parts(
        Translation3::from(position_m),
        UnitQuaternion::new_unchecked(q),
    ))
}
