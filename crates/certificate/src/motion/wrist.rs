//! Wrist: distance of joint 5 from 0 while the sponge is at a plate, always on the same side: where axes 4 and 6 are in line the wrist would flip.
//!
//! Requirement 32 of `docs/certificate.md`.

use crate::judged_job::JudgedJob;
use crate::motion::piece::Piece;
use crate::plan_statements::schedule::{Schedule, Span};
use crate::report::check::{Check, Measure, Sense, WorstCase, finite};
use crate::report::requirement::Requirement;
use crate::report::unit::Unit;

/// Index of joint 5.
const JOINT: usize = 4;

/// Range of joint 5 from an approach to the retreat after it.
#[derive(Debug, Clone, Copy)]
struct Visit {
    plate: usize,
    /// Least and greatest position, rounding included \[rad\], each with the index of its piece.
    least: (f64, usize),
    most: (f64, usize),
    /// Upper bound on the rounding \[rad\].
    rounding: f64,
}

impl Visit {
    /// Distance from 0 on the better side, the greater of min q₅ and −max q₅ \[rad\], with its piece; negative where the joint passes 0 by as much.
    /// The extremes are those of formula (12.1).
    fn margin(&self) -> (f64, usize) {
        if self.least.0 >= -self.most.0 {
            self.least
        } else {
            (-self.most.0, self.most.1)
        }
    }
}

/// The requirement, where the job has it.
pub(crate) fn check(judged: &JudgedJob<'_>, pieces: &[Piece], schedule: Option<&Schedule>) -> Option<Check> {
    let limit = judged.job.requirements.wrist_rad?;
    let Some(schedule) = schedule else {
        return Some(Check::not_judged(Requirement::Wrist));
    };
    let visits = visits(pieces, schedule);
    let worst = visits.iter().min_by(|a, b| a.margin().0.total_cmp(&b.margin().0));
    let Some(worst) = worst else {
        return Some(Check::not_judged(Requirement::Wrist));
    };
    let (bound, piece) = worst.margin();
    let bounds = [bound, bound + 2.0 * worst.rounding].map(finite);
    let measure = Measure::new(Sense::AtLeast, limit, Unit::Radian, bounds);
    let place = WorstCase {
        time_s: Some(nearest_0(&pieces[piece])),
        joint: Some(JOINT),
        plate: Some(worst.plate),
        segment: schedule.segment_of(piece),
        ..WorstCase::default()
    };
    Some(Check::measured(Requirement::Wrist, measure, place))
}

/// Runs of segments at a plate.
fn visits(pieces: &[Piece], schedule: &Schedule) -> Vec<Visit> {
    let mut visits: Vec<Visit> = Vec::new();
    let mut before: Option<&Span> = None;
    for span in &schedule.spans {
        let goes_on = before.is_some_and(|before| before.kind.is_at_plate() && before.plate == span.plate);
        before = Some(span);
        if !span.kind.is_at_plate() {
            continue;
        }
        if !goes_on {
            visits.push(Visit {
                plate: span.plate,
                least: (f64::INFINITY, span.pieces.start),
                most: (f64::NEG_INFINITY, span.pieces.start),
                rounding: 0.0,
            });
        }
        let Some(visit) = visits.last_mut() else { continue };
        for i in span.pieces.clone() {
            let extent = pieces[i].extent([0.0, pieces[i].length_s]);
            let (least, most) = (extent.least[JOINT], extent.most[JOINT]);
            if least < visit.least.0 {
                visit.least = (least, i);
            }
            if most > visit.most.0 {
                visit.most = (most, i);
            }
            visit.rounding = visit.rounding.max(pieces[i].rounding().position[JOINT]);
        }
    }
    visits
}

/// When, within a piece, joint 5 is nearest to 0 \[s\].
fn nearest_0(piece: &Piece) -> f64 {
    let at = |u: &f64| piece.position(*u)[JOINT].abs();
    let worst = piece
        .candidates(JOINT)
        .into_iter()
        .min_by(|a, b| at(a).total_cmp(&at(b)));
    piece.start_s + worst.unwrap_or(0.0)
}
