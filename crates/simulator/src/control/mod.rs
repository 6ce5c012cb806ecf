//! Control laws behind one trait.
//!
//! | law | what it commands | file |
//! | --- | --- | --- |
//! | `paper` | positions, the paper's low-pass filter to the letter | `kinematic.rs` |
//! | `exact` | the commanded positions themselves | `kinematic.rs` |
//! | `pd` | τ = Kp e + Kd ė | `pd.rs` |
//! | `pd_gravity` | the same + g(q) | `pd_gravity.rs` |
//! | `computed_torque` | τ = M(q) (q̈_d + Kd ė + Kp e) + C(q, q̇) q̇ + g(q) | `computed_torque.rs` |
//!
//! Gains and where they come from: `gains.rs`. Whether the sampled loop is stable: `stability.rs`. The law that a scenario
//! names: `named.rs`.

mod computed_torque;
mod gains;
mod kinematic;
mod named;
mod pd;
mod pd_gravity;
mod stability;

pub use computed_torque::ComputedTorque;
pub use gains::Gains;
pub use kinematic::Kinematic;
pub use named::{ControlError, kinematic, law};
pub use pd::Pd;
pub use pd_gravity::PdGravity;
pub use stability::{Loop, Stability, check};

use crate::plant::PlantState;
use platewash_kinematics::JointVector;
use platewash_workcell::trajectory::JointState;

/// What is asked of the arm at a sample and at the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// At the sample.
    pub now: JointState,
    /// At the next one.
    pub next: JointState,
}

/// What a law answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Command {
    /// Joint torques, held until the next sample \[N·m\].
    Torque(JointVector),
    /// Joint positions at the next sample \[rad\]: there is no plant.
    Position(JointVector),
}

/// A law that follows a commanded motion, sampled.
pub trait ControlLaw: std::fmt::Debug {
    /// Called before the first sample of every segment of the plan.
    fn begin_segment(&mut self) {}

    /// The answer at one sample.
    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command;
}

/// Errors of position and speed \[rad, rad/s\].
fn errors(
    reference: &JointState,
    state: &PlantState,
    feed: platewash_planner::scenario::FeedForward,
) -> (JointVector, JointVector) {
    use platewash_planner::scenario::FeedForward;
    let speed = match feed {
        FeedForward::Velocity => reference.qd - state.qd,
        FeedForward::None => -state.qd,
    };
    (reference.q - state.q, speed)
}
