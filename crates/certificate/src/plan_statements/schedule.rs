//! The piece ranges of the segments, and the check that the segments are those of a washing.
//!
//! Requirements 7, 9 and 10 of `docs/certificate.md`.
//!
//! depart, then for each plate in order approach, wash, retreat, with a transit between plates, and return;
//! without a gap from 0 to the last knot, every boundary a knot.
//!
//! From home to home, and at rest where a wash begins and where it ends.

use crate::motion::piece::Piece;
use crate::report::check::{Check, Discrepancy};
use crate::report::requirement::Requirement;
use platewash_kinematics::JointVector;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::job::RetreatLine;
use platewash_workcell::words::{count_with_noun, plate_name};
use std::ops::Range;

/// Segments by their pieces, in time order.
#[derive(Debug, Clone)]
pub(crate) struct Schedule {
    pub spans: Vec<Span>,
}

/// Segment of the motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Span {
    pub kind: SegmentKind,
    pub plate: usize,
    /// Range of its pieces; at least one.
    pub pieces: Range<usize>,
}

impl Schedule {
    /// Builds the schedule that a plan states.
    ///
    /// # Errors
    /// Discrepancies where the segments are not those of a washing.
    pub fn new(plan: &Plan, pieces: &[Piece]) -> Result<Self, Vec<Discrepancy>> {
        let mut wrong = kinds(plan);
        let mut spans = Vec::with_capacity(plan.segments.len());
        let times = &plan.knots.t_s;
        let mut next = 0;
        for (i, segment) in plan.segments.iter().enumerate() {
            let starts = times.get(next).copied().unwrap_or(f64::NAN);
            if segment.t_start_s != starts {
                let what = format!("segments[{i}].t_start_s");
                wrong.push(Discrepancy::new(
                    what,
                    segment.t_start_s,
                    format!("{starts}, without a gap"),
                ));
                break;
            }
            match times.binary_search_by(|t| t.total_cmp(&segment.t_end_s)) {
                Ok(end) if end > next => {
                    let (kind, plate) = (segment.kind, segment.plate);
                    let pieces = next..end;
                    spans.push(Span { kind, plate, pieces });
                    next = end;
                }
                _ => {
                    let what = format!("segments[{i}].t_end_s");
                    wrong.push(Discrepancy::new(what, segment.t_end_s, "the time of a later knot"));
                    break;
                }
            }
        }
        if wrong.is_empty() && next != pieces.len() {
            let end = times.get(next).copied().unwrap_or(0.0);
            let last = times.last().copied().unwrap_or(0.0);
            wrong.push(Discrepancy::new(
                "end of the last segment",
                end,
                format!("{last}, the last knot"),
            ));
        }
        if wrong.is_empty() {
            Ok(Self { spans })
        } else {
            Err(wrong)
        }
    }

    /// Builds the schedule of another motion that follows a plan at the same times. Each piece, given by its end in `ends_s` \[s\], belongs
    /// to the segment that contains its end, up to `near_s` \[s\]. Pieces after the end of the plan belong to its last segment.
    pub fn along(plan: &Plan, ends_s: &[f64], near_s: f64) -> Self {
        let mut next = 0;
        let last = plan.segments.len().saturating_sub(1);
        let span = |(i, segment): (usize, &PlanSegment)| {
            let end = match i {
                _ if i == last => ends_s.len(),
                _ => ends_s.partition_point(|t| *t <= segment.t_end_s + near_s).max(next),
            };
            let pieces = next..end;
            next = end;
            let (kind, plate) = (segment.kind, segment.plate);
            Span { kind, plate, pieces }
        };
        Self {
            spans: plan.segments.iter().enumerate().map(span).collect(),
        }
    }

    /// Returns the approach and retreat spans at a plate.
    pub fn around(&self, plate: usize) -> impl Iterator<Item = &Span> {
        let is_around =
            move |span: &&Span| span.plate == plate && span.kind.is_at_plate() && span.kind != SegmentKind::Wash;
        self.spans.iter().filter(is_around)
    }

    /// Returns index and kind of the segment at a plate at a time \[s\]: the wash, also at its ends, or the approach or retreat.
    pub fn at_plate(&self, pieces: &[Piece], plate: usize, time_s: f64) -> Option<(usize, SegmentKind)> {
        let has = |span: &Span| {
            let there = pieces.get(span.pieces.clone()).unwrap_or_default();
            let ends = there.first().zip(there.last());
            ends.is_some_and(|(first, last)| first.start_s <= time_s && time_s <= last.start_s + last.length_s)
        };
        let of = |span: &Span| span.plate == plate && span.kind.is_at_plate();
        let indexed = || self.spans.iter().enumerate().filter(|(_, span)| of(span));
        let wash = indexed().find(|(_, span)| span.kind == SegmentKind::Wash);
        let found = wash
            .filter(|(_, span)| has(span))
            .or_else(|| indexed().find(|(_, span)| has(span)));
        found.or(wash).map(|(i, span)| (i, span.kind))
    }

    /// Index and kind of the segment that a piece belongs to.
    pub fn segment_of(&self, piece: usize) -> Option<(usize, SegmentKind)> {
        let i = self.spans.partition_point(|s| s.pieces.end <= piece);
        self.spans.get(i).map(|s| (i, s.kind))
    }

    /// Returns index and kind of the segment at a time \[s\]; at a boundary, of the later one.
    pub fn segment_at(&self, pieces: &[Piece], time_s: f64) -> Option<(usize, SegmentKind)> {
        let piece = pieces.partition_point(|p| p.start_s <= time_s).saturating_sub(1);
        self.segment_of(piece)
    }
}

/// Compares the sequence of kinds and plates with the one that the order implies.
fn kinds(plan: &Plan) -> Vec<Discrepancy> {
    let expected = match plan.job.recovery.as_ref().filter(|recovery| recovery.is_motion_home()) {
        Some(recovery) => expected_home(recovery.retreat()),
        None => expected(&plan.order),
    };
    let mut wrong = Vec::new();
    if plan.segments.len() != expected.len() {
        let asked = format!("{} for {}", expected.len(), count_with_noun(plan.order.len(), "plate"));
        wrong.push(Discrepancy::new("number of segments", plan.segments.len(), asked));
    }
    let found = plan.segments.iter().map(|s| (s.kind, s.plate));
    let differs = |(found, expected): &((SegmentKind, usize), &(SegmentKind, usize))| found != *expected;
    if let Some((i, (found, expected))) = found.zip(&expected).enumerate().find(|(_, pair)| differs(pair)) {
        let say = |(kind, plate): (SegmentKind, usize)| format!("{} of {}", kind.name(), plate_name(plate));
        wrong.push(Discrepancy::new(format!("segments[{i}]"), say(found), say(*expected)));
    }
    wrong
}

/// Returns kinds and plates of a job that washes in this order. Depart belongs to the first plate, return to the last.
fn expected(order: &[usize]) -> Vec<(SegmentKind, usize)> {
    let mut all = Vec::with_capacity(4 * order.len() + 1);
    for (i, &plate) in order.iter().enumerate() {
        let towards = if i == 0 {
            SegmentKind::Depart
        } else {
            SegmentKind::Transit
        };
        all.extend([
            (towards, plate),
            (SegmentKind::Approach, plate),
            (SegmentKind::Wash, plate),
            (SegmentKind::Retreat, plate),
        ]);
    }
    if let Some(&last) = order.last() {
        all.push((SegmentKind::Return, last));
    }
    all
}

/// Returns kinds and plates of a motion from a stop home.
fn expected_home(retreat: Option<RetreatLine>) -> Vec<(SegmentKind, usize)> {
    let plate = retreat.map_or(0, |line| line.plate);
    let up = retreat.map(|_| (SegmentKind::Retreat, plate));
    up.into_iter().chain([(SegmentKind::Return, plate)]).collect()
}

/// Greatest distance from home that counts as home \[rad\], and greatest speed that counts as rest \[rad/s\].
const THERE: f64 = 1e-9;

/// Checks that the first and the last knot are the job's home positions, at rest.
pub(crate) fn home_to_home(plan: &Plan) -> Check {
    let mut wrong = Vec::new();
    let knots = &plan.knots;
    let ends = [
        (knots.q_rad.first(), knots.qd_rad_s.first()),
        (knots.q_rad.last(), knots.qd_rad_s.last()),
    ];
    for (i, (home, end)) in plan.job.home_rad.iter().zip(ends).enumerate() {
        let name = ["first", "last"][i];
        let (Some(q), Some(qd)) = end else { continue };
        if (q - home).amax() > THERE {
            wrong.push(Discrepancy::new(
                format!("positions of the {name} knot"),
                list(q),
                list(home),
            ));
        }
        if qd.amax() > THERE {
            wrong.push(Discrepancy::new(format!("speeds of the {name} knot"), list(qd), "rest"));
        }
    }
    Check::stated(Requirement::HomeToHome, wrong)
}

/// Checks that the arm rests at both ends of every wash.
pub(crate) fn rest_at_wash_ends(plan: &Plan, schedule: Option<&Schedule>) -> Check {
    let Some(schedule) = schedule else {
        return Check::not_judged(Requirement::RestAtWashEnds);
    };
    let mut wrong = Vec::new();
    for span in schedule.spans.iter().filter(|s| s.kind == SegmentKind::Wash) {
        for knot in [span.pieces.start, span.pieces.end] {
            let qd = plan.knots.qd_rad_s[knot];
            if qd.amax() > THERE {
                wrong.push(Discrepancy::new(
                    format!("speeds at {:.4} s", plan.knots.t_s[knot]),
                    list(&qd),
                    "rest",
                ));
            }
        }
    }
    Check::stated(Requirement::RestAtWashEnds, wrong)
}

fn list(q: &JointVector) -> String {
    let numbers: Vec<_> = q.iter().map(f64::to_string).collect();
    format!("[{}]", numbers.join(", "))
}
