//! Control laws: their input and output, and each law by its equation.
//!
//! Computed torque: the arm's own model makes every joint a double integrator.

use crate::dynamics::DynamicsModel;
use crate::plant::PlantState;
use platewash_kinematics::{JointLimits, JointVector};
use platewash_motion::trajectory::JointState;
use platewash_workcell::simulation::{ControlLawName, ControlSettings, FeedForward};

/// Commanded states at a sample and at the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// State at the sample.
    pub now: JointState,
    /// State at the next sample.
    pub next: JointState,
}

impl Reference {
    /// Reference at rest at `q` \[rad\], now and at the next sample: a waypoint.
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
    pub(crate) fn errors(&self, state: &PlantState, feed: FeedForward) -> (JointVector, JointVector) {
        let speed = match feed {
            FeedForward::Velocity => self.now.qd - state.qd,
            FeedForward::None => -state.qd,
        };
        (self.now.q - state.q, speed)
    }
}

/// Output of a law.
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

/// The commanded configuration is taken at once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExactLaw;

impl ControlLaw for ExactLaw {
    fn command(&mut self, reference: &Reference, _state: &PlantState) -> Command {
        Command::Position(reference.next.q)
    }
}

/// Proportional and derivative gains, joint by joint: \[N·m/rad\] and \[N·m·s/rad\], or \[1/s²\] and \[1/s\] for computed
/// torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Kp.
    pub kp: JointVector,
    /// Kd.
    pub kd: JointVector,
}

/// Quantity that the gains produce.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loop {
    /// Torques: `pd` and `pd_gravity`.
    Torque,
    /// Accelerations: `computed_torque`.
    Acceleration,
}

impl Gains {
    /// Kp = M ω², Kd = 2 ζ ω M: a joint of inertia M alone is then a second-order system of natural frequency ω \[rad/s\] and
    /// damping ratio ζ.
    #[must_use]
    pub fn of_frequency(inertia_kg_m2: &JointVector, frequency_rad_s: f64, damping_ratio: f64) -> Self {
        Self {
            kp: inertia_kg_m2 * (frequency_rad_s * frequency_rad_s),
            kd: inertia_kg_m2 * (2.0 * damping_ratio * frequency_rad_s),
        }
    }

    /// Gains of the settings: given outright, or from frequency and damping with M, each joint's largest inertia within the
    /// limits; M is 1 where the gains produce accelerations.
    #[must_use]
    pub fn new(settings: &ControlSettings, of: Loop, model: &DynamicsModel, limits: &JointLimits) -> Self {
        if let (Some(kp), Some(kd)) = (settings.joint_kp, settings.joint_kd) {
            return Self {
                kp: kp.into(),
                kd: kd.into(),
            };
        }
        let inertia = match of {
            Loop::Acceleration => JointVector::repeat(1.0),
            Loop::Torque => model.largest_inertias(limits),
        };
        Self::of_frequency(&inertia, settings.frequency_rad_s, settings.damping_ratio)
    }
}

/// The paper's "PD control", to the letter: `e = q_des − q`, `de = (e − e_prev)/dt`, `u = Kp e + Kd de`,
/// `q ← q + u dt`, with `e_prev` zero at the start of every segment.
///
/// There is no plant in it: `u` is a speed, and the law is the low-pass filter `q += Kp dt e + Kd Δe`. It steps once a sample towards
/// the next sample's configuration, as the paper's program steps towards the next waypoint.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperLaw {
    /// Kp \[1/s\].
    pub kp: f64,
    /// Kd.
    pub kd: f64,
    /// Time step \[s\].
    pub dt_s: f64,
    previous_error: JointVector,
}

impl PaperLaw {
    /// The law with the given gains and time step.
    #[must_use]
    pub fn new(kp: f64, kd: f64, dt_s: f64) -> Self {
        Self {
            kp,
            kd,
            dt_s,
            previous_error: JointVector::zeros(),
        }
    }
}

impl ControlLaw for PaperLaw {
    fn begin_segment(&mut self) {
        self.previous_error = JointVector::zeros();
    }

    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command {
        let position = &state.q;
        let error = reference.next.q - position;
        let rate = (error - self.previous_error) / self.dt_s;
        self.previous_error = error;
        Command::Position(position + (error * self.kp + rate * self.kd) * self.dt_s)
    }
}

/// A law that drives the torques of a plant, with e = q_d − q and gains \[N·m/rad, N·m·s/rad\], or \[1/s², 1/s\] for the last one:
///
/// - `pd`: τ = Kp e + Kd ė. Nothing holds the arm up: where it rests, Kp e = g(q).
/// - `pd_gravity`: τ = Kp e + Kd ė + g(q). At rest the error is zero (Takegaki, Arimoto, *J. Dyn. Sys. Meas. Control* 103, 1981); in motion
///   it is the error that the accelerations require, about q̈_d/ω².
/// - `computed_torque`: τ = M(q) (q̈_d + Kd ė + Kp e) + C(q, q̇) q̇ + g(q), one inverse dynamics; then ë + Kd ė + Kp e = 0 (Lynch, Park, *Modern
///   Robotics*, §11.4.2).
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueLaw<'a> {
    /// One of these; any other is `pd`.
    pub name: ControlLawName,
    /// The arm as the law believes it to be.
    pub model: &'a DynamicsModel,
    /// Gains of the law.
    pub gains: Gains,
    /// Choice of ė, the error's or the arm's alone; and use of the accelerations of the commanded motion.
    pub feed_forward: FeedForward,
}

impl ControlLaw for TorqueLaw<'_> {
    fn command(&mut self, reference: &Reference, state: &PlantState) -> Command {
        let (position, speed) = reference.errors(state, self.feed_forward);
        let correction = self.gains.kp.component_mul(&position) + self.gains.kd.component_mul(&speed);
        Command::Torque(match self.name {
            ControlLawName::PdGravity => self.model.gravity_torque(&state.q) + correction,
            ControlLawName::ComputedTorque => {
                let wanted = match self.feed_forward {
                    FeedForward::Velocity => reference.now.qdd + correction,
                    FeedForward::None => correction,
                };
                self.model.inverse_dynamics(&state.q, &state.qd, &wanted)
            }
            _ => correction,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand with Kp = 20, Kd = 0.1, dt = 0.01 towards a constant 1:
    /// e₁ = 1, q₁ = 0.2·1 + 0.1·(1 − 0) = 0.3; e₂ = 0.7, q₂ = 0.3 + 0.2·0.7 + 0.1·(0.7 − 1) = 0.41.
    #[test]
    fn the_papers_law_steps_as_written() {
        let mut law = PaperLaw::new(20.0, 0.1, 0.01);
        let target = Reference::towards(JointVector::repeat(1.0));
        let mut step = |q: JointVector| match law.command(&target, &PlantState::at_rest(q)) {
            Command::Position(q) => q,
            Command::Torque(_) => JointVector::repeat(f64::NAN),
        };
        let q1 = step(JointVector::zeros());
        let q2 = step(q1);
        assert!((q1 - JointVector::repeat(0.3)).amax() < 1e-15);
        assert!((q2 - JointVector::repeat(0.41)).amax() < 1e-15);
        law.begin_segment();
        let again = law.command(&target, &PlantState::at_rest(JointVector::zeros()));
        assert_eq!(
            again,
            Command::Position(q1),
            "the previous error is forgotten between segments"
        );
    }
}
