//! Pose of a sponge in the frame of a plate.

use nalgebra::Vector3;
use platewash_kinematics::rotation::RigidTransform;
use platewash_workcell::plate::Plate;

/// Pose of a sponge in the frame of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpongePose {
    /// Position of the tip \[m\].
    pub tip: Vector3<f64>,
    /// Axis a, out of the tool; a unit vector.
    pub axis: Vector3<f64>,
}

impl SpongePose {
    /// Returns the pose of a tip frame of the world, relative to a plate.
    #[must_use]
    pub fn on(plate: &Plate, tip: &RigidTransform) -> Self {
        let axis: Vector3<f64> = tip.rotation.column(2).into_owned();
        Self {
            tip: plate.local(&tip.translation),
            axis: plate.pose.inverse_transform_vector(&axis),
        }
    }
}
