//! Rule for the distances between plates.

use crate::layout::error::{LayoutError, not_negative};
use serde::{Deserialize, Serialize};

/// Rule for the distances between plates. It applies to centres and does not keep plates from overlapping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spacing {
    /// Distance between centres that must be exceeded \[m\].
    pub min_distance_m: f64,
    /// Distance of centres from the base axis that must be exceeded \[m\].
    pub base_radius_m: f64,
}

impl Spacing {
    /// Refuses distances that are negative or not finite.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        not_negative("min_distance_m", self.min_distance_m)?;
        not_negative("base_radius_m", self.base_radius_m)
    }
}
