//! Whether the segments say what every moment is for, and which moment belongs to which.

use super::hermite::Piece;
use platewash::Plan;
use platewash::planner::plan::PlanSegment;
use platewash::planner::tool_path::SegmentKind;

/// Whether the segments cover the motion from knot to knot, and their kinds and plates, in time as in the tool path, are those of
/// a job that washes in the plan's order.
pub fn is_sound(plan: &Plan) -> bool {
    let in_time: Vec<_> = plan.segments.iter().map(|s| (s.kind, s.plate)).collect();
    let in_space: Vec<_> = plan.tool_path.iter().map(|s| (s.kind, s.plate)).collect();
    [in_time, in_space].iter().all(|list| follows(list, &plan.order)) && covers(plan)
}

fn follows(list: &[(SegmentKind, usize)], order: &[usize]) -> bool {
    let last = 4 * order.len();
    list.len() == last + 1
        && list.iter().enumerate().all(|(i, (kind, plate))| {
            let expected = match (i, i % 4) {
                (0, _) => SegmentKind::Depart,
                (i, _) if i == last => return *kind == SegmentKind::Return && order.last() == Some(plate),
                (_, 0) => SegmentKind::Transition,
                (_, 1) => SegmentKind::Approach,
                (_, 2) => SegmentKind::Wash,
                _ => SegmentKind::Retreat,
            };
            *kind == expected && *plate == order[i / 4]
        })
}

fn covers(plan: &Plan) -> bool {
    let times = &plan.knots.t_s;
    let mut reached = times[0];
    let mut connected = |s: &PlanSegment| {
        let fits = s.t_start_s == reached && s.t_end_s > reached && times.contains(&s.t_end_s);
        reached = s.t_end_s;
        fits
    };
    plan.segments.iter().all(&mut connected) && reached == times[times.len() - 1]
}

/// Index of the segment in which the middle of a piece lies, for segments that are sound.
pub fn segment_of(plan: &Plan, piece: &Piece) -> usize {
    let middle = piece.start_s + 0.5 * piece.length_s;
    let after = plan.segments.partition_point(|s| s.t_end_s <= middle);
    after.min(plan.segments.len() - 1)
}

/// Whether the tip is on a plate, or on its normal.
pub fn is_at_plate(kind: SegmentKind) -> bool {
    use SegmentKind::{Approach, Retreat, Wash};
    matches!(kind, Approach | Wash | Retreat)
}
