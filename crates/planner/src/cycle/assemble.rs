//! Motions one after the other as one trajectory, and the plan's segments in time.

use super::CycleError;
use super::visit::Visit;
use crate::crossing::Crossing;
use crate::plan::PlanSegment;
use crate::timing::Timed;
use crate::tool_path::{Segment, SegmentKind, Shape};
use platewash_workcell::trajectory::Trajectory;

/// The whole cycle in time.
pub(super) struct Assembled {
    pub motion: Trajectory,
    pub tool_path: Vec<Segment>,
    pub segments: Vec<PlanSegment>,
}

#[derive(Default)]
struct Assembly {
    t_s: Vec<f64>,
    q: Vec<platewash_kinematics::JointVector>,
    qd: Vec<platewash_kinematics::JointVector>,
    tool_path: Vec<Segment>,
    segments: Vec<PlanSegment>,
}

/// Joins `visits` by `crossings`, one more than visits: from home, between, home.
pub(super) fn assemble(visits: &[Visit], crossings: &[Crossing]) -> Result<Assembled, CycleError> {
    let mut assembly = Assembly::default();
    for (k, crossing) in crossings.iter().enumerate() {
        let (before, after) = (k.checked_sub(1).map(|k| &visits[k]), visits.get(k));
        assembly.crossing(before, crossing, after);
        if let Some(visit) = after {
            let [_, wash, _] = visit.segments();
            assembly.stretch(wash, &visit.wash, f64::INFINITY);
            assembly.append(&visit.wash);
        }
    }
    let Assembly {
        t_s,
        q,
        qd,
        tool_path,
        segments,
    } = assembly;
    Ok(Assembled {
        motion: Trajectory::from_knots(t_s, q, qd)?,
        tool_path,
        segments,
    })
}

impl Assembly {
    /// Retreat, free motion and approach of one crossing.
    fn crossing(&mut self, before: Option<&Visit>, crossing: &Crossing, after: Option<&Visit>) {
        let [leaves, enters] = crossing.free;
        let kind = match (before, after) {
            (None, _) => SegmentKind::Depart,
            (_, None) => SegmentKind::Return,
            _ => SegmentKind::Transition,
        };
        let plate = after.or(before).map_or(0, |visit| visit.plate);
        if let Some(visit) = before {
            let [.., retreat] = visit.segments();
            self.stretch(retreat, &crossing.timed, leaves);
        }
        let free = Segment {
            kind,
            plate,
            shape: Shape::Free,
            waypoints: Vec::new(),
        };
        self.stretch(free, &crossing.timed, enters);
        if let Some(visit) = after {
            let [approach, ..] = visit.segments();
            self.stretch(approach, &crossing.timed, f64::INFINITY);
        }
        self.append(&crossing.timed);
    }

    /// Declares a segment up to the knot at `parameter` of a motion that is appended later, or up to its end.
    fn stretch(&mut self, segment: Segment, timed: &Timed, parameter: f64) {
        let start = self.t_s.last().copied().unwrap_or(0.0);
        let last = timed.parameters.len() - 1;
        // The knot there, whichever way its parameter was rounded.
        let after = timed.parameters.partition_point(|u| *u < parameter).clamp(1, last);
        let off = |knot: usize| (timed.parameters[knot] - parameter).abs();
        let knot = if off(after - 1) < off(after) { after - 1 } else { after };
        let t_start_s = self.segments.last().map_or(0.0, |s| s.t_end_s);
        self.segments.push(PlanSegment {
            kind: segment.kind,
            plate: segment.plate,
            t_start_s,
            t_end_s: start + timed.motion.times()[knot],
        });
        self.tool_path.push(segment);
    }

    /// Appends the knots of a motion; its first one is the last one so far.
    fn append(&mut self, timed: &Timed) {
        let start = self.t_s.last().copied().unwrap_or(0.0);
        let from = usize::from(!self.t_s.is_empty());
        let motion = &timed.motion;
        self.t_s.extend(motion.times()[from..].iter().map(|t| start + t));
        self.q.extend(&motion.positions()[from..]);
        self.qd.extend(&motion.speeds()[from..]);
    }
}
