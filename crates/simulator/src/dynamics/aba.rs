//! Forward dynamics, also with a force on the tool: the articulated-body algorithm (Featherstone 2008, §7.3), in one common frame.
//!
//! Spatial vectors are (angular, linear). With S the joint's motion, v_i = v_{i−1} + S_i q̇_i and c_i = v_i × S_i q̇_i,
//!
//! - outwards: Iᴬ_i = I_i, p_i = v_i ×* I_i v_i;
//! - inwards: U = Iᴬ S, D = Sᵀ U, u = τ − Sᵀ p; Iᴬ_{i−1} += Iᴬ − U Uᵀ/D, p_{i−1} += p + (Iᴬ − U Uᵀ/D) c + U u/D;
//! - outwards: a' = a_{i−1} + c, q̈ = (u − Uᵀ a')/D, a_i = a' + S q̈, with a_0 = −g.

use crate::dynamics::model::{DynamicsModel, Pass, Spatial};
use nalgebra::{Matrix6, Point3, Vector3, Vector6};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{AXES, Frame, JointVector};

/// (angular, linear) in the common frame.
type SpatialVector = Vector6<f64>;

/// Results of the inward pass for a joint that the outward pass needs.
#[derive(Clone, Copy, Default)]
struct Joint {
    /// S.
    axis: SpatialVector,
    /// c.
    drift: SpatialVector,
    /// U / D.
    share: SpatialVector,
    /// u / D.
    free: f64,
}

impl DynamicsModel {
    /// Accelerations q̈ \[rad/s²\] of the arm at positions `q` \[rad\] and speeds `qd` \[rad/s\] under the torques `torque`
    /// \[N·m\]: M(q) q̈ = τ − C(q, q̇) q̇ − g(q).
    #[must_use]
    pub fn forward_dynamics(&self, q: &JointVector, qd: &JointVector, torque: &JointVector) -> JointVector {
        self.forward_dynamics_with(q, qd, torque, &JointVector::zeros())
    }

    /// As [`DynamicsModel::forward_dynamics`] with an inertia `own` \[kg·m²\], not negative, that each joint alone has to turn: (M(q) + diag(own)) q̈ =
    /// τ − C(q, q̇) q̇ − g(q). A rotor behind a gear is one; a step of implicit friction has the form, too.
    #[must_use]
    pub fn forward_dynamics_with(
        &self,
        q: &JointVector,
        qd: &JointVector,
        torque: &JointVector,
        own: &JointVector,
    ) -> JointVector {
        let pass = self.pass(q);
        let (mut inertias, mut biases, mut joints) = outwards(&pass, qd);
        for i in (0..AXES).rev() {
            let (axis, drift) = (joints[i].axis, joints[i].drift);
            let across: SpatialVector = inertias[i] * axis;
            let stiffness = axis.dot(&across) + own[i];
            let share = across / stiffness;
            let free = (torque[i] - axis.dot(&biases[i])) / stiffness;
            joints[i].share = share;
            joints[i].free = free;
            if let Some(before) = i.checked_sub(1) {
                let left = inertias[i] - across * share.transpose();
                let passed = biases[i] + left * drift + across * free;
                inertias[before] += left;
                biases[before] += passed;
            }
        }
        let mut acceleration = spatial(&Vector3::zeros(), &-self.gravity);
        JointVector::from_fn(|i, _| {
            let joint = &joints[i];
            acceleration += joint.drift;
            let qdd = joint.free - joint.share.dot(&acceleration);
            acceleration += joint.axis * qdd;
            qdd
        })
    }
}

/// Inertias, bias wrenches and joints of the moving arm.
#[inline(always)]
fn outwards(pass: &Pass, qd: &JointVector) -> ([Matrix6<f64>; AXES], [SpatialVector; AXES], [Joint; AXES]) {
    let mut joints = [Joint::default(); AXES];
    let (mut inertias, mut biases) = ([Matrix6::zeros(); AXES], [SpatialVector::zeros(); AXES]);
    let (mut w, mut v) = (Vector3::zeros(), Vector3::zeros());
    for i in 0..AXES {
        let (axis, moment) = (pass.axes[i], pass.moments[i]);
        let (turn, slide) = (axis * qd[i], moment * qd[i]);
        w += turn;
        v += slide;
        let body = &pass.bodies[i];
        let (spin, momentum) = body.times(&w, &v);
        joints[i].axis = spatial(&axis, &moment);
        joints[i].drift = spatial(&w.cross(&turn), &(w.cross(&slide) + v.cross(&turn)));
        inertias[i] = matrix(body);
        biases[i] = spatial(&(w.cross(&spin) + v.cross(&momentum)), &w.cross(&momentum));
    }
    (inertias, biases, joints)
}

#[inline(always)]
fn spatial(angular: &Vector3<f64>, linear: &Vector3<f64>) -> SpatialVector {
    SpatialVector::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

/// The 6 × 6 spatial inertia \[I, \[h\]×; −\[h\]×, m 1\].
#[inline(always)]
fn matrix(body: &Spatial) -> Matrix6<f64> {
    let (m, i) = (body.mass, &body.inertia);
    let [x, y, z] = body.first_moment.into();
    #[rustfmt::skip]
    let matrix = Matrix6::new(
        i.m11, i.m12, i.m13, 0.0,  -z,   y,
        i.m21, i.m22, i.m23,   z, 0.0,  -x,
        i.m31, i.m32, i.m33,  -y,   x, 0.0,
          0.0,     z,    -y,   m, 0.0, 0.0,
           -z,   0.0,     x, 0.0,   m, 0.0,
            y,    -x,   0.0, 0.0, 0.0,   m,
    );
    matrix
}

impl DynamicsModel {
    /// Torques Jᵀ f \[N·m\] by which a force \[N\], base frame, on the origin of `frame` drives the joints at `q` \[rad\]:
    /// τ_j = z_j · ((p − p_j) × f) for the joints that move the frame.
    #[must_use]
    pub fn torque_of_force(&self, q: &JointVector, frame: &Frame, force: &Vector3<f64>) -> JointVector {
        let poses = self.poses(q);
        let Some(last) = frame.body().checked_sub(1) else {
            return JointVector::zeros();
        };
        let at = poses[last].then(frame.on_body()).translation;
        JointVector::from_fn(|j, _| {
            let axis = poses[j].rotation.column(2);
            if j <= last {
                axis.dot(&(at - poses[j].translation).cross(force))
            } else {
                0.0
            }
        })
    }

    /// Origin of `frame` at `q` \[rad\], base frame \[m\].
    #[must_use]
    pub fn position(&self, q: &JointVector, frame: &Frame) -> Point3<f64> {
        match frame.body().checked_sub(1) {
            Some(body) => self.poses(q)[body].then(frame.on_body()).translation.into(),
            None => frame.on_body().translation.into(),
        }
    }
}

/// A frame on the arm, and how the joints move it.
#[derive(Debug, Clone, Copy)]
pub struct FrameMotion {
    /// `T_base_frame`.
    pub pose: RigidTransform,
    /// z_j: axes of the joints that move it, zeros of the others.
    axes: [Vector3<f64>; AXES],
    /// z_j × (p − p_j): velocity of its origin when joint j turns at 1 rad/s \[m\].
    levers: [Vector3<f64>; AXES],
}

impl FrameMotion {
    /// Torques of a force \[N\] at the origin and a moment \[N·m\], base frame \[N·m\].
    #[inline]
    #[must_use]
    pub fn torque(&self, force: &Vector3<f64>, moment: &Vector3<f64>) -> JointVector {
        JointVector::from_fn(|j, _| self.levers[j].dot(force) + self.axes[j].dot(moment))
    }

    /// Velocity of the origin \[m/s\] and angular velocity \[rad/s\], base frame, at joint speeds `qd` \[rad/s\].
    #[inline]
    #[must_use]
    pub fn twist(&self, qd: &JointVector) -> [Vector3<f64>; 2] {
        let sum = |of: &[Vector3<f64>; AXES]| (0..AXES).fold(Vector3::zeros(), |sum, j| sum + of[j] * qd[j]);
        [sum(&self.levers), sum(&self.axes)]
    }
}

impl DynamicsModel {
    /// A frame at `q` \[rad\].
    #[must_use]
    pub fn frame_motion(&self, q: &JointVector, frame: &Frame) -> FrameMotion {
        let poses = self.poses(q);
        let count = frame.body().min(AXES);
        let pose = match count.checked_sub(1) {
            Some(last) => poses[last].then(frame.on_body()),
            None => *frame.on_body(),
        };
        let mut motion = FrameMotion {
            pose,
            axes: [Vector3::zeros(); AXES],
            levers: [Vector3::zeros(); AXES],
        };
        for (j, joint) in poses.iter().enumerate().take(count) {
            motion.axes[j] = joint.rotation.column(2).into_owned();
            motion.levers[j] = motion.axes[j].cross(&(pose.translation - joint.translation));
        }
        motion
    }
}
