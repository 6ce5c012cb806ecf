//! The scenario file: everything that decides a job, in TOML with the unit in every key's name.
//!
//! [`keys`] is the one table of keys, units, ranges and meanings: it checks files and makes
//! `docs/scenario.md`. The defaults are those of the types here.

mod certified;
mod control;
mod document;
mod error;
pub mod keys;
mod load;
mod paths;
mod plant;
mod shipped;
mod work;

pub use control::{ControlLawName, ControlSection, FeedForward};
pub use document::reference;
pub use error::{Problem, ScenarioError};
pub use plant::{Integrator, PlantSection};
pub use shipped::{SHIPPED, ShippedScenario};
pub use work::{MAX_PLATE_CHECKS, MAX_STROKE_CHECKS, MAX_WAYPOINTS};

use crate::layout::Region;
use crate::transition::Arc;
use platewash_kinematics::{JointVector, ToolFrame};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A job in full: what a scenario file states, with defaults filled in. Ranges are checked by
/// [`Scenario::parse`] and [`Scenario::validate`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Scenario {
    /// Name, for reports.
    pub name: String,
    /// Seed of every random stream.
    pub seed: u64,
    /// What counts as done.
    pub job: JobSection,
    /// The arm.
    pub robot: RobotSection,
    /// What it holds.
    pub tool: ToolSection,
    /// Where the plates lie.
    pub layout: LayoutSection,
    /// The path on a plate.
    pub wash: WashSection,
    /// Inverse kinematics along the path.
    pub ik: IkSection,
    /// The way between plates.
    pub transition: TransitionSection,
    /// Limits beyond those of the arm's description.
    pub limits: LimitsSection,
    /// How the arm follows.
    pub control: ControlSection,
    /// The arm as a physical system.
    pub plant: PlantSection,
}

/// `[job]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct JobSection {
    /// How the job is planned.
    pub program: Program,
    /// Whether a job that does not wash ends with an error.
    pub on_failure: OnFailure,
    /// In which order plates are washed.
    pub order: OrderRule,
    /// Share of a plate that must be swept for it to count as washed.
    pub required_coverage: f64,
}

/// How a job is planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Program {
    /// Waypoint after waypoint, each solved and followed by a control law: the paper's program.
    Paper,
    /// As a whole, from home to home: tool path, posture, crossings, timing, certificate.
    Certified,
}

/// What a job that does not wash leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OnFailure {
    /// A report; exit code 0.
    Report,
    /// A report; exit code 3 (infeasible) or 4 (verification failed).
    Fail,
}

/// In which order plates are washed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OrderRule {
    /// Always the nearest unvisited plate centre (the paper's rule).
    Nearest,
    /// As listed.
    Given,
    /// The least travel time in all; [`Program::Certified`] only.
    Fastest,
}

/// `[robot]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RobotSection {
    /// An arm that is built in.
    pub model: BuiltInArm,
    /// A description that replaces it.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "paths::lossy")]
    pub urdf: Option<PathBuf>,
    /// Its list of link pairs that need no check.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "paths::lossy")]
    pub srdf: Option<PathBuf>,
    /// Folders in which `package://` names are looked up.
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "paths::lossy_all")]
    pub package_path: Vec<PathBuf>,
    /// The frame in which tool poses are stated and returned.
    pub tool_frame: ToolFrame,
    /// Joint positions at the start \[deg\].
    pub start_deg: [f64; 6],
    /// Joint positions at the end \[deg\]; by default those at the start. [`Program::Certified`] only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub home_deg: Option<[f64; 6]>,
    /// Rated payload \[kg\]; without it, that of the built-in arm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub payload_kg: Option<f64>,
}

/// Arms that are built in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BuiltInArm {
    /// ABB IRB 120.
    Irb120,
}

/// `[tool]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ToolSection {
    /// From the flange to the sponge's far face \[m\]; 0 for no tool body.
    pub length_m: f64,
    /// Radius of the handle \[m\].
    pub radius_m: f64,
    /// Radius of the sponge \[m\]; also decides coverage.
    pub sponge_radius_m: f64,
    /// Height of the sponge \[m\].
    pub sponge_height_m: f64,
    /// How far the sponge is pressed in while it washes \[m\]: the tip may lift as far and still touch. An assumption.
    pub sponge_compression_m: f64,
    /// Mass of the tool body \[kg\]: an assumption.
    pub mass_kg: f64,
    /// Distance of its centre of mass from the flange along its axis \[m\]; without it, half its length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub com_m: Option<f64>,
    /// Its inertia about the centre of mass, ixx, ixy, ixz, iyy, iyz, izz with z along it \[kg·m²\]; without it, that of a
    /// uniform cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 6]>,
}

/// `[layout]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LayoutSection {
    /// Plates to sample.
    pub count: usize,
    /// Radius of a plate \[m\].
    pub plate_radius_m: f64,
    /// z of the washing surface \[m\].
    pub plate_height_m: f64,
    /// Thickness of a plate, downwards \[m\].
    pub plate_thickness_m: f64,
    /// A region by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<RegionName>,
    /// Range of x \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_m: Option<[f64; 2]>,
    /// Range of y \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_m: Option<[f64; 2]>,
    /// Range of the distance from the base axis \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rho_m: Option<[f64; 2]>,
    /// Range of the azimuth \[deg\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub azimuth_deg: Option<[f64; 2]>,
    /// Least distance between centres \[m\].
    pub min_distance_m: f64,
    /// Least distance of a centre from the base axis \[m\].
    pub base_radius_m: f64,
    /// What overlapping plates lead to.
    pub overlap: Overlap,
    /// Whether layouts are drawn until every plate can be washed whole.
    pub only_washable: bool,
    /// Plate centres, in place of sampling \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub positions_m: Option<Vec<[f64; 2]>>,
}

/// What plates that overlap lead to, in a certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Overlap {
    /// A finding.
    Report,
    /// The certificate fails.
    Fail,
}

/// The paper's two regions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RegionName {
    /// As the paper's text says.
    Text,
    /// As its appendix code says.
    Appendix,
}

impl RegionName {
    /// The region it names.
    #[must_use]
    pub fn region(self) -> Region {
        match self {
            Self::Text => Region::PAPER_TEXT,
            Self::Appendix => Region::PAPER_APPENDIX,
        }
    }
}

/// `[wash]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WashSection {
    /// Waypoints of the spiral.
    pub points: usize,
    /// Turns of the spiral.
    pub turns: f64,
    /// Outer radius of the spiral \[m\].
    pub path_radius_m: f64,
    /// Height of the tip above the washing surface \[m\].
    pub height_m: f64,
    /// Whether a full circle at the outer radius follows the spiral.
    pub closing_ring: bool,
    /// Least clearance that counts as free \[m\].
    pub clearance_m: f64,
    /// Largest angle of the tool from the plate's normal \[deg\]. This key and those below: [`Program::Certified`] only.
    pub tilt_max_deg: f64,
    /// Largest speed of the tip along the path \[m/s\].
    pub speed_m_s: f64,
    /// Largest acceleration of the tip on the path \[m/s²\].
    pub acceleration_m_s2: f64,
    /// How far the tip approaches and retreats along the plate's normal \[m\].
    pub lift_m: f64,
}

/// `[ik]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct IkSection {
    /// The solver.
    pub method: IkMethod,
    /// From where each waypoint is solved.
    pub seed: IkSeed,
    /// Largest accepted position error \[m\].
    pub position_tolerance_m: f64,
    /// Largest accepted orientation error \[rad\].
    pub orientation_tolerance_rad: f64,
}

/// The inverse-kinematics solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IkMethod {
    /// Damped least squares with a QP fallback, from the seed and a fixed list of starts.
    Numeric,
    /// The same, from the closed form's nearest branch where the seed is far away or fails (arms that have one).
    Analytic,
}

/// From where each waypoint is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IkSeed {
    /// The configuration that the arm really has, lagging behind (the paper).
    Executed,
    /// The answer at the previous waypoint.
    Previous,
}

/// `[transition]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TransitionSection {
    /// Curve through the waypoints.
    pub interpolation: Interpolation,
    /// Samples along the curve.
    pub samples: usize,
    /// Waypoints of the arc round the base, both ends included.
    pub mid_points: usize,
    /// Radius of the arc \[m\]; by default max(`layout.base_radius_m` + 0.1, 0.3).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mid_radius_m: Option<f64>,
    /// z of the arc \[m\].
    pub mid_height_m: f64,
}

/// A curve through waypoints at equally spaced times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// One cubic per segment, at rest at every waypoint (the paper).
    ZeroVelocity,
    /// One spline with continuous acceleration, at rest at both ends only.
    C2Spline,
}

/// `[limits]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LimitsSection {
    /// Joint acceleration limits \[rad/s²\]: an assumption, as the manufacturer publishes none.
    pub joint_acceleration_rad_s2: [f64; 6],
    /// Largest speed of the tip anywhere \[m/s\]: an assumption. [`Program::Certified`] only.
    pub tip_speed_m_s: f64,
    /// Largest acceleration of the tip anywhere \[m/s²\]: an assumption. [`Program::Certified`] only.
    pub tip_acceleration_m_s2: f64,
}

impl Scenario {
    /// Joint positions at the start and at the end \[rad\].
    #[must_use]
    pub fn homes(&self) -> [JointVector; 2] {
        let start = self.robot.start_deg;
        [start, self.robot.home_deg.unwrap_or(start)].map(|deg| JointVector::from(deg).map(f64::to_radians))
    }

    /// Largest angle of the tool from a plate's normal \[rad\]: `wash.tilt_max_deg`, and no more than the sponge gives way by its
    /// height `h` over its radius `s`, `asin(h / s)`. Beyond that its rim would have to go through the plate.
    #[must_use]
    pub fn tilt_max_rad(&self) -> f64 {
        let asked = self.wash.tilt_max_deg.to_radians();
        let gives_way = self.tool.sponge_height_m / self.tool.sponge_radius_m;
        if gives_way < 1.0 {
            asked.min(crate::trig::asin(gives_way))
        } else {
            asked
        }
    }

    /// The control law: the one stated, otherwise the paper's for the paper's program and computed torque for a certified job.
    #[must_use]
    pub fn law(&self) -> ControlLawName {
        self.control.law.unwrap_or(match self.job.program {
            Program::Paper => ControlLawName::Paper,
            Program::Certified => ControlLawName::ComputedTorque,
        })
    }

    /// The arc round the base.
    #[must_use]
    pub fn arc(&self) -> Arc {
        let section = &self.transition;
        Arc {
            points: section.mid_points,
            radius_m: section
                .mid_radius_m
                .unwrap_or((self.layout.base_radius_m + 0.1).max(0.3)),
            height_m: section.mid_height_m,
        }
    }
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            name: "unnamed".to_owned(),
            seed: 1,
            job: JobSection::default(),
            robot: RobotSection::default(),
            tool: ToolSection::default(),
            layout: LayoutSection::default(),
            wash: WashSection::default(),
            ik: IkSection::default(),
            transition: TransitionSection::default(),
            limits: LimitsSection::default(),
            control: ControlSection::default(),
            plant: PlantSection::default(),
        }
    }
}

impl Default for JobSection {
    fn default() -> Self {
        Self {
            program: Program::Certified,
            on_failure: OnFailure::Report,
            order: OrderRule::Nearest,
            required_coverage: 0.99,
        }
    }
}

impl Default for RobotSection {
    fn default() -> Self {
        Self {
            model: BuiltInArm::Irb120,
            urdf: None,
            srdf: None,
            package_path: Vec::new(),
            tool_frame: ToolFrame::Tool0,
            start_deg: [0.0; 6],
            home_deg: None,
            payload_kg: None,
        }
    }
}

impl Default for ToolSection {
    fn default() -> Self {
        Self {
            length_m: 0.0,
            radius_m: 0.02,
            sponge_radius_m: 0.025,
            sponge_height_m: 0.025,
            sponge_compression_m: 0.005,
            mass_kg: 0.3,
            com_m: None,
            inertia_kg_m2: None,
        }
    }
}

impl Default for LayoutSection {
    fn default() -> Self {
        Self {
            count: 4,
            plate_radius_m: 0.145,
            plate_height_m: 0.03,
            plate_thickness_m: 0.02,
            region: None,
            x_m: None,
            y_m: None,
            rho_m: None,
            azimuth_deg: None,
            min_distance_m: 0.28,
            base_radius_m: 0.25,
            overlap: Overlap::Fail,
            only_washable: false,
            positions_m: None,
        }
    }
}

impl Default for WashSection {
    fn default() -> Self {
        Self {
            points: 55,
            turns: 3.0,
            path_radius_m: 0.145,
            height_m: 0.05,
            closing_ring: false,
            clearance_m: 0.0,
            tilt_max_deg: 15.0,
            speed_m_s: 0.25,
            acceleration_m_s2: 4.0,
            lift_m: 0.03,
        }
    }
}

impl Default for IkSection {
    fn default() -> Self {
        Self {
            method: IkMethod::Numeric,
            seed: IkSeed::Previous,
            position_tolerance_m: 1e-6,
            orientation_tolerance_rad: 1e-6,
        }
    }
}

impl Default for TransitionSection {
    fn default() -> Self {
        Self {
            interpolation: Interpolation::C2Spline,
            samples: 50,
            mid_points: 5,
            mid_radius_m: None,
            mid_height_m: 0.25,
        }
    }
}

impl Default for LimitsSection {
    fn default() -> Self {
        Self {
            joint_acceleration_rad_s2: [4.0, 4.0, 4.0, 5.0, 5.0, 6.0],
            tip_speed_m_s: 1.0,
            tip_acceleration_m_s2: 8.0,
        }
    }
}
