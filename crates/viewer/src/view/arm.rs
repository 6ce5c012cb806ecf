//! The arm: joints, links, their visual shapes, and the shapes that count for the proof.

use super::body::{Body, Shape};
use platewash_kinematics::{AXES, Frame, Link as ModelLink, Pose, RobotModel};
use platewash_workcell::pose;
use serde::Serialize;
use ts_rs::TS;

/// An arm where it is mounted.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Arm {
    /// Its name.
    pub name: String,
    /// `T_world_base`.
    #[serde(serialize_with = "pose::serialize")]
    #[ts(as = "platewash_workcell::pose::PoseFields")]
    pub mount: Pose,
    /// The joints from the base to the tip.
    pub joints: Vec<Joint>,
    /// All links.
    pub links: Vec<Link>,
    /// `T_6_flange`: the mounting frame behind joint 6.
    #[serde(serialize_with = "pose::serialize")]
    #[ts(as = "platewash_workcell::pose::PoseFields")]
    pub flange: Pose,
}

/// A joint: `T_parent_joint(q) = origin · Rot_z(q)`.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// `T_parent_joint` at 0.
    #[serde(serialize_with = "pose::serialize")]
    #[ts(as = "platewash_workcell::pose::PoseFields")]
    pub origin: Pose,
    /// Lowest and highest position \[rad\]; `None` where it turns without end.
    pub position_rad: Option<[f64; 2]>,
    /// Highest speed \[rad/s\].
    pub speed_rad_s: f64,
    /// Highest acceleration \[rad/s²\], where a job states it.
    pub acceleration_rad_s2: Option<f64>,
}

/// A link, fixed to the frame behind some joints.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Link {
    /// Number of joints between it and the base.
    pub joints: usize,
    /// `T_frame_link`.
    #[serde(serialize_with = "pose::serialize")]
    #[ts(as = "platewash_workcell::pose::PoseFields")]
    pub pose: Pose,
    /// Visual bodies, link frame; where none are known, the page shows the shapes that count for the proof.
    pub visuals: Vec<Body>,
    /// The shapes that count for the proof, link frame.
    pub collision: Vec<Body>,
}

impl Arm {
    /// The arm at `mount` (`T_world_base`) with the frame that carries the tool at `flange`, and the accelerations that a job states \[rad/s²\].
    pub(super) fn new(robot: &RobotModel, mount: &Pose, flange: &Frame, accelerations: Option<[f64; AXES]>) -> Self {
        let joints = (0..AXES).map(|k| joint(robot, k, accelerations.map(|all| all[k])));
        Self {
            name: robot.name().to_owned(),
            mount: *mount,
            joints: joints.collect(),
            links: robot.links().iter().map(link).collect(),
            flange: flange.on_body().into(),
        }
    }
}

fn joint(robot: &RobotModel, k: usize, acceleration_rad_s2: Option<f64>) -> Joint {
    let limits = robot.limits();
    let range = [limits.lower[k], limits.upper[k]];
    Joint {
        name: robot.joints()[k].name.clone(),
        origin: (&robot.folded()[k]).into(),
        position_rad: range.iter().all(|limit| limit.is_finite()).then_some(range),
        speed_rad_s: limits.velocity[k],
        acceleration_rad_s2,
    }
}

fn link(link: &ModelLink) -> Link {
    let collision = link.collision.iter().map(|part| Body {
        shape: Shape::Solid(part.shape.clone()),
        pose: part.pose,
        rgba: None,
    });
    let visuals = link.visuals.iter().map(|visual| Body {
        shape: (&visual.shape).into(),
        pose: visual.pose,
        rgba: visual.rgba,
    });
    Link {
        joints: link.frame.body(),
        pose: link.frame.on_body().into(),
        visuals: visuals.collect(),
        collision: collision.collect(),
    }
}
