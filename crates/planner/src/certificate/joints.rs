//! Joint positions, speeds and accelerations against the arm's and the scenario's limits: exact, piece by piece.

use super::piece::Piece;
use super::promise::{Measure, Promise, PromiseName, Sense, Unit, Worst};
use super::schedule::Schedule;
use crate::plan::PlanLimits;
use platewash_kinematics::{AXES, JointVector};

/// The worst joint so far: by its margin for positions, by its share of the limit for speeds and accelerations.
struct Extreme {
    badness: f64,
    value: f64,
    limit: f64,
    joint: usize,
    piece: usize,
}

/// The three promises, in the order position, speed, acceleration.
pub(super) fn promises(pieces: &[Piece], limits: &PlanLimits, schedule: Option<&Schedule>) -> [Promise; 3] {
    let speed = JointVector::from(limits.velocity_rad_s);
    let acceleration = JointVector::from(limits.acceleration_rad_s2);
    let mut worst: [Option<Extreme>; 3] = [None, None, None];
    for (piece, cubic) in pieces.iter().enumerate() {
        let extent = cubic.extent([0.0, cubic.length_s]);
        for joint in 0..AXES {
            let above = limits.lower_rad[joint].map_or(f64::INFINITY, |least| extent.least[joint] - least);
            let below = limits.upper_rad[joint].map_or(f64::INFINITY, |most| most - extent.most[joint]);
            let margin = above.min(below);
            let (v, a) = (extent.speed[joint], extent.acceleration[joint]);
            let candidates = [
                (-margin, margin, 0.0),
                (v / speed[joint], v, speed[joint]),
                (a / acceleration[joint], a, acceleration[joint]),
            ];
            for (worst, (badness, value, limit)) in worst.iter_mut().zip(candidates) {
                // NaN is worse than anything.
                if worst.as_ref().is_none_or(|w| badness > w.badness || badness.is_nan()) {
                    *worst = Some(Extreme {
                        badness,
                        value,
                        limit,
                        joint,
                        piece,
                    });
                }
            }
        }
    }
    let [position, speed, acceleration] = worst;
    let promise = |name, extreme, unit, sense| promise(pieces, schedule, (name, unit, sense), extreme);
    [
        promise(PromiseName::JointPosition, position, Unit::Radian, Sense::AtLeast),
        promise(PromiseName::JointSpeed, speed, Unit::RadianPerSecond, Sense::AtMost),
        promise(
            PromiseName::JointAcceleration,
            acceleration,
            Unit::RadianPerSecondSquared,
            Sense::AtMost,
        ),
    ]
}

fn promise(
    pieces: &[Piece],
    schedule: Option<&Schedule>,
    (name, unit, sense): (PromiseName, Unit, Sense),
    extreme: Option<Extreme>,
) -> Promise {
    let Some(extreme) = extreme else {
        return Promise::not_judged(name);
    };
    let worst = Worst {
        time_s: Some(time_of(&pieces[extreme.piece], name, extreme.joint)),
        joint: Some(extreme.joint),
        segment: schedule.and_then(|s| s.segment_of(extreme.piece)),
        ..Worst::default()
    };
    // The extremes are attained: what is seen is the bound.
    let value = Some(extreme.value).filter(|v| v.is_finite() || *v == f64::INFINITY && sense == Sense::AtLeast);
    let limit = extreme.limit;
    let measure = Measure {
        bound: value,
        seen: value,
        limit,
        sense,
        unit,
    };
    Promise::measured(name, measure, worst)
}

/// When, within a piece, a joint is worst \[s\].
fn time_of(piece: &Piece, name: PromiseName, joint: usize) -> f64 {
    let middle = 0.5 * (piece.position(0.0)[joint] + piece.position(piece.length_s)[joint]);
    let value = |u: f64| match name {
        PromiseName::JointPosition => (piece.position(u)[joint] - middle).abs(),
        PromiseName::JointSpeed => piece.speed(u)[joint].abs(),
        _ => piece.acceleration(u)[joint].abs(),
    };
    let worst = piece
        .candidates(joint)
        .into_iter()
        .max_by(|a, b| value(*a).total_cmp(&value(*b)));
    piece.start_s + worst.unwrap_or(0.0)
}
