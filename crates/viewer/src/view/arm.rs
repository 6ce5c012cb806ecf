//! The arm: joints, links, what they look like and what counts for the proof.

use super::body::{Body, Pose};
use platewash_kinematics::{AXES, Frame, Link as ModelLink, Pose as Rigid, RobotModel};
use serde::Serialize;

/// An arm where it is mounted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Arm {
    /// Its name.
    pub name: String,
    /// `T_world_base`.
    pub mount: Pose,
    /// From the base to the tip.
    pub joints: Vec<Joint>,
    /// All links.
    pub links: Vec<Link>,
    /// `T_6_flange`: the mounting frame behind joint 6.
    pub flange: Pose,
}

/// A joint: `T_parent_joint(q) = origin · Rot_z(q)`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// `T_parent_joint` at 0.
    pub origin: Pose,
    /// Lowest and highest position \[rad\]; `None` where it turns without end.
    pub position_rad: Option<[f64; 2]>,
    /// Highest speed \[rad/s\].
    pub speed_rad_s: f64,
    /// Highest acceleration \[rad/s²\], where a job states it.
    pub acceleration_rad_s2: Option<f64>,
}

/// A link, fixed to the frame behind some joints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Link {
    /// Its name.
    pub name: String,
    /// How many joints are between it and the base.
    pub joints: usize,
    /// `T_frame_link`.
    pub pose: Pose,
    /// What it looks like, link frame; the shapes that count for the proof where nothing else is known.
    pub visuals: Vec<Body>,
    /// The shapes that count for the proof, link frame.
    pub collision: Vec<Body>,
}

impl Arm {
    /// The arm at `mount` (`T_world_base`) with the frame that carries the tool at `flange`, and the accelerations that a job states \[rad/s²\].
    pub(super) fn new(robot: &RobotModel, mount: &Rigid, flange: &Frame, accelerations: Option<[f64; AXES]>) -> Self {
        let joints = (0..AXES).map(|k| joint(robot, k, accelerations.map(|all| all[k])));
        Self {
            name: robot.name().to_owned(),
            mount: mount.into(),
            joints: joints.collect(),
            links: robot.links().iter().map(link).collect(),
            flange: Pose::from(&Rigid::from(flange.on_body())),
        }
    }
}

fn joint(robot: &RobotModel, k: usize, acceleration_rad_s2: Option<f64>) -> Joint {
    let limits = robot.limits();
    let range = [limits.lower[k], limits.upper[k]];
    Joint {
        name: robot.joints()[k].name.clone(),
        origin: Pose::from(&Rigid::from(&robot.folded()[k])),
        position_rad: range.iter().all(|limit| limit.is_finite()).then_some(range),
        speed_rad_s: limits.velocity[k],
        acceleration_rad_s2,
    }
}

fn link(link: &ModelLink) -> Link {
    let numbered = |k: usize| format!("{} {}", link.name, k + 1);
    let collision = link.collision.iter().enumerate();
    let collision = collision.map(|(k, shape)| Body::plain(&numbered(k), (&shape.shape).into(), &shape.pose));
    let collision: Vec<_> = collision.collect();
    let visuals = link.visuals.iter().enumerate().map(|(k, visual)| Body {
        name: visual.name.clone().unwrap_or_else(|| numbered(k)),
        shape: (&visual.shape).into(),
        pose: (&visual.pose).into(),
        rgba: visual.rgba,
    });
    let mut visuals: Vec<_> = visuals.collect();
    if visuals.is_empty() {
        visuals.clone_from(&collision);
    }
    Link {
        name: link.name.clone(),
        joints: link.frame.body(),
        pose: Pose::from(&Rigid::from(link.frame.on_body())),
        visuals,
        collision,
    }
}
