//! A certified job: the whole cycle, from home to home, planned before anything moves.
//!
//! scenario → arm → layout → order → per plate: stroke, posture, timing → crossings → one trajectory. Nothing here judges the
//! result: that is the certificate's, which uses none of it.

mod arm;
mod assemble;
mod choice;
mod report;
mod tour;
mod travel;
mod unwashable;
mod visit;

pub use report::CycleReport;
pub use tour::{EXACT_UP_TO, Optimality, TravelTimes};
pub use unwashable::UnwashablePlate;

use crate::clearance::{ClearanceError, ClearanceModel};
use crate::crossing::{self, Crossing, CrossingError, PaperArc, Route, Scene, Stage, Terminal, TerminalError};
use crate::job::{self, PlanError};
use crate::joint_path::JointPathError;
use crate::layout::{Layout, Plate};
use crate::plan::{Plan, PlanFileError, PlanParts, PlanSegment, Summary};
use crate::posture::{self, Cell, How, PostureError, PostureSettings};
use crate::scenario::{OrderRule, Scenario};
use crate::timing::{MotionLimits, TimingError, TipLimits};
use crate::tool_path::Segment;
use crate::trajectory::{KnotError, Trajectory};
use crate::{random, robot};
use arm::Arm;
use assemble::Assembled;
use nalgebra::Vector3;
use platewash_kinematics::ik::{IkPathError, IkSettingsError};
use platewash_kinematics::{JointVector, LimitViolation, RobotModel};
use serde::Serialize;
use visit::Visit;

/// What crossings keep beyond the clearance asked for, because they are looked at in steps \[m\].
const RESERVE_M: f64 = 1e-3;

/// Why a cycle could not be planned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CycleError {
    /// The end configuration lies outside the joint limits.
    #[error(
        "robot.home_deg: joint {} at {:.4}° is beyond its limit of {:.4}°",
        .0.joint + 1, .0.position_rad.to_degrees(), .0.limit_rad.to_degrees()
    )]
    Home(LimitViolation),
    /// A certified job needs a tool that touches the plates.
    #[error(
        "tool.length_m is 0: a certified job needs a tool; the paper's program (job.program = \"paper\") hovers without one"
    )]
    NoTool,
    /// The collision model could not be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// An inverse-kinematics setting is out of range.
    #[error(transparent)]
    IkSettings(#[from] IkSettingsError),
    /// The arm does not suit the posture planner.
    #[error(transparent)]
    Cell(PostureError),
    /// A plate cannot be washed whole.
    #[error("{0}")]
    Unwashable(Box<UnwashablePlate>),
    /// No layout drawn can be washed whole.
    #[error(
        "none of {layouts} layouts drawn can be washed whole, as layout.only_washable asks; of the last one, {last}"
    )]
    NoneWashable {
        /// Layouts drawn.
        layouts: usize,
        /// What stands in the way in the last one.
        last: String,
    },
    /// The arm cannot follow the line over a plate.
    #[error("the line over plate {plate}: {error}")]
    Line {
        /// The plate.
        plate: usize,
        /// Why.
        error: IkPathError,
    },
    /// The line over a plate is no path.
    #[error(transparent)]
    Terminal(#[from] TerminalError),
    /// There is no way between two plates, or from or to home.
    #[error(transparent)]
    Crossing(#[from] CrossingError),
    /// A path that cannot be splined.
    #[error(transparent)]
    Path(#[from] JointPathError),
    /// A path that cannot be timed.
    #[error(transparent)]
    Timing(#[from] TimingError),
    /// Motions that don't fit together.
    #[error(transparent)]
    Knots(#[from] KnotError),
}

impl CycleError {
    /// Whether the input was fine but asks for what cannot be done (exit code 3).
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        matches!(
            self,
            Self::Unwashable(_) | Self::NoneWashable { .. } | Self::Line { .. } | Self::Crossing(_)
        )
    }
}

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
        scenario.validate()?;
        let robot = robot::load(&scenario.robot)?;
        let layout = choice::place(scenario, &robot)?;
        Self::on(scenario, robot, layout)
    }

    /// Plans the cycle of a scenario on plates that were placed before.
    ///
    /// # Errors
    /// As [`Cycle::plan`].
    pub fn on(scenario: &Scenario, robot: RobotModel, layout: Layout) -> Result<Self, PlanError> {
        scenario.check_work()?;
        job::start(scenario, &robot)?;
        let stages = Stages::new(scenario, &robot, &layout.plates)?;
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
        let duration_s = self.motion.duration_s();
        Plan::sealed(PlanParts {
            scenario: &self.scenario,
            robot: &self.robot,
            plates: &self.layout.plates,
            order: &self.order,
            tool_path: &self.tool_path,
            segments: self.segments.clone(),
            motion: &self.motion,
            clearance_pairs: self.clearance_pairs.clone(),
            summary: Summary {
                headline: format!("{} plates in {duration_s:.2} s, from home to home", self.order.len()),
                plates_washed: self.order.len(),
                duration_s,
                waypoints_reached: [0, 0],
            },
        })
    }
}

/// What the stages share.
struct Stages<'a> {
    scenario: &'a Scenario,
    robot: &'a RobotModel,
    plates: &'a [Plate],
    clearance: ClearanceModel,
    /// Limits while washing, and elsewhere.
    washing: MotionLimits,
    crossing: MotionLimits,
    posture: PostureSettings,
    /// Configurations at the start and at the end \[rad\].
    homes: [JointVector; 2],
}

/// What the stages make.
struct Planned {
    order: Vec<usize>,
    tour: TourSummary,
    visits: Vec<VisitSummary>,
    crossings: Vec<CrossingSummary>,
    whole: Assembled,
}

impl<'a> Stages<'a> {
    fn new(scenario: &'a Scenario, robot: &'a RobotModel, plates: &'a [Plate]) -> Result<Self, CycleError> {
        if scenario.tool.length_m <= 0.0 {
            return Err(CycleError::NoTool);
        }
        let homes = scenario.homes();
        if let Some(violation) = robot.limits().violation(&homes[1]) {
            return Err(CycleError::Home(violation));
        }
        let (wash, limits) = (&scenario.wash, &scenario.limits);
        let of_tip = |speed_m_s, acceleration_m_s2| MotionLimits {
            velocity: robot.limits().velocity,
            acceleration: limits.joint_acceleration_rad_s2.into(),
            tip: Some(TipLimits {
                speed_m_s,
                acceleration_m_s2,
            }),
        };
        Ok(Self {
            scenario,
            robot,
            plates,
            clearance: ClearanceModel::new(robot, &scenario.tool, plates).map_err(CycleError::Clearance)?,
            washing: of_tip(
                wash.speed_m_s.min(limits.tip_speed_m_s),
                wash.acceleration_m_s2.min(limits.tip_acceleration_m_s2),
            ),
            crossing: of_tip(limits.tip_speed_m_s, limits.tip_acceleration_m_s2),
            posture: PostureSettings {
                tilt_max_rad: scenario.tilt_max_rad(),
                clearance_m: wash.clearance_m,
            },
            homes,
        })
    }

    fn carry_out(&self) -> Result<Planned, CycleError> {
        let cell =
            Cell::new(self.robot, &self.scenario.tool, &self.clearance, self.plates).map_err(CycleError::Cell)?;
        let arm = Arm::new(cell, self.posture.tilt_max_rad)?;
        let (order, tour) = self.order(&arm);
        let visits = self.visits(&arm, &order)?;
        let crossings = self.crossings(&arm, &visits)?;
        let duration = |motion: &Trajectory| motion.duration_s();
        Ok(Planned {
            tour,
            visits: visits
                .iter()
                .map(|visit| VisitSummary {
                    plate: visit.plate,
                    posture: visit.washing.how,
                    wash_s: duration(&visit.wash.motion),
                })
                .collect(),
            crossings: crossings
                .iter()
                .map(|crossing| CrossingSummary {
                    route: crossing.route,
                    duration_s: duration(&crossing.timed.motion),
                })
                .collect(),
            whole: assemble::assemble(&visits, &crossings)?,
            order,
        })
    }

    fn order(&self, arm: &Arm<'_>) -> (Vec<usize>, TourSummary) {
        let times = travel::times(self.scenario, arm, self.plates, &self.homes, &self.crossing);
        let nearest = times.nearest_next();
        let nearest_next_s = times.of(&nearest);
        let (order, optimality) = match self.scenario.job.order {
            OrderRule::Given => ((0..self.plates.len()).collect(), None),
            OrderRule::Nearest => (nearest, None),
            OrderRule::Fastest => {
                let (order, optimality) = times.best();
                (order, Some(optimality))
            }
        };
        let tour = TourSummary {
            travel_s: times.of(&order),
            nearest_next_s,
            optimality,
        };
        (order, tour)
    }

    fn visits(&self, arm: &Arm<'_>, order: &[usize]) -> Result<Vec<Visit>, CycleError> {
        let home = self.robot.fk(&self.homes[1]).rigid(&arm.cell.tip).translation;
        let mut visits: Vec<Visit> = Vec::with_capacity(order.len());
        for (k, &plate) in order.iter().enumerate() {
            let centre = visit::centre(&self.plates[plate], self.scenario);
            let towards = order
                .get(k + 1)
                .map_or(home, |&next| visit::centre(&self.plates[next], self.scenario));
            let stroke = visit::stroke(self.scenario, &centre, &towards);
            let near = visits.last().and_then(|v| v.washing.q.last()).unwrap_or(&self.homes[0]);
            let washing = posture::washing(&arm.cell, &stroke, centre, plate, &self.posture, near)
                .map_err(|error| self.unwashable(arm, plate, (centre, &stroke), near, error))
                .map_err(|plate| CycleError::Unwashable(Box::new(plate)))?;
            visits.push(visit::plan(
                self.scenario,
                arm,
                plate,
                (centre, stroke),
                washing,
                &self.washing,
            )?);
        }
        Ok(visits)
    }

    fn crossings(&self, arm: &Arm<'_>, visits: &[Visit]) -> Result<Vec<Crossing>, CycleError> {
        let required = self.scenario.wash.clearance_m + RESERVE_M;
        let keeps_clear = |q: &JointVector, stage: Stage| arm.keeps_clear(q, stage, required);
        let pose = |p: Vector3<f64>| arm.pose(p);
        let arc = PaperArc {
            arc: self.scenario.arc(),
            solver: &arm.solver,
            pose: &pose,
        };
        let scene = Scene {
            robot: self.robot,
            tip: &arm.cell.tip,
            keeps_clear: &keeps_clear,
            limits: &self.crossing,
            arc: Some(&arc),
        };
        let mut rng = random::stream(self.scenario.seed, "crossing");
        let [start, end] = self.homes.map(Terminal::home);
        let leaving = std::iter::once(&start).chain(visits.iter().map(|v| &v.exit));
        let entering = visits.iter().map(|v| &v.entry).chain(std::iter::once(&end));
        leaving
            .zip(entering)
            .map(|(from, to)| Ok(crossing::plan(&scene, from, to, &mut rng)?))
            .collect()
    }
}
