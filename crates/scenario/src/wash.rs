//! The `[wash]` section: the wash path and what it must keep.

use platewash_workcell::job::PatternName;
use serde::{Deserialize, Serialize};

/// Turns of the paper's spiral where none are stated.
pub const PAPER_TURNS: f64 = 3.0;

/// Outer radius of the paper's spiral where none is stated \[m\].
pub const PAPER_RADIUS_M: f64 = 0.145;

/// `[wash]`. Of the keys of the wash path, those that are left out are the planner's choice in a certified job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WashSection {
    /// Waypoints of the paper's spiral.
    pub points: usize,
    /// Kind of the wash path (certified).
    pub pattern: Option<PatternName>,
    /// Turns of the spiral, or rings but the last; without it, `PAPER_TURNS` in the paper's program.
    pub turns: Option<f64>,
    /// Greatest length of the wash path along the meridian, on a flat plate its outer radius \[m\]; without it, `PAPER_RADIUS_M` in
    /// the paper's program.
    pub path_radius_m: Option<f64>,
    /// Height of the tip above the washing surface \[m\].
    pub height_m: f64,
    /// Whether a full circle at the outer radius follows the spiral; without it, none in the paper's program.
    pub closing_ring: Option<bool>,
    /// Least clearance that counts as free \[m\].
    pub clearance_m: f64,
    /// Largest angle of the tool from the plate's normal \[deg\]. This key and those below: [`Program::Certified`](crate::Program::Certified) only.
    pub tilt_max_deg: f64,
    /// Largest such angle that is planned \[deg\].
    pub tilt_deg: Option<f64>,
    /// Slope of the sponge's axis as a share of that of the face.
    pub axis_share: Option<f64>,
    /// Largest speed of the tip along the path \[m/s\].
    pub speed_m_s: f64,
    /// Largest acceleration of the tip on the path \[m/s²\].
    pub acceleration_m_s2: f64,
    /// How far the tip approaches and retreats along the plate's normal \[m\].
    pub lift_m: f64,
    /// Largest speed at which the free sponge meets a plate \[m/s\].
    pub landing_speed_m_s: Option<f64>,
    /// Largest speed at which it leaves one \[m/s\].
    pub lifting_speed_m_s: Option<f64>,
    /// How far joint 5 keeps from 0 at a plate \[deg\].
    pub wrist_min_deg: Option<f64>,
    /// Whether the contact of sponge and plate is part of what is asked for; the keys below say how much of it.
    pub contact: bool,
    /// The least compression that counts as contact \[m\].
    pub contact_compression_m: Option<f64>,
    /// How much higher or lower than stated a plate may lie \[m\].
    pub contact_height_error_m: Option<f64>,
    /// Least share of a face in contact.
    pub contact_share: Option<f64>,
    /// Greatest compression over the free height.
    pub contact_strain: Option<f64>,
    /// Least and greatest normal force \[N\].
    pub contact_force_n: Option<[f64; 2]>,
    /// Least time in contact \[s\].
    pub contact_time_s: Option<f64>,
    /// Least share of a face with that time.
    pub contact_time_share: Option<f64>,
    /// Least dose of pressure over sliding distance \[Pa·m\].
    pub contact_dose_pa_m: Option<f64>,
    /// Least share of a face with that dose.
    pub contact_dose_share: Option<f64>,
}

impl Default for WashSection {
    fn default() -> Self {
        Self {
            points: 55,
            pattern: None,
            turns: None,
            path_radius_m: None,
            height_m: 0.05,
            closing_ring: None,
            clearance_m: 0.0,
            tilt_max_deg: 15.0,
            tilt_deg: None,
            axis_share: None,
            speed_m_s: 0.25,
            acceleration_m_s2: 4.0,
            lift_m: 0.03,
            landing_speed_m_s: None,
            lifting_speed_m_s: None,
            wrist_min_deg: None,
            contact: false,
            contact_compression_m: None,
            contact_height_error_m: None,
            contact_share: None,
            contact_strain: None,
            contact_force_n: None,
            contact_time_s: None,
            contact_time_share: None,
            contact_dose_pa_m: None,
            contact_dose_share: None,
        }
    }
}
