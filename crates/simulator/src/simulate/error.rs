//! Why a plan could not be simulated.

use crate::control::ControlError;
use crate::dynamics::DynamicsError;
use platewash_kinematics::words::{rounded_down, rounded_up};
use platewash_workcell::coverage::CoverageError;
use platewash_workcell::trajectory::KnotError;
use platewash_workcell::words::counted;

/// Significant digits of a rate or period that is suggested.
const DIGITS: usize = 3;

/// Periods of an execution that is not too much work, but for two of rounding.
fn most_periods(substeps: usize) -> f64 {
    super::MAX_SAMPLES
        .min(super::MAX_STEPS / substeps.max(1))
        .saturating_sub(3) as f64
}

/// A rate \[Hz\] at which so much motion is not too much work.
pub(super) fn highest_rate(duration_s: f64, substeps: usize) -> f64 {
    rounded_down(most_periods(substeps) / duration_s, DIGITS)
}

/// A period \[s\] with which it is not.
fn shortest_period(duration_s: f64, substeps: usize) -> f64 {
    rounded_up(duration_s / most_periods(substeps), DIGITS)
}

/// Why a plan could not be simulated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// The plan is for another arm.
    #[error("the plan is for the URDF with SHA-256 {planned}, the arm given has {given}")]
    OtherArm {
        /// Hash in the plan.
        planned: String,
        /// Hash of the arm.
        given: String,
    },
    /// The plan's knots are no motion.
    #[error("plan: {0}")]
    Knots(#[from] KnotError),
    /// The plan has no motion or no segments.
    #[error("plan: there is nothing to simulate: {knots} knots and {segments} segments")]
    Empty {
        /// Knots.
        knots: usize,
        /// Segments.
        segments: usize,
    },
    /// A segment names a plate that is not there.
    #[error("plan: segment {segment} names plate {plate}; there are {plates}")]
    Plate {
        /// Index of the segment.
        segment: usize,
        /// The plate it names.
        plate: usize,
        /// Plates of the plan.
        plates: usize,
    },
    /// A setting that makes no sense.
    #[error("{key} must be {expected}; found {found}")]
    Setting {
        /// The key of the scenario.
        key: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it is.
        found: f64,
    },
    /// So much work that it would not end soon.
    #[error(
        "{duration_s:.2} s at {rate_hz} Hz with {} a sample are too much work: at most {} samples and {} steps; \
         with as many steps a sample, control.rate_hz must be at most {} (for laws without a plant: control.dt_s at least {})",
        counted(*.substeps, "step"), super::MAX_SAMPLES, super::MAX_STEPS,
        highest_rate(*.duration_s, *.substeps), shortest_period(*.duration_s, *.substeps)
    )]
    TooLong {
        /// Duration of the plan \[s\].
        duration_s: f64,
        /// Samples a second.
        rate_hz: f64,
        /// Steps a sample.
        substeps: usize,
    },
    /// The arm has no dynamics.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// The law was refused.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The arm leaves all bounds.
    #[error(
        "the arm diverges: joint {} is at {position_rad:.3e} rad, moving at {speed_rad_s:.3e} rad/s, after {t_s:.4} s; raise \
         control.rate_hz or plant.substeps, or lower the gains", .joint + 1
    )]
    Divergence {
        /// When \[s\].
        t_s: f64,
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Where it is \[rad\].
        position_rad: f64,
        /// How fast it moves \[rad/s\].
        speed_rad_s: f64,
    },
    /// Coverage could not be measured.
    #[error("coverage: {0}")]
    Coverage(#[from] CoverageError),
}
