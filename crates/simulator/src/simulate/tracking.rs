//! How far the arm is from where the plan wants it, at the same time.

use super::execution::{Execution, Sample};
use super::statistics::Spread;
use platewash_kinematics::{AXES, Frame, JointVector, RobotModel};
use platewash_workcell::trajectory::{PlanSegment, SegmentKind};
use serde::Serialize;

/// Errors over some samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tracking {
    /// Distance of the tip from the planned one \[m\].
    pub tip_m: Spread,
    /// |q − q_d| of each joint \[rad\].
    pub joints_rad: [Spread; AXES],
}

/// Errors over a segment of the plan.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SegmentTracking {
    /// What the segment is for.
    pub kind: SegmentKind,
    /// The plate washed, or the plate it leads to.
    pub plate: usize,
    /// Start and end in the plan \[s\].
    pub span_s: [f64; 2],
    /// Samples within it.
    pub samples: usize,
    /// The errors.
    #[serde(flatten)]
    pub tracking: Tracking,
}

/// Distance of the tip from the planned one at every sample \[m\].
pub(super) fn tip_errors(execution: &Execution, robot: &RobotModel, tip: &Frame) -> Vec<f64> {
    let at = |q: &JointVector| robot.fk(q).rigid(tip).translation;
    let off = |sample: &Sample| (at(&sample.state.q) - at(&sample.commanded)).norm();
    execution.samples.iter().map(off).collect()
}

/// Errors over all samples that `of` takes, with the tip's errors at all samples.
pub(super) fn tracking(samples: &[Sample], tip_errors: &[f64]) -> Tracking {
    Tracking {
        tip_m: Spread::of(tip_errors.to_vec()),
        joints_rad: std::array::from_fn(|joint| {
            let error = |sample: &Sample| (sample.state.q[joint] - sample.commanded[joint]).abs();
            Spread::of(samples.iter().map(error).collect())
        }),
    }
}

/// Errors segment by segment; segments between two samples have zeros.
pub(super) fn by_segment(execution: &Execution, segments: &[PlanSegment], tip_errors: &[f64]) -> Vec<SegmentTracking> {
    let samples = &execution.samples;
    segments
        .iter()
        .enumerate()
        .map(|(index, segment)| {
            let from = samples.partition_point(|s| s.segment < index);
            let to = samples.partition_point(|s| s.segment <= index);
            SegmentTracking {
                kind: segment.kind,
                plate: segment.plate,
                span_s: [segment.t_start_s, segment.t_end_s],
                samples: to - from,
                tracking: tracking(&samples[from..to], &tip_errors[from..to]),
            }
        })
        .collect()
}
