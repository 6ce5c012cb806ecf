//! What a washing must keep, and what the arm must not exceed.
//!
//! What the contact of sponge and plate must keep.
//!
//! How a washing is planned: stated with the job, hashed, not judged.

use crate::arc::Arc as ArcRoundBase;
use platewash_kinematics::AXES;
use serde::{Deserialize, Serialize};

/// How far the tip of a plan may be from its wash path while it washes \[m\].
pub const PATH_TOLERANCE_M: f64 = 2e-4;

/// How far the tip of a plan may be from the line over the end of a wash path while it approaches and retreats \[m\].
pub const LINE_TOLERANCE_M: f64 = 1e-3;

/// What a washing must keep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirements {
    /// Share of a plate that must be swept for it to count as washed.
    pub coverage: f64,
    /// Least clearance of every pair that must keep clear \[m\]; at 0 only contact breaks it.
    pub clearance_m: f64,
    /// Largest angle of the tool from the plate's normal while it approaches, washes and retreats \[rad\]; see
    /// [`crate::job::JobTerms::tilt_max_rad`].
    pub tilt_rad: f64,
    /// Largest speed of the tip while it washes \[m/s\]; see [`crate::job::JobTerms::wash_speed_m_s`].
    pub wash_speed_m_s: f64,
    /// Largest acceleration of the tip while it washes \[m/s²\]; see [`crate::job::JobTerms::wash_acceleration_m_s2`].
    pub wash_acceleration_m_s2: f64,
    /// What follows where plates overlap.
    pub overlap: Overlap,
    /// Whether plates must be washed as they are listed.
    pub as_listed: bool,
    /// How fast the free sponge may meet a plate, and leave it \[m/s\]: the speed of every point of it that touches while it comes down
    /// and while it leaves; without them, that of washing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub landing_m_s: Option<f64>,
    /// The same while it leaves \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lifting_m_s: Option<f64>,
    /// How far joint 5 keeps from 0 while the sponge is at a plate, always on the same side \[rad\]: a wrist with axes 4 and 6 in line
    /// there would flip. Without it, nothing is asked of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrist_rad: Option<f64>,
    /// What the contact of sponge and plate must keep; without it, the sponge counts as touching with its whole face.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactRequirements>,
}

/// What a job does to its plates, as every report names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Treatment {
    /// The sponge presses them on the share, for the time and with the dose required.
    Washed,
    /// The sponge's face passes over them; contact is not required.
    Swept,
    /// A dry run: nothing is there.
    SweptInAir,
}

impl Treatment {
    /// The participle: `washed`, `swept`, `swept in the air`.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Washed => "washed",
            Self::Swept => "swept",
            Self::SweptInAir => "swept in the air",
        }
    }
}

/// What plates that overlap lead to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Overlap {
    /// It is waived, and reported.
    Report,
    /// The plan is not certified.
    Fail,
}

/// What joints and tip must not exceed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Joint accelerations \[rad/s²\]: an assumption, as the manufacturer publishes none.
    pub joint_acceleration_rad_s2: [f64; AXES],
    /// Speed of the tip anywhere \[m/s\]: an assumption.
    pub tip_speed_m_s: f64,
    /// Acceleration of the tip anywhere \[m/s²\]: an assumption.
    pub tip_acceleration_m_s2: f64,
}

/// What the contact of sponge and plate must keep while it washes, wherever within its error of height a plate lies, and whatever within
/// its range the sponge's stiffness is. Shares are of the area of a plate's face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactRequirements {
    /// c_min: the least compression of the sponge that counts as contact \[m\].
    pub compression_m: f64,
    /// ±δ: how much higher or lower than stated, along its axis, a plate may lie \[m\].
    pub height_error_m: f64,
    /// Least share that comes into contact.
    pub share: f64,
    /// Greatest strain of the sponge anywhere: its compression over its free height.
    pub strain: f64,
    /// Least and greatest normal force on the sponge while it washes \[N\].
    pub force_n: [f64; 2],
    /// Least time in contact \[s\] …
    pub time_s: f64,
    /// … on at least this share.
    pub time_share: f64,
    /// Least dose ∫ p dl of pressure over sliding distance in contact \[Pa·m\] …
    pub dose_pa_m: f64,
    /// … on at least this share.
    pub dose_share: f64,
}

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
