//! What a washing must keep, and what the arm must not exceed.

use super::contact::ContactRequirements;
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
    /// [`super::JobTerms::tilt_max_rad`].
    pub tilt_rad: f64,
    /// Largest speed of the tip while it washes \[m/s\]; see [`super::JobTerms::wash_speed_m_s`].
    pub wash_speed_m_s: f64,
    /// Largest acceleration of the tip while it washes \[m/s²\]; see [`super::JobTerms::wash_acceleration_m_s2`].
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
