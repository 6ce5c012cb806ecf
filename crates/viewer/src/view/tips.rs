//! The tip along a motion, in the world.

use nalgebra::Vector3;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{SegmentKind, Trajectory};

/// Largest motion of the tip between two moments, except for very fast ones \[m\].
const STEP_M: f64 = 4e-3;

/// Moments between two knots at most.
const MOST_STEPS: usize = 64;

/// The tip at a moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tip {
    /// Time \[s\].
    pub t_s: f64,
    /// Position of the tip, world frame \[m\].
    pub at: Vector3<f64>,
    /// The way out of the tool, world frame.
    pub axis: Vector3<f64>,
}

/// An arm with a tip, and a planned motion.
#[derive(Debug)]
pub(crate) struct Tips<'a> {
    robot: &'a RobotModel,
    motion: &'a Trajectory,
    mount: RigidTransform,
    tip: Frame,
}

impl<'a> Tips<'a> {
    pub fn new(plan: &Plan, robot: &'a RobotModel, motion: &'a Trajectory) -> Self {
        let workcell = &plan.job.workcell;
        Self {
            robot,
            motion,
            mount: RigidTransform::from(&workcell.mount),
            tip: workcell.tool.tip_frame(robot),
        }
    }

    /// The tip in a configuration \[rad\] at a moment \[s\].
    pub fn tip(&self, q: &JointVector, t_s: f64) -> Tip {
        let pose = self.mount.then(&self.robot.fk(q).rigid(&self.tip));
        Tip {
            t_s,
            at: pose.translation,
            axis: pose.rotation.column(2).into(),
        }
    }

    /// The planned tip at a moment \[s\].
    pub fn at(&self, t_s: f64) -> Option<Tip> {
        let state = self.motion.at(t_s)?;
        Some(self.tip(&state.q, t_s))
    }

    /// The planned tip from one time to another \[s\], close enough that straight lines between its moments are the way.
    pub fn during(&self, from_s: f64, to_s: f64) -> Vec<Tip> {
        let knots = self.motion.times();
        let first = knots.partition_point(|t| *t <= from_s);
        let last = knots.partition_point(|t| *t < to_s);
        let inside = knots.get(first..last).unwrap_or_default().iter().copied();
        let mut tips: Vec<Tip> = self.at(from_s).into_iter().collect();
        for t in inside.chain([to_s]) {
            let (Some(before), Some(there)) = (tips.last().copied(), self.at(t)) else {
                continue;
            };
            let steps = ((there.at - before.at).norm() / STEP_M)
                .ceil()
                .min(MOST_STEPS as f64)
                .max(1.0);
            let between = (1..steps as usize).map(|k| before.t_s + (t - before.t_s) * k as f64 / steps);
            tips.extend(between.filter_map(|t| self.at(t)));
            tips.push(there);
        }
        tips
    }
}

/// The washes of a plan: index of the plate, from and to \[s\]. Segments of no plate are left out.
pub(super) fn washes(plan: &Plan) -> impl Iterator<Item = (usize, [f64; 2])> {
    let washes = plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash);
    let of_plates = washes.filter(|segment| segment.plate < plan.job.plates.len());
    of_plates.map(|segment| (segment.plate, [segment.t_start_s, segment.t_end_s]))
}
