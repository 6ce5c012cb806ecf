//! Errors of a layout.

use crate::verdict::Infeasibility;
use crate::words::count_with_noun;
use thiserror::Error;

/// Error in one number of the request.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InputProblem {
    /// The number is NaN or infinite.
    #[error("is not a finite number")]
    NotFinite,
    /// The number is below zero, where zero or more is needed.
    #[error("is negative")]
    Negative,
    /// The number is zero or negative, where a size is needed.
    #[error("is not greater than zero")]
    NotPositive,
    /// The lower end of a range lies above its upper end.
    #[error("is reversed: its first number is greater than its second")]
    Reversed,
    /// The range has zero width, so that there is no area to draw from.
    #[error("has no width")]
    NoWidth,
    /// The azimuth range is more than a full turn.
    #[error("spans more than 360 degrees")]
    MoreThanATurn,
    /// The number is above the greatest supported value.
    #[error("is greater than {max}")]
    TooLarge {
        /// Greatest supported value, in the unit of the key.
        max: usize,
    },
}

/// Reason that a region has no admissible position for a first plate.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EmptyReason {
    /// The ranges `x_m`, `y_m`, `rho_m` and `azimuth_deg` have no area in common.
    #[error("its ranges (x_m, y_m, rho_m, azimuth_deg) have no area in common")]
    Disjoint,
    /// The intersection of the ranges is a point, a line or a strip of about a nanometre.
    #[error(
        "what its ranges (x_m, y_m, rho_m, azimuth_deg) have in common is too thin to draw from: a point, a line, or a \
         strip of about a nanometre; widen one of them"
    )]
    TooThin,
    /// Every point of the region, except slivers of about a nanometre, is within `base_radius_m` of the base axis.
    #[error(
        "all of it (but for what is too thin to draw from) lies within base_radius_m = {base_radius_m} m of the base axis"
    )]
    WithinBase {
        /// Radius around the base axis that must stay free \[m\].
        base_radius_m: f64,
    },
}

/// Reason that a layout could not be made.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A number of the request is invalid.
    #[error("{key} {problem}")]
    InvalidInput {
        /// Name of the number.
        key: &'static str,
        /// Description of the error.
        problem: InputProblem,
    },
    /// A coordinate of an explicitly given plate is not a finite number.
    #[error("positions_m[{plate}] is not finite")]
    InvalidPosition {
        /// Index of the plate, from 0.
        plate: usize,
    },
    /// The region has no room for any plate.
    #[error("no place can be drawn from the region: {reason}")]
    EmptyRegion {
        /// Reason.
        reason: EmptyReason,
    },
    /// Every random layout ran into a dead end. This is proved infeasible if `count` exceeds `upper_bound`.
    #[error(
        "{}: the best of {layouts_tried} random layouts held {most_placed} before no room was left{}{}",
        verdict(*.count, *.upper_bound), upper_bound_text(*.upper_bound), remedy(*.count, *.upper_bound)
    )]
    NoRoom {
        /// Number of plates asked for.
        count: usize,
        /// Greatest number of plates placed before a dead end.
        most_placed: usize,
        /// Number of layouts begun. Each ended with no room for the next plate.
        layouts_tried: u32,
        /// Upper bound on the number of plates in any arrangement, from the region's area and outline; `None` without a spacing.
        upper_bound: Option<usize>,
    },
}

fn cannot_fit(count: usize, upper_bound: Option<usize>) -> bool {
    upper_bound.is_some_and(|bound| count > bound)
}

/// Returns advice if a layout was only not found.
fn remedy(count: usize, upper_bound: Option<usize>) -> &'static str {
    if cannot_fit(count, upper_bound) {
        ""
    } else {
        "; another seed, a smaller least distance of the centres, or places that are given may do"
    }
}

fn verdict(count: usize, upper_bound: Option<usize>) -> String {
    if cannot_fit(count, upper_bound) {
        format!("{} cannot fit", count_with_noun(count, "plate"))
    } else {
        format!("no layout of {} found", count_with_noun(count, "plate"))
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

    /// True if no seed can give a layout; false if none was found.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        match self {
            Self::NoRoom { count, upper_bound, .. } => cannot_fit(*count, *upper_bound),
            // A place that is given may lie where none is drawn.
            Self::EmptyRegion {
                reason: EmptyReason::TooThin,
            } => false,
            _ => true,
        }
    }

    /// Returns the kind of infeasibility: proved, or only not found; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        match self {
            Self::NoRoom { .. } | Self::EmptyRegion { .. } => Some(Infeasibility::proved_if(self.is_proven())),
            _ => None,
        }
    }
}

/// Refuses a number that is not finite.
pub(crate) fn finite(key: &'static str, value: f64) -> Result<(), LayoutError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(LayoutError::invalid(key, InputProblem::NotFinite))
    }
}

/// Refuses a number that is not finite or is negative.
pub(crate) fn not_negative(key: &'static str, value: f64) -> Result<(), LayoutError> {
    finite(key, value)?;
    if value < 0.0 {
        Err(LayoutError::invalid(key, InputProblem::Negative))
    } else {
        Ok(())
    }
}

/// Refuses a number that is not finite and greater than zero.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<(), LayoutError> {
    finite(key, value)?;
    if value <= 0.0 {
        Err(LayoutError::invalid(key, InputProblem::NotPositive))
    } else {
        Ok(())
    }
}

/// Refuses a range that is not `[low, high]`, finite and of positive width.
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
