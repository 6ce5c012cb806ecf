//! One plate: its wash path, the arm on it, and the lines over both ends of the path.

use super::shared::Pipeline;
use crate::error::PlanError;
use crate::joint_path::{Ends, JointPath};
use crate::redundancy::Washing;
use crate::scene::{Contact, Scene};
use crate::timing::{self, Timed};
use crate::transit::LiftLine;
use crate::trig::{atan2, sin};
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::wash_path::{WashCurve, WashPath};
use std::f64::consts::TAU;

/// Distance of the samples on a line \[m\].
const LINE_STEP_M: f64 = 2e-3;

/// The share of the speed limit of washing at which the sponge touches at most: the rest is for what its rim adds to the tip.
const TOUCHING: f64 = 0.99;

/// A plate with all that is done on it.
#[derive(Debug)]
pub(super) struct Visit {
    pub path: WashPath,
    pub washing: Washing,
    /// The wash in time, from rest to rest.
    pub wash: Timed,
    /// The lines down to the path's start, seen from the plate, and up from its end.
    pub lines: [LiftLine; 2],
}

/// The wash path on a plate that ends in the direction of `towards` \[m\].
pub(super) fn wash_path(pipeline: &Pipeline<'_>, plate: usize, towards: &Vector3<f64>) -> WashPath {
    let settings = pipeline.settings;
    let curve = WashCurve {
        radius_m: settings.path_radius_m,
        turns: settings.turns,
        start_angle_rad: 0.0,
        closing_ring: settings.closing_ring,
    };
    WashPath {
        plate,
        curve: turned(curve, &pipeline.plates[plate].local(towards)),
        lift_m: settings.lift_m,
        cone_rad: pipeline.terms.tilt_max_rad(),
    }
}

/// The curve that ends in a direction of its plate's frame; it leaves the centre at an angle within a turn of 0, whatever its turns.
fn turned(curve: WashCurve, towards: &Vector3<f64>) -> WashCurve {
    let start_angle_rad = (atan2(towards.y, towards.x) - curve.end() % TAU) % TAU;
    WashCurve {
        start_angle_rad,
        ..curve
    }
}

impl Visit {
    /// Plans a visit with the configurations found for it.
    pub fn plan(
        pipeline: &Pipeline<'_>,
        scene: &Scene<'_>,
        path: WashPath,
        washing: Washing,
    ) -> Result<Self, PlanError> {
        let ends = Ends::Clamped(washing.end_slopes);
        let joints = JointPath::through(washing.theta.clone(), washing.q.clone(), ends)?;
        scene.check_cancelled()?;
        let wash = timing::time_optimal(&joints, scene.robot, &scene.tip, &pipeline.washing)?;
        let lines = lines(pipeline, scene, &path, &washing)?;
        Ok(Self {
            path,
            washing,
            wash,
            lines,
        })
    }
}

/// The lines over the beginning and the end of a wash path.
pub(super) fn lines(
    pipeline: &Pipeline<'_>,
    scene: &Scene<'_>,
    path: &WashPath,
    washing: &Washing,
) -> Result<[LiftLine; 2], PlanError> {
    let last = washing.q.len() - 1;
    let [start, end] = path.feet(&pipeline.plates[path.plate]);
    let line = |foot, k: usize| line(pipeline, scene, path, foot, (washing.tilt_rad[k], &washing.q[k]));
    Ok([line(start, 0)?, line(end, last)?])
}

/// The line over a contact point, with the tool turned as it is there.
fn line(
    pipeline: &Pipeline<'_>,
    scene: &Scene<'_>,
    path: &WashPath,
    foot: Vector3<f64>,
    (tilt_rad, q): (f64, &JointVector),
) -> Result<LiftLine, PlanError> {
    let (plate, lift_m, terms) = (path.plate, path.lift_m, pipeline.terms);
    let foot = Contact {
        point: foot,
        normal: pipeline.plates[plate].normal_at(&foot),
    };
    let steps = (lift_m / LINE_STEP_M).ceil().max(4.0);
    let heights: Vec<f64> = (0..=steps as usize).map(|k| lift_m * (k as f64 / steps)).collect();
    let over = |h: &f64| scene.tip_pose(&foot.raised(*h), tilt_rad);
    let poses: Vec<_> = heights.iter().map(over).collect();
    let found = scene.solver.solve_path(&poses, q);
    let not_found = |error| PlanError::Line {
        plate,
        lift_m,
        error: Box::new(error),
    };
    let mut configurations = found.map_err(not_found)?.q;
    // To the bit where the wash begins or ends.
    configurations[0] = *q;
    // The tilted rim touches up to there, and a sample more; what touches is no faster than while it washes.
    let touches_m = terms.workcell.tool.sponge.radius_m * sin(tilt_rad).abs() + LINE_STEP_M;
    let slow_m_s = TOUCHING * terms.wash_speed_m_s();
    Ok(LiftLine::line(plate, heights, configurations)?.no_faster(touches_m, slow_m_s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whole turns among them, whose remainder rounds to nothing or to nearly a turn.
        #[test]
        fn a_path_of_any_turns_begins_within_a_turn_of_0_and_ends_towards_the_next_place(
            turns in prop_oneof![0.25..200.0f64, (1..200u32).prop_map(f64::from), (5..4000u32).prop_map(|n| 0.05 * f64::from(n))],
            half_turns in -1.0..1.0f64,
            closing_ring in any::<bool>(),
        ) {
            let curve = WashCurve { radius_m: 0.12385, turns, start_angle_rad: 0.0, closing_ring };
            let (s, c) = crate::trig::sin_cos(0.5 * TAU * half_turns);
            let towards = Vector3::new(c, s, 0.0);
            let curve = turned(curve, &towards);
            prop_assert!(curve.start_angle_rad.abs() < TAU, "{}", curve.start_angle_rad);
            let end = curve.at(curve.end()).position.normalize();
            prop_assert!((end - towards.xy()).norm() < 1e-9, "{end} {towards}");
        }
    }
}
