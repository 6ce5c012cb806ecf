//! How an arm is assumed to move along a program that was read: straight in the joints with rounded corners, or on cubics.
//!
//! At a corner between segments of the speeds v₀ and v₁ the joints are assumed to accelerate evenly, for as long before the point as after
//! it: a parabola that leaves the straight segments where the corner begins and meets them again where it ends. A corner begins no farther
//! from the point than its radius, nor than half-way to either neighbour, measured at the tip. How large a controller really makes it is not
//! known: programs are judged with no corners, and with corners of half, once and twice their size.

use crate::reading::{Between, ReadPoint, Reading};
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_workcell::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_workcell::trajectory::KnotError;

/// Sizes of corners, relative to what a program says, with which its motion is judged.
pub const CORNER_SCALES: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// What is shorter is no line between two corners \[s\].
const NOTHING_S: f64 = 1e-9;

/// The motion of a program under one assumption.
#[derive(Debug, Clone, PartialEq)]
pub struct Interpreted {
    /// Size of its corners relative to what the program says; `None` where it has none.
    pub corner_scale: Option<f64>,
    /// The motion in the plan's time.
    pub motion: PiecewiseMotion,
}

/// The motions that a program is assumed to lead to, in the plan's time.
///
/// # Errors
/// [`KnotError`] for points that are no motion: times that do not ascend, numbers that are not finite.
pub fn motions(reading: &Reading, arm: &RobotModel, tip: &Frame) -> Result<Vec<Interpreted>, KnotError> {
    let one = |corner_scale, pieces| {
        let motion = PiecewiseMotion::new(pieces)?;
        Ok(Interpreted { corner_scale, motion })
    };
    let points = InPlanTime::of(reading);
    points.check()?;
    match reading.between {
        Between::Lines => Ok(vec![one(None, lines(&points))?]),
        Between::Cubics => Ok(vec![one(None, cubics(&points))?]),
        Between::RoundedLines => {
            let reach_m = reach_m(&points, arm, tip);
            let rounded = |scale| one(Some(scale), rounded(&points, &reach_m, scale));
            CORNER_SCALES.into_iter().map(rounded).collect()
        }
    }
}

/// The points of a program in the plan's time.
pub(crate) struct InPlanTime {
    /// \[s\]
    pub t_s: Vec<f64>,
    /// \[rad\]
    pub q_rad: Vec<JointVector>,
    /// \[rad/s\]
    pub qd_rad_s: Vec<JointVector>,
    /// Radius of the corner \[m\]; 0 where the arm stops.
    pub corner_m: Vec<f64>,
}

impl InPlanTime {
    fn of(reading: &Reading) -> Self {
        let share = reading.share();
        let of = |point: &ReadPoint| point.qd_rad_s.unwrap_or_default() / share;
        Self {
            t_s: reading.points.iter().map(|point| point.t_s * share).collect(),
            q_rad: reading.points.iter().map(|point| point.q_rad).collect(),
            qd_rad_s: reading.points.iter().map(of).collect(),
            corner_m: reading
                .points
                .iter()
                .map(|point| point.corner_m.unwrap_or(0.0))
                .collect(),
        }
    }

    /// Refuses what is no motion.
    fn check(&self) -> Result<(), KnotError> {
        for (knot, t_s) in self.t_s.iter().copied().enumerate() {
            let numbers = self.q_rad[knot].iter().chain(&self.qd_rad_s[knot]).copied();
            if !numbers.chain([t_s, self.corner_m[knot]]).all(f64::is_finite) {
                return Err(KnotError::NotFinite { knot });
            }
            let ascends = if knot == 0 {
                t_s == 0.0
            } else {
                t_s > self.t_s[knot - 1]
            };
            if !ascends {
                return Err(KnotError::Time { knot, t_s });
            }
        }
        Ok(())
    }

    /// The time between a point and the next one \[s\].
    fn step_s(&self, k: usize) -> f64 {
        self.t_s[k + 1] - self.t_s[k]
    }

    /// The joints' speed between a point and the next one \[rad/s\].
    fn speed(&self, k: usize) -> JointVector {
        (self.q_rad[k + 1] - self.q_rad[k]) / self.step_s(k)
    }

    fn segments(&self) -> std::ops::Range<usize> {
        0..self.t_s.len().saturating_sub(1)
    }
}

fn lines(points: &InPlanTime) -> Vec<MotionPiece> {
    let line = |k: usize| {
        let both = [k, k + 1];
        MotionPiece::line(both.map(|i| points.t_s[i]), both.map(|i| points.q_rad[i]))
    };
    points.segments().map(line).collect()
}

fn cubics(points: &InPlanTime) -> Vec<MotionPiece> {
    let cubic = |k: usize| {
        let both = [k, k + 1];
        MotionPiece {
            t_s: both.map(|i| points.t_s[i]),
            q_rad: both.map(|i| points.q_rad[i]),
            qd_rad_s: both.map(|i| points.qd_rad_s[i]),
        }
    };
    points.segments().map(cubic).collect()
}

/// How far the tip is from a point to the next one \[m\].
fn reach_m(points: &InPlanTime, arm: &RobotModel, tip: &Frame) -> Vec<f64> {
    let at = |q: &JointVector| arm.fk(q).rigid(tip).translation;
    let places: Vec<_> = points.q_rad.iter().map(at).collect();
    places.windows(2).map(|both| (both[1] - both[0]).norm()).collect()
}

/// A corner: when and where it begins and ends.
struct Corner {
    t_s: [f64; 2],
    q_rad: [JointVector; 2],
    qd_rad_s: [JointVector; 2],
}

/// Straight segments with corners of `scale` times their radius.
fn rounded(points: &InPlanTime, reach_m: &[f64], scale: f64) -> Vec<MotionPiece> {
    let Some((&last_s, &last)) = points.t_s.last().zip(points.q_rad.last()) else {
        return Vec::new();
    };
    let mut pieces = Vec::with_capacity(2 * points.t_s.len());
    let (mut t_s, mut q_rad) = (points.t_s[0], points.q_rad[0]);
    for k in 1..points.t_s.len().saturating_sub(1) {
        let Corner {
            t_s: [mut from, to],
            q_rad: [mut start, end],
            qd_rad_s,
        } = corner(points, reach_m, k, scale);
        if from - t_s > NOTHING_S {
            pieces.push(MotionPiece::line([t_s, from], [q_rad, start]));
        } else {
            (from, start) = (t_s, q_rad);
        }
        if to - from > NOTHING_S {
            pieces.push(MotionPiece {
                t_s: [from, to],
                q_rad: [start, end],
                qd_rad_s,
            });
            (t_s, q_rad) = (to, end);
        } else {
            (t_s, q_rad) = (from, start);
        }
    }
    if last_s > t_s {
        pieces.push(MotionPiece::line([t_s, last_s], [q_rad, last]));
    }
    pieces
}

fn corner(points: &InPlanTime, reach_m: &[f64], k: usize, scale: f64) -> Corner {
    let [before, after] = [k - 1, k];
    let radius_m = (points.corner_m[k] * scale)
        .min(0.5 * reach_m[before])
        .min(0.5 * reach_m[after]);
    // The time from where the corner begins to the point, and from the point to where it would end.
    let time_s = |segment: usize| match reach_m[segment] {
        reach if reach > 0.0 => radius_m / reach * points.step_s(segment),
        _ => 0.0,
    };
    let half_s = time_s(before).min(time_s(after));
    let (t, q) = (points.t_s[k], points.q_rad[k]);
    let qd_rad_s = [before, after].map(|segment| points.speed(segment));
    Corner {
        t_s: [t - half_s, t + half_s],
        q_rad: [q - qd_rad_s[0] * half_s, q + qd_rad_s[1] * half_s],
        qd_rad_s,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::Place;
    use proptest::prelude::*;

    fn reading(steps: &[(f64, [f64; 6], Option<f64>)], between: Between) -> Reading {
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
            between,
            tool: None,
            checks_start: false,
        }
    }

    fn steps() -> impl Strategy<Value = Vec<(f64, [f64; 6], Option<f64>)>> {
        let corner = prop::option::weighted(0.9, 0.0..0.02_f64);
        prop::collection::vec((0.01..0.1_f64, prop::array::uniform6(0.0..0.2_f64), corner), 2..12)
    }

    fn interpreted(reading: &Reading) -> (Vec<Interpreted>, RobotModel, Frame) {
        let arm = RobotModel::irb120().unwrap();
        let tip = platewash_workcell::fixtures::kitchen_tool().tip_frame(&arm);
        (motions(reading, &arm, &tip).unwrap(), arm, tip)
    }

    proptest! {
        /// Through every stop, near every other point, in speed without a step but at stops, and as long as the program.
        #[test]
        fn corners_are_smooth_and_small(steps in steps()) {
            let reading = reading(&steps, Between::RoundedLines);
            let (motions, arm, tip) = interpreted(&reading);
            prop_assert_eq!(motions.len(), CORNER_SCALES.len());
            let place = |q: &JointVector| arm.fk(q).rigid(&tip).translation;
            for Interpreted { corner_scale, motion } in &motions {
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
            let reading = reading(&steps, Between::RoundedLines);
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
        fn without_corners_it_is_a_polyline(steps in steps(), share in 0.0..1.0_f64) {
            let reading = reading(&steps, Between::RoundedLines);
            let (motions, ..) = interpreted(&reading);
            for both in reading.points.windows(2) {
                let t_s = both[0].t_s + share * (both[1].t_s - both[0].t_s);
                let [q, _] = motions[0].motion.at(t_s).unwrap();
                let line = both[0].q_rad + (both[1].q_rad - both[0].q_rad) * share;
                prop_assert!((q - line).amax() < 1e-9);
            }
        }
    }

    /// A share of the speed stretches time; what is judged is in the plan's.
    #[test]
    fn motions_are_in_the_time_of_the_plan() {
        let steps = [(0.2, [0.2; 6], Some(0.005)), (0.2, [0.15; 6], None)];
        let whole = reading(&steps, Between::RoundedLines);
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
    fn points_that_are_no_motion_are_refused() {
        let arm = RobotModel::irb120().unwrap();
        let tip = platewash_workcell::fixtures::kitchen_tool().tip_frame(&arm);
        for between in [Between::Lines, Between::RoundedLines, Between::Cubics] {
            for t_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                let mut reading = reading(&[(0.1, [0.2; 6], Some(0.005)), (0.1, [0.3; 6], None)], between);
                reading.points[2].t_s = t_s;
                assert!(motions(&reading, &arm, &tip).is_err(), "{between:?} {t_s}");
            }
        }
    }
}
