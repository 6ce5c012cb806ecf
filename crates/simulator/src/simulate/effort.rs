//! Torques, work and power.

use super::execution::Execution;
use super::statistics::Spread;
use platewash_kinematics::AXES;
use serde::Serialize;

/// What a joint's motor does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct JointEffort {
    /// |τ| \[N·m\].
    pub torque_n_m: Spread,
    /// Largest |τ| as a share of the limit; `None` where none is known.
    pub share_of_limit: Option<f64>,
    /// Work done by the motor, braking apart: Σ max(τ Δq, 0) \[J\].
    pub work_j: f64,
    /// Work taken up while braking: Σ max(−τ Δq, 0) \[J\].
    pub braking_j: f64,
    /// Largest |τ q̇| \[W\].
    pub power_w: f64,
}

/// What the motors do.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Joint by joint.
    pub joints: [JointEffort; AXES],
    /// Work of all motors, none of what braking takes up being used again \[J\].
    pub work_j: f64,
    /// Share of the samples at which a torque limit cut what the law asked for.
    pub saturated_share: f64,
}

impl Effort {
    /// Of an execution; `None` under a kinematic law, which has no torques.
    #[must_use]
    pub(super) fn of(execution: &Execution) -> Option<Self> {
        let limits = execution.limits?;
        let joints = std::array::from_fn(|joint| {
            let torques: Vec<_> = execution.samples.iter().map(|s| s.torque[joint].abs()).collect();
            let torque_n_m = Spread::of(torques);
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
