//! The `[ik]` section: inverse kinematics.
//!
//! The `[transition]` section: transits of the paper's program, and the arc of all transits.
//!
//! The `[limits]` section: limits of joints and tip.
//!
//! The `[job]` section: the program, its requirements, and the outcome of a failure.

use platewash_keys::Section;
use platewash_paper::cubic::Interpolation;
use platewash_paper::settings::{IkMethod, IkSeed};
use platewash_workcell::job::OrderRule;
use serde::{Deserialize, Serialize};

/// `[ik]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("ik")]
#[serde(default, deny_unknown_fields)]
pub struct IkSection {
    /// Solver of the paper's program: damped least squares with a QP fallback, alone or also from the closed form's nearest branch.
    #[key(domain = Word(&["numeric", "analytic"]), default = IkMethod::Numeric)]
    pub method: IkMethod,
    /// Each waypoint is solved from the configuration that the arm really has (the paper), or from the previous answer.
    #[key(domain = Word(&["executed", "previous"]), default = IkSeed::Previous)]
    pub seed: IkSeed,
    /// Largest accepted position error.
    #[key(unit = "m", domain = Number(1e-12, 1e-2), default = 1e-6)]
    pub position_tolerance_m: f64,
    /// Largest accepted orientation error.
    #[key(unit = "rad", domain = Number(1e-12, 1e-2), default = 1e-6)]
    pub orientation_tolerance_rad: f64,
}

/// `[transition]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("transition")]
#[serde(default, deny_unknown_fields)]
pub struct TransitionSection {
    /// Curve between plates: cubics at rest at every waypoint (the paper), or one spline with continuous acceleration.
    #[key(domain = Word(&["zero_velocity", "c2_spline"]), default = Interpolation::C2Spline)]
    pub interpolation: Interpolation,
    /// Samples along the curve, both ends included.
    #[key(domain = Integer(2, 100_000), default = 50)]
    pub samples: usize,
    /// Waypoints of the arc round the base, both ends included.
    #[key(domain = Integer(2, 1000), default = 5)]
    pub mid_points: usize,
    /// Radius of the arc; without it, max(layout.base_radius_m + 0.1, 0.3).
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mid_radius_m: Option<f64>,
    /// z of the arc.
    #[key(unit = "m", domain = Number(-10.0, 10.0), default = 0.25)]
    pub mid_height_m: f64,
}

/// `[limits]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("limits")]
#[serde(default, deny_unknown_fields)]
pub struct LimitsSection {
    /// Joint acceleration limits, at least 0.001 in a certified job: an assumption, as the manufacturer publishes none. Where the arm's
    /// description states less, that counts.
    #[key(unit = "rad/s²", domain = JointsAbove(0.0, 1e6), default = [4.0, 4.0, 4.0, 5.0, 5.0, 6.0])]
    pub joint_acceleration_rad_s2: [f64; 6],
    /// Largest speed of the tip anywhere (certified), at least 0.000001: an assumption.
    #[key(unit = "m/s", domain = NumberAbove(0.0, 100.0), default = 1.0)]
    pub tip_speed_m_s: f64,
    /// Largest acceleration of the tip anywhere (certified), at least 0.000001: an assumption.
    #[key(unit = "m/s²", domain = NumberAbove(0.0, 1e4), default = 8.0)]
    pub tip_acceleration_m_s2: f64,
}

/// `[job]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("job")]
#[serde(default, deny_unknown_fields)]
pub struct JobSection {
    /// Waypoint after waypoint as the paper's program, or planned as a whole, from home to home, with a certificate. Each uses the keys that
    /// it needs.
    #[key(domain = Word(&["paper", "certified"]), default = Program::Certified)]
    pub program: Program,
    /// A job that does not wash: report it (exit code 0), or also end with exit code 3 (infeasible) or 4 (verification failed).
    #[key(domain = Word(&["report", "fail"]), default = OnFailure::Report)]
    pub on_failure: OnFailure,
    /// Order of the plates: always the nearest unvisited centre, as listed, or the least travel time in all (certified only).
    #[key(domain = Word(&["nearest", "given", "fastest"]), default = OrderRule::Nearest)]
    pub order: OrderRule,
    /// Share of a plate's disc that the executed sponge must sweep for the plate to count as washed.
    #[key(domain = Number(0.0, 1.0), default = 0.99)]
    pub required_coverage: f64,
}

/// Program that plans a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Program {
    /// Waypoint after waypoint, each solved and followed by a control law: the paper's program.
    Paper,
    /// As a whole, from home to home: wash paths, redundancy, transits, timing, certificate.
    Certified,
}

/// Outcome of a job that does not wash.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OnFailure {
    /// A report; exit code 0.
    Report,
    /// A report; exit code 3 (infeasible) or 4 (verification failed).
    Fail,
}
