//! One plate: its wash path, the arm on it, and the lines over both ends of the path.

use crate::error::PlanError;
use crate::joint_path::{Ends, JointPath};
use crate::pattern::{Pattern, Shortfall, foundation};
use crate::pipeline::shared::Pipeline;
use crate::placed_arm::PlacedArm;
use crate::redundancy::Washing;
use crate::timing::{self, TimedPath};
use crate::transit::LiftLine;
use nalgebra::Vector3;
use platewash_bodies::contact::{Columns, SpongePose};
use platewash_kinematics::Pose;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::trig::{atan2, sin};
use platewash_workcell::wash_path::{WashCurve, WashPath};
use std::f64::consts::TAU;

/// Distance of the samples on a line \[m\].
const LINE_STEP_M: f64 = 2e-3;

/// Number of bisections of the height at which a sponge meets a plate.
const HALVINGS: u32 = 16;

/// Reserve added to that height \[m\].
const MEETS_M: f64 = 1e-4;

/// Share of the limit of the contact speed, in landing and in lifting, that the free sponge takes at most.
const LANDING: f64 = 0.97;

/// Share of the wash speed's limit at which the sponge touches at most: the rest is for the motion of its rim relative to the
/// tip.
const TOUCHING: f64 = 0.99;

/// Washing of one plate.
#[derive(Debug)]
pub(crate) struct Turn {
    /// Wash path of the plate.
    pub path: WashPath,
    /// The configurations along it.
    pub washing: Washing,
    /// Pattern of the path.
    pub pattern: Pattern,
    /// Shortfall against the promise about contact, as far as its configurations show.
    pub shortfall: Option<Shortfall>,
    /// The wash in time, from rest to rest, once it was timed.
    pub wash: Option<TimedPath>,
}

impl Turn {
    /// Times the wash along its configurations.
    pub fn timed(&self, pipeline: &Pipeline<'_>, placed: &PlacedArm<'_>) -> Result<TimedPath, PlanError> {
        let mut limits = pipeline.washing_of(self.path.plate);
        if let Some(tip) = &mut limits.tip {
            tip.speed_m_s *= self.pattern.speed_share;
        }
        let Washing {
            theta, q, end_slopes, ..
        } = &self.washing;
        let joints = JointPath::through(theta.clone(), q.clone(), Ends::Clamped(*end_slopes))?;
        placed.check_cancelled()?;
        Ok(timing::time_optimal(&joints, placed.robot, &placed.tip, &limits)?)
    }
}

/// A plate with all that is done on it.
#[derive(Debug)]
pub(crate) struct Visit {
    pub path: WashPath,
    pub washing: Washing,
    /// The wash in time, from rest to rest.
    pub wash: TimedPath,
    /// The lines down to the path's start, seen from the plate, and up from its end.
    pub lines: [LiftLine; 2],
}

/// Turns a curve so that it ends in a direction of its plate's frame; it leaves the centre at an angle within a turn of 0, for
/// any number of turns.
pub(crate) fn turned(curve: WashCurve, towards: &Vector3<f64>) -> WashCurve {
    let start_angle_rad = (atan2(towards.y, towards.x) - curve.end() % TAU) % TAU;
    WashCurve {
        start_angle_rad,
        ..curve
    }
}

/// A curve that ends where another one does.
pub(crate) fn turned_as(curve: WashCurve, other: &WashCurve) -> WashCurve {
    let end = (other.start_angle_rad + other.end()) % TAU;
    WashCurve {
        start_angle_rad: if curve.end() == other.end() {
            other.start_angle_rad
        } else {
            (end - curve.end() % TAU) % TAU
        },
        ..curve
    }
}

/// The lines over the beginning and the end of a wash path.
pub(crate) fn lines(
    pipeline: &Pipeline<'_>,
    placed: &PlacedArm<'_>,
    path: &WashPath,
    washing: &Washing,
) -> Result<[LiftLine; 2], PlanError> {
    let last = washing.q.len() - 1;
    let placed = &placed.clone().leaning_aside(washing.aside_rad);
    let (wanted, wash_m_s) = (&pipeline.terms.requirements, pipeline.terms.wash_speed_m_s());
    let (plate, lift_m, sponge) = (path.plate, path.lift_m, &pipeline.terms.workcell.tool.sponge);
    // With the tool turned as it is at the end, and no faster than asked from where the free sponge may meet the plate. Where nothing is
    // asked: from where the tilted rim touches while it washes, and a sample more.
    let line = |end: usize, k: usize, asked_m_s: Option<f64>| {
        let (foot, tilt_rad, q) = (&washing.feet[end], washing.tilt_rad[k], &washing.q[k]);
        let over = |h: &f64| placed.tip_pose(&foot.raised(*h), tilt_rad);
        let (touches_m, speed_m_s) = match asked_m_s {
            None => {
                let rim_m = sponge.radius_m * sin(placed.stance.lean_rad(tilt_rad));
                (rim_m + LINE_STEP_M, TOUCHING * wash_m_s)
            }
            Some(asked) => {
                let touches_m = pipeline.first_contact_height_m(plate, lift_m, over);
                (touches_m, LANDING * asked.min(wash_m_s))
            }
        };
        let mut heights = evenly(0.0, lift_m, 4.0);
        // A sample where it meets the plate: from there on it may be faster.
        if asked_m_s.is_some() && touches_m < lift_m - LINE_STEP_M {
            heights = evenly(0.0, touches_m, 2.0);
            heights.pop();
            heights.extend(evenly(touches_m, lift_m, 2.0));
        }
        let poses: Vec<_> = heights.iter().map(over).collect();
        let found = placed.solver.solve_path(&poses, q);
        let not_found = |error| PlanError::Line {
            plate,
            lift_m,
            error: Box::new(error),
        };
        let mut configurations = found.map_err(not_found)?.q;
        // To the bit where the wash begins or ends.
        configurations[0] = *q;
        let line = LiftLine::line(plate, heights, configurations)?;
        Ok::<_, PlanError>(line.no_faster(touches_m, speed_m_s))
    };
    Ok([line(0, 0, wanted.landing_m_s)?, line(1, last, wanted.lifting_m_s)?])
}

/// Heights from one to another, evenly, no farther apart than [`LINE_STEP_M`] and in that many steps or more.
fn evenly(from_m: f64, to_m: f64, least_steps: f64) -> Vec<f64> {
    let steps = ((to_m - from_m) / LINE_STEP_M).ceil().max(least_steps);
    let at = |k: usize| from_m + (to_m - from_m) * (k as f64 / steps);
    (0..=steps as usize).map(at).collect()
}

impl Pipeline<'_> {
    /// The height of the tip over a plate from which on down the free sponge may meet it, however much higher it lies, up to `lift_m`,
    /// with the tip's pose by its height \[m\].
    fn first_contact_height_m(&self, plate: usize, lift_m: f64, over: impl Fn(&f64) -> Pose) -> f64 {
        let sponge = &self.terms.workcell.tool.sponge;
        let (columns, plate) = (Columns::new(&foundation(sponge)), &self.plates[plate]);
        let higher_m = self.terms.height_error_of(plate);
        let deepest_m = |height: f64| {
            let pose = SpongePose::on(plate, &RigidTransform::from(&over(&height)));
            columns.load(&plate.surface, &pose, higher_m).deepest_m
        };
        // Raised, the sponge is pressed less.
        let (mut low, mut high) = (0.0, lift_m);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if deepest_m(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        (high + MEETS_M).min(lift_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::wash_path::WashPattern;
    use proptest::prelude::*;

    proptest! {
        /// Whole turns among them, whose remainder rounds to nothing or to nearly a turn.
        #[test]
        fn a_path_of_any_turns_begins_within_a_turn_of_0_and_ends_towards_the_next_place(
            turns in prop_oneof![0.25..200.0f64, (1..200u32).prop_map(f64::from), (5..4000u32).prop_map(|n| 0.05 * f64::from(n))],
            half_turns in -1.0..1.0f64,
            closing_ring in any::<bool>(),
        ) {
            let curve = WashCurve { radius_m: 0.12385, turns, start_angle_rad: 0.0, closing_ring, trim_rad: 0.0, pattern: WashPattern::Spiral };
            let (s, c) = platewash_kinematics::trig::sin_cos(0.5 * TAU * half_turns);
            let towards = Vector3::new(c, s, 0.0);
            let curve = turned(curve, &towards);
            prop_assert!(curve.start_angle_rad.abs() < TAU, "{}", curve.start_angle_rad);
            let end = curve.at(curve.end()).position.normalize();
            prop_assert!((end - towards.xy()).norm() < 1e-9, "{end} {towards}");
        }
    }
}
