//! Why a layout could not be made.

use crate::verdict::Infeasibility;
use crate::words::counted;
use thiserror::Error;

/// What is wrong with one number of the request.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InputProblem {
    /// NaN or infinite.
    #[error("is not a finite number")]
    NotFinite,
    /// Below zero where only zero or more makes sense.
    #[error("is negative")]
    Negative,
    /// Zero or negative where a size is needed.
    #[error("is not greater than zero")]
    NotPositive,
    /// A range whose lower end lies above its upper end.
    #[error("is reversed: its first number is greater than its second")]
    Reversed,
    /// A range of zero width, which has no area to draw from.
    #[error("has no width")]
    NoWidth,
    /// An azimuth range of more than a full turn.
    #[error("spans more than 360 degrees")]
    MoreThanATurn,
    /// Above the largest supported value.
    #[error("is greater than {max}")]
    TooLarge {
        /// The largest supported value, in the unit of the key.
        max: usize,
    },
}

/// Why a region holds no admissible position even before the first plate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EmptyReason {
    /// The ranges `x_m`, `y_m`, `rho_m` and `azimuth_deg` have no area in common.
    #[error("its ranges (x_m, y_m, rho_m, azimuth_deg) have no area in common")]
    Disjoint,
    /// What the ranges have in common is a point, a line or a strip of about a nanometre.
    #[error(
        "what its ranges (x_m, y_m, rho_m, azimuth_deg) have in common is too thin to draw from: a point, a line, or a \
         strip of about a nanometre; widen one of them"
    )]
    TooThin,
    /// Every point of the region, but for slivers of about a nanometre, is within `base_radius_m` of the base axis.
    #[error(
        "all of it (but for what is too thin to draw from) lies within base_radius_m = {base_radius_m} m of the base axis"
    )]
    WithinBase {
        /// The radius around the base axis that must stay free, metres.
        base_radius_m: f64,
    },
}

/// Why a layout could not be made.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A number of the request makes no sense.
    #[error("{key} {problem}")]
    InvalidInput {
        /// Its name.
        key: &'static str,
        /// What is wrong with it.
        problem: InputProblem,
    },
    /// A coordinate of an explicitly given plate is not a finite number.
    #[error("positions_m[{plate}] is not finite")]
    InvalidPosition {
        /// Index of the plate, from 0.
        plate: usize,
    },
    /// The region admits no plate at all.
    #[error("the region is empty: {reason}")]
    EmptyRegion {
        /// Why.
        reason: EmptyReason,
    },
    /// Every random layout ran into a dead end; proven infeasible when `count` exceeds `upper_bound`.
    #[error(
        "{}: the best of {layouts_tried} random layouts held {most_placed} before no room was left{}{}",
        verdict(*.count, *.upper_bound), upper_bound_text(*.upper_bound), remedy(*.count, *.upper_bound)
    )]
    NoRoom {
        /// Plates asked for.
        count: usize,
        /// The largest number of plates placed before a dead end.
        most_placed: usize,
        /// Layouts begun, each of which ended with no room for the next plate.
        layouts_tried: u32,
        /// No arrangement holds more plates than this, from the region's area and outline; `None` without a spacing.
        upper_bound: Option<usize>,
    },
}

fn cannot_fit(count: usize, upper_bound: Option<usize>) -> bool {
    upper_bound.is_some_and(|bound| count > bound)
}

/// What may do where a layout was only not found.
fn remedy(count: usize, upper_bound: Option<usize>) -> &'static str {
    if cannot_fit(count, upper_bound) {
        ""
    } else {
        "; another seed, a smaller least distance of the centres, or places that are given may do"
    }
}

fn verdict(count: usize, upper_bound: Option<usize>) -> String {
    if cannot_fit(count, upper_bound) {
        format!("{} cannot fit", counted(count, "plate"))
    } else {
        format!("no layout of {} found", counted(count, "plate"))
    }
}

fn upper_bound_text(upper_bound: Option<usize>) -> String {
    upper_bound.map_or_else(String::new, |n| {
        format!("; by area no arrangement holds more than {n} at this spacing")
    })
}

impl LayoutError {
    pub(crate) fn invalid(key: &'static str, problem: InputProblem) -> Self {
        Self::InvalidInput { key, problem }
    }

    /// Whether no seed can give a layout, as opposed to none having been found.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        match self {
            Self::NoRoom { count, upper_bound, .. } => cannot_fit(*count, *upper_bound),
            _ => true,
        }
    }

    /// Whether the plates have no room, or none was found for them; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        match self {
            Self::NoRoom { .. } | Self::EmptyRegion { .. } => Some(Infeasibility::proved_if(self.is_proven())),
            _ => None,
        }
    }
}

/// Refuses what is not a finite number.
pub(crate) fn finite(key: &'static str, value: f64) -> Result<(), LayoutError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(LayoutError::invalid(key, InputProblem::NotFinite))
    }
}

/// Refuses what is not a finite number of zero or more.
pub(crate) fn not_negative(key: &'static str, value: f64) -> Result<(), LayoutError> {
    finite(key, value)?;
    if value < 0.0 {
        Err(LayoutError::invalid(key, InputProblem::Negative))
    } else {
        Ok(())
    }
}

/// Refuses what is not a finite number greater than zero.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<(), LayoutError> {
    finite(key, value)?;
    if value <= 0.0 {
        Err(LayoutError::invalid(key, InputProblem::NotPositive))
    } else {
        Ok(())
    }
}

/// Refuses what is not a finite range `[low, high]` of positive width.
pub(crate) fn range(key: &'static str, [low, high]: [f64; 2]) -> Result<(), LayoutError> {
    finite(key, low)?;
    finite(key, high)?;
    if low > high {
        return Err(LayoutError::invalid(key, InputProblem::Reversed));
    }
    if low == high {
        return Err(LayoutError::invalid(key, InputProblem::NoWidth));
    }
    Ok(())
}
