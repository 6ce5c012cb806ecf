//! The plan file: everything that a verifier needs besides the URDF, sealed with a hash.

mod contents;

use crate::job::Job;
use crate::report::JobReport;
use crate::scenario::{Scenario, Tool};
use crate::tool_path::Segment;
use platewash_kinematics::{AXES, JointVector, RobotModel, sha256_hex};
use platewash_workcell::layout::Plate;
pub use platewash_workcell::segment::PlanSegment;
use platewash_workcell::trajectory::Trajectory;
use platewash_workcell::words::printable;
use serde::{Deserialize, Serialize};

/// The format that this version writes and reads.
pub const FORMAT: &str = "platewash-plan/1";

/// How far the tip of a certified plan may be from its path while it washes \[m\].
pub const PATH_TOLERANCE_M: f64 = 2e-4;

/// How far the tip of a certified plan may be from a plate's normal while it approaches and retreats \[m\].
pub const LINE_TOLERANCE_M: f64 = 1e-3;

/// What a plan is made of; the rest follows from the scenario and the arm.
#[derive(Debug)]
pub struct PlanParts<'a> {
    /// What was asked.
    pub scenario: &'a Scenario,
    /// The arm.
    pub robot: &'a RobotModel,
    /// The plates.
    pub plates: &'a [Plate],
    /// Plate indices in the order of washing.
    pub order: &'a [usize],
    /// What the tip must do.
    pub tool_path: &'a [Segment],
    /// The same in time.
    pub segments: Vec<PlanSegment>,
    /// The motion.
    pub motion: &'a Trajectory,
    /// The pairs of bodies that were checked for clearance.
    pub clearance_pairs: Vec<[String; 2]>,
    /// What a reader wants to know first.
    pub summary: Summary,
}

/// A plan file, `"format": "platewash-plan/1"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// [`FORMAT`].
    pub format: String,
    /// SHA-256 over the canonical JSON (RFC 8785) of everything else, lower-case hexadecimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hash: Option<String>,
    /// The scenario, resolved, with its seed.
    pub scenario: Scenario,
    /// The arm.
    pub robot: PlanRobot,
    /// The tip on the arm: the frame that follows the tool path.
    pub tip: TipPose,
    /// The pairs of bodies that were checked for clearance, by name.
    pub clearance_pairs: Vec<[String; 2]>,
    /// Joint positions at the start and at the end \[rad\].
    pub home_rad: [JointVector; 2],
    /// What it holds.
    pub tool: Tool,
    /// The plates.
    pub plates: Vec<Plate>,
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// How exactly the tip must be where the tool path says, where the inverse kinematics solved it.
    pub tolerances: Tolerances,
    /// What the tip must do, as parameters.
    pub tool_path: Vec<Segment>,
    /// Limits that hold for the motion; those of the tip, tilt, clearance and coverage for a certified job only.
    pub limits: PlanLimits,
    /// The segments in time.
    pub segments: Vec<PlanSegment>,
    /// The motion: cubic Hermite between knots.
    pub knots: Knots,
    /// What a reader wants to know first.
    pub summary: Summary,
}

/// The arm of a plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlanRobot {
    /// Name in the URDF.
    pub name: String,
    /// SHA-256 of the URDF.
    pub urdf_sha256: String,
}

/// The tip in the frame of the link behind joint 6: `T_link_tip`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TipPose {
    /// The link.
    pub link: String,
    /// Origin \[m\].
    pub position_m: [f64; 3],
    /// Orientation (w, x, y, z); z leaves the tool.
    pub quaternion_wxyz: [f64; 4],
}

impl TipPose {
    /// The tip of a tool on an arm.
    #[must_use]
    pub fn new(robot: &RobotModel, tool: &Tool) -> Self {
        let poses = robot.fk(&JointVector::zeros());
        let tip = platewash_workcell::tool::tip_frame(robot, tool);
        let relative = poses.pose(&robot.last_link_frame()).inv_mul(&poses.pose(&tip));
        let q = relative.rotation.quaternion();
        Self {
            link: robot.joints()[AXES - 1].child.clone(),
            position_m: relative.translation.vector.into(),
            quaternion_wxyz: [q.w, q.i, q.j, q.k],
        }
    }
}

/// Tolerances of the tool path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerances {
    /// Distance of the tip from its waypoint \[m\].
    pub position_m: f64,
    /// Angle of the tip from its waypoint \[rad\].
    pub orientation_rad: f64,
    /// Distance of the tip from a continuous path while it washes \[m\].
    pub path_m: f64,
    /// Distance of the tip from the plate's normal while it approaches and retreats \[m\].
    pub line_m: f64,
}

impl Tolerances {
    /// Those of a scenario.
    #[must_use]
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            position_m: scenario.ik.position_tolerance_m,
            orientation_rad: scenario.ik.orientation_tolerance_rad,
            path_m: PATH_TOLERANCE_M,
            line_m: LINE_TOLERANCE_M,
        }
    }
}

/// Limits of a plan; `null` where a joint has no position limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlanLimits {
    /// Lowest positions \[rad\].
    pub lower_rad: [Option<f64>; AXES],
    /// Highest positions \[rad\].
    pub upper_rad: [Option<f64>; AXES],
    /// Speeds \[rad/s\].
    pub velocity_rad_s: [f64; AXES],
    /// Accelerations \[rad/s²\]: an assumption.
    pub acceleration_rad_s2: [f64; AXES],
    /// Speed of the tip anywhere \[m/s\].
    pub tip_speed_m_s: f64,
    /// Acceleration of the tip anywhere \[m/s²\].
    pub tip_acceleration_m_s2: f64,
    /// Speed of the tip while it washes, never above that anywhere \[m/s\].
    pub wash_speed_m_s: f64,
    /// Acceleration of the tip while it washes, never above that anywhere \[m/s²\].
    pub wash_acceleration_m_s2: f64,
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats \[rad\].
    pub tilt_rad: f64,
    /// Clearance \[m\].
    pub clearance_m: f64,
    /// Share of a plate's disc.
    pub coverage: f64,
}

impl PlanLimits {
    /// Those of a scenario's arm and of its `[limits]`, `[wash]` and `[job]`.
    #[must_use]
    pub fn new(scenario: &Scenario, robot: &RobotModel) -> Self {
        let limits = robot.limits();
        let finite = |v: &JointVector| std::array::from_fn(|i| v[i].is_finite().then_some(v[i]));
        Self {
            lower_rad: finite(&limits.lower),
            upper_rad: finite(&limits.upper),
            velocity_rad_s: limits.velocity.into(),
            acceleration_rad_s2: scenario.limits.joint_acceleration_rad_s2,
            tip_speed_m_s: scenario.limits.tip_speed_m_s,
            tip_acceleration_m_s2: scenario.limits.tip_acceleration_m_s2,
            wash_speed_m_s: scenario.wash.speed_m_s.min(scenario.limits.tip_speed_m_s),
            wash_acceleration_m_s2: (scenario.wash.acceleration_m_s2).min(scenario.limits.tip_acceleration_m_s2),
            tilt_rad: scenario.tilt_max_rad(),
            clearance_m: scenario.wash.clearance_m,
            coverage: scenario.job.required_coverage,
        }
    }
}

/// The knots of a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knots {
    /// Times \[s\].
    pub t_s: Vec<f64>,
    /// Positions \[rad\], one row a knot.
    pub q_rad: Vec<JointVector>,
    /// Speeds \[rad/s\], one row a knot.
    pub qd_rad_s: Vec<JointVector>,
}

impl Knots {
    /// No knots at all.
    fn none() -> Self {
        Self {
            t_s: Vec::new(),
            q_rad: Vec::new(),
            qd_rad_s: Vec::new(),
        }
    }
}

/// What a reader wants to know first. Of a certified job it follows from the rest of the plan ([`crate::certificate::summary`]), and the
/// certificate judges it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// The report's first line.
    pub headline: String,
    /// Plates that count as washed: of a certified job those that the stroke sweeps to the share required, with the sponge tilted as
    /// much as it may be or, where that is not enough, as much as it is at the knots.
    pub plates_washed: usize,
    /// Duration \[s\].
    pub duration_s: f64,
    /// Waypoints solved and asked.
    pub waypoints_reached: [usize; 2],
}

/// Why a plan file could not be written or read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanFileError {
    /// A number in it is not finite, which JSON cannot say.
    #[error("plan cannot be written as JSON: {detail}")]
    Unwritable {
        /// The serialiser's words.
        detail: String,
    },
    /// Not a plan file.
    #[error("not a plan file: {}", printable(.detail))]
    Unreadable {
        /// The parser's words, with line and column.
        detail: String,
    },
    /// A key that no plan has.
    #[error("unknown key '{key}': a plan states what this program knows and nothing else")]
    UnknownKey {
        /// Its place, e.g. `tool_path[2].extra`.
        key: String,
    },
    /// A key that is left out. Nothing is filled in: the hash is that of what the file says.
    #[error("'{key}' is missing: a plan states every value, defaults too; plan the scenario again")]
    MissingKey {
        /// Its place, e.g. `scenario.wash.turns`.
        key: String,
    },
    /// A value that says something else than what would be read.
    #[error("'{key}' is {found}; expected {read}")]
    Inexact {
        /// Its place.
        key: String,
        /// What the file says.
        found: String,
        /// What a plan file would say.
        read: String,
    },
    /// Another format.
    #[error("plan format must be \"{FORMAT}\"; found \"{}\"", printable(.found))]
    Format {
        /// The format found.
        found: String,
    },
}

impl Plan {
    /// The plan of a job of the paper's program, sealed.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn new(job: &Job, report: &JobReport) -> Result<Self, PlanFileError> {
        Self::sealed(PlanParts {
            scenario: &job.scenario,
            robot: &job.robot,
            plates: &job.layout.plates,
            order: &job.tool_path.order,
            tool_path: &job.tool_path.segments,
            segments: segments(job),
            motion: &job.planned,
            clearance_pairs: report.clearance_pairs.clone(),
            summary: report.summary(),
        })
    }

    /// The plan of some parts, sealed.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn sealed(parts: PlanParts<'_>) -> Result<Self, PlanFileError> {
        let mut plan = Self::open(parts);
        plan.hash = Some(plan.seal()?);
        Ok(plan)
    }

    /// The plan of some parts, without a hash.
    #[must_use]
    pub fn open(parts: PlanParts<'_>) -> Self {
        let PlanParts { scenario, robot, .. } = parts;
        Self {
            format: FORMAT.to_owned(),
            hash: None,
            scenario: portable(scenario),
            robot: PlanRobot {
                name: robot.name().to_owned(),
                urdf_sha256: robot.sha256().to_owned(),
            },
            tip: TipPose::new(robot, &scenario.tool),
            clearance_pairs: parts.clearance_pairs,
            home_rad: scenario.homes(),
            tool: scenario.tool.clone(),
            plates: parts.plates.to_vec(),
            order: parts.order.to_vec(),
            tolerances: Tolerances::new(scenario),
            tool_path: parts.tool_path.to_vec(),
            limits: PlanLimits::new(scenario, robot),
            segments: parts.segments,
            knots: Knots {
                t_s: parts.motion.times().to_vec(),
                q_rad: parts.motion.positions().to_vec(),
                qd_rad_s: parts.motion.speeds().to_vec(),
            },
            summary: parts.summary,
        }
    }

    /// The hash that belongs to the contents.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`] for contents that could not be read back: a number that is not finite.
    pub fn seal(&self) -> Result<String, PlanFileError> {
        let mut open = Self {
            hash: None,
            ..self.clone()
        };
        // Waypoints are no part of the file.
        open.tool_path.iter_mut().for_each(|segment| segment.waypoints.clear());
        let canonical = serde_json_canonicalizer::to_vec(&open).map_err(unwritable)?;
        open.check_readable()?;
        Ok(sha256_hex(&canonical))
    }

    /// Refuses contents that would be read back as others.
    fn check_readable(mut self) -> Result<(), PlanFileError> {
        let refuse = |detail: &str| {
            let detail = detail.to_owned();
            Err(PlanFileError::Unwritable { detail })
        };
        // Almost all numbers are here, and all of one kind.
        let Knots { t_s, q_rad, qd_rad_s } = std::mem::replace(&mut self.knots, Knots::none());
        let mut numbers = t_s.iter().chain(q_rad.iter().chain(&qd_rad_s).flatten());
        if !numbers.all(|number| number.is_finite()) {
            return refuse("a number of the knots is not finite");
        }
        // What is not finite is written as `null`, and a whole number of more than 53 bits as its neighbour.
        let rest = serde_json_canonicalizer::to_vec(&self).map_err(unwritable)?;
        if serde_json::from_slice::<Self>(&rest).map_err(unwritable)? != self {
            return refuse("a whole number is above 2^53 − 1, the largest that JSON says exactly");
        }
        Ok(())
    }

    /// Whether the stored hash is that of the contents.
    #[must_use]
    pub fn is_sealed(&self) -> bool {
        self.hash.is_some() && self.hash == self.seal().ok()
    }

    /// The file's text: canonical JSON, one line.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn to_json(&self) -> Result<String, PlanFileError> {
        serde_json_canonicalizer::to_string(self).map_err(unwritable)
    }

    /// Reads a plan file's text: every key once, none unknown, none left out, so that what is read is all that the file says and the
    /// hash of the one is that of the other. The hash is not checked here: see [`Plan::is_sealed`].
    ///
    /// # Errors
    /// [`PlanFileError`] for anything but a plan of this format.
    pub fn from_json(text: &str) -> Result<Self, PlanFileError> {
        let plan: Self = serde_json::from_str(text).map_err(|e| PlanFileError::Unreadable { detail: e.to_string() })?;
        if plan.format != FORMAT {
            return Err(PlanFileError::Format { found: plan.format });
        }
        contents::check(text, &plan)?;
        Ok(plan)
    }
}

fn unwritable(e: serde_json::Error) -> PlanFileError {
    PlanFileError::Unwritable { detail: e.to_string() }
}

/// The segments one after the other: the step from the start to the first waypoint, then one per segment of the tool path.
/// A time belongs to the segment that ends at or after it.
#[must_use]
pub fn segments(job: &Job) -> Vec<PlanSegment> {
    let Some(first) = job.tool_path.segments.first() else {
        return Vec::new();
    };
    let mut all = vec![PlanSegment {
        kind: platewash_workcell::segment::SegmentKind::Depart,
        plate: first.plate,
        t_start_s: 0.0,
        t_end_s: job.time_of(0),
    }];
    let mut end = 0;
    for segment in &job.tool_path.segments {
        end += segment.waypoints.len();
        all.push(PlanSegment {
            kind: segment.kind,
            plate: segment.plate,
            t_start_s: all[all.len() - 1].t_end_s,
            t_end_s: job.time_of(end.saturating_sub(1)),
        });
    }
    all
}

/// The scenario as a plan states it: descriptions by file name, so that the same job has the same hash wherever it lies.
fn portable(scenario: &Scenario) -> Scenario {
    let mut portable = scenario.clone();
    let robot = &mut portable.robot;
    for path in [&mut robot.urdf, &mut robot.srdf].into_iter().flatten() {
        if let Some(name) = path.file_name() {
            // As text, which is what is read back.
            *path = name.to_string_lossy().into_owned().into();
        }
    }
    robot.package_path.clear();
    portable
}
