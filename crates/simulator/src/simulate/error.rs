//! Errors of a simulation.

use crate::control::ControlError;
use crate::dynamics::DynamicsError;
use crate::simulate::amount::{MAX_SAMPLES, MAX_STEPS, highest_rate, shortest_period};
use platewash_bodies::coverage::CoverageError;
use platewash_kinematics::words::rounded_up;
use platewash_motion::trajectory::KnotError;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::TermsError;
use platewash_workcell::words::{count_with_noun, plate_name};

/// Significant digits of a rate that is suggested.
const RATE_DIGITS: usize = 5;

/// Reason that a plan could not be simulated.
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
    /// The plan's job is none.
    #[error("plan: {0}")]
    Job(#[from] TermsError),
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
    #[error("plan: segment {segment} names {}; there are {plates}", plate_name(*.plate))]
    Plate {
        /// Index of the segment.
        segment: usize,
        /// The plate it names.
        plate: usize,
        /// Plates of the plan.
        plates: usize,
    },
    /// A setting of the plant that makes no sense.
    #[error("plant: {name} must be {expected}; found {found}")]
    Setting {
        /// The field of the settings.
        name: &'static str,
        /// Range or kind of value required.
        expected: &'static str,
        /// Value found.
        found: f64,
    },
    /// Foam that shall push back, on no sponge.
    #[error("plant: contact needs a tool with a sponge of some radius and height")]
    NoSponge,
    /// A stiffness that the sponge does not have.
    #[error(
        "plant: contact_stiffness_pa must be from {} to {}, as the sponge is stated; found {found_pa}", .range_pa[0], .range_pa[1]
    )]
    Stiffness {
        /// Least and greatest of the sponge \[Pa\].
        range_pa: [f64; 2],
        /// Stiffness asked for \[Pa\].
        found_pa: f64,
    },
    /// Foam that is too stiff for the steps of integration.
    #[error(
        "the sponge's contact is not stable with a stiffness of {stiffness_pa} Pa, integrated with {} a sample at {rate_hz} Hz: it needs at least {} \
         steps a sample, or {} Hz", count_with_noun(*.substeps, "step"), least_substeps, rounded_up(*.least_rate_hz, RATE_DIGITS)
    )]
    StiffContact {
        /// The stiffness \[Pa\].
        stiffness_pa: f64,
        /// Samples a second.
        rate_hz: f64,
        /// Steps a sample.
        substeps: usize,
        /// Least number of integration steps per sample that is stable at this rate.
        least_substeps: usize,
        /// A rate that does with as many steps \[Hz\].
        least_rate_hz: f64,
    },
    /// So much work that it would not end soon.
    #[error(
        "{duration_s:.2} s at {rate_hz} Hz with {} a sample are too much work: at most {} samples and {} steps; \
         with as many steps a sample, the rate must be at most {} Hz (for laws without a plant: the time step at least {} s)",
        count_with_noun(*.substeps, "step"), MAX_SAMPLES, MAX_STEPS,
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
         the rate or the steps a sample, or lower the gains", .joint + 1
    )]
    Divergence {
        /// Time in the simulation \[s\].
        t_s: f64,
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Position of the joint \[rad\].
        position_rad: f64,
        /// Speed of the joint \[rad/s\].
        speed_rad_s: f64,
    },
    /// The work was cancelled on request.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Coverage could not be measured.
    #[error("coverage: {0}")]
    Coverage(#[from] CoverageError),
}
