//! Requirements of a washing and of the contact between sponge and plate, and limits of the arm.

use platewash_kinematics::AXES;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Greatest distance of a plan's tip from its wash path while it washes \[m\].
pub const PATH_TOLERANCE_M: f64 = 2e-4;

/// Usual limit of the contact speed, of the free sponge that lands on a plate and that lifts off \[m/s\]: the default of both keys of a
/// scenario that asks for contact. A job that allows more requires less than usual.
pub const CONTACT_SPEED_M_S: f64 = 0.05;

/// Usual requirement of the wrist: least angle of joint 5 from 0 at a plate \[deg\], and the default of a scenario that asks for contact.
pub const WRIST_DEG: f64 = 3.0;

/// Greatest distance of a plan's tip from the line over the end of a wash path while it approaches and retreats \[m\].
pub const LINE_TOLERANCE_M: f64 = 1e-3;

/// Requirements of a washing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirements {
    /// Share of a plate that must be swept.
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
    /// Consequence of overlapping plates.
    pub overlap: Overlap,
    /// True if plates must be washed in the order in which they are listed.
    pub as_listed: bool,
    /// Greatest contact speed of the free sponge while it comes down on a plate \[m/s\], for every point of it that touches. Without
    /// `landing_m_s` and `lifting_m_s` it is the wash speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub landing_m_s: Option<f64>,
    /// Greatest contact speed of the free sponge while it leaves a plate \[m/s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lifting_m_s: Option<f64>,
    /// Least distance of joint 5 from 0 while the sponge is at a plate, always on the same side \[rad\]: a wrist with axes 4 and 6 in line
    /// would flip there. `None` for no requirement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrist_rad: Option<f64>,
    /// Requirements of the contact; `None` if the sponge counts as touching with its whole face.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<ContactRequirements>,
    /// Holder of the plates, which must stay where they are; `None` if that is assumed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holder: Option<HolderTerms>,
}

/// Treatment of the plates by a job, as every report names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Treatment {
    /// The sponge presses the plates on the required share, for the required time and with the required dose.
    Washed,
    /// The sponge's face passes over the plates; contact is not required.
    Swept,
    /// A dry run, where no plates are there; or a motion home after a stop, which goes over none.
    SweptInAir,
}

impl Treatment {
    /// Returns the participle: `washed`, `swept`, `swept in the air`.
    #[must_use]
    pub fn participle(self) -> &'static str {
        match self {
            Self::Washed => "washed",
            Self::Swept => "swept",
            Self::SweptInAir => "swept in the air",
        }
    }
}

/// Consequence of overlapping plates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Overlap {
    /// The overlap is waived, and reported.
    Report,
    /// The plan is not certified.
    Fail,
}

/// Limits of joints and tip.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Greatest joint accelerations \[rad/s²\]: an assumption, as the manufacturer publishes none.
    pub joint_acceleration_rad_s2: [f64; AXES],
    /// Greatest speed of the tip anywhere \[m/s\]: an assumption.
    pub tip_speed_m_s: f64,
    /// Greatest acceleration of the tip anywhere \[m/s²\]: an assumption.
    pub tip_acceleration_m_s2: f64,
}

/// Requirements of the contact between sponge and plate while it washes. They hold for every plate height within the error and every
/// stiffness within the sponge's range. Shares are of the area of a plate's face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct ContactRequirements {
    /// Least compression of the sponge that counts as contact, c_min \[m\].
    pub compression_m: f64,
    /// Height error ±δ of a plate along its axis \[m\].
    pub height_error_m: f64,
    /// Least share of the face that comes into contact.
    pub share: f64,
    /// Greatest strain of the sponge: its compression over its free height.
    pub strain: f64,
    /// Least and greatest contact force: that along the sponge's axis while it washes \[N\].
    pub force_n: [f64; 2],
    /// Least time in contact \[s\], required on `time_share`.
    pub time_s: f64,
    /// Least share of the face with that time in contact.
    pub time_share: f64,
    /// Least dose ∫ p dl in contact, pressure over sliding distance \[Pa·m\], required on `dose_share`.
    pub dose_pa_m: f64,
    /// Least share of the face with that dose.
    pub dose_share: f64,
}

/// Amounts wanted at a place of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactThresholds {
    /// Least compression of the foam that counts as contact \[m\].
    pub compression_m: f64,
    /// Height error of a plate along its axis \[m\].
    pub height_error_m: f64,
    /// Least time in contact \[s\].
    pub time_s: f64,
    /// Least dose ∫ p dl in contact, for the least stiffness \[Pa·m\].
    pub dose_pa_m: f64,
}

impl ContactRequirements {
    /// The amounts that are required at a place.
    #[must_use]
    pub const fn thresholds(&self) -> ContactThresholds {
        ContactThresholds {
            compression_m: self.compression_m,
            height_error_m: self.height_error_m,
            time_s: self.time_s,
            dose_pa_m: self.dose_pa_m,
        }
    }
}

/// Holder of the plates of a job while the sponge presses them, and the friction of the sponge: assumptions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HolderTerms {
    /// Greatest friction coefficient of the sponge on a plate.
    pub sponge_friction: f64,
    /// Mass of a plate \[kg\]; `None` if it is not stated, with a fixture alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plate_mass_kg: Option<f64>,
    /// Fixture that holds each plate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fixture: Option<FixtureTerms>,
    /// Ring on which each plate stands, held by its friction alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ring: Option<RingTerms>,
}

/// Strength of a fixture that holds a plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FixtureTerms {
    /// Force that it takes in any direction across the plate's axis \[N\].
    pub force_n: f64,
    /// Torque about the plate's axis that it takes at the same time \[N·m\].
    pub torque_nm: f64,
}

/// Ring about its axis on which a plate stands.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RingTerms {
    /// Least friction coefficient of the plate on what it stands on.
    pub friction: f64,
    /// Radius \[m\].
    pub radius_m: f64,
}
