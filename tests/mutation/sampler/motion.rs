//! Motion at sampled moments: cubic Hermite pieces, speed and acceleration of the joints and, from differences, of the tip.

use crate::mutation::sampler::findings::Findings;
use crate::mutation::sampler::paths;
use nalgebra::Vector3;
use platewash::certificate::Requirement;
use platewash::kinematics::Frame;
use platewash::motion::plan::Knots;
use platewash::motion::trajectory::{PlanSegment, SegmentKind};
use platewash::{JointVector, Plan, RobotModel, Tool, ToolFrame};

/// Motion between two neighbouring knots.
#[derive(Clone, Copy, PartialEq)]
pub struct Piece {
    /// Time of the first knot \[s\].
    pub start_s: f64,
    /// \[s\]
    pub length_s: f64,
    /// Positions at both ends \[rad\].
    pub q: [JointVector; 2],
    /// Speeds at both ends \[rad/s\].
    pub qd: [JointVector; 2],
}

/// The pieces between the knots, in time order.
pub fn pieces(knots: &Knots) -> Vec<Piece> {
    let piece = |k: usize| Piece {
        start_s: knots.t_s[k],
        length_s: knots.t_s[k + 1] - knots.t_s[k],
        q: [knots.q_rad[k], knots.q_rad[k + 1]],
        qd: [knots.qd_rad_s[k], knots.qd_rad_s[k + 1]],
    };
    (0..knots.t_s.len() - 1).map(piece).collect()
}

impl Piece {
    /// Positions at u in \[0, length\] \[s\].
    pub fn position(&self, u: f64) -> JointVector {
        let (s, h) = (u / self.length_s, self.length_s);
        let ([q0, q1], [v0, v1]) = (&self.q, &self.qd);
        let way = s * s * (3.0 - 2.0 * s);
        q0 + (q1 - q0) * way + v0 * (h * s * (1.0 - s) * (1.0 - s)) - v1 * (h * s * s * (1.0 - s))
    }

    /// Speeds \[rad/s\].
    pub fn speed(&self, u: f64) -> JointVector {
        let s = u / self.length_s;
        let ([q0, q1], [v0, v1]) = (&self.q, &self.qd);
        (q1 - q0) * (6.0 * s * (1.0 - s) / self.length_s)
            + v0 * ((1.0 - s) * (1.0 - 3.0 * s))
            + v1 * (s * (3.0 * s - 2.0))
    }

    /// Accelerations \[rad/s²\].
    pub fn acceleration(&self, u: f64) -> JointVector {
        let (s, h) = (u / self.length_s, self.length_s);
        let ([q0, q1], [v0, v1]) = (&self.q, &self.qd);
        ((q1 - q0) * ((6.0 - 12.0 * s) / h) + v0 * (6.0 * s - 4.0) + v1 * (6.0 * s - 2.0)) / h
    }

    /// Whether another piece is the same motion, whenever it happens.
    pub fn moves_like(&self, other: &Self) -> bool {
        (self.length_s - other.length_s).abs() < 1e-12 && self.q == other.q && self.qd == other.qd
    }
}

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
        let stage = is_sound.then(|| paths::segment_of(plan, piece));
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

/// What a value must exceed its limit by to count as broken, as a part of the limit, and \[rad\].
const EXACT: f64 = 2e-9;
const MARGIN_RAD: f64 = 1e-9;

/// What differences of the tip are right to, as a part of the limit.
const DIFFERENCE: f64 = 2e-9;

pub fn joints(plan: &Plan, robot: &RobotModel, pieces: &[Piece], moments: &[Moment], findings: &mut Findings) {
    let limits = robot.limits();
    let most = JointVector::from(plan.job.limits.joint_acceleration_rad_s2);
    for m in moments {
        let piece = &pieces[m.piece];
        let (q, qd, qdd) = (piece.position(m.u), piece.speed(m.u), piece.acceleration(m.u));
        let margin = (q - limits.lower).min().min((limits.upper - q).min());
        findings.at_least(Requirement::JointPosition, margin, 0.0, MARGIN_RAD);
        for (name, value, limit) in [
            (Requirement::JointSpeed, qd, &limits.velocity),
            (Requirement::JointAcceleration, qdd, &most),
        ] {
            let share = value.abs().component_div(limit).imax();
            findings.at_most(name, value[share].abs(), limit[share], EXACT * limit[share]);
        }
    }
}

/// While it washes against what washing must keep, otherwise against the limits of the tip anywhere.
pub fn tip(plan: &Plan, moments: &[Moment], findings: &mut Findings) {
    let (limits, wash) = (&plan.job.limits, &plan.job.requirements);
    for m in moments {
        let washes = m.segment(plan).is_some_and(|s| s.kind == SegmentKind::Wash);
        let [(speed, v), (acceleration, a)] = if washes {
            [
                (Requirement::WashSpeed, wash.wash_speed_m_s.min(limits.tip_speed_m_s)),
                (
                    Requirement::WashAcceleration,
                    wash.wash_acceleration_m_s2.min(limits.tip_acceleration_m_s2),
                ),
            ]
        } else {
            [
                (Requirement::TipSpeed, limits.tip_speed_m_s),
                (Requirement::TipAcceleration, limits.tip_acceleration_m_s2),
            ]
        };
        findings.at_most(speed, m.speed, v, DIFFERENCE * v);
        findings.at_most(acceleration, m.acceleration, a, DIFFERENCE * a);
    }
}
