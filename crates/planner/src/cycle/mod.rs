//! A certified job: the whole cycle, from home to home, planned before anything moves.
//!
//! scenario → arm → layout → order → per plate: stroke, posture, timing → crossings → one trajectory. Nothing here judges the
//! result: that is the certificate's, which uses none of it.

mod activity;
mod arm;
mod assemble;
mod choice;
mod error;
mod infeasible;
mod report;
mod stages;
mod tilt;
mod tour;
mod travel;
mod unwashable;
mod visit;

pub use activity::{Activity, Listener};
pub use error::CycleError;
pub use infeasible::{InfeasiblePart, InfeasiblePlate, InfeasibleReport};
pub use report::{CycleReport, CycleText};
pub use tour::{EXACT_UP_TO, Optimality, TravelTimes};
pub use unwashable::{Elsewhere, UnwashablePlate};

use crate::certificate;
use crate::crossing::Route;
use crate::error::PlanError;
use crate::place;
use crate::plan::{Plan, PlanFileError, PlanParts, PlanSegment, Summary};
use crate::posture::How;
use crate::robot;
use crate::scenario::Scenario;
use crate::tool_path::Segment;
use platewash_kinematics::RobotModel;
use platewash_workcell::layout::{Layout, Plate};
use platewash_workcell::trajectory::Trajectory;
use serde::Serialize;
use stages::Stages;

/// How a plate is washed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VisitSummary {
    /// The plate.
    pub plate: usize,
    /// Where its posture comes from.
    pub posture: How,
    /// Time on the plate \[s\].
    pub wash_s: f64,
}

/// How a crossing goes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CrossingSummary {
    /// Its route.
    pub route: Route,
    /// Time from contact to contact, or from or to home \[s\].
    pub duration_s: f64,
}

/// What the order gains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TourSummary {
    /// Travel time estimated for the order taken \[s\]: each joint at its limits from place to place.
    pub travel_s: f64,
    /// The same for always the plate reached soonest \[s\].
    pub nearest_next_s: f64,
    /// Whether the order is known to be the best under that estimate.
    pub optimality: Option<Optimality>,
}

/// A cycle, planned.
#[derive(Debug, Clone)]
pub struct Cycle {
    /// What was asked.
    pub scenario: Scenario,
    /// The arm.
    pub robot: RobotModel,
    /// The plates.
    pub layout: Layout,
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// What the tip must do.
    pub tool_path: Vec<Segment>,
    /// The same in time.
    pub segments: Vec<PlanSegment>,
    /// The motion.
    pub motion: Trajectory,
    /// One entry a plate, in the order of washing.
    pub visits: Vec<VisitSummary>,
    /// From home, between the plates, and home.
    pub crossings: Vec<CrossingSummary>,
    /// What the order gains.
    pub tour: TourSummary,
    clearance_pairs: Vec<[String; 2]>,
}

impl Cycle {
    /// Plans the cycle of a scenario.
    ///
    /// # Errors
    /// [`PlanError`], one variant a stage.
    pub fn plan(scenario: &Scenario) -> Result<Self, PlanError> {
        Self::plan_telling(scenario, activity::NOBODY)
    }

    /// The same; the listener hears what planning is busy with.
    ///
    /// # Errors
    /// As [`Cycle::plan`].
    pub fn plan_telling(scenario: &Scenario, listener: Listener<'_>) -> Result<Self, PlanError> {
        scenario.validate()?;
        Self::with_arm(scenario, robot::load(&scenario.robot)?, listener)
    }

    /// The same with the scenario's arm, loaded before.
    ///
    /// # Errors
    /// As [`Cycle::plan`].
    pub fn with_arm(scenario: &Scenario, robot: RobotModel, listener: Listener<'_>) -> Result<Self, PlanError> {
        Self::check(scenario, &robot, &[])?;
        let layout = choice::place(scenario, &robot, listener)?;
        Self::on_telling(scenario, robot, layout, listener)
    }

    /// Refuses what can be known to fail before any posture is planned: an end configuration beyond its limits or too near
    /// something, a tool without length. `plates` are those known by now.
    ///
    /// # Errors
    /// [`PlanError::Robot`] and [`PlanError::Cycle`].
    pub fn check(scenario: &Scenario, robot: &RobotModel, plates: &[Plate]) -> Result<(), PlanError> {
        place::start(scenario, robot)?;
        Ok(Stages::new(scenario, robot, plates)?.check_homes()?)
    }

    /// Plans the cycle of a scenario on plates that were placed before.
    ///
    /// # Errors
    /// As [`Cycle::plan`].
    pub fn on(scenario: &Scenario, robot: RobotModel, layout: Layout) -> Result<Self, PlanError> {
        Self::on_telling(scenario, robot, layout, activity::NOBODY)
    }

    fn on_telling(
        scenario: &Scenario,
        robot: RobotModel,
        layout: Layout,
        listener: Listener<'_>,
    ) -> Result<Self, PlanError> {
        scenario.check_work()?;
        place::start(scenario, &robot)?;
        let stages = Stages::new(scenario, &robot, &layout.plates)?.telling(listener);
        let planned = stages.carry_out()?;
        let names = stages.clearance.pair_names();
        let clearance_pairs = names.iter().map(|(a, b)| [(*a).to_owned(), (*b).to_owned()]).collect();
        Ok(Self {
            scenario: scenario.clone(),
            clearance_pairs,
            robot: robot.clone(),
            order: planned.order,
            tool_path: planned.whole.tool_path,
            segments: planned.whole.segments,
            motion: planned.whole.motion,
            visits: planned.visits,
            crossings: planned.crossings,
            tour: planned.tour,
            layout,
        })
    }

    /// The plan file's contents, sealed.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn to_plan(&self) -> Result<Plan, PlanFileError> {
        let mut plan = Plan::open(PlanParts {
            scenario: &self.scenario,
            robot: &self.robot,
            plates: &self.layout.plates,
            order: &self.order,
            tool_path: &self.tool_path,
            segments: self.segments.clone(),
            motion: &self.motion,
            clearance_pairs: self.clearance_pairs.clone(),
            summary: Summary::default(),
        });
        plan.summary = certificate::summary(&plan, &self.robot);
        plan.hash = Some(plan.seal()?);
        Ok(plan)
    }
}
