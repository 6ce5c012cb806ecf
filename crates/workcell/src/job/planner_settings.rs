//! Settings of the planner: part of the job and its hash, and not judged.

use crate::arc::Arc as ArcRoundBase;
use crate::wash_path::{PatternName, StatedNumbers};
use serde::{Deserialize, Serialize};

/// Planner of a job, with its settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(clippy::large_enum_variant)]
pub enum Planner {
    /// The planner of washings.
    Wash(PlannerSettings),
    /// The paper's program, with its own settings.
    Paper(serde_json::Value),
}

/// Settings of the planner of washings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannerSettings {
    /// Greatest length of the wash path along the meridian, on a flat plate its outer radius \[m\]; `None` lets the planner choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path_radius_m: Option<f64>,
    /// Turns of the spiral, or number of rings without the last; `None` lets the planner choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turns: Option<f64>,
    /// True if a full circle at the outer radius follows a spiral; `None` lets the planner choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closing_ring: Option<bool>,
    /// Kind of the wash path. `None` means a spiral if its turns or its radius are stated; otherwise the planner chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pattern: Option<PatternName>,
    /// Greatest planned angle of the tool from the normal \[rad\]; `None` lets the planner choose, up to the required angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_rad: Option<f64>,
    /// Slope of the sponge's axis as a share of that of the face: 0 keeps it along the plate's axis, 1 along the normal; `None` means half.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis_share: Option<f64>,
    /// Length of the approach and the retreat along the plate's normal \[m\].
    pub lift_m: f64,
    /// Rule for the order of the plates.
    pub order: OrderRule,
    /// Arc round the base, one of the routes that the planner tries.
    pub arc: ArcRoundBase,
    /// Distances beyond which the tool leans, at the borders of the arm's reach.
    pub reach: ReachBorders,
    /// True if the planner looks for another place for a plate that cannot be washed.
    pub relocate: bool,
}

impl PlannerSettings {
    /// Returns the numbers of the curve that are stated.
    #[must_use]
    pub fn stated_numbers(&self) -> StatedNumbers {
        StatedNumbers {
            turns: self.turns,
            path_radius_m: self.path_radius_m,
            closing_ring: self.closing_ring,
        }
    }
}

/// Rule for the order in which plates are washed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OrderRule {
    /// Always the plate that is reached soonest next.
    Nearest,
    /// As listed.
    Given,
    /// The order with the least total travel time.
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
    /// Distances measured on the IRB 120 with a tool of 150 mm. They suffice for every plate of the paper up to a path radius of 0.13 m.
    /// Other arms start from them, too.
    pub const IRB_120: Self = Self {
        near_m: 0.14,
        far_m: 0.62,
    };
}
