//! Inverse dynamics: the recursive Newton–Euler algorithm (Featherstone 2008, §5.3; Luh, Walker, Paul 1980), in the bodies'
//! own frames.
//!
//! Outwards, with R, t the pose of frame i in frame i − 1, z the joint's axis and a the acceleration of the frame's origin:
//!
//! - ω_i = Rᵀ ω_{i−1} + q̇ z
//! - α_i = Rᵀ α_{i−1} + q̈ z + Rᵀ ω_{i−1} × q̇ z
//! - a_i = Rᵀ (a_{i−1} + α_{i−1} × t + ω_{i−1} × (ω_{i−1} × t)), with a_0 = −g: gravity as an acceleration of the base
//! - f_i = m a_i + α_i × h + ω_i × (ω_i × h),  n_i = I α_i + ω_i × I ω_i + h × a_i
//!
//! with h = m c and I about the origin. Inwards f_{i−1} += R f_i, n_{i−1} += R n_i + t × R f_i, and τ_i = z · n_i.

use crate::dynamics::model::{Body, DynamicsModel};
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::sin_cos_lanes;
use platewash_kinematics::{AXES, JointVector};

/// Velocity and acceleration of a body, its own frame.
#[derive(Clone, Copy, Default)]
struct Motion {
    /// ω \[rad/s\].
    turning: Vector3<f64>,
    /// α \[rad/s²\].
    turning_rate: Vector3<f64>,
    /// a of the origin, less gravity \[m/s²\].
    linear_rate: Vector3<f64>,
}

/// Force and moment about the origin, the body's own frame.
#[derive(Clone, Copy, Default)]
struct Wrench {
    /// f \[N\].
    force: Vector3<f64>,
    /// n \[N·m\].
    moment: Vector3<f64>,
}

impl DynamicsModel {
    /// Torques τ \[N·m\] with which the arm at positions `q` \[rad\] and speeds `qd` \[rad/s\] accelerates by `qdd`
    /// \[rad/s²\]: τ = M(q) q̈ + C(q, q̇) q̇ + g(q).
    #[must_use]
    pub fn inverse_dynamics(&self, q: &JointVector, qd: &JointVector, qdd: &JointVector) -> JointVector {
        let (sines, cosines) = sin_cos_lanes::<AXES>(q.as_ref());
        let placed: [RigidTransform; AXES] =
            std::array::from_fn(|i| self.folded[i].turned_about_z(sines[i], cosines[i]));
        let mut motion = Motion {
            linear_rate: -self.gravity,
            ..Motion::default()
        };
        let mut wrenches = [Wrench::default(); AXES];
        for i in 0..AXES {
            motion = motion.next_body_motion(&placed[i], qd[i], qdd[i]);
            wrenches[i] = motion.wrench(&self.bodies[i]);
        }
        let mut torques = JointVector::zeros();
        for i in (0..AXES).rev() {
            torques[i] = wrenches[i].moment.z;
            if let Some(before) = i.checked_sub(1) {
                let force = times(&placed[i].rotation, &wrenches[i].force);
                let moment = times(&placed[i].rotation, &wrenches[i].moment);
                wrenches[before].force += force;
                wrenches[before].moment += moment + placed[i].translation.cross(&force);
            }
        }
        torques
    }

    /// Torques g(q) \[N·m\] that hold the arm still at `q` \[rad\].
    #[must_use]
    pub fn gravity_torque(&self, q: &JointVector) -> JointVector {
        self.inverse_dynamics(q, &JointVector::zeros(), &JointVector::zeros())
    }

    /// Torques C(q, q̇) q̇ + g(q) \[N·m\]: those at which nothing accelerates.
    #[must_use]
    pub fn bias_torque(&self, q: &JointVector, qd: &JointVector) -> JointVector {
        self.inverse_dynamics(q, qd, &JointVector::zeros())
    }

    /// Centrifugal and Coriolis torques C(q, q̇) q̇ \[N·m\].
    #[must_use]
    pub fn coriolis_torque(&self, q: &JointVector, qd: &JointVector) -> JointVector {
        self.bias_torque(q, qd) - self.gravity_torque(q)
    }
}

impl Motion {
    /// The motion of the next body, placed by (R, t), whose joint turns with `qd` and `qdd`.
    #[inline(always)]
    fn next_body_motion(&self, placed: &RigidTransform, qd: f64, qdd: f64) -> Self {
        let (w, turn) = (self.turning, &placed.rotation);
        let carried = back(turn, &w);
        let at_joint = self.linear_rate + times(&swing(&w, &self.turning_rate), &placed.translation);
        let rate = back(turn, &self.turning_rate);
        Self {
            turning: Vector3::new(carried.x, carried.y, carried.z + qd),
            turning_rate: Vector3::new(rate.x + carried.y * qd, rate.y - carried.x * qd, rate.z + qdd),
            linear_rate: back(turn, &at_joint),
        }
    }

    /// The wrench that gives a body this motion.
    #[inline(always)]
    fn wrench(&self, body: &Body) -> Wrench {
        let (w, h) = (self.turning, body.first_moment);
        let spin = times(&body.about_origin, &w);
        Wrench {
            force: self.linear_rate * body.mass + times(&swing(&w, &self.turning_rate), &h),
            moment: times(&body.about_origin, &self.turning_rate) + w.cross(&spin) + h.cross(&self.linear_rate),
        }
    }
}

/// \[α\]× + \[ω\]×², which maps a point of a body to its acceleration relative to the origin.
#[inline(always)]
fn swing(w: &Vector3<f64>, rate: &Vector3<f64>) -> Matrix3<f64> {
    let (xx, yy, zz) = (w.x * w.x, w.y * w.y, w.z * w.z);
    let (xy, xz, yz) = (w.x * w.y, w.x * w.z, w.y * w.z);
    Matrix3::new(
        -yy - zz,
        xy - rate.z,
        xz + rate.y,
        xy + rate.z,
        -xx - zz,
        yz - rate.x,
        xz - rate.y,
        yz + rate.x,
        -xx - yy,
    )
}

/// M v, written out: faster here than the general product.
#[inline(always)]
fn times(m: &Matrix3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        m.m11 * v.x + m.m12 * v.y + m.m13 * v.z,
        m.m21 * v.x + m.m22 * v.y + m.m23 * v.z,
        m.m31 * v.x + m.m32 * v.y + m.m33 * v.z,
    )
}

/// Mᵀ v, written out.
#[inline(always)]
fn back(m: &Matrix3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        m.m11 * v.x + m.m21 * v.y + m.m31 * v.z,
        m.m12 * v.x + m.m22 * v.y + m.m32 * v.z,
        m.m13 * v.x + m.m23 * v.y + m.m33 * v.z,
    )
}
