//! Why a law is refused.

use platewash_kinematics::JointVector;
use platewash_kinematics::words::{rounded, rounded_down, rounded_up};
use platewash_workcell::simulation::ControlLawName;

/// Reason that a law was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ControlError {
    /// A number that makes no sense.
    #[error("control: {name} must be {expected}; found {found}")]
    Setting {
        /// The field of the settings.
        name: &'static str,
        /// Range or kind of value required.
        expected: &'static str,
        /// Value found.
        found: f64,
    },
    /// A law that drives torques where one that moves positions is needed.
    #[error(
        "\"{}\" drives the torques of a plant; following waypoints, as the paper's program does, needs \"paper\" or \"exact\"",
        .law.name()
    )]
    NotKinematic {
        /// The law.
        law: ControlLawName,
    },
    /// The paper's law is not stable.
    #[error(
        "the law \"paper\" is not stable with kp = {kp}, kd = {kd} and a time step of {dt_s} s: kd must lie between −1 and 1, and kp \
         be above 0 and below 2 (1 − kd) / dt = {}", rounded(*.kp_limit, DIGITS)
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
        "the law \"{}\" is not stable sampled at {rate_hz} Hz (linearised about {}{}): {}",
        .law.name(), degrees(.q), if *.in_contact { ", the sponge on a plate" } else { "" }, remedy(*.least_rate_hz, *.highest_frequency_rad_s)
    )]
    Unstable {
        /// The law.
        law: ControlLawName,
        /// The rate asked for \[Hz\].
        rate_hz: f64,
        /// A configuration at which it is unstable \[rad\].
        q: JointVector,
        /// True where the sponge is on a plate there.
        in_contact: bool,
        /// The least rate at which these gains are stable \[Hz\]; `None` where none that may be asked for is.
        least_rate_hz: Option<f64>,
        /// The highest frequency that is stable at this rate with this damping \[rad/s\]; `None` where gains are given
        /// outright or none is.
        highest_frequency_rad_s: Option<f64>,
    },
}

/// Significant digits of suggested values.
const DIGITS: usize = 5;

fn degrees(q: &JointVector) -> String {
    let all: Vec<_> = q.iter().map(|v| format!("{:.0}", v.to_degrees())).collect();
    format!("({})°", all.join(", "))
}

fn remedy(rate: Option<f64>, frequency: Option<f64>) -> String {
    // Rounded towards stability: the suggested value is stable when it is typed in.
    let rate = rate.map(|rate| rounded_up(rate, DIGITS));
    let frequency = frequency.map(|frequency| rounded_down(frequency, DIGITS));
    match (rate, frequency) {
        (Some(rate), Some(frequency)) => {
            format!(
                "these gains need at least {rate} Hz, and at this rate the frequency must be at most {frequency} rad/s"
            )
        }
        (Some(rate), None) => format!("these gains need at least {rate} Hz"),
        (None, Some(frequency)) => format!("at this rate the frequency must be at most {frequency} rad/s"),
        (None, None) => {
            "no rate that may be asked for would do: every kp and kd must be above 0 and not as large".to_owned()
        }
    }
}

impl ControlError {
    /// The error without the suggestion of a rate above `highest_hz`, which would be refused.
    #[must_use]
    pub fn with_rates_up_to(mut self, highest_hz: f64) -> Self {
        if let Self::Unstable { least_rate_hz, .. } = &mut self {
            *least_rate_hz = least_rate_hz.filter(|rate| rounded_up(*rate, DIGITS) <= highest_hz);
        }
        self
    }
}
