//! Expectation for a plate before anything is planned.

use crate::redundancy::Chance;
use serde::Serialize;

/// The chance of a plate to be washed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct PlateOutlook {
    /// The plate.
    pub plate: usize,
    /// Chance of the plate to be washed.
    pub chance: Chance,
}
