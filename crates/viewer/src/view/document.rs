//! The document, and that of a plan, a job or a configuration.

use super::arm::Arm;
use super::beside::Beside;
use super::certificate::Certificate;
use super::clearance::Clearance;
use super::coverage::{self, PlateCoverage};
use super::dirt::{self, PlateDirt};
use super::error::ViewError;
use super::execution::{ExecutedMotion, Execution};
use super::heading::Heading;
use super::motion::Motion;
use super::plates::{self, Plate, WashPath};
use super::tips::Tips;
use platewash_bodies::job::WashJob;
use platewash_certificate as proved;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::PlanSegment;
use platewash_workcell::job::JobTerms;
use platewash_workcell::layout::TaskRegion;
use platewash_workcell::obstacle::Obstacle;
use platewash_workcell::tool::Tool;
use serde::Serialize;
use ts_rs::TS;

/// The format of the document.
pub const FORMAT: &str = "platewash-view/2";

/// Contents of a page.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct View {
    /// [`FORMAT`].
    pub format: &'static str,
    /// Version of the program that wrote it.
    pub version: &'static str,
    /// Heading of the page.
    pub heading: Heading,
    /// The proof; `None` where nothing was proved.
    pub certificate: Option<Certificate>,
    /// The arm.
    pub arm: Arm,
    /// Tool that it holds.
    pub tool: Option<Tool>,
    /// Bodies around it.
    pub surroundings: Surroundings,
    /// The plates, by their index.
    pub plates: Vec<Plate>,
    /// Paths that the tip follows, in the order of washing.
    pub paths: Vec<WashPath>,
    /// The stretches of the motion.
    pub segments: Vec<PlanSegment>,
    /// The planned motion; `None` for one configuration.
    pub motion: Option<Motion>,
    /// Configuration that the arm shows where there is no motion \[rad\].
    pub pose_rad: [f64; 6],
    /// The smallest distance over time; `None` where there is nothing to keep clear of.
    pub clearance: Option<Clearance>,
    /// Coverage of the plates by the planned motion.
    pub coverage: Vec<PlateCoverage>,
    /// Dirt on the plates; empty where no dose is proved.
    pub dirt: Vec<PlateDirt>,
    /// Executed motion.
    pub execution: Option<Execution>,
    /// Another program's motion on the same plates, where it is asked for.
    pub beside: Option<Beside>,
    /// Address of a live run's events, beside that of the page.
    pub live: Option<String>,
}

/// Bodies around an arm, and the region in which plates may lie.
#[derive(Debug, Clone, PartialEq, Default, Serialize, TS)]
pub struct Surroundings {
    /// World frame.
    pub obstacles: Vec<Obstacle>,
    /// Region in which the centres of plates are drawn at random.
    #[serde(flatten)]
    pub region: TaskRegion,
}

/// Data shown beside a plan.
#[derive(Debug, Clone, Copy, Default)]
pub struct ViewExtras<'a> {
    /// Its proof.
    pub certificate: Option<&'a proved::Certificate>,
    /// Executed motion of the plan.
    pub executed: Option<&'a ExecutedMotion>,
    /// Region in which its scenario draws plates at random.
    pub region: Option<&'a TaskRegion>,
    /// Path of the events of a live run.
    pub events: Option<&'a str>,
}

impl View {
    /// A plan on its arm. It need not be one that can be proved.
    ///
    /// # Errors
    /// [`ViewError`] for a plan that is no motion, a job with which nothing can be computed, or a motion of another plan.
    pub fn of_plan(plan: &Plan, robot: &RobotModel, extras: &ViewExtras<'_>) -> Result<Self, ViewError> {
        let (job, certificate) = (&plan.job, extras.certificate);
        job.validate()?;
        let motion = plan.knots.motion()?;
        let start = motion.positions().first().ok_or(ViewError::NoMotion)?;
        let tips = Tips::new(plan, robot, &motion);
        let execution = extras.executed;
        let execution = execution.map(|executed| Execution::new(executed, plan, &tips, certificate, coverage::CELLS));
        let region = extras.region.cloned().unwrap_or_default();
        Ok(Self {
            heading: Heading::of_plan(plan),
            certificate: certificate.map(Certificate::new),
            paths: plates::paths(plan, &tips),
            segments: plan.segments.clone(),
            motion: Some((&motion).into()),
            clearance: Clearance::new(plan, robot, &motion, certificate),
            coverage: coverage::plates(plan, certificate, coverage::CELLS, |[from, to]| tips.during(from, to)),
            dirt: match certificate {
                Some(certificate) => dirt::plates(plan, robot, certificate)?,
                None => Vec::new(),
            },
            execution: execution.transpose()?,
            live: extras.events.map(str::to_owned),
            ..Self::of_terms(job, robot, &region, start)
        })
    }

    /// A job that is not planned: the arm at home among the plates.
    #[must_use]
    pub fn of_job(job: &WashJob, region: &TaskRegion) -> Self {
        let terms = job.terms();
        Self {
            heading: Heading::of_job(job),
            ..Self::of_terms(terms, job.arm(), region, &terms.home_rad[0])
        }
    }

    /// The arm of a job in a configuration \[rad\], among the plates and the bodies around.
    fn of_terms(terms: &JobTerms, robot: &RobotModel, region: &TaskRegion, q: &JointVector) -> Self {
        let workcell = &terms.workcell;
        let flange = workcell.tool.mounting_frame(robot);
        let accelerations = Some(terms.limits.joint_acceleration_rad_s2);
        let plates = terms.plates.iter().enumerate();
        Self {
            arm: Arm::new(robot, &workcell.mount, &flange, accelerations),
            surroundings: Surroundings {
                obstacles: workcell.obstacles.clone(),
                region: region.clone(),
            },
            plates: plates
                .map(|(index, plate)| Plate::of_job(index, plate, terms))
                .collect(),
            ..Self::of_configuration(robot, Some(&workcell.tool), q)
        }
    }

    /// One configuration of an arm that stands at the origin \[rad\], with a tool or without.
    #[must_use]
    pub fn of_configuration(robot: &RobotModel, tool: Option<&Tool>, q: &JointVector) -> Self {
        let flange = tool.map_or(robot.last_link_frame(), |tool| tool.mounting_frame(robot));
        Self {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION"),
            heading: Heading::of_configuration(robot.name()),
            certificate: None,
            arm: Arm::new(robot, &Pose::identity(), &flange, None),
            tool: tool.cloned(),
            surroundings: Surroundings::default(),
            plates: Vec::new(),
            paths: Vec::new(),
            segments: Vec::new(),
            motion: None,
            pose_rad: (*q).into(),
            clearance: None,
            coverage: Vec::new(),
            dirt: Vec::new(),
            execution: None,
            beside: None,
            live: None,
        }
    }
}
