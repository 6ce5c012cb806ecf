//! How a washing is planned: stated with the job, hashed, not judged.

use crate::arc::Arc as ArcRoundBase;
use serde::{Deserialize, Serialize};

/// Who plans, and with which settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(clippy::large_enum_variant)]
pub enum Planner {
    /// The planner of washings.
    Wash(PlannerSettings),
    /// The paper's program, with the settings that it alone knows.
    Paper(serde_json::Value),
}

/// How a washing is planned.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannerSettings {
    /// Outer radius of the wash path \[m\].
    pub path_radius_m: f64,
    /// Turns of its spiral.
    pub turns: f64,
    /// Whether a full circle at the outer radius follows the spiral.
    pub closing_ring: bool,
    /// How far the tip approaches and retreats along the plate's normal \[m\].
    pub lift_m: f64,
    /// In which order plates are washed.
    pub order: OrderRule,
    /// The arc round the base, one of the ways that are tried.
    pub arc: ArcRoundBase,
    /// Where the upright tool leans at the borders of the arm's reach.
    pub reach: ReachBorders,
    /// Whether another place is looked for, for a plate that cannot be washed.
    pub relocate: bool,
}

/// In which order plates are washed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OrderRule {
    /// Always the plate that is reached soonest.
    Nearest,
    /// As listed.
    Given,
    /// The least travel time in all.
    Fastest,
}

/// Distances from axis 1 between which an upright tool suits an arm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReachBorders {
    /// Nearer to axis 1 the flange leans away from it \[m\].
    pub near_m: f64,
    /// Farther from axis 1 the flange leans towards it \[m\].
    pub far_m: f64,
}

impl ReachBorders {
    /// Those measured on the IRB 120 with a tool of 150 mm, where they suffice for every plate of the paper up to a path radius of
    /// 0.13 m. Other arms start from them, too.
    pub const IRB_120: Self = Self {
        near_m: 0.14,
        far_m: 0.62,
    };
}
