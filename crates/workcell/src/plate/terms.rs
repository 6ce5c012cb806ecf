//! Terms of one plate, where they differ from those of its job.

use crate::plate::bounds::GREATEST_M;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Terms of one plate, where they differ from those of its job.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, TS)]
#[serde(default, deny_unknown_fields)]
#[ts(optional_fields)]
pub struct PlateTerms {
    /// Height error ±δ of this plate along its axis \[m\]; `None` for that of the contact requirements.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_error_m: Option<f64>,
    /// Greatest distance of the real plate from its face and its body \[m\]: it adds to the height error, and the body is grown by it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation_m: Option<f64>,
    /// Index of its measured shape in [`crate::job::JobTerms::measured`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<usize>,
    /// Index of its soil in [`crate::job::JobTerms::soils`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soil: Option<usize>,
}

impl PlateTerms {
    /// True for a plate with the terms of its job.
    #[must_use]
    pub fn are_those_of_the_job(&self) -> bool {
        *self == Self::default()
    }

    /// Checks that the lengths are lengths.
    #[must_use]
    pub(crate) fn is_sound(&self) -> bool {
        let is_length = |length: f64| (0.0..=GREATEST_M).contains(&length);
        self.height_error_m.is_none_or(is_length) && self.deviation_m.is_none_or(is_length)
    }
}
