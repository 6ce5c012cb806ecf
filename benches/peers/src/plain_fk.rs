//! Forward kinematics of the IRB 120 as one would first write it: published dimensions, the platform's sine and
//! cosine. It is what our own is timed against, and what checks answers independently of it.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{AXES, JointVector};

/// The chain: one constant transform before each joint, which turns about its own z axis.
#[derive(Debug, Clone)]
pub struct PlainArm {
    before: [RigidTransform; AXES],
    tool: RigidTransform,
}

impl Default for PlainArm {
    fn default() -> Self {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let about_z = Matrix3::identity();
        // Columns: where the joint's x, y and z axes point in base axes at q = 0.
        let about_y = Matrix3::from_columns(&[x, -z, y]);
        let about_x = Matrix3::from_columns(&[-z, y, x]);
        let axes = [about_z, about_y, about_y, about_x, about_y, about_x];
        let steps = [Vector3::zeros(), z * 0.290, z * 0.270, z * 0.070, x * 0.302, x * 0.072];
        let mut last = about_z;
        let before = std::array::from_fn(|i| {
            let back = last.transpose();
            last = axes[i];
            RigidTransform {
                rotation: back * axes[i],
                translation: back * steps[i],
            }
        });
        // `tool0` is turned by 90° about y from the base, as joint 6's frame is.
        Self {
            before,
            tool: RigidTransform::identity(),
        }
    }
}

impl PlainArm {
    /// Poses of the seven bodies.
    #[must_use]
    pub fn bodies(&self, q: &JointVector) -> [RigidTransform; AXES + 1] {
        let mut bodies = [RigidTransform::identity(); AXES + 1];
        for (i, before) in self.before.iter().enumerate() {
            let (s, c) = f64::sin_cos(q[i]);
            bodies[i + 1] = bodies[i].then(before).turned_about_z(s, c);
        }
        bodies
    }

    /// Pose of `tool0`.
    #[must_use]
    pub fn tool0(&self, q: &JointVector) -> RigidTransform {
        self.bodies(q)[AXES].then(&self.tool)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_kinematics::{RobotModel, ToolFrame};
    use platewash_problems::problems::configurations;
    use platewash_problems::score::errors;
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    #[test]
    fn benches_use_the_arm_of_the_model() {
        let robot = RobotModel::irb120().unwrap();
        let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
        let plain = PlainArm::default();
        for q in configurations(&robot, 1000, &mut Pcg64::seed_from_u64(3)) {
            let [m, rad] = errors(&robot.fk(&q).rigid(&tool0), &plain.tool0(&q));
            assert!(m < 1e-14 && rad < 1e-14, "{m:e} {rad:e}");
        }
    }
}
