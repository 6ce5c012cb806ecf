//! Stability of a sampled torque law, linearised about rest, and the limits within which a law that was refused would have been stable.
//!
//! About a configuration that the arm shall hold, with gravity's slope left out, x = (δq, δq̇) obeys
//! M δq̈ = −S δq − (D + C) δq̇ + u, u = −K x held over the sampling time T, K = (Kp, Kd) or M (Kp, Kd) for computed torque, D friction,
//! S and C stiffness and damping of foam on a plate where the sponge is on one.
//! Over a sample the integrator's own steps are a matrix, x ← A x. The loop is stable if and only if the eigenvalues of A
//! lie within the unit circle, and certainly if ‖Aⁿ‖ < 1 for some n, which repeated squaring finds.

use crate::control::error::ControlError;
use crate::control::laws::{Gains, Loop};
use crate::dynamics::{DynamicsModel, MassMatrix};
use crate::plant::ContactSlope;
use nalgebra::SMatrix;
use platewash_kinematics::JointVector;
use platewash_workcell::simulation::{ControlLawName, ControlSettings, Integrator};

/// Squarings: n up to 2²⁴ samples.
const SQUARINGS: u32 = 24;

/// A sampled law on a plant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stability {
    /// Quantity that the gains produce.
    pub of: Loop,
    /// The gains.
    pub gains: Gains,
    /// Friction per speed at rest \[N·m·s/rad\].
    pub friction: JointVector,
    /// Integrator of the plant.
    pub integrator: Integrator,
    /// Steps of integration to a sample.
    pub substeps: usize,
}

/// x = (δq, δq̇).
type Transition = SMatrix<f64, 12, 12>;

/// A configuration about which a loop is checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperatingPoint {
    /// Joint positions \[rad\].
    pub q: JointVector,
    /// The foam on a plate there; `None` where nothing touches.
    pub contact: Option<ContactSlope>,
}

impl From<JointVector> for OperatingPoint {
    fn from(q: JointVector) -> Self {
        Self { q, contact: None }
    }
}

/// Checks that the loop, sampled at `rate_hz`, is stable at all `configurations`.
///
/// # Errors
/// The first configuration at which it is not stable. Also where a gain is 0, because the joint then never comes back.
pub fn check(
    law: &Stability,
    rate_hz: f64,
    model: &DynamicsModel,
    configurations: &[OperatingPoint],
) -> Result<(), Box<OperatingPoint>> {
    let fails = |at: &&OperatingPoint| !law.is_stable(&model.mass_matrix(&at.q), at.contact.as_ref(), 1.0 / rate_hz);
    configurations
        .iter()
        .find(fails)
        .map_or(Ok(()), |at| Err(Box::new(*at)))
}

impl Stability {
    /// Checks that the loop is stable with the mass matrix `mass`, foam on a plate if there is any, and the sampling time
    /// `period_s`.
    #[must_use]
    pub fn is_stable(&self, mass: &MassMatrix, contact: Option<&ContactSlope>, period_s: f64) -> bool {
        self.transition(mass, contact, period_s).is_some_and(contracts)
    }

    /// A; `None` where the mass matrix is not positive definite.
    fn transition(&self, mass: &MassMatrix, contact: Option<&ContactSlope>, period_s: f64) -> Option<Transition> {
        let h = period_s / self.substeps as f64;
        let friction = MassMatrix::from_diagonal(&self.friction);
        let felt = match self.integrator {
            Integrator::SemiImplicitEuler => mass + friction * h,
            Integrator::Rk4 => *mass,
        };
        let inverse = felt.cholesky()?.inverse();
        let gain = |k: &JointVector| match self.of {
            Loop::Torque => inverse * MassMatrix::from_diagonal(k),
            Loop::Acceleration => inverse * mass * MassMatrix::from_diagonal(k),
        };
        let (stiffness, foam) = contact.map_or((MassMatrix::zeros(), MassMatrix::zeros()), |contact| {
            (contact.stiffness, contact.damping)
        });
        let (stiffness, damping) = (inverse * stiffness, inverse * (friction + foam));
        let (step, input) = match self.integrator {
            Integrator::SemiImplicitEuler => euler(&stiffness, &damping, h),
            Integrator::Rk4 => rk4(&stiffness, &damping, h),
        };
        // The torque is that of the sample's first state, until the next one.
        let (passed, forced) = repeated(step, input, self.substeps);
        let mut feedback = Transition::zeros();
        feedback.fixed_view_mut::<6, 6>(6, 0).copy_from(&-gain(&self.gains.kp));
        feedback.fixed_view_mut::<6, 6>(6, 6).copy_from(&-gain(&self.gains.kd));
        Some(passed + forced * feedback)
    }
}

/// Transition of state and input over `count` steps under one input, by doubling.
fn repeated(mut step: Transition, mut input: Transition, mut count: usize) -> (Transition, Transition) {
    let (mut passed, mut forced) = (Transition::identity(), Transition::zeros());
    while count > 0 {
        if count % 2 == 1 {
            forced = step * forced + input;
            passed = step * passed;
        }
        input += step * input;
        step *= step;
        count /= 2;
    }
    (passed, forced)
}

/// One step of semi-implicit Euler: its effect on the state, and on an acceleration in rows 6 to 11.
fn euler(stiffness: &MassMatrix, damping: &MassMatrix, h: f64) -> (Transition, Transition) {
    let speed = MassMatrix::identity() - damping * h;
    let mut step = Transition::identity();
    let drop = stiffness * h;
    step.fixed_view_mut::<6, 6>(0, 0)
        .copy_from(&(MassMatrix::identity() - drop * h));
    step.fixed_view_mut::<6, 6>(6, 0).copy_from(&-drop);
    step.fixed_view_mut::<6, 6>(0, 6).copy_from(&(speed * h));
    step.fixed_view_mut::<6, 6>(6, 6).copy_from(&speed);
    let mut input = Transition::zeros();
    input.fixed_view_mut::<6, 6>(0, 6).fill_diagonal(h * h);
    input.fixed_view_mut::<6, 6>(6, 6).fill_diagonal(h);
    (step, input)
}

/// The same for Runge–Kutta: Σ (hF)ᵏ/k! up to k = 4 of ẋ = F x + G u.
fn rk4(stiffness: &MassMatrix, damping: &MassMatrix, h: f64) -> (Transition, Transition) {
    let mut rate = Transition::zeros();
    rate.fixed_view_mut::<6, 6>(0, 6).fill_diagonal(h);
    rate.fixed_view_mut::<6, 6>(6, 0).copy_from(&(-stiffness * h));
    rate.fixed_view_mut::<6, 6>(6, 6).copy_from(&(-damping * h));
    let mut forced = Transition::zeros();
    forced.fixed_view_mut::<6, 6>(6, 6).fill_diagonal(h);
    let one = Transition::identity();
    let sum = one + rate / 2.0 * (one + rate / 3.0 * (one + rate / 4.0));
    (one + rate * sum, sum * forced)
}

/// Checks that some power of the matrix is smaller than 1.
fn contracts(mut power: Transition) -> bool {
    for _ in 0..=SQUARINGS {
        let size = power.norm();
        if size < 1.0 {
            return true;
        }
        if !size.is_finite() {
            return false;
        }
        power *= power;
    }
    false
}

/// Highest rate that is tried while looking for one that is stable \[Hz\]: the highest that a job may ask for.
const HIGHEST_RATE_HZ: f64 = 1e5;

/// Halvings of a frequency in search of one that is stable: to a part in 10¹².
const MOST_HALVED: usize = 40;

/// Halvings of an interval in search of a limit: to a part in 10⁴.
const HALVINGS: u32 = 14;

/// The refusal, with the limits that were passed.
pub(crate) fn unstable(
    law: ControlLawName,
    settings: &ControlSettings,
    stability: &Stability,
    at: &OperatingPoint,
    model: &DynamicsModel,
    configurations: &[OperatingPoint],
) -> ControlError {
    let rate_hz = settings.rate_hz;
    let holds = |law: &Stability, rate: f64| check(law, rate, model, configurations).is_ok();
    let outright = settings.joint_kp.is_some() && settings.joint_kd.is_some();
    // Gains go with ω² and ω.
    let slower = |share: f64| Stability {
        gains: Gains {
            kp: stability.gains.kp * (share * share),
            kd: stability.gains.kd * share,
        },
        ..*stability
    };
    let share = if outright {
        None
    } else {
        let stable = |share: &f64| holds(&slower(*share), rate_hz);
        let mut halves = std::iter::successors(Some(0.5), |share| Some(0.5 * share)).take(MOST_HALVED);
        halves
            .find(stable)
            .and_then(|share| boundary(share, 2.0 * share, |share| stable(&share)))
    };
    let mut high = rate_hz;
    while high < HIGHEST_RATE_HZ && !holds(stability, high) {
        high = (2.0 * high).min(HIGHEST_RATE_HZ);
    }
    let least_rate_hz = boundary(high, 0.5 * high, |rate| holds(stability, rate)).filter(|_| high <= HIGHEST_RATE_HZ);
    ControlError::Unstable {
        law,
        rate_hz,
        q: at.q,
        in_contact: at.contact.is_some(),
        least_rate_hz,
        highest_frequency_rad_s: share.map(|share| share * settings.frequency_rad_s),
    }
}

/// The value nearest to `beyond` that still holds, from `within`, which does.
fn boundary(mut within: f64, mut beyond: f64, holds: impl Fn(f64) -> bool) -> Option<f64> {
    if !holds(within) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (within + beyond);
        if holds(middle) {
            within = middle;
        } else {
            beyond = middle;
        }
    }
    Some(within)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubling_equals_repeating_the_step() {
        let (step, input) = euler(&(MassMatrix::identity() * 7.0), &(MassMatrix::identity() * 3.0), 0.01);
        for count in 0..20 {
            let (mut passed, mut forced) = (Transition::identity(), Transition::zeros());
            for _ in 0..count {
                passed = step * passed;
                forced = step * forced + input;
            }
            let (fast, pushed) = repeated(step, input, count);
            assert!(
                (fast - passed).amax() < 1e-14 && (pushed - forced).amax() < 1e-14,
                "{count}"
            );
        }
    }
}
