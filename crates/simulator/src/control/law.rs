//! What every law is asked and answers.

use crate::plant::PlantState;
use platewash_kinematics::JointVector;
use platewash_workcell::simulation::FeedForward;
use platewash_workcell::trajectory::JointState;

/// What is asked of the arm at a sample and at the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// At the sample.
    pub now: JointState,
    /// At the next one.
    pub next: JointState,
}

impl Reference {
    /// To be at rest at `q` \[rad\], now and at the next sample: a waypoint.
    #[must_use]
    pub fn towards(q: JointVector) -> Self {
        let still = JointVector::zeros();
        let now = JointState {
            q,
            qd: still,
            qdd: still,
        };
        Self { now, next: now }
    }

    /// Errors of position and speed at the sample \[rad, rad/s\].
    pub(super) fn errors(&self, state: &PlantState, feed: FeedForward) -> (JointVector, JointVector) {
        let speed = match feed {
            FeedForward::Velocity => self.now.qd - state.qd,
            FeedForward::None => -state.qd,
        };
        (self.now.q - state.q, speed)
    }
}

/// What a law answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Command {
    /// Joint torques, held until the next sample \[N·m\].
    Torque(JointVector),
    /// Joint positions at the next sample \[rad\]: there is no plant.
    Position(JointVector),
}

/// A law that follows a commanded motion, sampled; or waypoints, one sample a waypoint.
pub trait ControlLaw: std::fmt::Debug {
    /// Called before the first sample of every segment of the plan.
    fn begin_segment(&mut self) {}

    /// The answer at one sample.
    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command;
}
