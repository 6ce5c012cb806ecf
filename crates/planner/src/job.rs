//! The whole job, stage after stage: scenario → arm → layout → tool path → joint path and execution → report.

use crate::clearance::{ClearanceError, ClearanceModel};
use crate::control::{self, NotKinematic};
use crate::coverage::CoverageError;
use crate::cycle::CycleError;
use crate::layout::{self, Layout, LayoutError, Plate, PlateGeometry, Region, SampleRequest, SampleSettings, Spacing};
use crate::random;
use crate::report::JobReport;
use crate::robot::{self, RobotError};
use crate::scenario::{IkMethod, LayoutSection, Scenario, ScenarioError};
use crate::tool_path::ToolPath;
use crate::tracking::{self, Step, TrackingError};
use crate::trajectory::Trajectory;
use platewash_kinematics::ik::{AnalyticStarts, IkError, IkSettings, IkSettingsError, IkSolver};
use platewash_kinematics::{JointVector, RobotModel};
use rand_pcg::Pcg64;

/// Why a job could not be carried out; one variant a stage.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The scenario was refused.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The arm could not be made.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The plates could not be placed.
    #[error("layout: {0}")]
    Layout(LayoutError),
    /// An inverse-kinematics setting is out of range.
    #[error(transparent)]
    IkSettings(#[from] IkSettingsError),
    /// A waypoint or configuration is not finite.
    #[error("inverse kinematics: {0}")]
    Ik(IkError),
    /// The control law moves no waypoints.
    #[error("control.law: {0}")]
    Law(NotKinematic),
    /// The control law does not stay finite.
    #[error(transparent)]
    Tracking(#[from] TrackingError),
    /// The collision model could not be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// Coverage could not be measured.
    #[error("coverage: {0}")]
    Coverage(CoverageError),
    /// The cycle of a certified job could not be planned.
    #[error(transparent)]
    Cycle(#[from] CycleError),
    /// The caller asked to stop.
    #[error("stopped before the end")]
    Stopped,
}

// The messages above hold those of their causes, which are therefore not told again as sources.
impl From<LayoutError> for PlanError {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}

impl From<NotKinematic> for PlanError {
    fn from(error: NotKinematic) -> Self {
        Self::Law(error)
    }
}

impl From<IkError> for PlanError {
    fn from(error: IkError) -> Self {
        Self::Ik(error)
    }
}

impl From<ClearanceError> for PlanError {
    fn from(error: ClearanceError) -> Self {
        Self::Clearance(error)
    }
}

impl From<CoverageError> for PlanError {
    fn from(error: CoverageError) -> Self {
        Self::Coverage(error)
    }
}

impl PlanError {
    /// Whether the input was fine but asks for what cannot be done (exit code 3), as opposed to bad input.
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        use LayoutError::{EmptyRegion, NoRoom};
        match self {
            Self::Layout(NoRoom { .. } | EmptyRegion { .. }) => true,
            Self::Cycle(error) => error.is_infeasible(),
            _ => false,
        }
    }
}

/// A job planned and followed, before it is judged.
#[derive(Debug, Clone)]
pub struct Job {
    /// What was asked.
    pub scenario: Scenario,
    /// The arm.
    pub robot: RobotModel,
    /// The plates.
    pub layout: Layout,
    /// What the tip shall do.
    pub tool_path: ToolPath,
    /// One step per waypoint of the tool path.
    pub steps: Vec<Step>,
    /// The commanded motion, from the start configuration on.
    pub planned: Trajectory,
    /// The motion that the control law makes of it.
    pub executed: Trajectory,
}

/// Places the plates of a scenario: sampled from the seed's own stream, or as given and checked.
///
/// # Errors
/// [`LayoutError`].
pub fn place_plates(scenario: &Scenario, robot: &RobotModel) -> Result<Layout, LayoutError> {
    draw_plates(scenario, robot, &mut random::stream(scenario.seed, "layout"))
}

/// The same from a stream of the caller's, so that one layout after the other can be drawn.
pub(crate) fn draw_plates(scenario: &Scenario, robot: &RobotModel, rng: &mut Pcg64) -> Result<Layout, LayoutError> {
    let section = &scenario.layout;
    let spacing = spacing(section);
    let geometry = PlateGeometry {
        radius_m: section.plate_radius_m,
        height_m: section.plate_height_m,
        thickness_m: section.plate_thickness_m,
    };
    let base = robot::base_footprint(robot);
    let region = region(section);
    match (&section.positions_m, region) {
        (Some(positions), region) => layout::check_explicit(positions, region.as_ref(), &spacing, &geometry, &base),
        (None, region) => {
            let request = SampleRequest {
                region: region.unwrap_or(Region::PAPER_APPENDIX),
                spacing,
                count: section.count,
                geometry,
                base,
            };
            layout::sample(&request, &SampleSettings::default(), rng)
        }
    }
}

/// Checks a scenario without running it: the arm loads, the start lies within its limits, and the plates have room in
/// principle (given ones are placed; for sampled ones the region is not empty).
///
/// Returns the arm, and what is to be said about given plates.
///
/// # Errors
/// As [`Job::run`] for the same fault.
pub fn check(scenario: &Scenario) -> Result<(RobotModel, Vec<layout::Finding>), PlanError> {
    scenario.validate()?;
    let robot = robot::load(&scenario.robot)?;
    start(scenario, &robot)?;
    if scenario.layout.positions_m.is_some() {
        let findings = place_plates(scenario, &robot)?.findings;
        return Ok((robot, findings));
    }
    let region = region(&scenario.layout).unwrap_or(Region::PAPER_APPENDIX);
    layout::Sampler::new(&region, &spacing(&scenario.layout))?;
    Ok((robot, Vec::new()))
}

/// The start configuration \[rad\], within the limits.
pub(crate) fn start(scenario: &Scenario, robot: &RobotModel) -> Result<JointVector, RobotError> {
    let [start, _] = scenario.homes();
    match robot.limits().violation(&start) {
        Some(violation) => Err(RobotError::Start(violation)),
        None => Ok(start),
    }
}

fn spacing(section: &LayoutSection) -> Spacing {
    Spacing {
        min_distance_m: section.min_distance_m,
        base_radius_m: section.base_radius_m,
    }
}

/// The region that a section states; `None` when it states none (explicit positions only).
fn region(section: &LayoutSection) -> Option<Region> {
    if let Some(named) = section.region {
        return Some(named.region());
    }
    let around = section.rho_m.map(|[_, most]| [-most, most]);
    Some(Region {
        x_m: section.x_m.or(around)?,
        y_m: section.y_m.or(around)?,
        rho_m: section.rho_m,
        azimuth_deg: section.azimuth_deg,
    })
}

impl Job {
    /// Plans and follows a scenario.
    ///
    /// # Errors
    /// [`PlanError`], one variant a stage. A job that does not wash is no error: see [`Job::report`].
    pub fn run(scenario: &Scenario) -> Result<Self, PlanError> {
        scenario.validate()?;
        let robot = robot::load(&scenario.robot)?;
        let layout = place_plates(scenario, &robot)?;
        Self::on(scenario, robot, layout)
    }

    /// Plans and follows a scenario on plates that were placed before.
    ///
    /// # Errors
    /// As [`Job::run`].
    pub fn on(scenario: &Scenario, robot: RobotModel, layout: Layout) -> Result<Self, PlanError> {
        scenario.check_work()?;
        let start = start(scenario, &robot)?;
        let tool_path = ToolPath::new(scenario, &layout);
        let solver = IkSolver::new(&robot, robot::tip_frame(&robot, &scenario.tool), ik_settings(scenario))?;
        let mut law = control::law(&scenario.control)?;
        let steps = tracking::follow(&robot, &solver, &tool_path, scenario.ik.seed, law.as_mut(), &start)?;
        let motion = |of: fn(&Step) -> JointVector| {
            let positions = std::iter::once(start).chain(steps.iter().map(of)).collect();
            Trajectory::through(positions, scenario.control.dt_s)
        };
        let (planned, executed) = (motion(|s| s.commanded), motion(|s| s.executed));
        Ok(Self {
            scenario: scenario.clone(),
            robot,
            layout,
            tool_path,
            steps,
            planned,
            executed,
        })
    }

    /// Judges the job: what was reached, how near it came, what it covered.
    ///
    /// # Errors
    /// [`PlanError::Clearance`] or [`PlanError::Coverage`].
    pub fn report(&self) -> Result<JobReport, PlanError> {
        let clearance = ClearanceModel::new(&self.robot, &self.scenario.tool, &self.layout.plates)?;
        JobReport::new(self, &clearance)
    }

    /// The plates.
    #[must_use]
    pub fn plates(&self) -> &[Plate] {
        &self.layout.plates
    }

    /// Time of a step \[s\]: the first waypoint is one time step after the start.
    #[must_use]
    pub fn time_of(&self, step: usize) -> f64 {
        self.planned.times().get(step + 1).copied().unwrap_or(0.0)
    }
}

/// Inverse-kinematics settings of a scenario: its tolerances, and analytic branches as starts unless the method is "numeric".
#[must_use]
pub fn ik_settings(scenario: &Scenario) -> IkSettings {
    let analytic_starts = match scenario.ik.method {
        IkMethod::Numeric => AnalyticStarts::Unused,
        IkMethod::Analytic => AnalyticStarts::Used,
    };
    IkSettings {
        analytic_starts,
        position_tolerance_m: scenario.ik.position_tolerance_m,
        orientation_tolerance_rad: scenario.ik.orientation_tolerance_rad,
        ..IkSettings::default()
    }
}
