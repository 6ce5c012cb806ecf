//! The arm's bodies, joint by joint: the data of every algorithm here.
//!
//! Body i is everything that joint i moves and joint i + 1 does not, in the folded frame of joint i (z along its axis, origin
//! on it). A body whose inertia about its own joint's axis is above zero moves only if kinetic energy does: by induction from
//! joint 1, ½ q̇ᵀ M q̇ = 0 then implies q̇ = 0, so that M is positive definite in every configuration.
//!
//! The pass over the whole arm at one configuration: axes and inertias, all in one frame: base axes, origin at joint 6.
//!
//! In a common frame spatial vectors of different bodies are added without being transformed first (Featherstone 2008, §2.9),
//! and with the origin at the wrist the small inertias there are not drowned by those of a long lever.

use crate::dynamics::body::{self, MassPropertiesError, RigidBody, steiner};
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::sin_cos_lanes;
use platewash_kinematics::{AXES, JointVector, Link, Pose, RobotModel, ToolFrameError};
use platewash_workcell::tool::Tool;

/// Standard gravity as rigid-body codes round it \[m/s²\].
pub const STANDARD_GRAVITY_M_S2: f64 = 9.81;

/// Reason that an arm has no dynamics.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// A link that moves states no mass.
    #[error("link '{link}' states no <inertial>: its mass, centre of mass and inertia are needed for dynamics")]
    Missing {
        /// The link.
        link: String,
    },
    /// A link that cannot exist.
    #[error("link '{link}': {cause}")]
    Link {
        /// The link.
        link: String,
        /// Reason that the mass properties are refused.
        cause: MassPropertiesError,
    },
    /// A tool that cannot exist.
    #[error("tool: {cause}")]
    Tool {
        /// Reason that the mass properties are refused.
        cause: MassPropertiesError,
    },
    /// The arm has no link that carries the tool.
    #[error(transparent)]
    Mount(#[from] ToolFrameError),
    /// A joint that nothing resists.
    #[error(
        "link '{link}': no inertia about the axis of joint '{joint}', which could then be accelerated without torque"
    )]
    NoInertia {
        /// The joint.
        joint: String,
        /// The link that it moves.
        link: String,
    },
    /// Gravity that is not finite.
    #[error("gravity must be finite; found {found:?} m/s²")]
    Gravity {
        /// Gravity found.
        found: [f64; 3],
    },
}

/// The dynamics of an arm, with or without a tool. Immutable once built.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicsModel {
    /// `F_i = T_{i−1}_i` at q = 0.
    pub(crate) folded: [RigidTransform; AXES],
    pub(crate) bodies: [Body; AXES],
    /// Acceleration of free fall, base frame \[m/s²\].
    pub(crate) gravity: Vector3<f64>,
}

/// A body in its joint's frame, in the forms that the algorithms use.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Body {
    /// Mass \[kg\].
    pub mass: f64,
    /// Centre of mass \[m\].
    pub com: Vector3<f64>,
    /// h = m c \[kg·m\].
    pub first_moment: Vector3<f64>,
    /// Inertia about the centre of mass \[kg·m²\].
    pub about_com: Matrix3<f64>,
    /// Inertia about the joint frame's origin \[kg·m²\].
    pub about_origin: Matrix3<f64>,
}

impl DynamicsModel {
    /// The dynamics of `robot` that holds `tool`, with gravity along −z of the base.
    ///
    /// Links behind a joint need mass: those that a joint moves and those with a collision shape. Frames without either
    /// weigh nothing. The base does not move; its mass does not matter.
    ///
    /// # Errors
    /// [`DynamicsError`], naming the link.
    pub fn new(robot: &RobotModel, tool: Option<&Tool>) -> Result<Self, DynamicsError> {
        let mut bodies = [RigidBody::default(); AXES];
        for link in robot.links() {
            if let (Some(body), Some(part)) = (behind_joint(link), mass_of(robot, link)?) {
                bodies[body] = bodies[body].with(&part.in_frame(link.frame.on_body()));
            }
        }
        if let Some((tool, mass)) = tool.and_then(|tool| Some((tool, tool.mass.as_ref()?))) {
            tool.check_mount(robot)?;
            let body = RigidBody::from(mass);
            body::check(&body).map_err(|cause| DynamicsError::Tool { cause })?;
            bodies[AXES - 1] = bodies[AXES - 1].with(&body.in_frame(tool.mounting_frame(robot).on_body()));
        }
        for (body, joint) in bodies.iter().zip(robot.joints()) {
            if body.inertia_about_origin().m33.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
                return Err(DynamicsError::NoInertia {
                    joint: joint.name.clone(),
                    link: joint.child.clone(),
                });
            }
        }
        Ok(Self {
            folded: *robot.folded(),
            bodies: bodies.map(|body| Body::new(&body)),
            gravity: Vector3::new(0.0, 0.0, -STANDARD_GRAVITY_M_S2),
        })
    }

    /// The same for an arm mounted at `T_world_base`, with gravity along −z of the world.
    ///
    /// # Errors
    /// As [`DynamicsModel::new`], and [`DynamicsError::Gravity`] for a mount that is no pose.
    pub fn mounted(robot: &RobotModel, tool: Option<&Tool>, mount: &Pose) -> Result<Self, DynamicsError> {
        let model = Self::new(robot, tool)?;
        let down = mount.inverse_transform_vector(&model.gravity);
        model.with_gravity(down)
    }

    /// The same arm under another gravity, the acceleration of free fall in the base frame \[m/s²\].
    ///
    /// # Errors
    /// [`DynamicsError::Gravity`] when it is not finite.
    pub fn with_gravity(mut self, gravity_m_s2: Vector3<f64>) -> Result<Self, DynamicsError> {
        if !gravity_m_s2.iter().all(|v| v.is_finite()) {
            let found = gravity_m_s2.into();
            return Err(DynamicsError::Gravity { found });
        }
        self.gravity = gravity_m_s2;
        Ok(self)
    }

    /// Mass of everything that moves \[kg\].
    #[must_use]
    pub fn moving_mass_kg(&self) -> f64 {
        self.bodies.iter().map(|body| body.mass).sum()
    }
}

impl Body {
    fn new(body: &RigidBody) -> Self {
        Self {
            mass: body.mass_kg,
            com: body.com_m,
            first_moment: body.com_m * body.mass_kg,
            about_com: body.inertia_kg_m2,
            about_origin: body.inertia_about_origin(),
        }
    }
}

/// Index of the body that a link belongs to, 0 for links moved by joint 1; `None` for the base.
fn behind_joint(link: &Link) -> Option<usize> {
    link.frame.body().checked_sub(1)
}

/// The mass properties of a link, in its frame; `None` for the base and for a pure frame.
fn mass_of(robot: &RobotModel, link: &Link) -> Result<Option<RigidBody>, DynamicsError> {
    let Some(body) = behind_joint(link) else {
        return Ok(None);
    };
    let name = || link.name.clone();
    let Some(inertial) = &link.inertial else {
        let is_needed = robot.joints()[body].child == link.name || !link.collision.is_empty();
        return if is_needed {
            Err(DynamicsError::Missing { link: name() })
        } else {
            Ok(None)
        };
    };
    let part = RigidBody::from(inertial);
    body::check(&part).map_err(|cause| DynamicsError::Link { link: name(), cause })?;
    Ok(Some(part))
}

/// Joint axes and rigid-body inertias in the common frame.
pub(crate) struct Pass {
    /// z_i: direction of the axis.
    pub axes: [Vector3<f64>; AXES],
    /// r_i × z_i: velocity of the origin when the joint turns at 1 rad/s \[m\].
    pub moments: [Vector3<f64>; AXES],
    /// The bodies.
    pub bodies: [Spatial; AXES],
}

/// A rigid body's spatial inertia about the common origin.
#[derive(Clone, Copy)]
pub(crate) struct Spatial {
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
    pub(crate) fn pass(&self, q: &JointVector) -> Pass {
        let poses = self.poses(q);
        let origin = poses[AXES - 1].translation;
        let axis = |i: usize| -> Vector3<f64> { poses[i].rotation.column(2).into() };
        Pass {
            axes: std::array::from_fn(axis),
            moments: std::array::from_fn(|i| (poses[i].translation - origin).cross(&axis(i))),
            bodies: std::array::from_fn(|i| {
                let (body, RigidTransform { rotation, translation }) = (&self.bodies[i], &poses[i]);
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
    pub(crate) fn poses(&self, q: &JointVector) -> [RigidTransform; AXES] {
        let (sines, cosines) = sin_cos_lanes::<AXES>(q.as_ref());
        let mut poses = self.folded;
        let mut before = RigidTransform::identity();
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
