//! A pose as people and programs read it.

use platewash::Pose;
use serde::Serialize;

/// A pose as people and programs read it.
#[derive(Debug, Serialize)]
pub struct FramePose {
    /// \[m\].
    pub position_m: [f64; 3],
    /// Rows of the rotation matrix.
    pub rotation: [[f64; 3]; 3],
    /// (w, x, y, z).
    pub quaternion_wxyz: [f64; 4],
    /// URDF's roll, pitch, yaw \[rad\].
    pub rpy_rad: [f64; 3],
    /// They \[deg\].
    pub rpy_deg: [f64; 3],
}

impl From<&Pose> for FramePose {
    fn from(pose: &Pose) -> Self {
        let matrix = pose.rotation.to_rotation_matrix();
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let q = pose.rotation.quaternion();
        Self {
            position_m: pose.translation.vector.into(),
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)])),
            quaternion_wxyz: [q.w, q.i, q.j, q.k],
            rpy_rad: [roll, pitch, yaw],
            rpy_deg: [roll, pitch, yaw].map(f64::to_degrees),
        }
    }
}
