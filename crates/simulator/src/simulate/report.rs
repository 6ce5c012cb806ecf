//! The report of an execution.

use crate::plant::foam::{DENSE_FACTOR, DENSE_STRAIN};
use crate::simulate::error::SimulationError;
use crate::simulate::execution::Execution;
use crate::simulate::measures::{self, Effort, SegmentTracking, Tracking};
use crate::simulate::payload::{PayloadCheck, PayloadVerdict};
use crate::simulate::rounding::rounded_for_display;
use crate::simulate::washing::{self, PlateOutcome};
use platewash_kinematics::{JointFriction, RobotModel};
use platewash_motion::plan::Plan;
use platewash_workcell::dry_run::DryRun;
use platewash_workcell::job::Treatment;
use platewash_workcell::simulation::{ControlLawName, PlantSettings, SimulationSettings};
use platewash_workcell::words::part_of;
use serde::Serialize;

/// Verdict on the wash as the controller executed it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SimulationVerdict {
    /// Every plate is washed, and the arm may carry its tool as far as is known.
    Washed,
    /// Every plate is swept, which is all that the job requires, and the arm may carry its tool as far as is known.
    Swept,
    /// A dry run whose raised plates are swept as they would be washed. Nothing is washed.
    DryRun,
    /// A plate is not washed.
    NotWashed,
    /// A plate is not swept.
    NotSwept,
    /// A raised plate of a dry run is not swept.
    NotFollowed,
    /// The arm may not carry its tool, even if the plates are washed with it.
    Overloaded,
    /// The plan's hash does not match its contents: the simulated plan is not the one that was written.
    Altered,
}

impl SimulationVerdict {
    fn new(treatment: Treatment, is_done: bool) -> Self {
        match (treatment, is_done) {
            (Treatment::Washed, true) => Self::Washed,
            (Treatment::Swept, true) => Self::Swept,
            (Treatment::SweptInAir, true) => Self::DryRun,
            (Treatment::Washed, false) => Self::NotWashed,
            (Treatment::Swept, false) => Self::NotSwept,
            (Treatment::SweptInAir, false) => Self::NotFollowed,
        }
    }

    /// Returns true where the execution fulfils all requirements of the job.
    #[must_use]
    pub fn is_done(self) -> bool {
        matches!(self, Self::Washed | Self::Swept | Self::DryRun)
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Washed => "washed",
            Self::Swept => "swept",
            Self::DryRun => "followed",
            Self::NotWashed => "not washed",
            Self::NotSwept => "not swept",
            Self::NotFollowed => "not followed",
            Self::Overloaded => "overloaded",
            Self::Altered => "altered",
        }
    }
}

/// State of a plan's hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Seal {
    /// The hash is that of the contents.
    Whole,
    /// The hash differs from that of the contents, or is missing.
    Broken,
}

impl Seal {
    pub(crate) fn from_plan(plan: &Plan) -> Self {
        if plan.is_sealed() { Self::Whole } else { Self::Broken }
    }
}

/// The report of a plan's execution under a law. Lengths in metres, angles in radians, times in seconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SimulationReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Seed of the plan.
    pub seed: u64,
    /// Dry run, if the plan is one: its plates are raised, and nothing is washed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dry_run: Option<DryRun>,
    /// Name of the arm.
    pub robot: String,
    /// The law.
    pub law: ControlLawName,
    /// Verdict on the wash, and on the plan's hash.
    pub verdict: SimulationVerdict,
    /// The first line.
    pub headline: String,
    /// Duration of the execution \[s\].
    pub duration_s: f64,
    /// Samples.
    pub samples: usize,
    /// Time between them \[s\].
    pub period_s: f64,
    /// One entry a plate, in the order of washing.
    pub plates: Vec<PlateOutcome>,
    /// Errors over the whole execution.
    pub tracking: Tracking,
    /// Errors segment by segment.
    pub segments: Vec<SegmentTracking>,
    /// Torques, work and power; none under a kinematic law.
    pub effort: Option<Effort>,
    /// The tool's mass against the arm's payload.
    pub payload: PayloadCheck,
    /// Assumptions, where nothing is published or measured.
    pub assumptions: Vec<String>,
}

impl SimulationReport {
    /// Judges an execution of `plan` by [`crate::simulate::simulate`] with that arm and those settings.
    ///
    /// # Errors
    /// [`SimulationError::Coverage`] for plates or sponges that make no sense.
    pub fn new(
        plan: &Plan,
        robot: &RobotModel,
        settings: &SimulationSettings,
        execution: &Execution,
    ) -> Result<Self, SimulationError> {
        Self::judge(plan, robot, settings, execution, Seal::from_plan(plan))
    }

    /// Report of a plan with the given state of its hash.
    pub(crate) fn judge(
        plan: &Plan,
        robot: &RobotModel,
        settings: &SimulationSettings,
        execution: &Execution,
        seal: Seal,
    ) -> Result<Self, SimulationError> {
        let plan = &*plan.seen_from_base();
        let tip = plan.job.workcell.tool.tip_frame(robot);
        let tip_errors = measures::tip_errors(execution, robot, &tip);
        let plates = washing::plates(plan, robot, settings, execution)?;
        let payload = PayloadCheck::new(&plan.job.workcell.tool, settings.payload_kg, robot);
        let (treatment, done) = (
            plan.job.treatment(),
            plates.iter().filter(|plate| plate.verdict.is_done()).count(),
        );
        let verdict = match seal {
            Seal::Broken => SimulationVerdict::Altered,
            Seal::Whole if payload.verdict == PayloadVerdict::Exceeded => SimulationVerdict::Overloaded,
            Seal::Whole => SimulationVerdict::new(treatment, done == plan.job.plates_to_wash().count()),
        };
        let done_words = match plan.job.is_motion_home() {
            true => "the motion home".to_owned(),
            false => format!(
                "{} {}",
                part_of(done, plan.job.plates_to_wash().count(), "plate"),
                treatment.participle()
            ),
        };
        let tracking = measures::tracking(&execution.samples, &tip_errors);
        Ok(Self {
            scenario: plan.provenance.scenario.clone(),
            seed: plan.job.seed,
            dry_run: plan.job.dry_run.clone(),
            robot: robot.name().to_owned(),
            law: settings.law,
            verdict,
            headline: format!(
                "{}{}{done_words} under {}; the tip is off by {:.3} mm rms, {:.3} mm at most",
                plan.job.notices(),
                payload.overload().map_or_else(String::new, |words| words + "; "),
                settings.law.name(),
                1e3 * tracking.tip_m.rms,
                1e3 * tracking.tip_m.max
            ),
            duration_s: execution.samples.last().map_or(0.0, |sample| sample.t_s),
            samples: execution.samples.len(),
            period_s: execution.period_s,
            plates,
            tracking,
            segments: measures::by_segment(execution, &plan.segments, &tip_errors),
            effort: Effort::measure(execution),
            payload,
            assumptions: assumptions(plan, settings, robot.friction()),
        })
    }
}

fn assumptions(plan: &Plan, settings: &SimulationSettings, described: &JointFriction) -> Vec<String> {
    let tool = &plan.job.workcell.tool;
    if settings.law.is_kinematic() {
        return vec!["there is no plant: the law moves positions".to_owned()];
    }
    let mut all =
        vec!["the law knows masses and inertias exactly, and measures positions and speeds exactly".to_owned()];
    if tool.is_present() {
        all.push(format!(
            "the tool weighs {} kg and its sponge is pressed in by {} mm",
            rounded_for_display(tool.mass.map_or(0.0, |mass| mass.mass_kg)),
            rounded_for_display(1e3 * tool.sponge.compression_m)
        ));
    }
    all.extend(plant_assumptions(&settings.plant, described));
    all
}

/// The friction of the joints in words, and its source.
fn friction_words(plant: &PlantSettings, described: &JointFriction) -> &'static str {
    let none = JointFriction::default();
    let stated = JointFriction {
        viscous: plant.viscous_friction_n_m_s,
        coulomb: plant.coulomb_friction_n_m,
    };
    match (stated == none, *described == none) {
        (true, true) => "there is no friction in the joints",
        (true, false) => "there is no friction in the joints, as the settings state; the arm's description states some",
        (false, false) if stated == *described => "the joints have the friction of the arm's description",
        (false, false) => "the joints have the friction that is stated, in place of that of the arm's description",
        (false, true) => "the joints have the friction that is stated",
    }
}

fn plant_assumptions(plant: &PlantSettings, described: &JointFriction) -> Vec<String> {
    let mut all = Vec::new();
    all.push(friction_words(plant, described).to_owned());
    if let Some(foam) = &plant.contact {
        all.push(format!(
            "plates push back by the sponge's foam: an elastic foundation of {} kPa{}, {} times as stiff beyond a strain of {}, without friction",
            rounded_for_display(1e-3 * foam.stiffness_pa),
            match foam.damping_pa_s {
                0.0 => String::new(),
                damping => format!(" and {} Pa·s", rounded_for_display(damping)),
            },
            rounded_for_display(DENSE_FACTOR),
            rounded_for_display(DENSE_STRAIN)
        ));
    } else if plant.contact_force_n == 0.0 {
        all.push("the plate does not push back".to_owned());
    } else {
        all.push(format!(
            "the plate pushes with a constant {} N wherever the sponge touches",
            rounded_for_display(plant.contact_force_n)
        ));
    }
    if plant.torque_limit_n_m.is_some() {
        all.push("torque limits are those that are stated".to_owned());
    }
    all
}
