//! Segments of a plan in time.

use crate::simulate::error::SimulationError;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind};

/// Largest excess of a sampling time over a segment's end that still counts as within it, as a part of the sampling period:
/// rounding.
const ROUNDING: f64 = 1e-6;

/// The segment at ascending times.
#[derive(Debug, Clone)]
pub(crate) struct Schedule<'a> {
    segments: &'a [PlanSegment],
    index: usize,
    slack_s: f64,
}

impl<'a> Schedule<'a> {
    /// The segments of a plan, looked up every `period_s`.
    ///
    /// # Errors
    /// [`SimulationError::Empty`] without segments, [`SimulationError::Plate`] for a segment of no plate.
    pub fn new(plan: &'a Plan, period_s: f64) -> Result<Self, SimulationError> {
        let (segments, plates) = (&plan.segments[..], plan.job.plates.len());
        if segments.is_empty() || plan.knots.t_s.is_empty() {
            return Err(SimulationError::Empty {
                knots: plan.knots.t_s.len(),
                segments: segments.len(),
            });
        }
        if let Some(segment) = segments.iter().position(|s| s.plate >= plates) {
            let plate = segments[segment].plate;
            return Err(SimulationError::Plate { segment, plate, plates });
        }
        Ok(Self {
            segments,
            index: 0,
            slack_s: ROUNDING * period_s,
        })
    }

    /// Index of the segment that ends at or after `t`, not before the one asked for last; the last one beyond the end.
    pub fn at(&mut self, t: f64) -> usize {
        while self.index + 1 < self.segments.len() && self.segments[self.index].t_end_s + self.slack_s < t {
            self.index += 1;
        }
        self.index
    }

    /// A segment.
    pub fn segment(&self, index: usize) -> &'a PlanSegment {
        &self.segments[index]
    }

    /// The plate that the sponge shall be on in a segment, if on any.
    pub fn washed_plate(&self, index: usize) -> Option<usize> {
        let segment = &self.segments[index];
        (segment.kind == SegmentKind::Wash).then_some(segment.plate)
    }
}
