//! Job of the paper's program: arm, workcell, plates, settings.

use crate::error::PaperError;
use crate::part::PaperPart;
use crate::settings::PaperSettings;
use platewash_bodies::assembly;
use platewash_bodies::job::WashJob;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::{Plan, PlanFileError};
use platewash_workcell::Workcell;
use platewash_workcell::job::{JobTerms, Limits, Overlap, Planner, Requirements};
use platewash_workcell::json::JsonError;
use platewash_workcell::layout::Layout;
use platewash_workcell::simulation::{ControlLawName, ControlSettings, PlantSettings, SimulationSettings};
use platewash_workcell::tool::{StraightTool, Tool};
use serde_json::Value;
use std::sync::Arc;

/// A job for the paper's program.
#[derive(Debug, Clone)]
pub struct PaperJob {
    /// Its name, in reports and in the plan's provenance.
    pub name: String,
    /// The arm.
    pub arm: Arc<RobotModel>,
    /// The world; the sponge of its tool decides coverage.
    pub workcell: Workcell,
    /// The plates.
    pub layout: Layout,
    /// The seed that they were drawn with.
    pub seed: u64,
    /// Joint positions at the start \[rad\].
    pub start_rad: JointVector,
    /// Requirements that the report judges: coverage and clearance. The rest is stated in the plan alone.
    pub requirements: Requirements,
    /// Limits beyond those of the arm's description; the report judges joint accelerations. The rest is stated in the plan alone.
    pub limits: Limits,
    /// Settings of the program.
    pub settings: PaperSettings,
    /// Settings of the simulation: the law must be one without a plant.
    pub simulation: SimulationSettings,
}

impl PaperJob {
    /// A part of the paper, on plates of it (see [`PaperPart::draw`]): no tool body, all joints at zero at the start, the paper's law.
    ///
    /// # Errors
    /// [`PaperError::Clearance`] for an arm with a shape that is none.
    pub fn of_part(part: PaperPart, arm: Arc<RobotModel>, layout: Layout, seed: u64) -> Result<Self, PaperError> {
        let workcell = assembly::workcell_on_floor(&arm, Tool::from(StraightTool::default()))?;
        Ok(Self {
            name: format!("paper-{}", part.name()),
            arm,
            workcell,
            layout,
            seed,
            start_rad: JointVector::zeros(),
            requirements: Requirements {
                // An assumption: the paper has no measure of clean.
                coverage: 0.99,
                clearance_m: 0.0,
                tilt_rad: 15_f64.to_radians(),
                wash_speed_m_s: 0.25,
                wash_acceleration_m_s2: 4.0,
                overlap: Overlap::Fail,
                as_listed: false,
                landing_m_s: None,
                lifting_m_s: None,
                wrist_rad: None,
                contact: None,
                holder: None,
            },
            limits: Limits {
                joint_acceleration_rad_s2: [4.0, 4.0, 4.0, 5.0, 5.0, 6.0],
                tip_speed_m_s: 1.0,
                tip_acceleration_m_s2: 8.0,
            },
            settings: part.settings(),
            simulation: SimulationSettings {
                law: ControlLawName::Paper,
                control: ControlSettings::default(),
                plant: PlantSettings::default(),
                payload_kg: None,
            },
        })
    }

    /// The job that a plan file of the paper's program states, its plates as they lie there, to be run again.
    ///
    /// # Errors
    /// As [`PaperJob::of_terms`].
    pub fn of_plan(plan: &Plan, arm: Arc<RobotModel>) -> Result<Self, PaperError> {
        let (name, terms) = (plan.provenance.scenario.clone(), plan.job.clone());
        let layout = Layout::from_plates(terms.plates.clone());
        Self::of_terms(name, terms, layout, arm)
    }

    /// The job of [`PaperJob::terms`].
    ///
    /// # Errors
    /// [`PaperError::Terms`] for another program's job, or settings that are none of this one's.
    pub fn of_terms(name: String, terms: JobTerms, layout: Layout, arm: Arc<RobotModel>) -> Result<Self, PaperError> {
        let unreadable = |reason: String| PlanFileError::Unreadable(JsonError { reason });
        let Planner::Paper(stated) = terms.planner else {
            return Err(unreadable("the plan is none of the paper's program".to_owned()).into());
        };
        let settings = serde_json::from_value(stated);
        Ok(Self {
            name,
            arm,
            workcell: terms.workcell,
            layout,
            seed: terms.seed,
            start_rad: terms.home_rad[0],
            requirements: terms.requirements,
            limits: terms.limits,
            settings: settings.map_err(|e| unreadable(e.to_string()))?,
            simulation: terms.simulation,
        })
    }

    /// The job as a plan file states it.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn terms(&self) -> Result<JobTerms, PlanFileError> {
        Ok(JobTerms {
            workcell: self.workcell.clone(),
            plates: self.layout.plates.clone(),
            requirements: self.requirements,
            limits: self.limits,
            home_rad: [self.start_rad; 2],
            planner: Planner::Paper(stated(&self.settings)?),
            seed: self.seed,
            simulation: self.simulation.clone(),
            dry_run: None,
            recovery: None,
            soils: Vec::new(),
            measured: Vec::new(),
        })
    }

    /// Refuses a job with which nothing can be computed or that is too much work.
    ///
    /// # Errors
    /// [`PaperError::Setting`], [`PaperError::Work`], and [`PaperError::Job`]: terms with which nothing can be computed, another arm
    /// than the workcell's, or a start beyond its limits.
    pub fn validate(&self) -> Result<(), PaperError> {
        self.settings.validate()?;
        self.settings.check_work(self.layout.plates.len())?;
        WashJob::new(self.arm.clone(), self.terms()?)?;
        Ok(())
    }
}

/// The settings as they are read back from a plan file, in which 3.0 is 3.
fn stated(settings: &PaperSettings) -> Result<Value, PlanFileError> {
    let unwritable = |e: serde_json::Error| PlanFileError::Unwritable { detail: e.to_string() };
    let text = serde_json_canonicalizer::to_string(settings).map_err(unwritable)?;
    serde_json::from_str(&text).map_err(unwritable)
}
