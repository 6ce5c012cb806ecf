//! The law that a scenario names, refused where it cannot be stable.

use super::{ComputedTorque, ControlLaw, Gains, Kinematic, Loop, Pd, PdGravity, Stability, check};
use crate::dynamics::DynamicsModel;
use crate::plant::Plant;
use platewash_kinematics::words::{rounded, rounded_down, rounded_up};
use platewash_kinematics::{JointLimits, JointVector};
use platewash_planner::control::{ExactLaw, PaperLaw};
use platewash_planner::scenario::{ControlLawName, ControlSection};

/// Highest rate that is tried while looking for one that is stable \[Hz\]: the highest that `control.rate_hz` may be.
const HIGHEST_RATE_HZ: f64 = 1e5;

/// Halvings of a frequency in search of one that is stable: to a part in 10¹².
const MOST_HALVED: usize = 40;

/// Halvings of an interval in search of a limit: to a part in 10⁴.
const HALVINGS: u32 = 14;

/// Why a law was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// A number that makes no sense.
    #[error("control.{key} must be {expected}; found {found}")]
    Setting {
        /// The key.
        key: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it is.
        found: f64,
    },
    /// The paper's law is not stable.
    #[error(
        "control.law = \"paper\" is not stable with kp = {kp}, kd = {kd}, dt_s = {dt_s}: kd must lie between −1 and 1 and kp \
         be above 0 and below 2 (1 − kd) / dt_s = {}", rounded(*.kp_limit, DIGITS)
    )]
    UnstablePaper {
        /// Kp \[1/s\].
        kp: f64,
        /// Kd.
        kd: f64,
        /// Time step \[s\].
        dt_s: f64,
        /// Kp must be below this \[1/s\].
        kp_limit: f64,
    },
    /// The sampled loop is not stable.
    #[error(
        "control.law = \"{}\" is not stable sampled at {rate_hz} Hz (linearised about {}): {}",
        .law.name(), degrees(.q), remedy(*.least_rate_hz, *.highest_frequency_rad_s)
    )]
    Unstable {
        /// The law.
        law: ControlLawName,
        /// The rate asked for \[Hz\].
        rate_hz: f64,
        /// A configuration at which it is unstable \[rad\].
        q: JointVector,
        /// The least rate at which these gains are stable \[Hz\]; `None` where none that may be asked for is.
        least_rate_hz: Option<f64>,
        /// The highest frequency that is stable at this rate with this damping \[rad/s\]; `None` where gains are given
        /// outright or none is.
        highest_frequency_rad_s: Option<f64>,
    },
}

/// Significant digits of what is suggested.
const DIGITS: usize = 5;

fn degrees(q: &JointVector) -> String {
    let all: Vec<_> = q.iter().map(|v| format!("{:.0}", v.to_degrees())).collect();
    format!("({})°", all.join(", "))
}

fn remedy(rate: Option<f64>, frequency: Option<f64>) -> String {
    // Rounded towards what is stable: what is suggested holds when it is typed in.
    let rate = rate.map(|rate| rounded_up(rate, DIGITS));
    let frequency = frequency.map(|frequency| rounded_down(frequency, DIGITS));
    match (rate, frequency) {
        (Some(rate), Some(frequency)) => {
            format!("these gains need at least {rate} Hz, and at this rate frequency_rad_s must be at most {frequency}")
        }
        (Some(rate), None) => format!("these gains need at least {rate} Hz"),
        (None, Some(frequency)) => format!("at this rate frequency_rad_s must be at most {frequency}"),
        (None, None) => {
            "no rate that may be asked for would do: every kp and kd must be above 0 and not as large".to_owned()
        }
    }
}

impl ControlError {
    /// The same without the suggestion of a rate above `highest_hz`, which would be refused.
    #[must_use]
    pub fn with_rates_up_to(mut self, highest_hz: f64) -> Self {
        if let Self::Unstable { least_rate_hz, .. } = &mut self {
            *least_rate_hz = least_rate_hz.filter(|rate| rounded_up(*rate, DIGITS) <= highest_hz);
        }
        self
    }
}

/// A law without a plant: `exact`, otherwise the paper's, whose error obeys e_{k+1} = (1 − Kp dt − Kd) e_k + Kd e_{k−1} about a
/// constant target and is stable if and only if |Kd| < 1 and 0 < Kp dt < 2 (1 − Kd) (Jury's criterion).
///
/// # Errors
/// [`ControlError::UnstablePaper`].
pub fn kinematic(name: ControlLawName, section: &ControlSection) -> Result<Kinematic, ControlError> {
    if name == ControlLawName::Exact {
        return Ok(Kinematic(Box::new(ExactLaw)));
    }
    let ControlSection { kp, kd, dt_s, .. } = *section;
    let kp_limit = 2.0 * (1.0 - kd) / dt_s;
    if kd.abs() < 1.0 && kp > 0.0 && dt_s > 0.0 && kp < kp_limit {
        return Ok(Kinematic(Box::new(PaperLaw::new(kp, kd, dt_s))));
    }
    Err(ControlError::UnstablePaper { kp, kd, dt_s, kp_limit })
}

/// The law `name` with the settings of `section` on a plant, whose model it knows. `limits` bound the configurations from
/// which gains are scaled; the sampled loop must be stable about each of `configurations` \[rad\], with `substeps` steps of
/// integration a sample.
///
/// # Errors
/// [`ControlError`]: a setting that makes no sense, or a torque law that is not stable at its rate, with the limit.
pub fn law<'a>(
    name: ControlLawName,
    section: &ControlSection,
    plant: &'a Plant,
    limits: &JointLimits,
    configurations: &[JointVector],
    substeps: usize,
) -> Result<Box<dyn ControlLaw + 'a>, ControlError> {
    if name.is_kinematic() {
        return Ok(Box::new(kinematic(name, section)?));
    }
    settings(section)?;
    let (model, feed_forward) = (&plant.model, section.feed_forward);
    let gains = Gains::new(section, name, model, limits);
    let stability = Stability {
        of: match name {
            ControlLawName::ComputedTorque => Loop::Acceleration,
            _ => Loop::Torque,
        },
        gains,
        friction: plant.friction.largest(),
        integrator: plant.integrator,
        substeps: substeps.max(1),
    };
    check(&stability, section.rate_hz, model, configurations)
        .map_err(|q| unstable(name, section, &stability, q, (model, configurations)))?;
    Ok(match name {
        ControlLawName::ComputedTorque => Box::new(ComputedTorque {
            model,
            gains,
            feed_forward,
        }),
        ControlLawName::PdGravity => Box::new(PdGravity {
            model,
            gains,
            feed_forward,
        }),
        _ => Box::new(Pd { gains, feed_forward }),
    })
}

fn settings(section: &ControlSection) -> Result<(), ControlError> {
    let refuse = |key, expected, found| Err(ControlError::Setting { key, expected, found });
    let rate = section.rate_hz;
    if !(rate.is_finite() && rate > 0.0) {
        return refuse("rate_hz", "finite and above 0 Hz", rate);
    }
    let outright = [("joint_kp", section.joint_kp), ("joint_kd", section.joint_kd)];
    for (key, gains) in outright {
        let bad = gains.and_then(|gains| gains.into_iter().find(|k| !(k.is_finite() && *k >= 0.0)));
        if let Some(found) = bad {
            return refuse(key, "finite and not negative", found);
        }
    }
    if section.joint_kp.is_some() && section.joint_kd.is_some() {
        return Ok(());
    }
    for (key, found) in [
        ("frequency_rad_s", section.frequency_rad_s),
        ("damping_ratio", section.damping_ratio),
    ] {
        if !(found.is_finite() && found > 0.0) {
            return refuse(key, "finite and above 0", found);
        }
    }
    Ok(())
}

/// The refusal, with the limits that were passed.
fn unstable(
    law: ControlLawName,
    section: &ControlSection,
    stability: &Stability,
    q: JointVector,
    (model, configurations): (&DynamicsModel, &[JointVector]),
) -> ControlError {
    let rate_hz = section.rate_hz;
    let holds = |law: &Stability, rate: f64| check(law, rate, model, configurations).is_ok();
    let outright = section.joint_kp.is_some() && section.joint_kd.is_some();
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
        q,
        least_rate_hz,
        highest_frequency_rad_s: share.map(|share| share * section.frequency_rad_s),
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
