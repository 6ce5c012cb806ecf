//! What stands around the arm, and where plates may lie.

use super::body::Body;
use platewash_workcell::layout::TaskRegion;
use platewash_workcell::workcell::Obstacle;
use serde::Serialize;

/// What stands around the arm.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Surroundings {
    /// World frame.
    pub obstacles: Vec<Body>,
    /// Radius about the base axis that plates' centres keep away from \[m\].
    pub base_circle_m: Option<f64>,
    /// Where plates' centres are drawn, a closed polygon seen from above \[m\].
    pub region_m: Option<Vec<[f64; 2]>>,
}

impl Surroundings {
    pub(super) fn new(obstacles: &[Obstacle], region: &TaskRegion) -> Self {
        let body = |obstacle: &Obstacle| Body::plain(&obstacle.name, (&obstacle.shape).into(), &obstacle.pose);
        Self {
            obstacles: obstacles.iter().map(body).collect(),
            base_circle_m: region.base_circle_m,
            region_m: region.polygon_m.clone(),
        }
    }
}
