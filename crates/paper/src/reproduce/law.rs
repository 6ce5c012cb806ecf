//! The paper's control law as a filter, with a gain and a phase.

use super::row::Row;
use super::statistics::Estimate;
use crate::tracking::moved;
use platewash_kinematics::JointVector;
use platewash_kinematics::trig::{atan2, sin_cos};
use platewash_simulator::control::{ControlLaw, PaperLaw};
use platewash_workcell::simulation::ControlSettings;

/// Turn of the paper's spiral per waypoint \[rad\]: 3 turns in 54 steps.
const TURN_PER_WAYPOINT: f64 = 3.0 * std::f64::consts::TAU / 54.0;
/// Waypoints until the transient has died away (its factor is about 0.7 a step), and waypoints measured: whole periods.
const SETTLE: usize = 360;
const MEASURED: usize = 360;

/// Steady-state answer of a law to a sinusoidal command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrequencyResponse {
    /// Amplitude of the answer over that of the command.
    pub gain: f64,
    /// Phase of the answer against the command \[rad\]; negative when it lags.
    pub phase_rad: f64,
}

impl FrequencyResponse {
    /// Drives a law with `sin(turn·k)` and reads the answer **after** each step against the command of the same
    /// step, by correlation over whole periods. A law that drives torques moves nothing here.
    #[must_use]
    pub fn measure(law: &mut dyn ControlLaw, turn_per_step: f64) -> Self {
        law.begin_segment();
        let (mut q, mut in_phase, mut quadrature) = (JointVector::zeros(), 0.0, 0.0);
        for k in 0..SETTLE + MEASURED {
            let (s, c) = sin_cos(turn_per_step * k as f64);
            q = moved(law, &JointVector::repeat(s), q).unwrap_or(q);
            if k >= SETTLE {
                in_phase += q[0] * s;
                quadrature += q[0] * c;
            }
        }
        let scale = 2.0 / MEASURED as f64;
        Self {
            gain: scale * f64::sqrt(in_phase * in_phase + quadrature * quadrature),
            phase_rad: atan2(quadrature, in_phase),
        }
    }
}

/// Gain and phase of the paper's law.
pub(super) fn rows() -> [Row; 2] {
    const GROUP: &str = "The control law as a filter, at 20° per waypoint";
    let control = ControlSettings::default();
    let mut law = PaperLaw::new(control.kp, control.kd, control.dt_s);
    let FrequencyResponse { gain, phase_rad } = FrequencyResponse::measure(&mut law, TURN_PER_WAYPOINT);
    let quantities = [
        ("law_gain", "gain", "", 1.0, gain),
        ("law_phase", "phase", "deg", 0.0, phase_rad.to_degrees()),
    ];
    quantities.map(|(key, words, unit, paper, value)| Row::new(GROUP, key, words, unit, paper, Estimate::exact(value)))
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;

    /// The transfer function by hand: with a = Kp dt and b = Kd, q_k = q_{k−1} + a e_k + b (e_k − e_{k−1}) and
    /// e_k = r_k − q_{k−1} give H(z) = z ((a + b) z − b) / (z² − (1 − a − b) z − b).
    #[test]
    fn the_measured_response_is_that_of_the_transfer_function() {
        use nalgebra::Complex;
        for (kp, kd, turn) in [
            (20.0, 0.1, TURN_PER_WAYPOINT),
            (20.0, 0.1, TURN_PER_WAYPOINT / 2.0),
            (50.0, 0.0, TURN_PER_WAYPOINT),
        ] {
            let (a, b) = (kp * 0.01, kd);
            let z = Complex::new(f64::cos(turn), f64::sin(turn));
            let h = z * (z * (a + b) - b) / (z * z - z * (1.0 - a - b) - b);
            let found = FrequencyResponse::measure(&mut PaperLaw::new(kp, kd, 0.01), turn);
            assert!((found.gain - h.norm()).abs() < 1e-9, "{found:?} {}", h.norm());
            assert!((found.phase_rad - h.arg()).abs() < 1e-9);
        }
    }
}
