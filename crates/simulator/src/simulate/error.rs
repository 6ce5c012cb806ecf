//! Errors of a simulation.
//!
//! Also here: checks of its settings.

use crate::control::ControlError;
use crate::dynamics::DynamicsError;
use crate::simulate::run::{MAX_SAMPLES, MAX_STEPS, highest_rate, shortest_period};
use platewash_kinematics::words::rounded_up;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::coverage::CoverageError;
use platewash_workcell::job::JobError;
use platewash_workcell::simulation::{FoamContact, PlantSettings, SimulationSettings};
use platewash_workcell::tool::Tool;
use platewash_workcell::trajectory::KnotError;
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
    Job(#[from] JobError),
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

/// Stiffer, or damped more, is no foam \[Pa, Pa·s\].
const STIFFEST_PA: f64 = 1e9;

/// Largest excess of a stiffness over the bounds of the sponge's range, as a part of them.
const ROUNDING: f64 = 1e-12;

/// Checks the settings that the law does not check by itself; a plan file may state any value.
pub(crate) fn check(settings: &SimulationSettings, tool: &Tool) -> Result<(), SimulationError> {
    check_period(settings)?;
    check_plant(&settings.plant)?;
    match &settings.plant.contact {
        Some(contact) if !settings.law.is_kinematic() => check_contact(&settings.plant, contact, tool),
        _ => Ok(()),
    }
}

/// Checks that the foam is within the sponge's stated range, and that no other force is set.
fn check_contact(plant: &PlantSettings, contact: &FoamContact, tool: &Tool) -> Result<(), SimulationError> {
    let refuse = |name, expected, found| Err(SimulationError::Setting { name, expected, found });
    if plant.contact_force_n > 0.0 {
        let expected = "0 where foam pushes back (contact): one of both";
        return refuse("contact_force_n", expected, plant.contact_force_n);
    }
    let FoamContact {
        stiffness_pa,
        damping_pa_s,
    } = *contact;
    if !(stiffness_pa > 0.0 && stiffness_pa <= STIFFEST_PA) {
        return refuse("contact_stiffness_pa", "above 0 and at most 1e9 Pa", stiffness_pa);
    }
    if !(0.0..=STIFFEST_PA).contains(&damping_pa_s) {
        return refuse("contact_damping_pa_s", "from 0 to 1e9 Pa·s", damping_pa_s);
    }
    let height_m = tool.sponge.free_height_m();
    if !(tool.is_present() && height_m > 0.0 && tool.sponge.radius_m > 0.0) {
        return Err(SimulationError::NoSponge);
    }
    match tool.sponge.stiffness_pa {
        // The bounds themselves are within, however they were rounded on their way from a file.
        Some([least, most])
            if !(stiffness_pa >= least * (1.0 - ROUNDING) && stiffness_pa <= most * (1.0 + ROUNDING)) =>
        {
            Err(SimulationError::Stiffness {
                range_pa: [least, most],
                found_pa: stiffness_pa,
            })
        }
        _ => Ok(()),
    }
}

fn check_period(settings: &SimulationSettings) -> Result<(), ControlError> {
    let period = settings.period_s();
    if period.is_finite() && period > 0.0 {
        return Ok(());
    }
    let (name, found) = if settings.law.is_kinematic() {
        ("dt_s", settings.control.dt_s)
    } else {
        ("rate_hz", settings.control.rate_hz)
    };
    let expected = "finite and above 0";
    Err(ControlError::Setting { name, expected, found })
}

fn check_plant(plant: &PlantSettings) -> Result<(), SimulationError> {
    let refuse = |name, expected, found| Err(SimulationError::Setting { name, expected, found });
    if !(1..=1000).contains(&plant.substeps) {
        return refuse("substeps", "from 1 to 1000", plant.substeps as f64);
    }
    let friction = [
        ("viscous_friction_n_m_s", plant.viscous_friction_n_m_s),
        ("coulomb_friction_n_m", plant.coulomb_friction_n_m),
        ("contact_force_n", [plant.contact_force_n; 6]),
    ];
    for (name, values) in friction {
        if let Some(found) = values.into_iter().find(|v| !(v.is_finite() && *v >= 0.0)) {
            return refuse(name, "finite and not negative", found);
        }
    }
    let limits = plant.torque_limit_n_m.into_iter().flatten();
    if let Some(found) = limits.into_iter().find(|v| !(v.is_finite() && *v > 0.0)) {
        return refuse("torque_limit_n_m", "finite and above 0", found);
    }
    Ok(())
}
