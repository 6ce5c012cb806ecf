//! Motions one after the other as one trajectory, and the plan's segments in time.

use super::visit::Visit;
use crate::error::PlanError;
use crate::timing::Timed;
use crate::transit::Transit;
use platewash_kinematics::JointVector;
use platewash_workcell::trajectory::Trajectory;
use platewash_workcell::trajectory::{PlanSegment, SegmentKind};

/// The whole motion in time.
#[derive(Debug)]
pub(super) struct Assembled {
    pub motion: Trajectory,
    pub segments: Vec<PlanSegment>,
}

#[derive(Default)]
struct Assembly {
    t_s: Vec<f64>,
    q: Vec<JointVector>,
    qd: Vec<JointVector>,
    segments: Vec<PlanSegment>,
}

/// Joins `visits` by `transits`, one more than visits: from home, between, home.
pub(super) fn assemble(visits: &[Visit], transits: &[Transit]) -> Result<Assembled, PlanError> {
    let mut assembly = Assembly::default();
    for (k, transit) in transits.iter().enumerate() {
        let plate = |visit: &Visit| visit.path.plate;
        let (before, after) = (k.checked_sub(1).map(|k| &visits[k]), visits.get(k));
        assembly.transit(before.map(plate), transit, after.map(plate));
        if let Some(visit) = after {
            assembly.declare(SegmentKind::Wash, plate(visit), &visit.wash, f64::INFINITY);
            assembly.append(&visit.wash);
        }
    }
    let Assembly { t_s, q, qd, segments } = assembly;
    Ok(Assembled {
        motion: Trajectory::from_knots(t_s, q, qd)?,
        segments,
    })
}

impl Assembly {
    /// Retreat from a plate, free motion and approach to a plate of one transit.
    fn transit(&mut self, before: Option<usize>, transit: &Transit, after: Option<usize>) {
        let [leaves, enters] = transit.free;
        let kind = match (before, after) {
            (None, _) => SegmentKind::Depart,
            (_, None) => SegmentKind::Return,
            _ => SegmentKind::Transit,
        };
        let plate = after.or(before).unwrap_or(0);
        if let Some(before) = before {
            self.declare(SegmentKind::Retreat, before, &transit.timed, leaves);
        }
        self.declare(kind, plate, &transit.timed, enters);
        if let Some(after) = after {
            self.declare(SegmentKind::Approach, after, &transit.timed, f64::INFINITY);
        }
        self.append(&transit.timed);
    }

    /// Declares a segment up to the knot at `parameter` of a motion that is appended later, or up to its end.
    fn declare(&mut self, kind: SegmentKind, plate: usize, timed: &Timed, parameter: f64) {
        let start = self.t_s.last().copied().unwrap_or(0.0);
        let last = timed.parameters.len() - 1;
        // The knot there, whichever way its parameter was rounded.
        let after = timed.parameters.partition_point(|u| *u < parameter).clamp(1, last);
        let off = |knot: usize| (timed.parameters[knot] - parameter).abs();
        let knot = if off(after - 1) < off(after) { after - 1 } else { after };
        let t_start_s = self.segments.last().map_or(0.0, |s| s.t_end_s);
        self.segments.push(PlanSegment {
            kind,
            plate,
            t_start_s,
            t_end_s: start + timed.motion.times()[knot],
        });
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
