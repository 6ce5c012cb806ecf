//! The motion that an arm is assumed to make along a program: through its points, with rounded corners.

use platewash_export::judgement::{CORNER_SCALES, ProgramMotion, motions};
use platewash_export::program::Place;
use platewash_export::reading::{ReadPoint, Reading, SegmentShape};
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use proptest::prelude::*;

fn reading(steps: &[(f64, [f64; 6], Option<f64>)], interpolation: SegmentShape) -> Reading {
    let mut t_s = 0.0;
    let mut points = vec![(0.0, [0.1; 6], None)];
    for &(step_s, q, corner_m) in steps {
        t_s += step_s;
        points.push((t_s, q, corner_m));
    }
    let place = Place {
        file: "made.up".to_owned(),
        line: 1,
    };
    let point = |(t_s, q, corner_m): (f64, [f64; 6], Option<f64>)| ReadPoint {
        place: place.clone(),
        t_s,
        q_rad: JointVector::from(q),
        qd_rad_s: None,
        corner_m,
    };
    Reading {
        speed_share: None,
        points: points.into_iter().map(point).collect(),
        interpolation,
        tool: None,
        start_within_deg: None,
        most_share: None,
        settings: Vec::new(),
    }
}

fn steps() -> impl Strategy<Value = Vec<(f64, [f64; 6], Option<f64>)>> {
    let corner = prop::option::weighted(0.9, 0.0..0.02_f64);
    prop::collection::vec((0.01..0.1_f64, prop::array::uniform6(0.0..0.2_f64), corner), 2..12)
}

fn interpreted(reading: &Reading) -> (Vec<ProgramMotion>, RobotModel, Frame) {
    let arm = RobotModel::irb120().unwrap();
    let tip = kitchen_tool().tip_frame(&arm);
    (motions(reading, &arm, &tip).unwrap(), arm, tip)
}

proptest! {
    /// Through every stop, near every other point, in speed without a step but at stops, and as long as the program.
    #[test]
    fn corners_are_smooth_and_small(steps in steps()) {
        let reading = reading(&steps, SegmentShape::RoundedLines);
        let (motions, arm, tip) = interpreted(&reading);
        prop_assert_eq!(motions.len(), CORNER_SCALES.len());
        let place = |q: &JointVector| arm.fk(q).rigid(&tip).translation;
        for ProgramMotion { corner_scale, motion } in &motions {
            let scale = corner_scale.unwrap();
            let last = reading.points.last().unwrap();
            prop_assert!((motion.duration_s() - last.t_s).abs() < 1e-12);
            for (k, point) in reading.points.iter().enumerate() {
                let [q, _] = motion.at(point.t_s.min(motion.duration_s())).unwrap();
                let ends = k == 0 || k + 1 == reading.points.len();
                match point.corner_m {
                    Some(radius_m) if !ends => {
                        // The parabola's middle is nearer to the point than where it begins, which is within the radius: a chord of the
                        // joints' motion may be a little longer than that of the tip.
                        let off_m = (place(&q) - place(&point.q_rad)).norm();
                        prop_assert!(off_m <= 1.1 * scale * radius_m + 1e-12, "{off_m} {radius_m}");
                    }
                    _ => prop_assert!((q - point.q_rad).amax() < 1e-12),
                }
            }
            for both in motion.pieces().windows(2) {
                prop_assert!((both[0].q_rad[1] - both[1].q_rad[0]).amax() < 1e-12);
                let step = (both[0].qd_rad_s[1] - both[1].qd_rad_s[0]).amax();
                let at = reading.points.iter().find(|point| (point.t_s - both[0].t_s[1]).abs() < 1e-9);
                let sharp = at.is_some_and(|point| point.corner_m.unwrap_or(0.0) * scale < 1e-6);
                prop_assert!(sharp || step < 1e-6, "{step} at {}", both[0].t_s[1]);
            }
        }
    }

    /// A corner is the parabola of even acceleration, worked out here from its three points.
    #[test]
    fn a_corner_is_a_parabola(steps in steps(), share in 0.0..1.0_f64) {
        let reading = reading(&steps, SegmentShape::RoundedLines);
        let (motions, ..) = interpreted(&reading);
        for piece in motions[2].motion.pieces() {
            let [from, to] = piece.accelerations();
            prop_assert!((from - to).amax() < 1e-6 * (1.0 + from.amax()), "even");
            if from.amax() < 1e-6 {
                continue;
            }
            // A Bezier curve of three points: its middle one is where both tangents meet.
            let h = piece.length_s();
            let middle = piece.q_rad[0] + piece.qd_rad_s[0] * (0.5 * h);
            let [a, b] = [1.0 - share, share];
            let bezier = piece.q_rad[0] * (a * a) + middle * (2.0 * a * b) + piece.q_rad[1] * (b * b);
            prop_assert!((piece.at(piece.t_s[0] + share * h)[0] - bezier).amax() < 1e-9);
        }
    }

    #[test]
    fn a_motion_without_corners_is_a_polyline(steps in steps(), share in 0.0..1.0_f64) {
        let reading = reading(&steps, SegmentShape::RoundedLines);
        let (motions, ..) = interpreted(&reading);
        for both in reading.points.windows(2) {
            let t_s = both[0].t_s + share * (both[1].t_s - both[0].t_s);
            let [q, _] = motions[0].motion.at(t_s).unwrap();
            let line = both[0].q_rad + (both[1].q_rad - both[0].q_rad) * share;
            prop_assert!((q - line).amax() < 1e-9);
        }
    }
}

/// A share of the speed stretches time; the judged motion is in the time of the plan.
#[test]
fn program_motions_are_in_the_time_of_the_plan() {
    let steps = [(0.2, [0.2; 6], Some(0.005)), (0.2, [0.15; 6], None)];
    let whole = reading(&steps, SegmentShape::RoundedLines);
    let mut slow = whole.clone();
    slow.speed_share = Some(0.25);
    slow.points.iter_mut().for_each(|point| point.t_s *= 4.0);
    let [a, b] = [&whole, &slow].map(|reading| interpreted(reading).0);
    for (a, b) in a.iter().zip(&b) {
        let [q, qd] = [0, 1].map(|i| a.motion.at(0.17).unwrap()[i] - b.motion.at(0.17).unwrap()[i]);
        assert!(q.amax() < 1e-12 && qd.amax() < 1e-9);
    }
}

#[test]
fn rejects_points_that_form_no_motion() {
    let arm = RobotModel::irb120().unwrap();
    let tip = kitchen_tool().tip_frame(&arm);
    for between in [SegmentShape::Lines, SegmentShape::RoundedLines, SegmentShape::Cubics] {
        for t_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut reading = reading(&[(0.1, [0.2; 6], Some(0.005)), (0.1, [0.3; 6], None)], between);
            reading.points[2].t_s = t_s;
            assert!(motions(&reading, &arm, &tip).is_err(), "{between:?} {t_s}");
        }
    }
}
