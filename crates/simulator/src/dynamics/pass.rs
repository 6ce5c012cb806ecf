//! The pass over the whole arm at one configuration: axes and inertias, all in one frame: base axes, origin at joint 6.
//!
//! In a common frame spatial vectors of different bodies are added without being transformed first (Featherstone 2008, §2.9),
//! and with the origin at the wrist the small inertias there are not drowned by those of a long lever.

use super::body::steiner;
use super::model::DynamicsModel;
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::trig::{Separate, sin_cos_lanes};
use platewash_kinematics::{AXES, JointVector};

/// Joint axes and rigid-body inertias in the common frame.
pub(super) struct Pass {
    /// z_i: direction of the axis.
    pub axes: [Vector3<f64>; AXES],
    /// r_i × z_i: velocity of the origin when the joint turns at 1 rad/s \[m\].
    pub moments: [Vector3<f64>; AXES],
    /// The bodies.
    pub bodies: [Spatial; AXES],
}

/// A rigid body's spatial inertia about the common origin.
#[derive(Clone, Copy)]
pub(super) struct Spatial {
    /// m \[kg\].
    pub mass: f64,
    /// h = m d, d the centre of mass \[kg·m\].
    pub first_moment: Vector3<f64>,
    /// I about the origin \[kg·m²\].
    pub inertia: Matrix3<f64>,
}

impl DynamicsModel {
    /// Axes and inertias at `q` \[rad\].
    #[inline(always)]
    pub(super) fn pass(&self, q: &JointVector) -> Pass {
        let poses = self.poses(q);
        let origin = poses[AXES - 1].translation;
        let axis = |i: usize| -> Vector3<f64> { poses[i].rotation.column(2).into() };
        Pass {
            axes: std::array::from_fn(axis),
            moments: std::array::from_fn(|i| (poses[i].translation - origin).cross(&axis(i))),
            bodies: std::array::from_fn(|i| {
                let (body, Rigid { rotation, translation }) = (&self.bodies[i], &poses[i]);
                let d = translation - origin + rotation * body.com;
                Spatial {
                    mass: body.mass,
                    first_moment: d * body.mass,
                    inertia: rotation * body.about_com * rotation.transpose() + steiner(body.mass, &d),
                }
            }),
        }
    }

    /// `T_base_i` of the six bodies at `q` \[rad\].
    #[inline(always)]
    pub(super) fn poses(&self, q: &JointVector) -> [Rigid; AXES] {
        let (sines, cosines) = sin_cos_lanes::<Separate, AXES>(q.as_ref());
        let mut poses = self.folded;
        let mut before = Rigid::identity();
        for (i, pose) in poses.iter_mut().enumerate() {
            *pose = before.then(pose).turned_about_z(sines[i], cosines[i]);
            before = *pose;
        }
        poses
    }
}

impl Spatial {
    /// I v: moment and force of the momentum (or of the wrench) that belongs to an angular part `w` and a linear part `v`:
    /// (I ω + h × v, m v − h × ω).
    #[inline(always)]
    pub fn times(&self, w: &Vector3<f64>, v: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let h = &self.first_moment;
        (self.inertia * w + h.cross(v), v * self.mass - h.cross(w))
    }
}
