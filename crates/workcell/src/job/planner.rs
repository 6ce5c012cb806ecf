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
    /// Greatest length of the wash path along the meridian, on a flat plate its outer radius \[m\]; without it, the planner chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path_radius_m: Option<f64>,
    /// Turns of its spiral, or its rings but the last; without it, the planner chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turns: Option<f64>,
    /// Whether a full circle at the outer radius follows a spiral; without it, the planner chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closing_ring: Option<bool>,
    /// Kind of the wash path; without it, a spiral where its turns or its radius are stated, otherwise the planner chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pattern: Option<PatternName>,
    /// The tool's largest angle from the normal that is planned \[rad\]; without it, the planner chooses, up to what is required.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_rad: Option<f64>,
    /// Slope of the sponge's axis as a share of that of the face: 0 keeps it along the plate's axis, 1 along the normal; without it, half.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis_share: Option<f64>,
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

/// Kinds of wash paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PatternName {
    /// A spiral from the centre.
    Spiral,
    /// Rings about the centre, joined by blends.
    Rings,
}

impl PatternName {
    /// The names, as files state them.
    pub const NAMES: [&'static str; 2] = ["spiral", "rings"];
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
