//! Joint positions, speeds and accelerations against the limits of the arm and the job: piece by piece, exact but for the
//! rounding that the bounds include.
//!
//! Requirements 12–14, formulas (12.1) and (12.2) in `docs/certificate.md`.

use crate::judged_job::JointLimits;
use crate::motion::piece::Piece;
use crate::plan_statements::schedule::Schedule;
use crate::report::check::{Check, Measure, Sense, WorstCase};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use platewash_kinematics::AXES;

/// The worst joint so far, compared by margin for positions, and by share of the limit for speeds and accelerations.
struct Extreme {
    badness: f64,
    /// Proved bound.
    bound: f64,
    /// Value that the joint certainly attains: the bound less twice its rounding.
    attained: f64,
    limit: f64,
    joint: usize,
    piece: usize,
}

impl Extreme {
    /// True if this is worse than the worst so far. NaN is worse than anything.
    fn is_worse_than(&self, worst: Option<&Self>) -> bool {
        worst.is_none_or(|w| self.badness > w.badness || self.badness.is_nan())
    }
}

/// Checks the three requirements, in the order position, speed, acceleration: the extremes of formula (12.1) with the rounding of formula (12.2).
pub(crate) fn checks(pieces: &[Piece], limits: &JointLimits, schedule: Option<&Schedule>) -> [Check; 3] {
    let (speed, acceleration) = (&limits.speed_rad_s, &limits.acceleration_rad_s2);
    let [lower, upper] = &limits.position_rad;
    let mut worst: [Option<Extreme>; 3] = [None, None, None];
    for (piece, cubic) in pieces.iter().enumerate() {
        let extent = cubic.extent([0.0, cubic.length_s]);
        let rounding = cubic.rounding();
        for joint in 0..AXES {
            let margin = (extent.least[joint] - lower[joint]).min(upper[joint] - extent.most[joint]);
            let (v, a) = (extent.speed[joint], extent.acceleration[joint]);
            let candidates = [
                (-margin, margin, margin + 2.0 * rounding.position[joint], 0.0),
                (v / speed[joint], v, v - 2.0 * rounding.speed[joint], speed[joint]),
                (
                    a / acceleration[joint],
                    a,
                    a - 2.0 * rounding.acceleration[joint],
                    acceleration[joint],
                ),
            ];
            for (worst, (badness, bound, attained, limit)) in worst.iter_mut().zip(candidates) {
                let found = Extreme {
                    badness,
                    bound,
                    attained,
                    limit,
                    joint,
                    piece,
                };
                if found.is_worse_than(worst.as_ref()) {
                    *worst = Some(found);
                }
            }
        }
    }
    let [position, speed, acceleration] = worst;
    let check = |name, extreme, unit, sense| check(pieces, schedule, (name, unit, sense), extreme);
    [
        check(Requirement::JointPosition, position, Unit::Radian, Sense::AtLeast),
        check(Requirement::JointSpeed, speed, Unit::RadianPerSecond, Sense::AtMost),
        check(
            Requirement::JointAcceleration,
            acceleration,
            Unit::RadianPerSecondSquared,
            Sense::AtMost,
        ),
    ]
}

fn check(
    pieces: &[Piece],
    schedule: Option<&Schedule>,
    (name, unit, sense): (Requirement, Unit, Sense),
    extreme: Option<Extreme>,
) -> Check {
    let Some(extreme) = extreme else {
        return Check::not_judged(name);
    };
    let worst = WorstCase {
        time_s: Some(time_of(&pieces[extreme.piece], name, extreme.joint)),
        joint: Some(extreme.joint),
        segment: schedule.and_then(|s| s.segment_of(extreme.piece)),
        ..WorstCase::default()
    };
    let number = |v: f64| Some(v).filter(|v| v.is_finite() || *v == f64::INFINITY && sense == Sense::AtLeast);
    let bounds = [extreme.bound, extreme.attained].map(number);
    let measure = Measure::new(sense, extreme.limit, unit, bounds);
    Check::measured(name, measure, worst)
}

/// Time within a piece at which a joint is worst \[s\].
fn time_of(piece: &Piece, name: Requirement, joint: usize) -> f64 {
    let middle = 0.5 * (piece.position(0.0)[joint] + piece.position(piece.length_s)[joint]);
    let value = |u: f64| match name {
        Requirement::JointPosition => (piece.position(u)[joint] - middle).abs(),
        Requirement::JointSpeed => piece.speed(u)[joint].abs(),
        _ => piece.acceleration(u)[joint].abs(),
    };
    let worst = piece
        .candidates(joint)
        .into_iter()
        .max_by(|a, b| value(*a).total_cmp(&value(*b)));
    piece.start_s + worst.unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::check::Status;
    use platewash_kinematics::JointVector;

    fn limits() -> JointLimits {
        let job = platewash_fixtures::kitchen();
        JointLimits::new(
            job.arm(),
            JointVector::from(job.terms().limits.joint_acceleration_rad_s2),
        )
    }

    fn judged(times: [f64; 2], q: [f64; 2], v: [f64; 2]) -> [Check; 3] {
        let joint_1 = |v: f64| JointVector::new(v, 0.0, 0.0, 0.0, 0.0, 0.0);
        let piece = Piece::new(times, q.map(joint_1), v.map(joint_1));
        checks(&[piece], &limits(), None)
    }

    /// Worked out in fractions, its knots say 16/3 rad/s², a third above the limit; in floating-point numbers they give 4 rad/s².
    #[test]
    fn a_piece_of_a_few_units_in_the_last_place_hides_no_acceleration() {
        let times = [0.5, 0.500_000_000_000_000_7];
        let (q, v) = (
            [0.010_798_297_365_814_597, 0.010_798_297_365_816_13],
            [2.299_479_166_666_667, 2.299_479_166_666_667_4],
        );
        let [_, _, acceleration] = judged(times, q, v);
        let measure = acceleration.measure.unwrap();
        assert_eq!(measure.limit, 4.0);
        assert!(measure.bound.unwrap() > 16.0 / 3.0, "{measure:?}");
        assert!(measure.seen.unwrap() < 16.0 / 3.0, "{measure:?}");
        assert_eq!(acceleration.status, Status::NotProved);
    }

    #[test]
    fn a_piece_of_a_tenth_of_a_millisecond_keeps_its_limits_to_the_rounding_that_is_allowed() {
        let h = (40.0 + 1e-4) - 40.0;
        let (v0, v1) = (2.0, 2.0 + 3.999_998 * h);
        let [_, _, acceleration] = judged([40.0, 40.0 + h], [1.0, 1.0 + 0.5 * (v0 + v1) * h], [v0, v1]);
        assert_eq!(acceleration.status, Status::Proved, "{acceleration:?}");
        let [_, _, acceleration] = judged([40.0, 40.0 + h], [1.0, 1.0 + 0.5 * (v0 + v1) * h], [v0, v1 + h]);
        assert_eq!(acceleration.status, Status::Violated, "{acceleration:?}");
    }
}
