//! The moments at which a motion is looked at, with speed and acceleration of the tip from differences.

use super::hermite::Piece;
use super::schedule;
use nalgebra::Vector3;
use platewash::kinematics::Frame;
use platewash::workcell::trajectory::PlanSegment;
use platewash::{JointVector, Plan, RobotModel, Tool, ToolFrame};

/// Half a difference in time \[s\].
const DELTA_S: f64 = 2e-5;

/// What positions of the tip are right to \[m\]: rounding.
const PLACE_M: f64 = 2e-15;

/// Time between samples of long pieces \[s\], and samples of a piece at least and at most: both ends and the middle.
const STEP_S: f64 = 0.01;
const LEAST: usize = 3;
const MOST: usize = 60;

/// The tip on the arm.
pub struct Arm<'a> {
    robot: &'a RobotModel,
    mount: Frame,
    /// The tip in the mounting frame \[m\], and the way out of the tool there.
    tip: Vector3<f64>,
    axis: Vector3<f64>,
}

/// A moment of a motion.
pub struct Moment {
    pub piece: usize,
    /// Time since the piece began \[s\].
    pub u: f64,
    pub tip: Vector3<f64>,
    /// z of the tool.
    pub axis: Vector3<f64>,
    /// The mean speed about here is no less \[m/s\].
    pub speed: f64,
    /// The same for the acceleration \[m/s²\].
    pub acceleration: f64,
    /// Index of its segment; none where the segments do not say what a moment is for.
    pub stage: Option<usize>,
}

impl Moment {
    /// Its segment.
    pub fn segment(&self, plan: &Plan) -> Option<PlanSegment> {
        self.stage.map(|i| plan.segments[i])
    }
}

impl<'a> Arm<'a> {
    pub fn new(robot: &'a RobotModel, tool: &Tool) -> Self {
        Self {
            robot,
            mount: robot.tool_frame(ToolFrame::Tool0).unwrap(),
            tip: tool.tip.translation.vector,
            axis: tool.tip.rotation * Vector3::z(),
        }
    }

    /// Position and z axis of the tip, base frame.
    pub fn tip(&self, q: &JointVector) -> [Vector3<f64>; 2] {
        let mount = self.robot.fk(q).rigid(&self.mount);
        [
            mount.translation + mount.rotation * self.tip,
            mount.rotation * self.axis,
        ]
    }

    /// Height of the lowest point of a sponge's rim, and how fast it moves: no less than the mean over a moment during which it is at or
    /// below a height \[m\]; `None` where it is not.
    pub fn touch(&self, piece: &Piece, u: f64, (radius_m, below_m): (f64, f64)) -> Option<f64> {
        let delta = (piece.length_s / 8.0).min(DELTA_S);
        let middle = u.clamp(delta, piece.length_s - delta);
        let mounts =
            [middle - delta, middle, middle + delta].map(|u| self.robot.fk(&piece.position(u)).rigid(&self.mount));
        let axis = mounts[1].rotation * self.axis;
        // Down along the rim's plane, without a difference of nearly equal numbers where the tool is upright.
        let steepest = Vector3::new(axis.x * axis.z, axis.y * axis.z, -axis.xy().norm_squared());
        let out = steepest.try_normalize(0.0).map_or(steepest, |d| d * radius_m);
        // A point of the tool, which moves with it.
        let carried = mounts[1].rotation.transpose() * out + self.tip;
        let [before, _, after] = mounts.map(|mount| mount.translation + mount.rotation * carried);
        let touches = before.z.max(after.z) <= below_m;
        touches.then(|| ((after - before).norm() - 2.0 * PLACE_M) / (2.0 * delta))
    }

    fn moment(&self, piece: &Piece, k: usize, u: f64, stage: Option<usize>) -> Moment {
        let delta = (piece.length_s / 8.0).min(DELTA_S);
        let middle = u.clamp(delta, piece.length_s - delta);
        let at = |u: f64| self.tip(&piece.position(u));
        let [tip, axis] = at(u);
        let there = if middle == u { tip } else { at(middle)[0] };
        let [before, after] = [middle - delta, middle + delta].map(|u| at(u)[0]);
        let bend = (after - there * 2.0 + before).norm() - 4.0 * PLACE_M;
        Moment {
            piece: k,
            u,
            tip,
            axis,
            speed: ((after - before).norm() - 2.0 * PLACE_M) / (2.0 * delta),
            acceleration: bend / (delta * delta),
            stage,
        }
    }
}

/// Moments of all pieces in time order, both ends of each included, and those at some times \[s\] besides.
pub fn all(arm: &Arm<'_>, plan: &Plan, pieces: &[Piece], is_sound: bool, also_at: &[f64]) -> Vec<Moment> {
    let mut all = Vec::with_capacity(6 * pieces.len());
    for (k, piece) in pieces.iter().enumerate() {
        let stage = is_sound.then(|| schedule::segment_of(plan, piece));
        let mut times = within(piece, also_at);
        let count = (LEAST + (piece.length_s / STEP_S) as usize).min(MOST);
        times.extend((0..count).map(|j| piece.length_s * j as f64 / (count - 1) as f64));
        times.sort_by(f64::total_cmp);
        all.extend(times.into_iter().map(|u| arm.moment(piece, k, u, stage)));
    }
    all
}

/// Those of some times \[s\] that lie within a piece, since it began.
pub fn within(piece: &Piece, times: &[f64]) -> Vec<f64> {
    const NEAR_S: f64 = 1e-9;
    let since = times.iter().map(|t| t - piece.start_s);
    let inside = since.filter(|u| *u >= -NEAR_S && *u <= piece.length_s + NEAR_S);
    inside.map(|u| u.clamp(0.0, piece.length_s)).collect()
}
