//! Hindrances of the arm at a contact point: the filters of a configuration, one per variant.

use platewash_bodies::clearance::PairClearance;
use platewash_kinematics::LimitViolation;
use platewash_kinematics::ik::analytic::{AnalyticError, OutOfReach, Rejection};
use platewash_kinematics::ik::{IkCause, IkError};
use platewash_kinematics::words::{distinct_decimals, nonzero_decimals};
use serde::Serialize;
use std::fmt;

/// Reason that a contact point cannot be washed at a tilt in a configuration of the arm.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Hindrance {
    /// The wrist cannot be where it must.
    #[error("out of reach by {} mm", nonzero_decimals(1e3 * .0.by_m, 1))]
    Reach(OutOfReach),
    /// A joint would be beyond its limit.
    #[error(
        "joint {} is {}° beyond its limit of {:.2}°",
        .0.joint + 1, nonzero_decimals((.0.position_rad - .0.limit_rad).abs().to_degrees(), 2), .0.limit_rad.to_degrees()
    )]
    Limit(LimitViolation),
    /// The numeric inverse kinematics found nothing.
    #[error("inverse kinematics: {cause}, {:.1} mm off", 1e3 * position_error_m)]
    Unsolved {
        /// Cause reported by the inverse kinematics.
        cause: IkCause,
        /// Distance of the tip of the best configuration from the target \[m\].
        position_error_m: f64,
    },
    /// Two bodies are too near.
    #[error(
        "{} is {} mm from {}; {} mm must be kept",
        pair.a, distinct_decimals(1e3 * pair.distance_m, 1e3 * required_m, 1)[0],
        pair.b, distinct_decimals(1e3 * pair.distance_m, 1e3 * required_m, 1)[1]
    )]
    Clearance {
        /// The bodies.
        pair: Box<PairClearance>,
        /// Clearance required of the pair \[m\].
        required_m: f64,
    },
    /// A joint would have to move too far from the last contact point.
    #[error("joint {} would have to jump by {:.1}°", joint + 1, by_rad.to_degrees())]
    Jump {
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Size of the jump \[rad\].
        by_rad: f64,
    },
    /// Joint 5 would be too near to 0, or on its other side.
    #[error("joint 5 is {}° from 0, where the wrist flips; {:.2}° must be kept", nonzero_decimals(.found_rad.to_degrees(), 2), .least_rad.to_degrees())]
    Wrist {
        /// Angle of joint 5 from 0 \[rad\].
        found_rad: f64,
        /// Least angle required \[rad\].
        least_rad: f64,
    },
    /// The tool would lean too far from the normal of the face.
    #[error("the tool leans {:.2}° from the normal, at most {:.2}° are planned", .found_rad.to_degrees(), .most_rad.to_degrees())]
    Cone {
        /// Lean of the tool \[rad\].
        found_rad: f64,
        /// Largest lean allowed \[rad\].
        most_rad: f64,
    },
    /// The pose or the start of the arm is not finite.
    #[error("not finite")]
    NotFinite,
}

/// The kinds of [`Hindrance`], for counting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Filter {
    /// [`Hindrance::Reach`] and [`Hindrance::Unsolved`].
    Reach,
    /// [`Hindrance::Limit`].
    Limit,
    /// [`Hindrance::Clearance`].
    Clearance,
    /// [`Hindrance::Jump`].
    Continuity,
    /// [`Hindrance::Wrist`].
    Wrist,
    /// [`Hindrance::Cone`].
    Cone,
    /// [`Hindrance::NotFinite`].
    Numbers,
}

impl Hindrance {
    /// Its kind.
    #[must_use]
    pub fn filter(&self) -> Filter {
        match self {
            Self::Reach(_) | Self::Unsolved { .. } => Filter::Reach,
            Self::Limit(_) => Filter::Limit,
            Self::Clearance { .. } => Filter::Clearance,
            Self::Jump { .. } => Filter::Continuity,
            Self::Wrist { .. } => Filter::Wrist,
            Self::Cone { .. } => Filter::Cone,
            Self::NotFinite => Filter::Numbers,
        }
    }

    /// Amount by which the requirement is missed, in the unit of its kind: m for reach and clearance, rad for limits and jumps.
    #[must_use]
    pub fn shortfall(&self) -> f64 {
        match self {
            Self::Reach(miss) => miss.by_m,
            Self::Unsolved { position_error_m, .. } => *position_error_m,
            Self::Limit(violation) => (violation.position_rad - violation.limit_rad).abs(),
            Self::Clearance { pair, required_m } => required_m - pair.distance_m,
            Self::Jump { by_rad, .. } => *by_rad,
            Self::Wrist { found_rad, least_rad } => least_rad - found_rad,
            Self::Cone { found_rad, most_rad } => found_rad - most_rad,
            Self::NotFinite => f64::INFINITY,
        }
    }
}

impl Hindrance {
    /// In words where this is the greatest of many like it: "by up to" and what is passed at, rounded to the worse.
    pub(crate) fn fmt_worst(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mm = |m: f64| (1e4 * m).ceil() / 10.0;
        let degrees = |rad: f64| (100.0 * rad.to_degrees()).ceil() / 100.0;
        // 10 mm up to rounding is printed as 10 mm.
        let nearest = |mm: f64| (10.0 * mm + 1e-6).floor() / 10.0;
        match self {
            Self::Reach(miss) => write!(f, "out of reach by up to {:.1} mm", mm(miss.by_m)),
            Self::Limit(violation) => write!(
                f,
                "joint {} is up to {:.2}° beyond its limit of {:.2}°",
                violation.joint + 1,
                degrees(self.shortfall()),
                violation.limit_rad.to_degrees()
            ),
            Self::Unsolved {
                cause,
                position_error_m,
            } => write!(
                f,
                "inverse kinematics: {cause}, up to {:.1} mm off",
                mm(*position_error_m)
            ),
            Self::Clearance { pair, required_m } => {
                let [at, required] = distinct_decimals(nearest(1e3 * pair.distance_m), 1e3 * required_m, 1);
                match pair.distance_m > 0.0 {
                    true => write!(f, "{} passes {} at {at} mm; {required} mm required", pair.a, pair.b),
                    false => write!(f, "{} runs into {}; {required} mm required", pair.a, pair.b),
                }
            }
            Self::Jump { joint, by_rad } => {
                write!(
                    f,
                    "joint {} would have to jump by up to {:.1}°",
                    joint + 1,
                    by_rad.to_degrees()
                )
            }
            Self::Wrist { found_rad, least_rad } => {
                let [at, required] = [found_rad, least_rad].map(|rad| rad.to_degrees());
                let [at, required] = distinct_decimals((100.0 * at).floor() / 100.0, required, 2);
                write!(
                    f,
                    "joint 5 passes 0, where the wrist flips, at {at}°; {required}° required"
                )
            }
            Self::Cone { .. } => fmt::Display::fmt(self, f),
            Self::NotFinite => f.write_str("not finite"),
        }
    }
}

impl From<AnalyticError> for Hindrance {
    fn from(error: AnalyticError) -> Self {
        match error {
            AnalyticError::OutOfReach(miss) => Self::Reach(miss),
            AnalyticError::Limits { violation, .. } => Self::Limit(violation),
            _ => Self::NotFinite,
        }
    }
}

impl From<Rejection> for Hindrance {
    fn from(rejection: Rejection) -> Self {
        match rejection {
            Rejection::OutOfReach(miss) => Self::Reach(miss),
            Rejection::Limit(violation) => Self::Limit(violation),
        }
    }
}

impl From<IkError> for Hindrance {
    fn from(error: IkError) -> Self {
        match error {
            IkError::NotSolved(failure) => Self::Unsolved {
                cause: failure.cause,
                position_error_m: failure.position_error_m,
            },
            _ => Self::NotFinite,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reports_the_distance_and_the_required_clearance() {
        struct WorstText(f64);
        impl fmt::Display for WorstText {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let [a, b] = ["handle", "post"].map(str::to_owned);
                let pair = Box::new(PairClearance {
                    a,
                    b,
                    distance_m: self.0,
                    place_m: [0.0; 3],
                    has_hull: false,
                    mounted_on: None,
                    reduced_by_m: 0.0,
                });
                let required_m = 0.0105;
                Hindrance::Clearance { pair, required_m }.fmt_worst(f)
            }
        }
        for (distance_m, words) in [
            (0.00154, "handle passes post at 1.5 mm; 10.5 mm required"),
            (0.01 - 1e-12, "handle passes post at 10.0 mm; 10.5 mm required"),
            (0.0104999, "handle passes post at 10.4 mm; 10.5 mm required"),
            (0.0, "handle runs into post; 10.5 mm required"),
            (-0.002, "handle runs into post; 10.5 mm required"),
        ] {
            assert_eq!(WorstText(distance_m).to_string(), words);
        }
    }
}
