//! The job under judgement with its arm, the limits that follow from both, and the wash path of each plate.
//!
//! The limits are those of the job and of the arm.
//!
//! The bodies that a job adds to the arm are checked here: distances to them must be computable.

use crate::error::ProveError;
use crate::report::requirement::Requirement;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;
use platewash_workcell::{MOST_BODIES, Obstacle, ObstacleShape, Workcell};

/// The job under judgement, with its arm.
#[derive(Debug)]
pub(crate) struct JudgedJob<'a> {
    pub job: &'a JobTerms,
    pub robot: &'a RobotModel,
    pub joints: JointLimits,
    /// Greatest angle of the tool from the plate's normal while it approaches, washes and retreats \[rad\].
    pub tilt_rad: f64,
    /// Upwards, in the frame of the arm's base. [`JudgedJob::new`] takes it for that of the world.
    pub up: Vector3<f64>,
    paths: Vec<Option<WashPath>>,
}

impl<'a> JudgedJob<'a> {
    /// Joins a job, its arm and the wash paths of its plates; a path may be missing.
    pub fn new(job: &'a JobTerms, robot: &'a RobotModel, paths: Vec<Option<WashPath>>) -> Self {
        // A path may state a narrower cone than the job allows; what one states, all keep.
        let cones = paths.iter().flatten().map(|path| path.cone_rad);
        Self {
            job,
            robot,
            joints: JointLimits::new(robot, JointVector::from(job.limits.joint_acceleration_rad_s2)),
            tilt_rad: cones.fold(job.tilt_max_rad(), f64::min),
            up: Vector3::z(),
            paths,
        }
    }

    /// The plates.
    pub fn plates(&self) -> &'a [Plate] {
        &self.job.plates
    }

    /// Wash path of a plate; `None` where it cannot be judged.
    pub fn path_of(&self, plate: usize) -> Option<&WashPath> {
        self.paths.get(plate)?.as_ref()
    }

    /// Greatest distance of a plate's wash path from the plate's axis \[m\]; `None` where it cannot be judged.
    pub fn path_radius_m(&self, plate: usize) -> Option<f64> {
        let surface = &self.plates().get(plate)?.surface;
        let curve = self.path_of(plate)?.curve;
        Some(surface.at_arc(curve.radius_m).radius_m)
    }

    /// Returns true where a requirement applies to the job. A motion home washes nothing, so that it has no order and no
    /// wash paths; of the sponge at a plate it asks how that is left.
    pub fn asks_for(&self, requirement: Requirement) -> bool {
        use Requirement as R;
        let Some(recovery) = self.job.recovery.as_ref().filter(|recovery| recovery.is_motion_home()) else {
            return true;
        };
        match requirement {
            R::ContactSpeed | R::LineDeviation => recovery.retreat().is_some(),
            R::RestAtWashEnds | R::WashSpeed | R::WashAcceleration => false,
            R::Tilt | R::ContactHeight | R::PathDeviation | R::Reach | R::Swept => false,
            _ => true,
        }
    }

    /// Radius of the sponge \[m\].
    pub fn sponge_m(&self) -> f64 {
        self.job.workcell.tool.sponge.radius_m
    }
}

/// Limits of the joints, from the arm and, for accelerations, the job.
#[derive(Debug, Clone)]
pub(crate) struct JointLimits {
    /// Lowest and highest joint positions \[rad\]; infinite for a continuous joint.
    pub position_rad: [JointVector; 2],
    /// Greatest joint speeds \[rad/s\].
    pub speed_rad_s: JointVector,
    /// Greatest joint accelerations \[rad/s²\]: an assumption, but for those of the arm's description.
    pub acceleration_rad_s2: JointVector,
}

impl JointLimits {
    /// Returns the limits of an arm with the given greatest accelerations \[rad/s²\], or those of its description where they are less.
    pub fn new(robot: &RobotModel, acceleration_rad_s2: JointVector) -> Self {
        let limits = robot.limits();
        Self {
            position_rad: [limits.lower, limits.upper],
            speed_rad_s: limits.velocity,
            acceleration_rad_s2: limits.within_acceleration(&acceleration_rad_s2),
        }
    }
}

/// The greatest size of a body, and the greatest distance of one from its frame, along each axis \[m\].
const GREATEST_M: f64 = 1e3;

/// Least and greatest number of points of a hull.
const POINTS: [usize; 2] = [4, 100_000];

/// Checks that every shape has a finite size and every pose is valid.
///
/// # Errors
/// [`ProveError::Body`].
pub(crate) fn check(world: &Workcell) -> Result<(), ProveError> {
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
    let is_sound = |shape: Option<&Shape>, pose: &Pose| shape.is_none_or(is_shape) && is_valid_pose(pose);
    let mut all = tool.chain(obstacles).chain(frames);
    match all.find(|(_, shape, pose)| !is_sound(*shape, pose)) {
        Some((name, ..)) => Err(ProveError::Body { name: name.clone() }),
        None => Ok(()),
    }
}

/// Checks the parts of an obstacle: each is a hull, and neither their number nor that of all their points is too large. True for an
/// obstacle without parts.
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

/// Checks that a pose is not too far away and that its rotation is normalised.
fn is_valid_pose(pose: &Pose) -> bool {
    let near = pose.translation.vector.iter().all(|c| c.abs() <= GREATEST_M);
    near && (pose.rotation.quaternion().norm() - 1.0).abs() <= 1e-9
}
