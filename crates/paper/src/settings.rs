//! Settings of a run of the paper's program besides arm, plates and control law.

use crate::cubic::Interpolation;
use crate::order::PaperOrder;
use crate::spiral::PaperSpiral;
use platewash_kinematics::ik::{AnalyticStarts, IkSettings};
use platewash_workcell::arc::Arc;
use serde::{Deserialize, Serialize};

/// Settings of the paper's program.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperSettings {
    /// The path on a plate.
    pub spiral: PaperSpiral,
    /// Height of the tip over the plate while it washes \[m\].
    pub height_m: f64,
    /// The curve between plates.
    pub transit: TransitCurve,
    /// The arc round the base that the curve goes through.
    pub arc: Arc,
    /// The inverse kinematics.
    pub ik: PaperIk,
    /// Order in which plates are washed.
    pub order: PaperOrder,
}

/// The curve from one plate to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransitCurve {
    /// The curve through the waypoints of the arc.
    pub interpolation: Interpolation,
    /// Samples along it, both ends included.
    pub samples: usize,
}

/// The inverse kinematics of the paper's program.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperIk {
    /// The solver.
    pub method: IkMethod,
    /// Configuration from which each waypoint is solved.
    pub seed: IkSeed,
    /// Largest accepted position error \[m\].
    pub position_tolerance_m: f64,
    /// Largest accepted orientation error \[rad\].
    pub orientation_tolerance_rad: f64,
}

/// The inverse-kinematics solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IkMethod {
    /// Damped least squares with a QP fallback, from the seed and a fixed list of starts.
    Numeric,
    /// Besides, from the closed form's nearest branch where the seed is far away or fails (arms that have one).
    Analytic,
}

/// Configuration from which each waypoint is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IkSeed {
    /// The configuration that the arm really has, lagging behind (the paper).
    Executed,
    /// The answer at the previous waypoint.
    Previous,
}

/// A setting with which nothing can be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the paper's program: {name} must be {expected}; found {found}")]
pub struct SettingError {
    /// Its place in [`PaperSettings`], e.g. `spiral.points`.
    pub name: &'static str,
    /// Range or kind of value required.
    pub expected: &'static str,
    /// Value found.
    pub found: f64,
}

impl PaperSettings {
    /// Settings of the program in the paper's appendix.
    #[must_use]
    pub fn appendix() -> Self {
        Self {
            spiral: PaperSpiral {
                points: 55,
                turns: 3.0,
                radius_m: 0.145,
                closing_ring: false,
            },
            height_m: 0.05,
            transit: TransitCurve {
                interpolation: Interpolation::ZeroVelocity,
                samples: 50,
            },
            // The radius is max(base radius + 0.1 m, 0.3 m). The height is absolute in the code; the text says "above the plate".
            arc: Arc {
                points: 5,
                radius_m: 0.35,
                height_m: 0.25,
            },
            ik: PaperIk {
                method: IkMethod::Numeric,
                seed: IkSeed::Executed,
                position_tolerance_m: 1e-6,
                orientation_tolerance_rad: 1e-6,
            },
            order: PaperOrder::Nearest,
        }
    }

    /// Settings of the paper's text, which differs in the region of the plates alone.
    #[must_use]
    pub fn text() -> Self {
        Self::appendix()
    }

    /// The solver's settings.
    #[must_use]
    pub fn ik_settings(&self) -> IkSettings {
        let analytic_starts = match self.ik.method {
            IkMethod::Numeric => AnalyticStarts::Unused,
            IkMethod::Analytic => AnalyticStarts::Used,
        };
        IkSettings {
            analytic_starts,
            position_tolerance_m: self.ik.position_tolerance_m,
            orientation_tolerance_rad: self.ik.orientation_tolerance_rad,
            ..IkSettings::default()
        }
    }

    /// Refuses settings with which nothing can be computed, NaN and infinity included; the solver checks those of its own.
    ///
    /// # Errors
    /// [`SettingError`], naming the first.
    pub fn validate(&self) -> Result<(), SettingError> {
        at_least_two("spiral.points", self.spiral.points)?;
        positive("spiral.turns", self.spiral.turns)?;
        positive("spiral.radius_m", self.spiral.radius_m)?;
        finite("height_m", self.height_m)?;
        at_least_two("transit.samples", self.transit.samples)?;
        let points = self.arc.points;
        refuse_unless(
            (2..=1000).contains(&points),
            "arc.points",
            "from 2 to 1000",
            points as f64,
        )?;
        positive("arc.radius_m", self.arc.radius_m)?;
        finite("arc.height_m", self.arc.height_m)
    }
}

fn at_least_two(name: &'static str, count: usize) -> Result<(), SettingError> {
    refuse_unless(count >= 2, name, "at least 2", count as f64)
}

fn positive(name: &'static str, found: f64) -> Result<(), SettingError> {
    refuse_unless(found > 0.0 && found.is_finite(), name, "finite and above 0", found)
}

fn finite(name: &'static str, found: f64) -> Result<(), SettingError> {
    refuse_unless(found.is_finite(), name, "finite", found)
}

fn refuse_unless(fits: bool, name: &'static str, expected: &'static str, found: f64) -> Result<(), SettingError> {
    if fits {
        return Ok(());
    }
    Err(SettingError { name, expected, found })
}
