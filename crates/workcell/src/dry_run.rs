//! What makes a job a dry run: the motion of another plan in the air, over plates that stand below as obstacles.
//!
//! The job of a dry run, out of the plan that is tried out.
//!
//! The plates are raised, together with everything that the tip does on them; the real ones stay where they are, as obstacles that must
//! be kept clear of like any other. Arm, tool, home, requirements and the settings of the planner are those of the plan, but for two
//! speeds that come down, and a plate that does not push back on a sponge in the air.

use crate::clearance::{self, ClearanceError};
use crate::job::{JobError, JobTerms, Limits, PATH_TOLERANCE_M, Requirements, WashJob};
use crate::plan::{Plan, Process};
use crate::plate::{GREATEST_M, Plate};
use crate::simulation::{PlantSettings, SimulationSettings};
use crate::words::quoted;
use crate::workcell::{Exclusion, MOST_BODIES, Obstacle, ObstacleShape, Workcell};
use platewash_kinematics::RobotModel;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Height of a dry run that is asked for without one \[m\].
pub const HEIGHT_M: f64 = 0.05;

/// The tip's largest speed in a dry run that is asked for without one \[m/s\].
pub const SPEED_M_S: f64 = 0.1;

/// Digits of a hash that are told.
const TOLD: usize = 12;

/// Digits of a hash.
const DIGITS: usize = 64;

/// That a job is the dry run of a plan. Its plates are those of that plan, raised, and nothing is there; the real ones stand below them as
/// obstacles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DryRun {
    /// Hash of the plan that is tried out: stated; whoever has that plan can compare.
    pub parent: String,
    /// How far its plates are raised \[m\].
    pub height_m: f64,
}

impl DryRun {
    /// What a person must read wherever a washing would be said to be washed.
    #[must_use]
    pub fn words(&self) -> String {
        let height_mm = (1e6 * self.height_m).round() / 1e3;
        format!(
            "DRY RUN of {}: {height_mm} mm above the plates, nothing is washed",
            self.parent_short()
        )
    }

    /// The first digits of the parent's hash; the beginning of what is no hash, in quotes.
    #[must_use]
    pub fn parent_short(&self) -> String {
        let first: String = self.parent.chars().take(TOLD).collect();
        if self.names_a_hash() {
            first
        } else {
            crate::words::quoted(&first)
        }
    }

    /// Whether the parent is named by what can be a hash: lower-case hexadecimal digits, as many as SHA-256 has.
    #[must_use]
    pub fn names_a_hash(&self) -> bool {
        let digit = |c: u8| matches!(c, b'0'..=b'9' | b'a'..=b'f');
        self.parent.len() == DIGITS && self.parent.bytes().all(digit)
    }

    /// Whether the plates are raised at all, and not out of this world.
    #[must_use]
    pub fn is_above(&self) -> bool {
        self.height_m > 0.0 && self.height_m <= GREATEST_M
    }

    /// Name of the obstacle that a real plate is.
    #[must_use]
    pub fn real_name(plate: usize) -> String {
        format!("real plate {plate}")
    }

    /// The raised plate of a real one.
    #[must_use]
    pub fn raised(&self, real: &Plate) -> Plate {
        let mut plate = *real;
        plate.pose.translation.vector += real.axis() * self.height_m;
        plate
    }

    /// The real plate of a raised one.
    #[must_use]
    pub fn lowered(&self, raised: &Plate) -> Plate {
        let mut plate = *raised;
        plate.pose.translation.vector -= raised.axis() * self.height_m;
        plate
    }

    /// A real plate as an obstacle.
    #[must_use]
    pub fn standing(index: usize, real: &Plate) -> Obstacle {
        let (shape, pose) = real.enclosure();
        Obstacle::new(&Self::real_name(index), ObstacleShape::Convex(shape), pose)
    }
}

/// Why a plan has no dry run of that kind.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DryRunError {
    /// A run of the paper's program.
    #[error("the plan is a run of the paper's program, which is not proved; a dry run is one of a washing")]
    PaperRun,
    /// It is a dry run already.
    #[error("the plan is itself a dry run (of {parent}): give the plan of the washing")]
    OfDryRun {
        /// The first digits of that plan's hash.
        parent: String,
    },
    /// Its hash is missing or not that of its contents.
    #[error("the plan was changed after it was written; a dry run names its parent by its hash")]
    NotSealed,
    /// A height that is none.
    #[error("the height must be a number above 0 m and at most {GREATEST_M} m; found {found}")]
    Height {
        /// What was asked for \[m\].
        found: f64,
    },
    /// So low that the sponge would come nearer to the real plates than the job allows.
    #[error(
        "at {found} m the sponge comes nearer to the real plates than the clearance that the job asks for; at least {least} m are needed, \
         and more where the tool tilts"
    )]
    TooLow {
        /// What was asked for \[m\].
        found: f64,
        /// What an upright tool takes \[m\].
        least: f64,
    },
    /// A speed that is none, or no slower than the plan.
    #[error("the speed must be a number above 0 m/s and at most the plan's {most} m/s; found {found}")]
    Speed {
        /// What was asked for \[m/s\].
        found: f64,
        /// The speed limit of the plan's tip \[m/s\].
        most: f64,
    },
    /// More plates than can stand in the way.
    #[error("{found} bodies of the tool, obstacles and real plates; a dry run may have at most {MOST_BODIES}")]
    TooManyBodies {
        /// How many.
        found: usize,
    },
    /// A body has the name of a real plate.
    #[error("{} is the name of a body already; a dry run gives it to a plate that stands in the way", quoted(.name))]
    NameTaken {
        /// The name.
        name: String,
    },
    /// What was planned follows other wash paths.
    #[error("its wash paths are not those that this version plans for its job, so that a dry run would follow others")]
    OtherPaths,
    /// A shape of the arm is none.
    #[error(transparent)]
    Clearance(#[from] ClearanceError),
    /// What comes of it is no job.
    #[error(transparent)]
    Job(#[from] JobError),
}

/// The terms of a dry run of `parent`, a plan for `arm`, with its plates raised by `height_m` \[m\] and its tip no faster than
/// `speed_m_s` \[m/s\]. Whether the parent is proved is for whoever hands it over to know.
///
/// # Errors
/// [`DryRunError`].
pub fn dry_run_terms(parent: &Plan, arm: &RobotModel, height_m: f64, speed_m_s: f64) -> Result<JobTerms, DryRunError> {
    let job = &parent.job;
    let dry_run = DryRun {
        parent: named(parent)?,
        height_m,
    };
    check(job, &dry_run, speed_m_s)?;
    let terms = JobTerms {
        workcell: workcell(job, arm)?,
        plates: job.plates.iter().map(|plate| dry_run.raised(plate)).collect(),
        requirements: Requirements {
            wash_speed_m_s: job.requirements.wash_speed_m_s.min(speed_m_s),
            ..job.requirements
        },
        limits: Limits {
            tip_speed_m_s: speed_m_s,
            ..job.limits
        },
        simulation: SimulationSettings {
            plant: PlantSettings {
                contact_force_n: 0.0,
                contact: None,
                ..job.simulation.plant.clone()
            },
            ..job.simulation.clone()
        },
        dry_run: Some(dry_run),
        ..job.clone()
    };
    terms.validate()?;
    Ok(terms)
}

/// The job of a dry run: its terms, as [`dry_run_terms`] has them, with the arm of the parent, under the name of the parent's scenario.
///
/// # Errors
/// [`DryRunError`].
pub fn dry_run_job(
    parent: &Plan,
    arm: &Arc<RobotModel>,
    height_m: f64,
    speed_m_s: f64,
) -> Result<WashJob, DryRunError> {
    let terms = dry_run_terms(parent, arm, height_m, speed_m_s)?;
    let name = format!("{}-dry-run", parent.provenance.scenario);
    Ok(WashJob::new(arm.clone(), terms)?.named(&name))
}

/// Refuses a plan for the job of a dry run that does not follow the wash paths of its parent.
///
/// # Errors
/// [`DryRunError::OtherPaths`].
pub fn check_paths(parent: &Plan, planned: &Plan) -> Result<(), DryRunError> {
    match planned.wash_paths == parent.wash_paths {
        true => Ok(()),
        false => Err(DryRunError::OtherPaths),
    }
}

/// The least height for a dry run of a job \[m\], where its tool is upright: the clearance, and how far the tip may be off its path.
#[must_use]
pub fn least_height_m(job: &JobTerms) -> f64 {
    job.requirements.clearance_m + PATH_TOLERANCE_M
}

/// The hash of a plan that can have a dry run.
fn named(parent: &Plan) -> Result<String, DryRunError> {
    if [parent.process, Process::from(&parent.job.planner)].contains(&Process::Paper) {
        return Err(DryRunError::PaperRun);
    }
    if let Some(dry_run) = &parent.job.dry_run {
        let parent = dry_run.parent_short();
        return Err(DryRunError::OfDryRun { parent });
    }
    let sealed = parent.hash.clone().filter(|_| parent.is_sealed());
    sealed.ok_or(DryRunError::NotSealed)
}

fn check(job: &JobTerms, dry_run: &DryRun, speed_m_s: f64) -> Result<(), DryRunError> {
    let (found, least, most) = (dry_run.height_m, least_height_m(job), job.limits.tip_speed_m_s);
    if !dry_run.is_above() {
        return Err(DryRunError::Height { found });
    }
    if found < least {
        return Err(DryRunError::TooLow { found, least });
    }
    if !(speed_m_s > 0.0 && speed_m_s <= most) {
        return Err(DryRunError::Speed { found: speed_m_s, most });
    }
    let world = &job.workcell;
    let bodies = world.obstacles.len() + world.tool.bodies.len() + job.plates.len();
    if bodies > MOST_BODIES {
        return Err(DryRunError::TooManyBodies { found: bodies });
    }
    Ok(())
}

/// The world with the real plates in it; pairs that the parent leaves out stay left out, and none besides but what follows from the arm.
fn workcell(job: &JobTerms, arm: &RobotModel) -> Result<Workcell, DryRunError> {
    let world = &job.workcell;
    let of_tool = world.tool.bodies.iter().map(|body| &body.name);
    let of_arm = arm.links().iter().map(|link| &link.name);
    let mut names = world
        .obstacles
        .iter()
        .map(|body| &body.name)
        .chain(of_tool)
        .chain(of_arm);
    let real = |name: &&String| (0..job.plates.len()).any(|plate| **name == DryRun::real_name(plate));
    if let Some(name) = names.find(real).cloned() {
        return Err(DryRunError::NameTaken { name });
    }
    let mut obstacles = world.obstacles.clone();
    let standing = job.plates.iter().enumerate();
    obstacles.extend(standing.map(|(i, plate)| DryRun::standing(i, plate)));
    let before = clearance::exclusions(arm, &world.tool, &world.obstacles)?;
    let mut exclusions = clearance::exclusions(arm, &world.tool, &obstacles)?;
    let others = world.exclusions.iter().filter(|stated| !before.contains(stated));
    exclusions.extend(others.cloned().collect::<Vec<Exclusion>>());
    Ok(Workcell {
        obstacles,
        exclusions,
        ..world.clone()
    })
}
