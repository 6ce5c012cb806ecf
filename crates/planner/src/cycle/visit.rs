//! One plate: its stroke, the posture of the arm on it, and the lines over both ends of the stroke.

use super::CycleError;
use super::arm::Arm;
use crate::crossing::Terminal;
use crate::joint_path::{Ends, JointPath};
use crate::posture::Washing;
use crate::scenario::Scenario;
use crate::timing::{self, MotionLimits, Timed};
use crate::tool_path::{Segment, SegmentKind, Shape};
use crate::trig::{atan2, sin};
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::layout::Plate;
use platewash_workcell::stroke::Stroke;
use std::f64::consts::TAU;

/// Distance of the samples on a line \[m\].
const LINE_STEP_M: f64 = 2e-3;

/// The share of the speed limit of washing at which the sponge touches at most: the rest is for what its rim adds to the tip.
const TOUCHING: f64 = 0.99;

/// A plate with all that is done on it.
pub(super) struct Visit {
    pub plate: usize,
    /// Centre of the stroke, at the height of the tip \[m\].
    pub centre: Vector3<f64>,
    pub stroke: Stroke,
    pub washing: Washing,
    /// The wash in time, from rest to rest.
    pub wash: Timed,
    /// The line down to the stroke's start, seen from the plate.
    pub entry: Terminal,
    /// The line up from the stroke's end.
    pub exit: Terminal,
}

/// Where the tip washes a plate about \[m\].
pub(super) fn centre(plate: &Plate, scenario: &Scenario) -> Vector3<f64> {
    Vector3::new(plate.x_m, plate.y_m, plate.z_m + scenario.wash.height_m)
}

/// The stroke on a plate that ends in the direction of `towards` \[m\]; it leaves the centre at an angle within a turn of 0,
/// whatever its turns.
pub(super) fn stroke(scenario: &Scenario, centre: &Vector3<f64>, towards: &Vector3<f64>) -> Stroke {
    let wash = &scenario.wash;
    let way = towards - centre;
    let mut stroke = Stroke {
        radius_m: wash.path_radius_m,
        turns: wash.turns,
        start_angle_rad: 0.0,
        closing_ring: wash.closing_ring,
    };
    stroke.start_angle_rad = (atan2(way.y, way.x) - stroke.end() % TAU) % TAU;
    stroke
}

/// Plans a visit with the posture found for it.
pub(super) fn plan(
    scenario: &Scenario,
    arm: &Arm<'_>,
    plate: usize,
    (centre, stroke): (Vector3<f64>, Stroke),
    washing: Washing,
    limits: &MotionLimits,
) -> Result<Visit, CycleError> {
    let path = JointPath::through(
        washing.theta.clone(),
        washing.q.clone(),
        Ends::Clamped(washing.end_slopes),
    )?;
    let wash = timing::time_optimal(&path, arm.cell.robot, &arm.cell.tip, limits)?;
    let [entry, exit] = lines(scenario, arm, plate, (centre, &stroke), &washing)?;
    Ok(Visit {
        plate,
        centre,
        stroke,
        washing,
        wash,
        entry,
        exit,
    })
}

/// The lines over the beginning and the end of a stroke.
pub(super) fn lines(
    scenario: &Scenario,
    arm: &Arm<'_>,
    plate: usize,
    (centre, stroke): (Vector3<f64>, &Stroke),
    washing: &Washing,
) -> Result<[Terminal; 2], CycleError> {
    let last = washing.q.len() - 1;
    let end = stroke.at(stroke.end()).position;
    let foot = centre + Vector3::new(end.x, end.y, 0.0);
    Ok([
        line(scenario, arm, plate, centre, (washing.tilt_rad[0], &washing.q[0]))?,
        line(scenario, arm, plate, foot, (washing.tilt_rad[last], &washing.q[last]))?,
    ])
}

/// The line over a contact point, with the tool turned as it is there.
fn line(
    scenario: &Scenario,
    arm: &Arm<'_>,
    plate: usize,
    foot: Vector3<f64>,
    (tilt_rad, q): (f64, &JointVector),
) -> Result<Terminal, CycleError> {
    let lift_m = scenario.wash.lift_m;
    let steps = (lift_m / LINE_STEP_M).ceil().max(4.0);
    let heights: Vec<f64> = (0..=steps as usize).map(|k| lift_m * (k as f64 / steps)).collect();
    let over = |h: &f64| arm.cell.tip_pose(foot + Vector3::z() * *h, tilt_rad);
    let poses: Vec<_> = heights.iter().map(over).collect();
    let path = arm.solver.solve_path(&poses, q);
    let line = |error| CycleError::Line {
        plate,
        lift_m,
        error: Box::new(error),
    };
    let mut configurations = path.map_err(line)?.q;
    // To the bit where the wash begins or ends.
    configurations[0] = *q;
    // The tilted rim touches up to there, and a sample more; what touches is no faster than while it washes.
    let touches_m = scenario.tool.sponge_radius_m * sin(tilt_rad).abs() + LINE_STEP_M;
    let slow_m_s = TOUCHING * scenario.wash.speed_m_s.min(scenario.limits.tip_speed_m_s);
    Ok(Terminal::line(plate, heights, configurations)?.no_faster(touches_m, slow_m_s))
}

impl Visit {
    /// Approach, wash and retreat as the plan declares them.
    pub fn segments(&self) -> [Segment; 3] {
        let end = self.stroke.at(self.stroke.end()).position;
        let line = |kind, foot: Vector3<f64>, terminal: &Terminal| {
            self.segment(
                kind,
                Shape::Line {
                    foot_m: foot.into(),
                    normal: [0.0, 0.0, 1.0],
                    height_m: terminal.height_m(),
                },
            )
        };
        let stroke = Shape::Stroke {
            centre_m: self.centre.into(),
            normal: [0.0, 0.0, 1.0],
            stroke: self.stroke,
        };
        [
            line(SegmentKind::Approach, self.centre, &self.entry),
            self.segment(SegmentKind::Wash, stroke),
            line(
                SegmentKind::Retreat,
                self.centre + Vector3::new(end.x, end.y, 0.0),
                &self.exit,
            ),
        ]
    }

    fn segment(&self, kind: SegmentKind, shape: Shape) -> Segment {
        Segment {
            kind,
            plate: self.plate,
            shape,
            waypoints: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whole turns among them, whose remainder rounds to nothing or to nearly a turn.
        #[test]
        fn a_stroke_of_any_turns_begins_within_a_turn_of_0_and_ends_towards_the_next_place(
            turns in prop_oneof![0.25..200.0f64, (1..200u32).prop_map(f64::from), (5..4000u32).prop_map(|n| 0.05 * f64::from(n))],
            half_turns in -1.0..1.0f64,
            closing_ring in any::<bool>(),
        ) {
            let mut scenario = Scenario::load("kitchen").unwrap();
            (scenario.wash.turns, scenario.wash.closing_ring) = (turns, closing_ring);
            let centre = Vector3::new(0.3, 0.1, 0.03);
            let (s, c) = crate::trig::sin_cos(0.5 * TAU * half_turns);
            let towards = Vector3::new(c, s, 0.0);
            let stroke = stroke(&scenario, &centre, &(centre + towards));
            prop_assert!(stroke.start_angle_rad.abs() < TAU, "{}", stroke.start_angle_rad);
            let end = stroke.at(stroke.end()).position.normalize();
            prop_assert!((end - towards.xy()).norm() < 1e-9, "{end} {towards}");
        }
    }
}
