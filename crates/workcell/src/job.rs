//! A job: what is to be washed, in which workcell, and what the washing must keep. Resolved: every number is stated, there are no
//! defaults and no files left.

use crate::arc::Arc as ArcRoundBase;
use crate::clearance::ClearanceError;
use crate::layout::MAX_PLATES;
use crate::plate::{GREATEST_M, Plate};
use crate::simulation::SimulationSettings;
use crate::workcell::{ArmId, ObstacleShape, Workcell};
use platewash_kinematics::{AXES, JointVector, LimitViolation, Pose, RobotModel};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// The largest seed: up to here every whole number is a JSON number of its own (RFC 8785 writes them all as doubles), so that no two
/// seeds are one text in a plan file.
pub const MAX_SEED: u64 = (1 << 53) - 1;

/// How far the tip of a plan may be from its wash path while it washes \[m\].
pub const PATH_TOLERANCE_M: f64 = 2e-4;

/// How far the tip of a plan may be from the line over the end of a wash path while it approaches and retreats \[m\].
pub const LINE_TOLERANCE_M: f64 = 1e-3;

/// The terms of a job: everything about it but the arm itself, as a plan file states it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JobTerms {
    /// The world.
    pub workcell: Workcell,
    /// The plates, by their index.
    pub plates: Vec<Plate>,
    /// What the washing must keep.
    pub requirements: Requirements,
    /// What joints and tip must not exceed, beyond the limits of the arm's description.
    pub limits: Limits,
    /// Joint positions at the start and at the end \[rad\].
    pub home_rad: [JointVector; 2],
    /// How it is planned: hashed, not judged.
    pub planner: Planner,
    /// Seed of every random stream.
    pub seed: u64,
    /// How its plan is simulated: hashed, not judged.
    pub simulation: SimulationSettings,
}

/// What a washing must keep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirements {
    /// Share of a plate that must be swept for it to count as washed.
    pub coverage: f64,
    /// Least clearance of every pair that must keep clear \[m\]; at 0 only contact breaks it.
    pub clearance_m: f64,
    /// Largest angle of the tool from the plate's normal while it approaches, washes and retreats \[rad\]; see
    /// [`JobTerms::tilt_max_rad`].
    pub tilt_rad: f64,
    /// Largest speed of the tip while it washes \[m/s\]; see [`JobTerms::wash_speed_m_s`].
    pub wash_speed_m_s: f64,
    /// Largest acceleration of the tip while it washes \[m/s²\]; see [`JobTerms::wash_acceleration_m_s2`].
    pub wash_acceleration_m_s2: f64,
    /// What follows where plates overlap.
    pub overlap: Overlap,
    /// Whether plates must be washed as they are listed.
    pub as_listed: bool,
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
    /// Outer radius of the wash path \[m\].
    pub path_radius_m: f64,
    /// Turns of its spiral.
    pub turns: f64,
    /// Whether a full circle at the outer radius follows the spiral.
    pub closing_ring: bool,
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

impl JobTerms {
    /// How the washing is planned; `None` for a run of the paper's program.
    #[must_use]
    pub fn planner_settings(&self) -> Option<&PlannerSettings> {
        match &self.planner {
            Planner::Wash(settings) => Some(settings),
            Planner::Paper(_) => None,
        }
    }

    /// Largest angle of the tool from a plate's normal \[rad\]: what is required, and no more than the sponge allows.
    #[must_use]
    pub fn tilt_max_rad(&self) -> f64 {
        let sponge = self.workcell.tool.sponge.greatest_tilt_rad();
        self.requirements.tilt_rad.min(sponge)
    }

    /// Largest speed of the tip while it washes \[m/s\], never above that anywhere.
    #[must_use]
    pub fn wash_speed_m_s(&self) -> f64 {
        self.requirements.wash_speed_m_s.min(self.limits.tip_speed_m_s)
    }

    /// Largest acceleration of the tip while it washes \[m/s²\], never above that anywhere.
    #[must_use]
    pub fn wash_acceleration_m_s2(&self) -> f64 {
        let anywhere = self.limits.tip_acceleration_m_s2;
        self.requirements.wash_acceleration_m_s2.min(anywhere)
    }

    /// Refuses terms with which nothing can be computed, NaN and infinity included.
    ///
    /// # Errors
    /// [`JobError`], naming the first.
    pub fn validate(&self) -> Result<(), JobError> {
        let wanted = &self.requirements;
        within("requirements.coverage", wanted.coverage, [0.0, 1.0])?;
        within("requirements.clearance_m", wanted.clearance_m, [0.0, 1.0])?;
        within("requirements.tilt_rad", wanted.tilt_rad, [0.0, FRAC_PI_2])?;
        positive("requirements.wash_speed_m_s", wanted.wash_speed_m_s)?;
        positive("requirements.wash_acceleration_m_s2", wanted.wash_acceleration_m_s2)?;
        for joint in self.limits.joint_acceleration_rad_s2 {
            positive("limits.joint_acceleration_rad_s2", joint)?;
        }
        positive("limits.tip_speed_m_s", self.limits.tip_speed_m_s)?;
        positive("limits.tip_acceleration_m_s2", self.limits.tip_acceleration_m_s2)?;
        for joint in self.home_rad.iter().flatten() {
            within("home_rad", *joint, [-1e3, 1e3])?;
        }
        if self.seed > MAX_SEED {
            return Err(JobError::Seed { found: self.seed });
        }
        self.check_tool()?;
        self.check_world()?;
        let count = self.plates.len();
        if !(1..=MAX_PLATES).contains(&count) {
            return Err(JobError::PlateCount { found: count });
        }
        match self.plates.iter().position(|plate| !plate.is_sound()) {
            Some(plate) => Err(JobError::NoPlate { plate }),
            None => Ok(()),
        }
    }

    fn check_tool(&self) -> Result<(), JobError> {
        let tool = &self.workcell.tool;
        for (name, size) in [
            ("workcell.tool.sponge.radius_m", tool.sponge.radius_m),
            ("workcell.tool.sponge.height_m", tool.sponge.height_m),
        ] {
            positive(name, size)?;
            within(name, size, [0.0, GREATEST_M])?;
        }
        let most = tool.sponge.height_m;
        within(
            "workcell.tool.sponge.compression_m",
            tool.sponge.compression_m,
            [0.0, most],
        )?;
        for at in tool
            .tip
            .translation
            .vector
            .iter()
            .chain(&tool.sponge.pose.translation.vector)
        {
            within("workcell.tool.tip", *at, [-10.0, 10.0])?;
        }
        Ok(())
    }

    /// What this version can judge of a world.
    fn check_world(&self) -> Result<(), JobError> {
        let workcell = &self.workcell;
        if workcell.mount != Pose::identity() {
            return Err(JobError::Mount);
        }
        let floor = |shape: &ObstacleShape| *shape == ObstacleShape::HalfSpace;
        let tilted = |pose: &Pose| *pose != Pose::identity();
        if let Some(other) = workcell.obstacles.iter().find(|o| floor(&o.shape) && tilted(&o.pose)) {
            let name = other.name.clone();
            return Err(JobError::HalfSpace { name });
        }
        match self.plates.iter().position(|plate| !plate.is_level()) {
            Some(plate) => Err(JobError::TiltedPlate { plate }),
            None => Ok(()),
        }
    }
}

/// Why a job is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JobError {
    /// A number out of range.
    #[error("job: {name} must be {expected}; found {found}")]
    Number {
        /// Its place in the job.
        name: &'static str,
        /// What it must be.
        expected: String,
        /// What it is.
        found: f64,
    },
    /// A seed that JSON cannot say.
    #[error("job: seed must be at most 2^53 − 1; found {found}")]
    Seed {
        /// What it is.
        found: u64,
    },
    /// No plates, or too many.
    #[error("{found} plates; a job has at least 1 and at most {MAX_PLATES}")]
    PlateCount {
        /// Plates found.
        found: usize,
    },
    /// A plate of no size, or nowhere.
    #[error("plate {plate}: its centre, height, radius and thickness must be finite, the latter two above 0")]
    NoPlate {
        /// Index of the plate.
        plate: usize,
    },
    /// A plate that does not lie level.
    #[error("plate {plate} is tilted; this version washes level plates only")]
    TiltedPlate {
        /// Index of the plate.
        plate: usize,
    },
    /// The arm is not mounted at the world's origin.
    #[error("the arm must be mounted at the origin of the world; this version knows no other mount")]
    Mount,
    /// A half-space that is not the floor.
    #[error("obstacle \"{name}\": a half-space must be z ≤ 0 of the world; this version knows no other")]
    HalfSpace {
        /// The obstacle.
        name: String,
    },
    /// The terms are for another arm.
    #[error("the job is for the arm \"{}\" with description {}; given is \"{}\" with {}", .job.name, .job.urdf_sha256, .given.name, .given.urdf_sha256)]
    OtherArm {
        /// That of the job.
        job: Box<ArmId>,
        /// The one given.
        given: Box<ArmId>,
    },
    /// An end configuration beyond the arm's limits.
    #[error("at the {end} of the motion: {violation}")]
    Home {
        /// Which end.
        end: End,
        /// Which joint, and by how much.
        violation: LimitViolation,
    },
    /// A shape of the arm is none.
    #[error(transparent)]
    Clearance(#[from] ClearanceError),
}

/// An end of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Where it starts.
    Start,
    /// Where it ends.
    End,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Start => "start",
            Self::End => "end",
        })
    }
}

/// A job with its arm.
#[derive(Debug, Clone)]
pub struct WashJob {
    name: String,
    arm: Arc<RobotModel>,
    terms: JobTerms,
}

impl WashJob {
    /// The terms with the arm that they are for.
    ///
    /// # Errors
    /// [`JobError`]: terms with which nothing can be computed, another arm, or an end configuration beyond its limits.
    pub fn new(arm: Arc<RobotModel>, terms: JobTerms) -> Result<Self, JobError> {
        terms.validate()?;
        let given = ArmId::of(&arm);
        if terms.workcell.arm != given {
            let job = Box::new(terms.workcell.arm.clone());
            let given = Box::new(given);
            return Err(JobError::OtherArm { job, given });
        }
        for (end, q) in [End::Start, End::End].into_iter().zip(&terms.home_rad) {
            if let Some(violation) = arm.limits().violation(q) {
                return Err(JobError::Home { end, violation });
            }
        }
        let name = "unnamed".to_owned();
        Ok(Self { name, arm, terms })
    }

    /// The same job under the name of a scenario, for reports and the plan's provenance.
    #[must_use]
    pub fn named(self, name: &str) -> Self {
        let name = name.to_owned();
        Self { name, ..self }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The arm.
    #[must_use]
    pub fn arm(&self) -> &RobotModel {
        &self.arm
    }

    /// The arm, to be shared.
    #[must_use]
    pub fn shared_arm(&self) -> Arc<RobotModel> {
        self.arm.clone()
    }

    /// Everything else.
    #[must_use]
    pub fn terms(&self) -> &JobTerms {
        &self.terms
    }

    /// The same job on other plates.
    ///
    /// # Errors
    /// [`JobError`] for plates that are none.
    pub fn on_plates(&self, plates: Vec<Plate>) -> Result<Self, JobError> {
        let terms = JobTerms {
            plates,
            ..self.terms.clone()
        };
        Ok(Self::new(self.arm.clone(), terms)?.named(&self.name))
    }
}

fn within(name: &'static str, found: f64, [least, most]: [f64; 2]) -> Result<(), JobError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    let expected = format!("from {least} to {most}");
    Err(JobError::Number { name, expected, found })
}

fn positive(name: &'static str, found: f64) -> Result<(), JobError> {
    if found > 0.0 && found.is_finite() {
        return Ok(());
    }
    let expected = "finite and above 0".to_owned();
    Err(JobError::Number { name, expected, found })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{kitchen, kitchen_terms};
    use crate::workcell::Obstacle;

    type Change = fn(&mut JobTerms);

    #[test]
    fn terms_with_which_nothing_can_be_computed_are_refused_by_name() {
        let good = kitchen();
        let cases: [(&str, Change); 22] = [
            ("requirements.coverage", |t| t.requirements.coverage = f64::NAN),
            ("requirements.coverage", |t| t.requirements.coverage = 1.1),
            ("requirements.clearance_m", |t| t.requirements.clearance_m = -1e-9),
            ("requirements.tilt_rad", |t| t.requirements.tilt_rad = 2.0),
            ("requirements.wash_speed_m_s", |t| t.requirements.wash_speed_m_s = 0.0),
            ("requirements.wash_acceleration_m_s2", |t| {
                t.requirements.wash_acceleration_m_s2 = f64::INFINITY
            }),
            ("limits.joint_acceleration_rad_s2", |t| {
                t.limits.joint_acceleration_rad_s2[5] = -1.0
            }),
            ("limits.tip_speed_m_s", |t| t.limits.tip_speed_m_s = f64::NAN),
            ("limits.tip_acceleration_m_s2", |t| t.limits.tip_acceleration_m_s2 = 0.0),
            ("home_rad", |t| t.home_rad[1][3] = f64::NAN),
            ("seed", |t| t.seed = MAX_SEED + 1),
            ("0 plates", |t| t.plates.clear()),
            ("plate 2", |t| t.plates[2].thickness_m = 0.0),
            ("plate 1 is tilted", |t| {
                t.plates[1].pose.rotation = nalgebra::UnitQuaternion::from_euler_angles(0.1, 0.0, 0.0)
            }),
            ("sponge.radius_m", |t| t.workcell.tool.sponge.radius_m = 1000.1),
            ("sponge.radius_m", |t| t.workcell.tool.sponge.radius_m = 0.0),
            ("sponge.height_m", |t| t.workcell.tool.sponge.height_m = 1000.1),
            ("sponge.height_m", |t| t.workcell.tool.sponge.height_m = f64::NAN),
            ("sponge.compression_m", |t| t.workcell.tool.sponge.compression_m = 1.0),
            ("mounted at the origin", |t| t.workcell.mount.translation.z = 0.5),
            ("obstacle \"wall\"", |t| {
                let wall = Obstacle {
                    name: "wall".to_owned(),
                    pose: Pose::translation(0.0, 0.0, -1.0),
                    ..Obstacle::floor()
                };
                t.workcell.obstacles.push(wall);
            }),
            ("the job is for the arm \"other\"", |t| {
                t.workcell.arm.name = "other".to_owned()
            }),
        ];
        for (words, change) in cases {
            let mut terms = good.terms().clone();
            change(&mut terms);
            let said = WashJob::new(good.shared_arm(), terms).unwrap_err().to_string();
            assert!(said.contains(words), "{words}: {said}");
        }
    }

    #[test]
    fn a_home_beyond_the_limits_is_refused_by_its_joint() {
        let good = kitchen();
        let mut terms = good.terms().clone();
        terms.home_rad[1][2] = 3.0;
        let said = WashJob::new(good.shared_arm(), terms).unwrap_err().to_string();
        assert!(said.contains("end of the motion") && said.contains("joint 3"), "{said}");
    }

    /// By hand: atan(1/2) is 26.6°, less than the 30° asked for.
    #[test]
    fn a_flat_sponge_allows_less_tilt_than_is_asked_for() {
        let robot = RobotModel::irb120().unwrap();
        let mut terms = kitchen_terms(&robot, Vec::new());
        terms.requirements.tilt_rad = 30_f64.to_radians();
        assert_eq!(terms.tilt_max_rad(), 30_f64.to_radians());
        terms.workcell.tool.sponge.height_m = 0.5 * terms.workcell.tool.sponge.radius_m;
        assert!((terms.tilt_max_rad() - 0.5_f64.atan()).abs() < 1e-15);
    }
}
