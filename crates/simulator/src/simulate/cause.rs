//! Why a plate is not washed, or less of it than planned.

use platewash_kinematics::words::told_apart;
use serde::Serialize;
use std::fmt;

/// Why less is swept than planned, or why a plate is not washed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "cause", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Cause {
    /// There is no tool body: the flange hovers.
    NoTool,
    /// The tip lifts off: it is farther above the plate than the sponge is compressed.
    Lifted {
        /// Share of the wash's samples.
        share: f64,
        /// Height of the tip, at most \[m\].
        most_m: f64,
        /// When \[s\].
        t_s: f64,
    },
    /// The arm sinks: the tip is deeper below the surface than the sponge is high, where in truth the plate would stop it.
    Sunk {
        /// Share of the wash's samples.
        share: f64,
        /// Depth of the tip, at most \[m\].
        most_m: f64,
        /// When \[s\].
        t_s: f64,
    },
    /// The tip strays sideways from its path by more than a tenth of the sponge's radius.
    Strayed {
        /// Root mean square of the horizontal distance \[m\].
        rms_m: f64,
        /// At most \[m\].
        most_m: f64,
        /// When \[s\].
        t_s: f64,
    },
    /// Less is surely swept than is required.
    NotSwept {
        /// What is surely swept.
        at_least: f64,
        /// What is required.
        required: f64,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (percent, mm) = (|share: f64| 100.0 * share, |length: f64| 1e3 * length);
        match *self {
            Self::NoTool => write!(f, "there is no tool body: the flange hovers"),
            Self::Lifted { share, most_m, t_s } => write!(
                f,
                "contact is lost for {:.1} % of the wash: the tip lifts by up to {:.1} mm (at {t_s:.3} s)",
                percent(share),
                mm(most_m)
            ),
            Self::Sunk { share, most_m, t_s } => write!(
                f,
                "the arm sinks for {:.1} % of the wash: the tip is up to {:.1} mm below the surface (at {t_s:.3} s), deeper than \
                 the sponge is high",
                percent(share),
                mm(most_m)
            ),
            Self::Strayed { rms_m, most_m, t_s } => write!(
                f,
                "the tip strays sideways by {:.1} mm rms, {:.1} mm at most (at {t_s:.3} s)",
                mm(rms_m),
                mm(most_m)
            ),
            Self::NotSwept { at_least, required } => {
                let [swept, required] = told_apart(percent(at_least), percent(required), 1);
                write!(f, "{swept} % is surely swept, {required} % is required")
            }
        }
    }
}
