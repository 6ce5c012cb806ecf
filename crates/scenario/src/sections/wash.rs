//! The `[wash]` section: the wash path and its requirements.

use crate::lossy_path::serialize_lossy;
use platewash_keys::Section;
use platewash_workcell::wash_path::PatternName;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Turns of the paper's spiral where none are stated.
pub const PAPER_TURNS: f64 = 3.0;

/// Outer radius of the paper's spiral where none is stated \[m\].
pub const PAPER_RADIUS_M: f64 = 0.145;

/// `[wash]`. Of the keys of the wash path, those that are left out are the planner's choice in a certified job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("wash")]
#[serde(default, deny_unknown_fields)]
pub struct WashSection {
    /// Waypoints of the paper's spiral.
    #[key(domain = Integer(2, 100_000), default = 55)]
    pub points: usize,
    /// Kind of the wash path (certified): a spiral, or rings joined by blends. Without it, a spiral where turns, path_radius_m or closing_ring
    /// is stated, otherwise the planner chooses.
    #[key(domain = Word(&PatternName::NAMES))]
    pub pattern: Option<PatternName>,
    /// Turns of the spiral, from 0.25 to 200 in a certified job; or rings but the last, a whole number from 1 to 99. Without it, 3 in the
    /// paper's program; in a certified job the planner chooses.
    #[key(domain = NumberAbove(0.0, 1000.0))]
    pub turns: Option<f64>,
    /// Outer radius of the wash path, on a plate with a profile along the face; in a certified job at least 0.0001, and π · path_radius_m ·
    /// (turns + 2) at most 100 m. Without it, 0.145 in the paper's program; in a certified job the planner chooses.
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    pub path_radius_m: Option<f64>,
    /// Height of the tip above the washing surface.
    #[key(unit = "m", domain = Number(0.0, 1.0), default = 0.05)]
    pub height_m: f64,
    /// True where a full circle at the outer radius follows the spiral. Without it, none in the paper's program; in a certified job the planner
    /// chooses, and a circle that it adds may end before a full turn, as that of rings may.
    #[key(domain = Bool)]
    pub closing_ring: Option<bool>,
    /// Least clearance that counts as free; at 0 only contact is a violation. In a certified job the planner keeps 0.5 mm more while washing,
    /// and 1 mm more at home, on the lines over plates and between them, because it looks in steps.
    #[key(unit = "m", domain = Number(0.0, 1.0))]
    pub clearance_m: f64,
    /// Largest angle of the tool from the plate's normal at a plate (certified), and never above atan(sponge_height_m / sponge_radius_m).
    #[key(unit = "deg", domain = Number(0.0, 60.0), default = 15.0)]
    pub tilt_max_deg: f64,
    /// Largest angle of the tool from the plate's normal that is planned (certified): at most tilt_max_deg, which is what is judged. Without
    /// it, the planner chooses.
    #[key(unit = "deg", domain = Number(0.0, 60.0))]
    pub tilt_deg: Option<f64>,
    /// Slope of the sponge's axis as a share of the slope of the face below it (certified): 0 keeps it along the plate's axis, 1 along the
    /// normal. Without it, 0.5.
    #[key(domain = Number(0.0, 1.0))]
    pub axis_share: Option<f64>,
    /// Largest speed of the tip while it washes, and of the sponge's rim where it touches before and after (certified); at least 0.000001.
    #[key(unit = "m/s", domain = NumberAbove(0.0, 10.0), default = 0.25)]
    pub speed_m_s: f64,
    /// Largest acceleration of the tip while it washes (certified); at least 0.000001.
    #[key(unit = "m/s²", domain = NumberAbove(0.0, 1000.0), default = 4.0)]
    pub acceleration_m_s2: f64,
    /// Distance by which the tip approaches and retreats along the plate's normal (certified): more than clearance_m and 1 mm, so that a
    /// tilted sponge too is clear of the plate.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0), default = 0.03)]
    pub lift_m: f64,
    /// Largest speed at which the free sponge meets a plate (certified); at least 0.000001. Without it, 0.05 where contact is true, otherwise
    /// speed_m_s.
    #[key(unit = "m/s", domain = NumberAbove(0.0, 10.0))]
    pub landing_speed_m_s: Option<f64>,
    /// Largest speed at which the sponge leaves a plate (certified); at least 0.000001. Without it, 0.05 where contact is true, otherwise
    /// speed_m_s.
    #[key(unit = "m/s", domain = NumberAbove(0.0, 10.0))]
    pub lifting_speed_m_s: Option<f64>,
    /// Angle that joint 5 keeps away from 0, on one side, from approach to retreat (certified), so that the wrist does not flip. Without
    /// it, 3 where contact is true, otherwise nothing is asked of it.
    #[key(unit = "deg", domain = Number(0.0, 90.0))]
    pub wrist_min_deg: Option<f64>,
    /// True where the contact of sponge and plate must be proved (certified): the share of a face that is pressed, for how long, how hard.
    /// The keys contact_… below say how much; each has a default.
    #[key(domain = Bool)]
    pub contact: bool,
    /// The least compression of the sponge that counts as contact. Without it, 0.001 where contact is true.
    #[key(unit = "m", domain = Number(0.0, 1.0))]
    pub contact_compression_m: Option<f64>,
    /// Height error of a plate, up or down from its stated height: an assumption. Without it, 0.001 where contact is true.
    #[key(unit = "m", domain = Number(0.0, 1.0))]
    pub contact_height_error_m: Option<f64>,
    /// Least share of a face's area that comes into contact, wherever within the height error the plate lies. Without it, 0.995 where contact
    /// is true.
    #[key(domain = Number(0.0, 1.0))]
    pub contact_share: Option<f64>,
    /// Greatest strain of the sponge anywhere: compression over free height; a sponge pressed further bottoms out. Without it, 0.6 where
    /// contact is true.
    #[key(domain = NumberAbove(0.0, 1.0))]
    pub contact_strain: Option<f64>,
    /// Least and greatest force along the sponge's axis while it washes, for every stiffness in its range. Without it, [1, 40] where contact
    /// is true.
    #[key(unit = "N", domain = Range(0.0, 1e6))]
    pub contact_force_n: Option<[f64; 2]>,
    /// Least time in contact, on contact_time_share. Without it, 0.1 where contact is true.
    #[key(unit = "s", domain = Number(0.0, 1e6))]
    pub contact_time_s: Option<f64>,
    /// Share of a face's area that is in contact for contact_time_s. Without it, 0.99 where contact is true.
    #[key(domain = Number(0.0, 1.0))]
    pub contact_time_share: Option<f64>,
    /// Least dose ∫ p dl of pressure over sliding distance in contact, of the softest sponge, on contact_dose_share. Without it, 50 where
    /// contact is true.
    #[key(unit = "Pa·m", domain = Number(0.0, 1e9))]
    pub contact_dose_pa_m: Option<f64>,
    /// Share of a face's area that gets contact_dose_pa_m. Without it, 0.99 where contact is true.
    #[key(domain = Number(0.0, 1.0))]
    pub contact_dose_share: Option<f64>,
    /// TOML file of kinds of soil: `[[soil]]` sections with name, source, and as wanted dose_pa_m, passes, speed_m_s, force_n. Plates name
    /// theirs by layout.plate_soil, or each by its own.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub soil_file: Option<PathBuf>,
}
