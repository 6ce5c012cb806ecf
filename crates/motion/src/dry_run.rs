//! Job of a dry run, built from the plan that it tries out.
//!
//! Arm, tool, home, requirements and planner settings are those of the plan, except two speeds that are reduced, and the plates' contact
//! forces, which are absent in the air. The plates are raised ([`DryRun`]).

use crate::plan::{Plan, Process};
use platewash_bodies::clearance::{self, ClearanceError};
use platewash_bodies::job::{JobError, WashJob};
use platewash_kinematics::RobotModel;
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::{JobTerms, Limits, PATH_TOLERANCE_M, Requirements};
use platewash_workcell::plate::GREATEST_M;
use platewash_workcell::simulation::{PlantSettings, SimulationSettings};
use platewash_workcell::words::quoted;
use platewash_workcell::{Exclusion, MOST_BODIES, Workcell};
use std::sync::Arc;

/// Reason that a plan has no such dry run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DryRunError {
    /// The plan is a run of the paper's program.
    #[error("the plan is a run of the paper's program, which is not proved; a dry run is one of a washing")]
    PaperRun,
    /// The plan is a dry run already.
    #[error("the plan is itself a dry run (of {parent}): give the plan of the washing")]
    OfDryRun {
        /// First digits of its parent's hash.
        parent: String,
    },
    /// The plan is the motion home of a recovery.
    #[error("the plan is a motion home after a stop, which washes nothing; a dry run is one of a washing")]
    MotionHome,
    /// The plan's hash is missing, or not that of its contents.
    #[error("the plan was changed after it was written; a dry run names its parent by its hash")]
    NotSealed,
    /// The height is out of range.
    #[error("the height must be a number above 0 m and at most {GREATEST_M} m; found {found}")]
    Height {
        /// Height asked for \[m\].
        found: f64,
    },
    /// The height is so low that the sponge would come nearer to the real plates than the job allows.
    #[error(
        "at {found} m the sponge comes nearer to the real plates than the clearance that the job asks for; at least {least} m are needed, \
         and more where the tool tilts"
    )]
    TooLow {
        /// Height asked for \[m\].
        found: f64,
        /// Least height with an upright tool \[m\].
        least: f64,
    },
    /// The speed is out of range, or above that of the plan.
    #[error("the speed must be a number above 0 m/s and at most the plan's {most} m/s; found {found}")]
    Speed {
        /// Speed asked for \[m/s\].
        found: f64,
        /// Speed limit of the plan's tip \[m/s\].
        most: f64,
    },
    /// There are too many bodies once the real plates are added.
    #[error("{found} bodies of the tool, obstacles and real plates; a dry run may have at most {MOST_BODIES}")]
    TooManyBodies {
        /// Number of bodies.
        found: usize,
    },
    /// A body has the name of a real plate.
    #[error("{} is the name of a body already; a dry run gives it to a plate that stands in the way", quoted(.name))]
    NameTaken {
        /// Name of the body.
        name: String,
    },
    /// The new plan follows other wash paths.
    #[error("its wash paths are not those that this version plans for its job, so that a dry run would follow others")]
    OtherPaths,
    /// A shape of the arm is invalid.
    #[error(transparent)]
    Clearance(#[from] ClearanceError),
    /// The resulting job is invalid.
    #[error(transparent)]
    Job(#[from] JobError),
}

/// Builds the terms of a dry run of `parent`, a plan for `arm`, with its plates raised by `height_m` \[m\] and its tip no faster than
/// `speed_m_s` \[m/s\]. The caller must know if the parent is proved.
///
/// # Errors
/// [`DryRunError`].
pub fn dry_run_terms(parent: &Plan, arm: &RobotModel, height_m: f64, speed_m_s: f64) -> Result<JobTerms, DryRunError> {
    let job = &parent.job;
    if job.is_motion_home() {
        return Err(DryRunError::MotionHome);
    }
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
    terms.validate().map_err(JobError::from)?;
    Ok(terms)
}

/// Builds the job of a dry run: its terms, from [`dry_run_terms`], with the arm of the parent, under the name of the parent's scenario.
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

/// Checks that a plan for the job of a dry run follows the wash paths of its parent.
///
/// # Errors
/// [`DryRunError::OtherPaths`].
pub fn check_paths(parent: &Plan, planned: &Plan) -> Result<(), DryRunError> {
    match planned.wash_paths == parent.wash_paths {
        true => Ok(()),
        false => Err(DryRunError::OtherPaths),
    }
}

/// Least height for a dry run of a job with an upright tool \[m\]: the clearance plus the tolerance of the tip's path.
#[must_use]
pub fn least_height_m(job: &JobTerms) -> f64 {
    job.requirements.clearance_m + PATH_TOLERANCE_M
}

/// Returns the hash of a plan that can have a dry run.
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

/// Returns the workcell with the real plates in it. The exclusions are those of the parent and those that follow from the arm.
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
    obstacles.extend(standing.map(|(i, plate)| DryRun::plate_as_obstacle(i, plate)));
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
