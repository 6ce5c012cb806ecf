//! Which piece of the motion belongs to which segment, and whether the segments are those of a certified job.
//!
//! depart, then for each plate in order approach, wash, retreat, with a transition between plates, and return; one segment of
//! the tool path for each, without a gap from 0 to the last knot, every boundary a knot.

use super::piece::Piece;
use super::promise::Discrepancy;
use crate::plan::Plan;
use crate::tool_path::SegmentKind;
use platewash_workcell::words::counted;
use std::ops::Range;

/// The segments by their pieces, in time order.
#[derive(Debug, Clone)]
pub(super) struct Schedule {
    pub stages: Vec<Stage>,
}

/// A segment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Stage {
    pub kind: SegmentKind,
    pub plate: usize,
    /// Its pieces; at least one.
    pub pieces: Range<usize>,
}

impl Schedule {
    /// The schedule that a plan states.
    ///
    /// # Errors
    /// What keeps it from being one of a certified job.
    pub fn new(plan: &Plan, pieces: &[Piece]) -> Result<Self, Vec<Discrepancy>> {
        let mut wrong = kinds(plan);
        let mut stages = Vec::with_capacity(plan.segments.len());
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
                    stages.push(Stage { kind, plate, pieces });
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
            Ok(Self { stages })
        } else {
            Err(wrong)
        }
    }

    /// Index and kind of the segment that a piece belongs to.
    pub fn segment_of(&self, piece: usize) -> Option<(usize, SegmentKind)> {
        let i = self.stages.partition_point(|s| s.pieces.end <= piece);
        self.stages.get(i).map(|s| (i, s.kind))
    }

    /// Index and kind of the segment of a time \[s\]; at a boundary that of the later one.
    pub fn segment_at(&self, pieces: &[Piece], time_s: f64) -> Option<(usize, SegmentKind)> {
        let piece = pieces.partition_point(|p| p.start_s <= time_s).saturating_sub(1);
        self.segment_of(piece)
    }
}

/// Whether the tip is on a plate, or on its normal.
pub(super) fn is_at_plate(kind: SegmentKind) -> bool {
    matches!(kind, SegmentKind::Approach | SegmentKind::Wash | SegmentKind::Retreat)
}

/// The sequence of kinds and plates, in time and in the tool path, against what the order asks for.
fn kinds(plan: &Plan) -> Vec<Discrepancy> {
    let expected = expected(&plan.order);
    let mut wrong = Vec::new();
    for (list, found) in [
        (
            "segments",
            plan.segments.iter().map(|s| (s.kind, s.plate)).collect::<Vec<_>>(),
        ),
        ("tool_path", plan.tool_path.iter().map(|s| (s.kind, s.plate)).collect()),
    ] {
        if found.len() != expected.len() {
            let asked = format!("{} for {}", expected.len(), counted(plan.order.len(), "plate"));
            wrong.push(Discrepancy::new(format!("length of {list}"), found.len(), asked));
        }
        let first = found
            .iter()
            .zip(&expected)
            .position(|(found, expected)| found != expected);
        if let Some(i) = first {
            let say = |(kind, plate): (SegmentKind, usize)| format!("{} of plate {plate}", kind.name());
            wrong.push(Discrepancy::new(
                format!("{list}[{i}]"),
                say(found[i]),
                say(expected[i]),
            ));
        }
    }
    wrong
}

/// Kinds and plates of a job that washes in this order. Depart leads to the first plate; a return belongs to the last.
fn expected(order: &[usize]) -> Vec<(SegmentKind, usize)> {
    let mut all = Vec::with_capacity(4 * order.len() + 1);
    for (i, &plate) in order.iter().enumerate() {
        let towards = if i == 0 {
            SegmentKind::Depart
        } else {
            SegmentKind::Transition
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
