//! Within which limits a law that was refused would have been stable.

use super::error::ControlError;
use super::gains::Gains;
use super::stability::{Stability, Standing, check};
use crate::dynamics::DynamicsModel;
use platewash_workcell::simulation::{ControlLawName, ControlSettings};

/// Highest rate that is tried while looking for one that is stable \[Hz\]: the highest that a job may ask for.
const HIGHEST_RATE_HZ: f64 = 1e5;

/// Halvings of a frequency in search of one that is stable: to a part in 10¹².
const MOST_HALVED: usize = 40;

/// Halvings of an interval in search of a limit: to a part in 10⁴.
const HALVINGS: u32 = 14;

/// The refusal, with the limits that were passed.
pub(super) fn unstable(
    law: ControlLawName,
    settings: &ControlSettings,
    stability: &Stability,
    at: &Standing,
    (model, configurations): (&DynamicsModel, &[Standing]),
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
