//! Where plates are drawn, to look at.

use serde::Serialize;

/// Where the centres of plates are drawn. A plan has its plates and does not say it.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct TaskRegion {
    /// Radius about the base axis that the centres keep away from \[m\].
    pub base_circle_m: Option<f64>,
    /// A closed polygon seen from above \[m\].
    pub polygon_m: Option<Vec<[f64; 2]>>,
}
