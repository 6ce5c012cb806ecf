//! One row of the table: a measured quantity.

use super::statistics::Estimate;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// One measured quantity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// Stable key, e.g. `dead_end_rate.text.4_plates`; listed in `docs/reproduce.md`.
    pub key: String,
    /// Group heading.
    pub group: &'static str,
    /// Name of the quantity, in words.
    pub quantity: String,
    /// Unit: `%`, `mm`, `deg` or empty for a ratio.
    pub unit: &'static str,
    /// Value that the paper's text takes for granted, in the same unit; `None` where it states none.
    pub paper: Option<f64>,
    /// Measured value, in the same unit.
    pub measured: f64,
    /// Half-width of the 95 % interval; `None` where the value has no sampling error or too few samples.
    pub half_width_95: Option<f64>,
}

impl Row {
    pub(super) fn new(
        group: &'static str,
        key: impl Into<String>,
        quantity: impl Into<String>,
        unit: &'static str,
        paper: impl Into<Option<f64>>,
        estimate: Estimate,
    ) -> Self {
        Self {
            key: key.into(),
            group,
            quantity: quantity.into(),
            unit,
            paper: paper.into(),
            measured: estimate.value,
            half_width_95: estimate.half_width_95,
        }
    }
}

impl Display for Row {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (quantity, digits) = match self.unit {
            "" => (self.quantity.clone(), 3),
            unit => (format!("{} [{unit}]", self.quantity), 1),
        };
        let known =
            |value: Option<f64>, digits: usize| value.map_or_else(|| "–".to_owned(), |v| format!("{v:.digits$}"));
        let (paper, error) = (known(self.paper, digits), known(self.half_width_95, digits + 1));
        write!(
            f,
            "  {quantity:<62} {paper:>9} {:>10.digits$} {error:>8}",
            self.measured
        )
    }
}
