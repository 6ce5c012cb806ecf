//! The paper's law, to the letter.

use super::law::{Command, ControlLaw, Reference};
use crate::plant::PlantState;
use platewash_kinematics::JointVector;

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
