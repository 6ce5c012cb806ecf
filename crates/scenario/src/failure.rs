//! Failures of a scenario, in the scenario's own keys.
//!
//! Planner, prover and simulator know no keys: their errors name things of the domain. Here each error gets the keys that decide
//! it.

use crate::body_error::BodyError;
use crate::error::ScenarioError;
use crate::sections::tool::tool_keys;
use crate::to_job::arm::ArmError;
use platewash_bodies::clearance::ClearanceError;
use platewash_bodies::job::{End, JobError};
use platewash_bodies::tool_chain::ToolError;
use platewash_certificate::ProveError;
use platewash_motion::plan::PlanFileError;
use platewash_paper::PaperError;
use platewash_paper::tracking::TrackingError;
use platewash_planner::transit::TransitError;
use platewash_planner::{InfeasibleReport, PlaceSearch, PlanError};
use platewash_simulator::{ControlError, DynamicsError, SimulationError};
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::layout::LayoutError;
use platewash_workcell::verdict::Infeasibility;
use std::borrow::Cow;
use std::fmt;

/// Reason that a scenario could not be carried out. Its words name the keys that decide it.
#[derive(Debug, Clone, PartialEq, derive_more::From)]
#[non_exhaustive]
pub enum Failure {
    /// The scenario was refused.
    #[from]
    Scenario(ScenarioError),
    /// The arm could not be made.
    #[from]
    Arm(ArmError),
    /// The plates could not be placed.
    #[from]
    Layout(LayoutError),
    /// The tip shall wash off the plates.
    NoContact {
        /// Its height over them \[m\].
        height_m: f64,
    },
    /// The bodies of the tool are no tool.
    #[from]
    Tool(ToolError),
    /// An obstacle or a body of the tool could not be made.
    #[from]
    Body(BodyError),
    /// The terms are no job.
    #[from(JobError, ClearanceError)]
    Job(JobError),
    /// The washing could not be planned.
    #[from(PlanError, Cancelled)]
    Plan(PlanError),
    /// The paper's program could not be carried out.
    #[from]
    Paper(PaperError),
    /// The plan could not be judged.
    #[from]
    Prove(ProveError),
    /// The plan could not be simulated.
    #[from]
    Simulation(SimulationError),
    /// The plan could not be written.
    #[from]
    File(PlanFileError),
    /// Meshes of obstacles count as convex hulls, in which bodies stand that may be clear of the meshes.
    Hull {
        /// The failure that names them.
        why: Box<Self>,
        /// Words on the hulls, and on whether a decomposition mends it.
        advice: String,
    },
}

impl Failure {
    /// The failure without advice on meshes.
    #[must_use]
    pub fn cause(&self) -> &Self {
        match self {
            Self::Hull { why, .. } => why,
            other => other,
        }
    }

    /// Returns the verdict on a job without a plan: proved infeasible, or no way found; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        match self.cause() {
            Self::Layout(error) => error.infeasibility(),
            Self::Plan(error) => error.infeasibility(),
            Self::Paper(error) => error.infeasibility(),
            _ => None,
        }
    }

    /// The error that left a job without a plan; `None` where the input is at fault.
    #[must_use]
    pub fn plan_error(&self) -> Option<Cow<'_, PlanError>> {
        match self.cause() {
            Self::Plan(error) => Some(Cow::Borrowed(error)),
            Self::Layout(error) | Self::Paper(PaperError::Layout(error)) => {
                Some(Cow::Owned(PlanError::Layout(error.clone())))
            }
            _ => None,
        }
    }

    /// Report of a refused job: its verdict, the reason with the keys that decide it, and the plates concerned; `None` where the input
    /// is at fault. The reason is this failure in words, as a row of a study and an exception of Python have it, too.
    #[must_use]
    pub fn report(&self, scenario: &str, seed: u64) -> Option<InfeasibleReport> {
        let report = InfeasibleReport::new(scenario, seed, self.plan_error()?.as_ref())?;
        Some(report.explained(self.to_string()))
    }

    /// [`Failure::report`] without a word on other places of a plate, for the page, which looks for them afterwards.
    #[must_use]
    pub fn report_without_places(&self, scenario: &str, seed: u64) -> Option<InfeasibleReport> {
        let report = self.report(scenario, seed)?;
        Some(match self.cause() {
            Self::Plan(PlanError::Unwashable(plate)) => report.explained(plate.reason_text()),
            _ => report,
        })
    }

    /// Returns true where the work was cancelled on request.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        matches!(
            self.cause(),
            Self::Plan(PlanError::Cancelled(_))
                | Self::Paper(PaperError::Cancelled(_))
                | Self::Prove(ProveError::Cancelled(_))
                | Self::Simulation(SimulationError::Cancelled(_))
        )
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scenario(error) => write!(f, "{error}"),
            Self::Arm(error) => write!(f, "{error}"),
            Self::Layout(error) => layout(f, error),
            Self::NoContact { height_m } => write!(
                f,
                "wash.height_m must be 0 in a certified job, whose sponge touches the plates; found {height_m}"
            ),
            Self::Tool(error) => write!(f, "{}: {error}", tool_keys(error)),
            Self::Body(error) => write!(f, "{error}"),
            Self::Job(error) => job(f, error),
            Self::Plan(error) => plan(f, error),
            Self::Paper(error) => paper(f, error),
            Self::Prove(error) => write!(f, "{error}"),
            Self::Simulation(error) => simulation(f, error),
            Self::File(error) => write!(f, "{error}"),
            Self::Hull { why, advice } => write!(f, "{why}; {advice}"),
        }
    }
}

impl std::error::Error for Failure {}

/// The key that states an end of the motion.
pub(crate) fn home_key(end: End) -> &'static str {
    match end {
        End::Start => "robot.start_deg",
        End::End => "robot.home_deg",
    }
}

fn layout(f: &mut fmt::Formatter<'_>, error: &LayoutError) -> fmt::Result {
    write!(f, "layout: {error}")?;
    match error {
        LayoutError::NoRoom { .. } if !error.is_proven() => {
            f.write_str(" (seed; layout.min_distance_m; layout.positions_m)")
        }
        _ => Ok(()),
    }
}

fn job(f: &mut fmt::Formatter<'_>, error: &JobError) -> fmt::Result {
    match error {
        JobError::Home { end, violation } => write!(f, "{}: {violation}", home_key(*end)),
        other => write!(f, "{other}"),
    }
}

fn plan(f: &mut fmt::Formatter<'_>, error: &PlanError) -> fmt::Result {
    match error {
        PlanError::Job(error) => job(f, error),
        PlanError::Layout(error) => layout(f, error),
        PlanError::Overlap(_) => write!(
            f,
            "{error}, and layout.overlap = \"fail\": no plan for these plates can be proved"
        ),
        PlanError::Home { end, violation } => write!(f, "{}: {violation}", home_key(*end)),
        PlanError::HomeNotClear { end, too_near } => {
            write!(
                f,
                "{}: the arm is not clear at home: {too_near} (wash.clearance_m)",
                home_key(*end)
            )
        }
        PlanError::NoTool => f.write_str(
            "tool.length_m is 0: a certified job needs a tool; the paper's program (job.program = \"paper\") hovers without one",
        ),
        PlanError::NoneWashable { .. } => write!(f, "{error} (layout.only_washable asks for it)"),
        PlanError::Unwashable(plate) if plate.nearest_m.is_none() && plate.place_search == PlaceSearch::Off => {
            write!(f, "{error}, as plates are sampled: another seed or layout.only_washable may do")
        }
        PlanError::Line { .. } | PlanError::LiftLine(_) | PlanError::Transit(TransitError::Line { .. }) => {
            write!(f, "{error} (wash.lift_m decides it)")
        }
        PlanError::Tilt { .. } => write!(f, "{error} (wash.tilt_max_deg)"),
        PlanError::Transit(TransitError::NotFound { .. } | TransitError::Home { .. }) => {
            write!(f, "{error} (wash.clearance_m)")
        }
        PlanError::Timing(_) | PlanError::Transit(TransitError::Timing(_)) => write!(
            f,
            "{error}; wash.speed_m_s, wash.acceleration_m_s2 and the keys of [limits] decide it"
        ),
        other => write!(f, "{other}"),
    }
}

fn paper(f: &mut fmt::Formatter<'_>, error: &PaperError) -> fmt::Result {
    match error {
        PaperError::Job(error) => job(f, error),
        PaperError::Layout(error) => layout(f, error),
        PaperError::Law(error) => control(f, error),
        PaperError::Tracking(TrackingError::Divergence { .. }) => {
            write!(f, "{error} (control.kp, control.kd, control.dt_s)")
        }
        other => write!(f, "{other}"),
    }
}

fn simulation(f: &mut fmt::Formatter<'_>, error: &SimulationError) -> fmt::Result {
    match error {
        SimulationError::Control(error) => control(f, error),
        SimulationError::Setting { name, expected, found } => {
            write!(f, "plant.{name} must be {expected}; found {found}")
        }
        SimulationError::NoSponge => write!(f, "{error} (tool.length_m and the keys of its sponge)"),
        SimulationError::Stiffness { range_pa, found_pa } => {
            let [least, most] = range_pa.map(|pa| 1e-3 * pa);
            write!(
                f,
                "plant.contact_stiffness_pa must be within tool.sponge_stiffness_kpa, {least} to {most} kPa; found {found_pa} Pa"
            )
        }
        SimulationError::StiffContact { .. } => {
            write!(
                f,
                "{error} (plant.substeps, control.rate_hz; plant.contact_stiffness_pa)"
            )
        }
        SimulationError::TooLong { .. } => {
            write!(f, "{error} (control.rate_hz, control.dt_s, plant.substeps)")
        }
        SimulationError::Divergence { .. } => {
            write!(f, "{error} (control.rate_hz, plant.substeps; the gains of [control])")
        }
        SimulationError::Dynamics(DynamicsError::Tool { .. }) => {
            write!(f, "{error}; see tool.mass_kg, tool.com_m and tool.inertia_kg_m2")
        }
        other => write!(f, "{other}"),
    }
}

fn control(f: &mut fmt::Formatter<'_>, error: &ControlError) -> fmt::Result {
    match error {
        ControlError::Setting { name, expected, found } => {
            write!(f, "control.{name} must be {expected}; found {found}")
        }
        ControlError::NotKinematic { .. } => write!(f, "control.law: {error}"),
        ControlError::UnstablePaper { .. } => write!(f, "control.kp, control.kd, control.dt_s: {error}"),
        ControlError::Unstable {
            highest_frequency_rad_s: Some(_),
            ..
        } => write!(f, "control.frequency_rad_s, control.rate_hz: {error}"),
        other => write!(f, "control.rate_hz, the gains of [control]: {other}"),
    }
}
