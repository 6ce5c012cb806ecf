//! The tip over a stretch of time: its state at both ends, and bounds of its derivatives between.
//!
//! Formulas (0.1) to (0.4) in `docs/certificate.md`.
//!
//! With p(q) the tip's position and J its Jacobian, v = J q̇ and
//! a = J q̈ + Σ_j q̇_j (2 ω_j − q̇_j z_j) × J_j, ω_j = Σ_{i ≤ j} q̇_i z_i; the tool turns with ω = ω_6, ω̇ = Σ_j q̈_j z_j + q̇_j ω_j × z_j.
//! For a vector f of time, ‖f(t)‖ ≤ max(‖f(a)‖, ‖f(b)‖) + h²/8 · sup ‖f″‖ on [a, b], h = b − a. The bounds of the derivatives of
//! p(q(t)) follow from the chain rule (Faà di Bruno) with the levers of [`platewash_bodies::clearance::lever`]; a cubic has no fourth
//! derivative.
//!
//! Many requirements look at the same moments: the ends of the pieces and the middles of their parts. Each is computed when it is first
//! needed and kept ([`TipPiece`]). It depends on arm and piece alone, so that it is the same whoever asks first.

use crate::motion::piece::Piece;
use nalgebra::Vector3;
use platewash_bodies::clearance::lever::{self, Levers};
use platewash_kinematics::{AXES, Axes, Frame, JointVector, RobotModel};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::tool::Tool;
use std::sync::OnceLock;

/// The arm with its tip.
#[derive(Debug)]
pub(crate) struct Arm<'a> {
    robot: &'a RobotModel,
    tip: Frame,
    /// Levers R that hold in every configuration, formula (0.2) \[m\].
    greatest: Levers,
    cancel: &'a CancelToken,
}

/// State of the tip at a moment, base frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moment {
    /// Position \[m\].
    pub position: Vector3<f64>,
    /// Direction of the tool's z axis, out of the tool.
    pub axis: Vector3<f64>,
    /// Direction of the tool's x axis, across `axis`; it turns with the tool.
    pub side: Vector3<f64>,
    /// Velocity \[m/s\].
    pub speed: Vector3<f64>,
    /// Acceleration \[m/s²\].
    pub acceleration: Vector3<f64>,
    /// Angular velocity ω of the tool \[rad/s\].
    pub turning: Vector3<f64>,
    /// Angular acceleration ω̇ \[rad/s²\].
    pub turning_more: Vector3<f64>,
    levers: Levers,
}

/// Greatest depth of halving of a piece down to which its parts are kept. It limits the memory.
const KEPT_DEPTH: u32 = 6;

/// Piece of a motion, or a part of one, with the tip's states that are known of it.
#[derive(Debug)]
pub(crate) struct TipPiece<'a> {
    piece: &'a Piece,
    ends: [Moment; 2],
    part: Part,
}

/// Part of a piece, with what is known of it.
#[derive(Debug)]
struct Part {
    /// Start and end within the piece \[s\].
    u: [f64; 2],
    depth: u32,
    derivatives: OnceLock<Derivatives>,
    middle: OnceLock<Box<Middle>>,
}

/// The middle of a part, and its halves.
#[derive(Debug)]
pub(crate) struct Middle {
    there: Moment,
    parts: [Part; 2],
}

/// Stretch of time within a piece, with the tip's states at its ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch<'a> {
    pub piece: &'a Piece,
    /// Start and end within the piece \[s\].
    pub u: [f64; 2],
    pub ends: [&'a Moment; 2],
    part: &'a Part,
}

/// The two halves of a stretch: of one that is kept, or of a shorter one.
#[derive(Debug)]
pub(crate) enum Halves<'a> {
    Kept(Stretch<'a>, &'a Middle),
    Passing(Stretch<'a>, Box<Middle>),
}

/// Bounds of derivatives of the tip over a stretch: formulas (0.3) and (0.4). `rates` are D₁, D₂ and D₃, `levers` is ρ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Derivatives {
    rates: [JointVector; 3],
    levers: Levers,
}

impl<'a> Arm<'a> {
    /// Returns an arm with a tool. Once `cancel` is set, it halves no more stretches.
    pub fn new(robot: &'a RobotModel, tool: &Tool, cancel: &'a CancelToken) -> Self {
        let tip = tool.tip_frame(robot);
        let zero = robot.fk(&JointVector::zeros());
        let greatest = lever::greatest(&zero, tip.body(), &zero.rigid(&tip).translation);
        Self {
            robot,
            tip,
            greatest,
            cancel,
        }
    }

    /// Computes the tip at time u \[s\] within a piece.
    pub fn at(&self, piece: &Piece, u: f64) -> Moment {
        let (qd, qdd) = (piece.speed(u), piece.acceleration(u));
        let poses = self.robot.fk(&piece.position(u));
        let tip = poses.rigid(&self.tip);
        let jacobian = poses.jacobian(&self.tip, Axes::Base);
        let (mut speed, mut acceleration, mut turning) = (Vector3::zeros(), Vector3::zeros(), Vector3::zeros());
        let mut turning_more = Vector3::zeros();
        let mut levers = Levers::zeros();
        for j in 0..AXES {
            let column: Vector3<f64> = jacobian.fixed_view::<3, 1>(0, j).into_owned();
            let axis: Vector3<f64> = jacobian.fixed_view::<3, 1>(3, j).into_owned();
            turning_more += axis * qdd[j] + turning.cross(&axis) * qd[j];
            turning += axis * qd[j];
            speed += column * qd[j];
            acceleration += column * qdd[j] + (turning * 2.0 - axis * qd[j]).cross(&column) * qd[j];
            levers[j] = column.norm();
        }
        Moment {
            position: tip.translation,
            axis: tip.rotation.column(2).into_owned(),
            side: tip.rotation.column(0).into_owned(),
            speed,
            acceleration,
            turning,
            turning_more,
            levers,
        }
    }

    /// Returns the pieces of a motion with the tip's states at their ends.
    pub fn along<'p>(&self, pieces: &'p [Piece]) -> Vec<TipPiece<'p>> {
        let whole = |piece: &'p Piece| self.part(piece, [0.0, piece.length_s]);
        pieces.iter().map(whole).collect()
    }

    /// Returns a part of a piece, from `u[0]` to `u[1]` within it \[s\].
    pub fn part<'p>(&self, piece: &'p Piece, u: [f64; 2]) -> TipPiece<'p> {
        TipPiece {
            piece,
            ends: u.map(|u| self.at(piece, u)),
            part: Part::new(u, 0),
        }
    }

    /// Returns the two halves of a stretch; `None` if it is too short to halve, or if the work was cancelled.
    pub fn halves<'p>(&self, whole: &Stretch<'p>) -> Option<Halves<'p>> {
        let [from, to] = whole.u;
        let middle = 0.5 * (from + to);
        if !(middle > from && middle < to) || self.cancel.is_cancelled() {
            return None;
        }
        let depth = whole.part.depth + 1;
        let compute = || {
            Box::new(Middle {
                there: self.at(whole.piece, middle),
                parts: [[from, middle], [middle, to]].map(|u| Part::new(u, depth)),
            })
        };
        Some(if depth <= KEPT_DEPTH {
            Halves::Kept(*whole, whole.part.middle.get_or_init(compute))
        } else {
            Halves::Passing(*whole, compute())
        })
    }

    /// Returns bounds of derivatives that hold all over a stretch: D₁, D₂ and D₃ of its piece, formulas (12.1) and (12.2), and the levers ρ,
    /// formula (0.2).
    pub fn derivatives<'p>(&self, stretch: &Stretch<'p>) -> &'p Derivatives {
        stretch.part.derivatives.get_or_init(|| {
            let speed = stretch.piece.greatest_speed(stretch.u);
            // The nearer end is half a stretch away.
            let drift = speed * (0.5 * stretch.length_s());
            let [from, to] = &stretch.ends;
            Derivatives {
                rates: [
                    speed,
                    stretch.piece.greatest_acceleration(stretch.u),
                    stretch.piece.jerk(),
                ],
                levers: lever::within(&from.levers.sup(&to.levers), &drift, &self.greatest),
            }
        })
    }
}

impl TipPiece<'_> {
    /// Returns the stretch over all of it.
    pub fn stretch(&self) -> Stretch<'_> {
        Stretch {
            piece: self.piece,
            u: self.part.u,
            ends: self.ends.each_ref(),
            part: &self.part,
        }
    }
}

impl Part {
    fn new(u: [f64; 2], depth: u32) -> Self {
        Self {
            u,
            depth,
            derivatives: OnceLock::new(),
            middle: OnceLock::new(),
        }
    }
}

impl Halves<'_> {
    /// Returns the first half and the second.
    pub fn both(&self) -> [Stretch<'_>; 2] {
        let (whole, middle): (_, &Middle) = match self {
            Self::Kept(whole, middle) => (whole, middle),
            Self::Passing(whole, middle) => (whole, middle),
        };
        let ([first, last], there) = (whole.ends, &middle.there);
        let half = |part: usize, ends| Stretch {
            piece: whole.piece,
            u: middle.parts[part].u,
            ends,
            part: &middle.parts[part],
        };
        [half(0, [first, there]), half(1, [there, last])]
    }
}

impl Stretch<'_> {
    pub fn length_s(&self) -> f64 {
        self.u[1] - self.u[0]
    }

    /// Times of both ends \[s\].
    pub fn times(&self) -> [f64; 2] {
        self.u.map(|u| self.piece.start_s + u)
    }

    /// Upper bound on the rise above the ends' values, h²/8 · sup ‖f″‖ of formula (0.1). `curvature` is sup ‖f″‖, and h is the length of the
    /// stretch.
    pub fn sag(&self, curvature: f64) -> f64 {
        self.length_s() * self.length_s() * 0.125 * curvature
    }
}

impl Derivatives {
    /// Upper bound on sup ‖p̈‖ \[m/s²\], formula (0.3).
    pub fn second(&self) -> f64 {
        let [d1, d2, _] = &self.rates;
        self.sum([d2]) + self.sum([d1, d1])
    }

    /// Upper bound on sup ‖p⃛‖ \[m/s³\], formula (0.3).
    pub fn third(&self) -> f64 {
        let [d1, d2, d3] = &self.rates;
        self.sum([d3]) + 3.0 * self.sum([d1, d2]) + self.sum([d1, d1, d1])
    }

    /// Upper bound on sup ‖p⁗‖ \[m/s⁴\], formula (0.3). It holds for cubics: q⁗ = 0.
    pub fn fourth(&self) -> f64 {
        let [d1, d2, d3] = &self.rates;
        4.0 * self.sum([d1, d3]) + 3.0 * self.sum([d2, d2]) + 6.0 * self.sum([d1, d1, d2]) + self.sum([d1, d1, d1, d1])
    }

    /// Upper bound on sup ‖ä‖ of the tool's axis a, a unit vector \[1/s²\], formula (0.4).
    pub fn second_of_axis(&self) -> f64 {
        let [d1, d2, _] = &self.rates;
        d2.sum() + d1.sum() * d1.sum()
    }

    /// Upper bound on sup ‖a⃛‖ of the tool's axis \[1/s³\], formula (0.4).
    pub fn third_of_axis(&self) -> f64 {
        let [d1, d2, d3] = self.rates.map(|d| d.sum());
        d3 + 3.0 * d1 * d2 + d1 * d1 * d1
    }

    /// Upper bound on sup ‖ω̇‖ of the tool's angular acceleration \[rad/s²\]: the sum of formula (0.4), as each joint's axis turns with the joints
    /// before it.
    pub fn first_of_turning(&self) -> f64 {
        self.second_of_axis()
    }

    /// Upper bound on sup ‖ω̈‖ \[rad/s³\]: the sum of formula (0.4).
    pub fn second_of_turning(&self) -> f64 {
        self.third_of_axis()
    }

    /// Upper bound on the rounding of the tip's acceleration \[m/s²\], Σ ρ δq̈ of formula (16.1). `joints` is δq̈, formula (12.2) \[rad/s²\].
    pub fn rounding(&self, joints: &JointVector) -> f64 {
        self.sum([joints])
    }

    /// Sum over all tuples of joints of ρ times the product of `rates`, as in formula (0.3).
    fn sum<const N: usize>(&self, rates: [&JointVector; N]) -> f64 {
        lever::tuples(&self.levers, 0, rates)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(size: f64) -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-size..size).prop_map(JointVector::from)
    }

    proptest! {
        #[test]
        fn the_derivatives_are_those_of_the_position_and_stay_within_their_bounds(
            q in vector(1.5), step in vector(0.2), v in [vector(2.0), vector(2.0)], share in 0.05..0.95f64,
        ) {
            let robot = RobotModel::irb120().unwrap();
            let (tool, cancel) = (platewash_fixtures::kitchen_tool(), CancelToken::new());
            let arm = Arm::new(&robot, &tool, &cancel);
            let piece = Piece::new([0.0, 0.2], [q, q + step], v);
            let (u, h) = (0.2 * share, 1e-5);
            let [before, here, after] = [u - h, u, u + h].map(|u| arm.at(&piece, u));
            prop_assert!(((after.position - before.position) / (2.0 * h) - here.speed).norm() < 1e-6);
            prop_assert!(((after.speed - before.speed) / (2.0 * h) - here.acceleration).norm() < 1e-5);
            let whole = arm.part(&piece, [0.0, piece.length_s]);
            let bounds = arm.derivatives(&whole.stretch());
            let third = (after.acceleration - before.acceleration) / (2.0 * h);
            let fourth = (after.acceleration - here.acceleration * 2.0 + before.acceleration) / (h * h);
            let axis = (after.axis - here.axis * 2.0 + before.axis) / (h * h);
            prop_assert!(here.acceleration.norm() <= bounds.second() + 1e-9);
            prop_assert!(third.norm() <= bounds.third() + 1e-3);
            prop_assert!(fourth.norm() <= bounds.fourth() + 1e-1);
            prop_assert!(axis.norm() <= bounds.second_of_axis() + 1e-4);
            // A direction turns with the tool: its first derivative is ω × itself.
            let turned = |m: &Moment| m.turning.cross(&m.axis);
            prop_assert!(((after.axis - before.axis) / (2.0 * h) - turned(&here)).norm() < 1e-6);
            let third = (turned(&after) - turned(&here) * 2.0 + turned(&before)) / (h * h);
            prop_assert!(third.norm() <= bounds.third_of_axis() + 1e-2);
            let first = (after.turning - before.turning) / (2.0 * h);
            let second = (after.turning - here.turning * 2.0 + before.turning) / (h * h);
            prop_assert!(first.norm() <= bounds.first_of_turning() + 1e-6);
            prop_assert!((first - here.turning_more).norm() < 1e-5);
            prop_assert!(second.norm() <= bounds.second_of_turning() + 1e-2);
            prop_assert!(here.side.dot(&here.axis).abs() < 1e-12);
        }
    }
}
