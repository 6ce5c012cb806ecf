//! What is judged: a job with its arm, the limits that follow from both, and how each plate is washed.
//!
//! The limits that count in judging a plan: those of its job and of the arm.
//!
//! The bodies that a job adds to the arm: whether distances to them can be worked out at all.

use crate::error::ProveError;
use nalgebra::Point3;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;
use platewash_workcell::workcell::{MOST_BODIES, Obstacle, ObstacleShape};

/// A job that is judged.
#[derive(Debug)]
pub(crate) struct Subject<'a> {
    pub job: &'a JobTerms,
    pub robot: &'a RobotModel,
    pub limits: Limits,
    paths: Vec<Option<WashPath>>,
}

impl<'a> Subject<'a> {
    /// A job for an arm, with the wash paths of its plates as far as there are any.
    pub fn new(job: &'a JobTerms, robot: &'a RobotModel, paths: Vec<Option<WashPath>>) -> Self {
        let mut limits = Limits::new(job, robot);
        // A path may state a narrower cone than the job allows; what one states, all keep.
        let cones = paths.iter().flatten().map(|path| path.cone_rad);
        limits.tilt_rad = cones.fold(limits.tilt_rad, f64::min);
        Self {
            job,
            robot,
            limits,
            paths,
        }
    }

    /// The plates.
    pub fn plates(&self) -> &'a [Plate] {
        &self.job.plates
    }

    /// How a plate is washed; `None` where that cannot be judged.
    pub fn path_of(&self, plate: usize) -> Option<&WashPath> {
        self.paths.get(plate)?.as_ref()
    }

    /// How far the wash path of a plate gets from its axis \[m\]; `None` where that cannot be judged.
    pub fn path_radius_m(&self, plate: usize) -> Option<f64> {
        let surface = &self.plates().get(plate)?.surface;
        let curve = self.path_of(plate)?.curve;
        Some(surface.at_arc(curve.radius_m).radius_m)
    }

    /// Radius of the sponge \[m\].
    pub fn sponge_m(&self) -> f64 {
        self.job.workcell.tool.sponge.radius_m
    }
}

/// What must not be exceeded.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    /// Lowest and highest joint positions \[rad\]; infinite for a continuous joint.
    pub position_rad: [JointVector; 2],
    /// Joint speeds \[rad/s\].
    pub speed_rad_s: JointVector,
    /// Joint accelerations \[rad/s²\]: an assumption.
    pub acceleration_rad_s2: JointVector,
    /// Speed of the tip anywhere \[m/s\].
    pub tip_speed_m_s: f64,
    /// Acceleration of the tip anywhere \[m/s²\].
    pub tip_acceleration_m_s2: f64,
    /// Speed of the tip while it washes \[m/s\].
    pub wash_speed_m_s: f64,
    /// Acceleration of the tip while it washes \[m/s²\].
    pub wash_acceleration_m_s2: f64,
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats \[rad\].
    pub tilt_rad: f64,
    /// Clearance \[m\].
    pub clearance_m: f64,
    /// Share of a plate's face.
    pub coverage: f64,
}

impl Limits {
    /// Those of a job and its arm.
    pub fn new(job: &JobTerms, robot: &RobotModel) -> Self {
        let joints = robot.limits();
        Self {
            position_rad: [joints.lower, joints.upper],
            speed_rad_s: joints.velocity,
            acceleration_rad_s2: JointVector::from(job.limits.joint_acceleration_rad_s2),
            tip_speed_m_s: job.limits.tip_speed_m_s,
            tip_acceleration_m_s2: job.limits.tip_acceleration_m_s2,
            wash_speed_m_s: job.wash_speed_m_s(),
            wash_acceleration_m_s2: job.wash_acceleration_m_s2(),
            tilt_rad: job.tilt_max_rad(),
            clearance_m: job.requirements.clearance_m,
            coverage: job.requirements.coverage,
        }
    }
}

/// The greatest size of a body, and the greatest distance of one from its frame, along each axis \[m\].
const GREATEST_M: f64 = 1e3;

/// Points of a hull at least and at most.
const POINTS: [usize; 2] = [4, 100_000];

/// Refuses shapes that are none and places that are nowhere.
///
/// # Errors
/// [`ProveError::Body`].
pub(crate) fn check(job: &JobTerms) -> Result<(), ProveError> {
    let world = &job.workcell;
    let tool = world.tool.bodies.iter().map(|b| (&b.name, Some(&b.shape), &b.pose));
    let obstacles = world.obstacles.iter().map(|o| match &o.shape {
        ObstacleShape::HalfSpace | ObstacleShape::Parts(_) => (&o.name, None, &o.pose),
        ObstacleShape::Convex(shape) => (&o.name, Some(shape), &o.pose),
    });
    if let Some(none) = world.obstacles.iter().find(|o| !has_sound_parts(o)) {
        let name = none.name.clone();
        return Err(ProveError::Body { name });
    }
    let sponge = "sponge".to_owned();
    let tip = "tip of the tool".to_owned();
    let frames = [(&sponge, None, &world.tool.sponge.pose), (&tip, None, &world.tool.tip)];
    let is_sound = |shape: Option<&Shape>, pose: &Pose| shape.is_none_or(is_shape) && is_place(pose);
    let mut all = tool.chain(obstacles).chain(frames);
    match all.find(|(_, shape, pose)| !is_sound(*shape, pose)) {
        Some((name, ..)) => Err(ProveError::Body { name: name.clone() }),
        None => Ok(()),
    }
}

/// Whether the parts of an obstacle that has some are hulls, not too many of them and of not too many points together.
fn has_sound_parts(obstacle: &Obstacle) -> bool {
    let ObstacleShape::Parts(hulls) = &obstacle.shape else {
        return true;
    };
    let [_, most] = POINTS;
    let points: usize = hulls.iter().map(Vec::len).sum();
    (1..=MOST_BODIES).contains(&hulls.len()) && points <= most && hulls.iter().all(|points| is_hull(points))
}

fn is_hull(points: &[Point3<f64>]) -> bool {
    let [least, most] = POINTS;
    let near = points.iter().flat_map(|p| p.iter()).all(|c| c.abs() <= GREATEST_M);
    (least..=most).contains(&points.len()) && near
}

fn is_shape(shape: &Shape) -> bool {
    let size = |size: f64| size > 0.0 && size <= GREATEST_M;
    match shape {
        Shape::Box { half_m } => half_m.iter().all(|half| size(*half)),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => size(*radius_m) && size(*half_length_m),
        Shape::Sphere { radius_m } => size(*radius_m),
        Shape::Capsule {
            radius_m,
            half_length_m,
        } => size(*radius_m) && (0.0..=GREATEST_M).contains(half_length_m),
        Shape::Hull { points } => is_hull(points),
    }
}

/// Whether a pose is a place not too far away, and a rotation.
fn is_place(pose: &Pose) -> bool {
    let near = pose.translation.vector.iter().all(|c| c.abs() <= GREATEST_M);
    near && (pose.rotation.quaternion().norm() - 1.0).abs() <= 1e-9
}
