//! Measures of an execution: torques, work and power, and the distance of the arm from the plan at the same time.

use crate::simulate::execution::{Execution, Sample};
use platewash_kinematics::{AXES, Frame, JointVector, RobotModel};
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use serde::Serialize;

/// Effort of a joint's motor.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct JointEffort {
    /// |τ| \[N·m\].
    pub torque_n_m: Spread,
    /// Largest |τ| as a share of the limit; `None` without a known limit.
    pub share_of_limit: Option<f64>,
    /// Work done by the motor, braking apart: Σ max(τ Δq, 0) \[J\].
    pub work_j: f64,
    /// Work taken up while braking: Σ max(−τ Δq, 0) \[J\].
    pub braking_j: f64,
    /// Largest |τ q̇| \[W\].
    pub power_w: f64,
}

/// Effort of all motors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Joint by joint.
    pub joints: [JointEffort; AXES],
    /// Work of all motors; energy from braking is not reused \[J\].
    pub work_j: f64,
    /// Share of the samples at which a torque limit cut the torque of the law.
    pub saturated_share: f64,
}

impl Effort {
    /// Effort in an execution; `None` under a kinematic law, which has no torques.
    #[must_use]
    pub(crate) fn measure(execution: &Execution) -> Option<Self> {
        let limits = execution.limits?;
        let joints = std::array::from_fn(|joint| {
            let torques: Vec<_> = execution.samples.iter().map(|s| s.torque[joint].abs()).collect();
            let torque_n_m = Spread::from_values(torques);
            let [work_j, braking_j] = work(execution, joint);
            let powers = execution
                .samples
                .iter()
                .map(|s| (s.torque[joint] * s.state.qd[joint]).abs());
            JointEffort {
                torque_n_m,
                share_of_limit: limits.0[joint].map(|most| torque_n_m.max / most),
                work_j,
                braking_j,
                power_w: powers.fold(0.0, f64::max),
            }
        });
        Some(Self {
            joints,
            work_j: joints.iter().map(|j| j.work_j).sum(),
            saturated_share: execution.saturated as f64 / execution.samples.len().max(1) as f64,
        })
    }
}

/// Work done and taken up by a joint: the torque is constant between samples, so that τ Δq is exact.
fn work(execution: &Execution, joint: usize) -> [f64; 2] {
    let steps = execution.samples.windows(2);
    steps.fold([0.0, 0.0], |[done, taken], pair| {
        let work = pair[0].torque[joint] * (pair[1].state.q[joint] - pair[0].state.q[joint]);
        [done + work.max(0.0), taken - work.min(0.0)]
    })
}

/// Size of errors.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Spread {
    /// Root mean square.
    pub rms: f64,
    /// 95 of 100 are not above it (the nearest rank).
    pub p95: f64,
    /// The largest.
    pub max: f64,
}

impl Spread {
    /// Spread of magnitudes, in any order; zeros for none.
    #[must_use]
    pub fn from_values(mut values: Vec<f64>) -> Self {
        if values.is_empty() {
            return Self::default();
        }
        let squares: f64 = values.iter().map(|v| v * v).sum();
        let rms = (squares / values.len() as f64).sqrt();
        let rank = (19 * values.len()).div_ceil(20) - 1;
        let (_, p95, above) = values.select_nth_unstable_by(rank, f64::total_cmp);
        let p95 = *p95;
        let max = above.iter().copied().fold(p95, f64::max);
        Self { rms, p95, max }
    }
}

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
    /// Kind of the segment.
    pub kind: SegmentKind,
    /// The plate washed, or the plate it leads to.
    pub plate: usize,
    /// Start and end in the plan \[s\].
    pub span_s: [f64; 2],
    /// Samples within it.
    pub samples: usize,
    /// Tracking errors of the segment.
    #[serde(flatten)]
    pub tracking: Tracking,
}

/// Distance of the tip from the planned one at every sample \[m\].
pub(crate) fn tip_errors(execution: &Execution, robot: &RobotModel, tip: &Frame) -> Vec<f64> {
    let at = |q: &JointVector| robot.fk(q).rigid(tip).translation;
    let off = |sample: &Sample| (at(&sample.state.q) - at(&sample.commanded)).norm();
    execution.samples.iter().map(off).collect()
}

/// Errors over all samples that `of` takes, with the tip's errors at all samples.
pub(crate) fn tracking(samples: &[Sample], tip_errors: &[f64]) -> Tracking {
    Tracking {
        tip_m: Spread::from_values(tip_errors.to_vec()),
        joints_rad: std::array::from_fn(|joint| {
            let error = |sample: &Sample| (sample.state.q[joint] - sample.commanded[joint]).abs();
            Spread::from_values(samples.iter().map(error).collect())
        }),
    }
}

/// Errors segment by segment; segments between two samples have zeros.
pub(crate) fn by_segment(execution: &Execution, segments: &[PlanSegment], tip_errors: &[f64]) -> Vec<SegmentTracking> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_counted_from_one() {
        let spread = Spread::from_values((1..=20).rev().map(f64::from).collect());
        assert_eq!((spread.p95, spread.max), (19.0, 20.0));
        assert!((spread.rms - (2870.0f64 / 20.0).sqrt()).abs() < 1e-15);
        let one = Spread::from_values(vec![3.0]);
        assert_eq!((one.rms, one.p95, one.max), (3.0, 3.0, 3.0));
        assert_eq!(Spread::from_values(Vec::new()), Spread::default());
        assert_eq!(Spread::from_values((1..=100).map(f64::from).collect()).p95, 95.0);
    }
}
