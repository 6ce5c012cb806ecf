//! Control laws that follow waypoints, one step a waypoint.

use crate::scenario::{ControlLawName, ControlSection};
use platewash_kinematics::JointVector;

/// A law that moves the joints towards the commanded configuration once per waypoint.
pub trait ControlLaw {
    /// Called before the first waypoint of every segment.
    fn begin_segment(&mut self);

    /// Joint positions \[rad\] one step after `position`, with `desired` commanded.
    fn step(&mut self, desired: &JointVector, position: &JointVector) -> JointVector;
}

/// The paper's "PD control", to the letter: `e = q_des − q`, `de = (e − e_prev)/dt`, `u = Kp e + Kd de`,
/// `q ← q + u dt`, with `e_prev` zero at the start of every segment.
///
/// There is no plant in it: `u` is a speed, and the law is the low-pass filter `q += Kp dt e + Kd Δe`.
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

    fn step(&mut self, desired: &JointVector, position: &JointVector) -> JointVector {
        let error = desired - position;
        let rate = (error - self.previous_error) / self.dt_s;
        self.previous_error = error;
        position + (error * self.kp + rate * self.kd) * self.dt_s
    }
}

/// The commanded configuration is taken at once: a perfect servo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExactLaw;

impl ControlLaw for ExactLaw {
    fn begin_segment(&mut self) {}

    fn step(&mut self, desired: &JointVector, _position: &JointVector) -> JointVector {
        *desired
    }
}

/// A law that drives torques where one that moves positions is needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "\"{}\" drives the torques of a plant; following waypoints, as the paper's program does, needs \"paper\" or \"exact\"",
    .0.name()
)]
pub struct NotKinematic(pub ControlLawName);

/// The law that a section names; the paper's where it names none.
///
/// # Errors
/// [`NotKinematic`] for a law that drives torques.
pub fn law(section: &ControlSection) -> Result<Box<dyn ControlLaw>, NotKinematic> {
    match section.law.unwrap_or(ControlLawName::Paper) {
        ControlLawName::Paper => Ok(Box::new(PaperLaw::new(section.kp, section.kd, section.dt_s))),
        ControlLawName::Exact => Ok(Box::new(ExactLaw)),
        torque => Err(NotKinematic(torque)),
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
        let target = JointVector::repeat(1.0);
        let q1 = law.step(&target, &JointVector::zeros());
        let q2 = law.step(&target, &q1);
        assert!((q1 - JointVector::repeat(0.3)).amax() < 1e-15);
        assert!((q2 - JointVector::repeat(0.41)).amax() < 1e-15);
        law.begin_segment();
        let again = law.step(&target, &JointVector::zeros());
        assert_eq!(again, q1, "the previous error is forgotten between segments");
    }
}
