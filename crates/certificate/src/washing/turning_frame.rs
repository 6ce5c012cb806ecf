//! Motion of the sponge in a frame that turns about the plate's axis with it.
//!
//! A plate is a body of revolution: in a frame that turns about its axis it is at rest, too. The sponge, which goes round with its lean,
//! hardly moves there, so that much more is known of it between two moments. The frame stands at an angle φ at every moment; over a stretch
//! between two of them it turns evenly, at Ω. With r the tip from a point of the axis, v and p̈ its speed and acceleration, a the tool's
//! axis, seen from there
//!
//! - the tip has the speed v − Ω × r, whose second derivative is p⃛ − Ω × p̈, and the acceleration p̈ − 2 Ω × v + Ω × (Ω × r), whose
//!   first is p⃛ − 2 Ω × p̈ + Ω × (Ω × v);
//! - a has the first derivative ȧ − Ω × a, of which the derivative is ä − Ω × ȧ, and the second ä − 2 Ω × ȧ + Ω × (Ω × a), of which it is
//!   a⃛ − 2 Ω × ä + Ω × (Ω × ȧ).
//!
//! Each is known at the moments of the wash, which are near each other, and bounded between by half of the time between two of them times
//! its derivative, or by h²/8 times its second.
//!
//! The columns of the sponge's face, a disc, need not turn with the tool: they stand along u, the direction across a next to d, which lies
//! across the plate's axis and is at rest in the frame: u = g/‖g‖, g = d − (d·a) a. With m the greatest |d·a|, a₁ and a₂ bounds of a's
//! derivatives and c² = 1 − m² ≤ ‖g‖²:
//!
//! - ‖ġ‖ ≤ a₁ √(1 + m²) = g₁ and ‖g̈‖ ≤ a₂ (1 + m) + 2 a₁² = g₂, as ȧ is across a;
//! - ‖u̇‖ ≤ g₁/c = u₁ and ‖ü‖ ≤ g₂/c + 3 g₁²/c² = u₂, and of a × u the second is at most a₂ + 2 a₁ u₁ + u₂ = b₂;
//! - so that the columns turn by no more than √(a₁² + u₁²), and any direction that turns with them has a second derivative of at most
//!   √(u₂² + b₂² + a₂²).

use crate::motion::tip;
use crate::washing::instants::Instants;
use nalgebra::{Vector3, Vector5};
use platewash_bodies::contact::{Drift, Moment};
use platewash_kinematics::trig::{atan2, sin_cos};
use platewash_workcell::plate::Plate;

/// Distance from the plate's axis below which the frame turns more slowly than the sponge goes round \[m\].
const LEAST_RADIUS_M: f64 = 0.02;

/// Frame that turns about a plate's axis through a wash.
#[derive(Debug)]
pub(crate) struct TurningFrame<'a> {
    instants: &'a Instants,
    /// Angle φ of the frame at every moment \[rad\].
    angles: Vec<f64>,
    states: Vec<State>,
}

/// State of the sponge at a moment, in the frame of the plate.
#[derive(Debug)]
struct State {
    tip: Vector3<f64>,
    speed: Vector3<f64>,
    acceleration: Vector3<f64>,
    axis: Vector3<f64>,
    /// Time derivatives ȧ and ä of the axis.
    first: Vector3<f64>,
    second: Vector3<f64>,
}

/// Upper bounds in the turning frame, at a moment or over a stretch: the tip's speed and acceleration, a₁, a₂ and m. The head of this file
/// defines the symbols.
type UpperBounds = Vector5<f64>;

impl<'a> TurningFrame<'a> {
    /// Returns the frame that follows the sponge.
    pub fn new(plate: &Plate, instants: &'a Instants) -> Self {
        let local = |v: &Vector3<f64>| plate.pose.inverse_transform_vector(v);
        let state = |(tip, moment): (&tip::Moment, &Moment)| {
            let (axis, w) = (moment.pose.axis, moment.turning);
            let first = w.cross(&axis);
            State {
                tip: moment.pose.tip,
                speed: moment.speed,
                acceleration: local(&tip.acceleration),
                axis,
                first,
                second: local(&tip.turning_more).cross(&axis) + w.cross(&first),
            }
        };
        let states: Vec<_> = instants.tips.iter().zip(&instants.moments).map(state).collect();
        // Across the way from the plate's axis to the tip, so that what leans towards the axis leans across it.
        let mut angle = states.first().map_or(0.0, |at| atan2(at.tip.x, -at.tip.y));
        let mut angles = vec![angle];
        for pair in states.windows(2) {
            let (from, to) = (pair[0].tip.xy(), pair[1].tip.xy());
            let round = atan2(from.perp(&to), from.dot(&to));
            let most = (to - from).norm() / LEAST_RADIUS_M;
            angle += round.max(-most).min(most);
            angles.push(angle);
        }
        Self {
            instants,
            angles,
            states,
        }
    }

    /// Returns u at a moment, in the plate's frame.
    pub fn side(&self, at: usize) -> Vector3<f64> {
        let (d, a) = (direction(self.angles[at]), self.states[at].axis);
        (d - a * d.dot(&a)).normalize()
    }

    /// Bounds the motion of the sponge from one moment to a later one, with the columns along u.
    pub fn drift(&self, from: usize, to: usize) -> Drift {
        let time = |at: usize| self.instants.moments[at].t_s;
        let length_s = time(to) - time(from);
        let rate = if length_s > 0.0 {
            (self.angles[to] - self.angles[from]) / length_s
        } else {
            0.0
        };
        let seen = |at: usize| {
            let angle = self.angles[from] + rate * (time(at) - time(from));
            self.states[at].in_turning_frame(rate, &direction(angle))
        };
        let mut greatest = UpperBounds::zeros();
        let mut before = seen(from);
        for k in from..to {
            let after = seen(k + 1);
            let between = self.between(k, rate.abs());
            greatest = greater(&greatest, &(greater(&before, &after) + between));
            before = after;
        }
        drift(&greatest, length_s)
    }

    /// Returns the amounts by which the values between a moment and the next may exceed those at both. `rate` is the magnitude of Ω \[rad/s\].
    fn between(&self, at: usize, rate: f64) -> UpperBounds {
        let (Some(drift), Some(jerk)) = (self.instants.drifts.get(at), self.instants.jerks.get(at)) else {
            return UpperBounds::repeat(f64::INFINITY);
        };
        let half_s = 0.5 * drift.length_s;
        let square = rate * rate;
        let first_of_axis = drift.bending + rate * drift.axis;
        UpperBounds::new(
            0.5 * half_s * half_s * (jerk.tip_m_s3 + rate * drift.tip_m_s2),
            half_s * (jerk.tip_m_s3 + 2.0 * rate * drift.tip_m_s2 + square * drift.tip_m_s),
            half_s * first_of_axis,
            half_s * (jerk.axis + 2.0 * rate * drift.bending + square * drift.axis),
            half_s * (drift.axis + rate),
        )
    }
}

impl State {
    /// Returns the values seen from a frame that turns at Ω, which is `rate` \[rad/s\], and in which the direction `d` is at rest.
    fn in_turning_frame(&self, rate: f64, d: &Vector3<f64>) -> UpperBounds {
        let omega = Vector3::z() * rate;
        let round = |v: &Vector3<f64>| omega.cross(v);
        UpperBounds::new(
            (self.speed - round(&self.tip)).norm(),
            (self.acceleration - round(&self.speed) * 2.0 + round(&round(&self.tip))).norm(),
            (self.first - round(&self.axis)).norm(),
            (self.second - round(&self.first) * 2.0 + round(&round(&self.axis))).norm(),
            d.dot(&self.axis).abs(),
        )
    }
}

/// Returns the greater of both, value by value. NaN is kept.
fn greater(a: &UpperBounds, b: &UpperBounds) -> UpperBounds {
    a.zip_map(b, |a, b| if a > b || a.is_nan() { a } else { b })
}

/// Bounds the motion of columns along u over a stretch of the length h: they turn by at most √(a₁² + u₁²), and bend by at most
/// √(u₂² + b₂² + a₂²). `bounds` has the tip's speed and acceleration, a₁, a₂ and m; `length_s` is h.
fn drift(bounds: &UpperBounds, length_s: f64) -> Drift {
    let [speed, acceleration, a1, a2, m]: [f64; 5] = (*bounds).into();
    let c = (1.0 - m * m).sqrt();
    let (g1, g2) = (a1 * (1.0 + m * m).sqrt(), a2 * (1.0 + m) + 2.0 * a1 * a1);
    let (u1, u2) = (g1 / c, g2 / c + 3.0 * g1 * g1 / (c * c));
    let b2 = a2 + 2.0 * a1 * u1 + u2;
    Drift {
        length_s,
        tip_m_s: speed,
        tip_m_s2: acceleration,
        turning: (a1 * a1 + u1 * u1).sqrt(),
        axis: a1,
        bending: (u2 * u2 + b2 * b2 + a2 * a2).sqrt(),
    }
}

/// Returns the direction across the plate's axis at an angle \[rad\].
fn direction(angle: f64) -> Vector3<f64> {
    let (s, c) = sin_cos(angle);
    Vector3::new(c, s, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::piece::Piece;
    use crate::motion::tip::Arm;
    use nalgebra::Rotation3;
    use platewash_bodies::contact::Foundation;
    use platewash_fixtures::{kitchen_plate, kitchen_tool};
    use platewash_kinematics::{JointVector, RobotModel};
    use platewash_workcell::cancel::CancelToken;
    use proptest::prelude::*;

    const FOUNDATION: Foundation = Foundation {
        radius_m: 0.025,
        free_height_m: 0.025,
        compression_m: 0.005,
        stiffness_pa: [2e4; 2],
    };

    /// Step of the finite differences in the test \[s\].
    const STEP_S: f64 = 1e-4;

    fn vector(size: f64) -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-size..size).prop_map(JointVector::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

        /// Checks by finite differences in the turning frame that no tip, axis or column moves, turns or bends more than the bounds say.
        #[test]
        fn no_point_moves_more_than_the_bound(
            q in vector(1.2), step in vector(0.05), v in [vector(0.4), vector(0.4)], aside in [-0.15..0.15f64, -0.15..0.15f64], share in 0.05..0.95f64,
        ) {
            let robot = RobotModel::irb120().unwrap();
            let (tool, cancel) = (kitchen_tool(), CancelToken::new());
            let arm = Arm::new(&robot, &tool, &cancel);
            let piece = Piece::new([0.0, 0.2], [q, q + step], v);
            let first = arm.at(&piece, 0.0).position;
            let plate = kitchen_plate([first.x + aside[0], first.y + aside[1]]);
            let instants = Instants::new(&arm, &arm.along(std::slice::from_ref(&piece)), &plate, (&FOUNDATION, 1e-3));
            let frame = TurningFrame::new(&plate, &instants);
            let last = instants.moments.len() - 1;
            let drift = frame.drift(0, last);
            let rate = (frame.angles[last] - frame.angles[0]) / 0.2;
            // The tip, the axis, and both directions along which columns stand.
            let seen = |t: f64| {
                let there = arm.at(&piece, t);
                let angle = frame.angles[0] + rate * t;
                let axis = plate.pose.inverse_transform_vector(&there.axis);
                let d = direction(angle);
                let u = (d - axis * d.dot(&axis)).normalize();
                let back = Rotation3::from_axis_angle(&Vector3::z_axis(), -angle);
                [plate.local(&there.position), axis, u, axis.cross(&u)].map(|v| back * v)
            };
            let t = 0.2 * share;
            let [before, here, after] = [t - STEP_S, t, t + STEP_S].map(seen);
            for k in 0..4 {
                let speed = (after[k] - before[k]).norm() / (2.0 * STEP_S);
                let bend = (after[k] - here[k] * 2.0 + before[k]).norm() / (STEP_S * STEP_S);
                let [most_speed, most_bend] = match k {
                    0 => [drift.tip_m_s, drift.tip_m_s2],
                    1 => [drift.axis, drift.bending],
                    _ => [drift.turning, drift.bending],
                };
                // A bound is NaN where nothing is known, for a tool that lies across.
                prop_assert!(most_speed.is_nan() || speed <= most_speed * (1.0 + 1e-6) + 1e-5, "{k}: {speed} {drift:?}");
                prop_assert!(most_bend.is_nan() || bend <= most_bend * (1.0 + 1e-3) + 1e-2, "{k}: {bend} {drift:?}");
            }
            for at in [0, last] {
                let there = &instants.moments[at];
                let side = frame.side(at);
                let turned = Rotation3::from_axis_angle(&Vector3::z_axis(), frame.angles[0] + rate * there.t_s) * seen(there.t_s)[2];
                prop_assert!((side - turned).norm() <= 1e-9, "{side} {turned}");
                prop_assert!(side.dot(&there.pose.axis).abs() <= 1e-9);
            }
        }
    }

    /// A tip that goes round the plate's axis evenly does not move at all.
    #[test]
    fn a_circling_motion_stands_still_in_the_turning_frame() {
        let robot = RobotModel::irb120().unwrap();
        let (tool, cancel) = (kitchen_tool(), CancelToken::new());
        let arm = Arm::new(&robot, &tool, &cancel);
        let mut step = JointVector::zeros();
        step[0] = 0.1;
        let q = JointVector::from([0.2, 0.3, 0.1, 0.0, 0.6, 0.0]);
        let piece = Piece::new([0.0, 0.1], [q, q + step], [step * 10.0; 2]);
        let plate = kitchen_plate([0.0, 0.0]);
        let instants = Instants::new(
            &arm,
            &arm.along(std::slice::from_ref(&piece)),
            &plate,
            (&FOUNDATION, 0.0),
        );
        let frame = TurningFrame::new(&plate, &instants);
        let drift = frame.drift(0, instants.moments.len() - 1);
        assert!(instants.drifts[0].tip_m_s > 0.2, "{:?}", instants.drifts[0]);
        assert!(drift.tip_m_s < 1e-4 && drift.axis < 0.02, "{drift:?}");
    }
}
