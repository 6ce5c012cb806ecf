//! Control laws behind one trait.
//!
//! | law | command | file |
//! | --- | --- | --- |
//! | `paper` | positions, the paper's low-pass filter to the letter | `laws.rs` |
//! | `exact` | the commanded positions themselves | `laws.rs` |
//! | `pd` | τ = Kp e + Kd ė | `laws.rs` |
//! | `pd_gravity` | that and g(q) | `laws.rs` |
//! | `computed_torque` | τ = M(q) (q̈_d + Kd ė + Kp e) + C(q, q̇) q̇ + g(q) | `laws.rs` |
//!
//! The trait: `laws.rs`. Gains and their source: `laws.rs`. Stability of the sampled loop: `stability.rs`. Reasons of a refusal:
//! `error.rs`; the limits within which a law is accepted: `stability.rs`.
//!
//! A further law is a name in [`ControlLawName`], a type in `laws.rs`, and the cases that the compiler then misses in [`kinematic`] and
//! [`law`].

mod error;
pub(crate) mod laws;
mod stability;

pub use crate::control::error::ControlError;
pub use crate::control::laws::{Command, ControlLaw, ExactLaw, Gains, Loop, PaperLaw, Reference, TorqueLaw};
pub use crate::control::stability::{OperatingPoint, Stability, check};

use crate::control::stability::unstable;
use crate::plant::Plant;
use platewash_kinematics::JointLimits;
use platewash_workcell::simulation::{ControlLawName, ControlSettings};

/// Returns the law `name` without a plant, as the paper's program needs, with any gains.
///
/// # Errors
/// [`ControlError::NotKinematic`] for a law that drives torques.
pub fn kinematic(name: ControlLawName, settings: &ControlSettings) -> Result<Box<dyn ControlLaw>, ControlError> {
    let ControlSettings { kp, kd, dt_s, .. } = *settings;
    match name {
        ControlLawName::Paper => Ok(Box::new(PaperLaw::new(kp, kd, dt_s))),
        ControlLawName::Exact => Ok(Box::new(ExactLaw)),
        ControlLawName::Pd | ControlLawName::PdGravity | ControlLawName::ComputedTorque => {
            Err(ControlError::NotKinematic { law: name })
        }
    }
}

/// Returns a law as [`kinematic`], and refuses it where it is not stable. About a constant target the error of the paper's law obeys
/// e_{k+1} = (1 − Kp dt − Kd) e_k + Kd e_{k−1}. It is stable if and only if |Kd| < 1 and 0 < Kp dt < 2 (1 − Kd) (Jury's criterion).
///
/// # Errors
/// [`ControlError::UnstablePaper`], and those of [`kinematic`].
pub fn stable_kinematic(name: ControlLawName, settings: &ControlSettings) -> Result<Box<dyn ControlLaw>, ControlError> {
    let ControlSettings { kp, kd, dt_s, .. } = *settings;
    let kp_limit = 2.0 * (1.0 - kd) / dt_s;
    let is_stable = kd.abs() < 1.0 && kp > 0.0 && dt_s > 0.0 && kp < kp_limit;
    if name == ControlLawName::Paper && !is_stable {
        return Err(ControlError::UnstablePaper { kp, kd, dt_s, kp_limit });
    }
    kinematic(name, settings)
}

/// The law `name` with its settings on a plant, whose model it knows. `limits` bound the configurations from which gains are scaled;
/// the sampled loop must be stable about each of `configurations`, with `substeps` steps of integration a sample.
///
/// # Errors
/// [`ControlError`]: a setting that makes no sense, or a law that is not stable at its rate, with the limit.
pub fn law<'a>(
    name: ControlLawName,
    settings: &ControlSettings,
    plant: &'a Plant,
    limits: &JointLimits,
    configurations: &[OperatingPoint],
    substeps: usize,
) -> Result<Box<dyn ControlLaw + 'a>, ControlError> {
    let of = match name {
        ControlLawName::Paper | ControlLawName::Exact => return stable_kinematic(name, settings),
        ControlLawName::Pd | ControlLawName::PdGravity => Loop::Torque,
        ControlLawName::ComputedTorque => Loop::Acceleration,
    };
    check_settings(settings)?;
    let model = &plant.model;
    let gains = Gains::new(settings, of, model, limits);
    let stability = Stability {
        of,
        gains,
        friction: plant.friction.largest(),
        integrator: plant.integrator,
        substeps: substeps.max(1),
    };
    check(&stability, settings.rate_hz, model, configurations)
        .map_err(|at| unstable(name, settings, &stability, &at, model, configurations))?;
    Ok(Box::new(TorqueLaw {
        name,
        model,
        gains,
        feed_forward: settings.feed_forward,
    }))
}

fn check_settings(settings: &ControlSettings) -> Result<(), ControlError> {
    let refuse = |name, expected, found| Err(ControlError::Setting { name, expected, found });
    let rate = settings.rate_hz;
    if !(rate.is_finite() && rate > 0.0) {
        return refuse("rate_hz", "finite and above 0 Hz", rate);
    }
    let outright = [("joint_kp", settings.joint_kp), ("joint_kd", settings.joint_kd)];
    for (name, gains) in outright {
        let bad = gains.and_then(|gains| gains.into_iter().find(|k| !(k.is_finite() && *k >= 0.0)));
        if let Some(found) = bad {
            return refuse(name, "finite and not negative", found);
        }
    }
    if settings.joint_kp.is_some() && settings.joint_kd.is_some() {
        return Ok(());
    }
    for (name, found) in [
        ("frequency_rad_s", settings.frequency_rad_s),
        ("damping_ratio", settings.damping_ratio),
    ] {
        if !(found.is_finite() && found > 0.0) {
            return refuse(name, "finite and above 0", found);
        }
    }
    Ok(())
}
