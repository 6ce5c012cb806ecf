//! The stages of a certified job on one core, each with what the stages before it made.

use platewash_bodies::clearance::ClearanceModel;
use platewash_bodies::job::WashJob;
use platewash_certificate::prove;
use platewash_motion::plan::Plan;
use platewash_planner::joint_path::{Ends, JointPath};
use platewash_planner::placed_arm::PlacedArm;
use platewash_planner::plan;
use platewash_planner::redundancy::{Task, Washing, washing};
use platewash_planner::timing::{self, MotionLimits, TipLimits};
use platewash_scenario::Scenario;
use platewash_workcell::wash_path::{WashCurve, WashPath, WashPattern};
use std::error::Error;
use std::hint::black_box;

/// One stage, or the whole of several.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The plates are placed.
    Layout,
    /// The bodies of arm, tool, plates and obstacles, and their pairs.
    Bodies,
    /// Tilt, yaw and branch along the wash path of one plate.
    Redundancy,
    /// The motion along one plate's wash path.
    Timing,
    /// All phases of planning: from the job to the motion from home to home, sealed.
    Plan,
    /// The hash of a plan, and the text of its file.
    Seal,
    /// The text is read and checked.
    Read,
    /// The certificate.
    Prove,
}

impl Stage {
    /// All, in the order of the job, with the names that benchmarks give them.
    pub const ALL: [(Self, &'static str); 8] = [
        (Self::Layout, "layout"),
        (Self::Bodies, "bodies and their pairs"),
        (Self::Redundancy, "configurations of one plate"),
        (Self::Timing, "timing of one wash"),
        (Self::Plan, "plan, from home to home"),
        (Self::Seal, "seal and write"),
        (Self::Read, "read"),
        (Self::Prove, "prove"),
    ];
}

/// A job whose stages can be run again and again.
#[derive(Debug)]
pub struct Stages {
    scenario: Scenario,
    job: WashJob,
    surroundings: ClearanceModel,
    path: JointPath,
    limits: MotionLimits,
    plan: Plan,
    text: String,
}

impl Stages {
    /// The stages of a shipped scenario.
    ///
    /// # Errors
    /// Those of planning.
    pub fn new(scenario: &str) -> Result<Self, Box<dyn Error>> {
        Self::of(Scenario::load(scenario)?)
    }

    /// The stages of a scenario.
    ///
    /// # Errors
    /// Those of planning.
    pub fn of(scenario: Scenario) -> Result<Self, Box<dyn Error>> {
        let job = scenario.job()?;
        let surroundings = surroundings(&job)?;
        let washed = configurations(&job, &surroundings, &wash_path(&job, 0)?)?;
        let plan = plan(&job)?.plan;
        let terms = job.terms();
        Ok(Self {
            path: JointPath::through(washed.theta, washed.q, Ends::Clamped(washed.end_slopes))?,
            limits: MotionLimits {
                velocity: job.arm().limits().velocity,
                acceleration: terms.limits.joint_acceleration_rad_s2.into(),
                tip: Some(TipLimits {
                    speed_m_s: terms.wash_speed_m_s(),
                    acceleration_m_s2: terms.wash_acceleration_m_s2(),
                }),
            },
            text: plan.to_json()?,
            scenario,
            job,
            surroundings,
            plan,
        })
    }

    /// Runs one stage.
    ///
    /// # Errors
    /// Those of the stage.
    pub fn run(&self, stage: Stage) -> Result<(), Box<dyn Error>> {
        let arm = self.job.arm();
        match stage {
            Stage::Layout => drop(black_box(self.scenario.layout(arm)?)),
            Stage::Bodies => drop(black_box(surroundings(&self.job)?)),
            Stage::Redundancy => {
                let path = wash_path(&self.job, 0)?;
                drop(black_box(configurations(&self.job, &self.surroundings, &path)?));
            }
            Stage::Timing => {
                let tip = self.job.terms().workcell.tool.tip_frame(arm);
                drop(black_box(timing::time_optimal(&self.path, arm, &tip, &self.limits)?));
            }
            Stage::Plan => drop(black_box(plan(&self.job)?)),
            Stage::Seal => drop(black_box((self.plan.seal()?, self.plan.to_json()?))),
            Stage::Read => drop(black_box(Plan::from_json(&self.text)?)),
            Stage::Prove => drop(black_box(prove(&self.plan, arm)?)),
        }
        Ok(())
    }
}

/// The wash path of a plate whose spiral leaves the centre along x, by the settings of a job.
///
/// # Errors
/// A job of the paper's program.
pub fn wash_path(job: &WashJob, plate: usize) -> Result<WashPath, Box<dyn Error>> {
    let terms = job.terms();
    let settings = terms
        .planner_settings()
        .ok_or("the job is one of the paper's program")?;
    Ok(WashPath {
        plate,
        curve: WashCurve {
            radius_m: settings.path_radius_m.unwrap_or(0.12385),
            turns: settings.turns.unwrap_or(3.5),
            start_angle_rad: 0.0,
            closing_ring: settings.closing_ring.unwrap_or(true),
            trim_rad: 0.0,
            pattern: WashPattern::Spiral,
        },
        lift_m: settings.lift_m,
        cone_rad: terms.tilt_max_rad(),
    })
}

/// The arm in the job's workcell, among its plates.
///
/// # Errors
/// An arm with a shape that is none.
pub fn surroundings(job: &WashJob) -> Result<ClearanceModel, Box<dyn Error>> {
    let terms = job.terms();
    Ok(ClearanceModel::new(job.arm(), &terms.workcell, &terms.plates)?)
}

/// The configurations for washing a plate along a path.
///
/// # Errors
/// A plate that cannot be washed so.
pub fn configurations(
    job: &WashJob,
    surroundings: &ClearanceModel,
    path: &WashPath,
) -> Result<Washing, Box<dyn Error>> {
    let terms = job.terms();
    let settings = terms
        .planner_settings()
        .ok_or("the job is one of the paper's program")?;
    let placed = PlacedArm::new(
        job.arm(),
        &terms.workcell.tool,
        surroundings,
        &terms.plates,
        settings.reach,
    )?;
    let task = Task::new(&placed, path, terms.requirements.clearance_m, &terms.home_rad[0])?;
    Ok(washing(&task)?)
}
