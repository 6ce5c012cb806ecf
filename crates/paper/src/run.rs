//! The paper's program, stage after stage: tool path, inverse kinematics and execution.

use crate::error::PaperError;
use crate::job::PaperJob;
use crate::tool_path::ToolPath;
use crate::tracking::{self, Step};
use platewash_kinematics::JointVector;
use platewash_kinematics::ik::IkSolver;
use platewash_motion::plan::{Knots, Plan, PlanFileError, PlanParts, Provenance};
use platewash_motion::trajectory::{PlanSegment, SegmentKind, Trajectory};
use platewash_simulator::control;
use platewash_workcell::cancel::CancelToken;

/// A job planned and followed, before it is judged.
#[derive(Debug, Clone)]
pub struct PaperRun {
    /// The job that was run.
    pub job: PaperJob,
    /// Path that the tip is to follow.
    pub tool_path: ToolPath,
    /// One step per waypoint of the tool path.
    pub steps: Vec<Step>,
    /// The commanded motion, from the start configuration on.
    pub planned: Trajectory,
    /// The motion that the control law makes of it.
    pub executed: Trajectory,
}

/// Plans and follows a job.
///
/// # Errors
/// [`PaperError`], one variant a stage. A run that does not wash is no error: see [`PaperRun::report`].
pub fn run(job: &PaperJob) -> Result<PaperRun, PaperError> {
    run_with(job, &CancelToken::new())
}

/// Plans and follows a job; a token can cancel it.
///
/// # Errors
/// As [`run`], and [`PaperError::Cancelled`].
pub fn run_with(job: &PaperJob, cancel: &CancelToken) -> Result<PaperRun, PaperError> {
    job.validate()?;
    let (arm, start) = (&job.arm, &job.start_rad);
    let tool_path = ToolPath::new(&job.settings, &job.layout.plates);
    let solver = IkSolver::new(arm, job.workcell.tool.tip_frame(arm), job.settings.ik_settings())?;
    let mut law = control::kinematic(job.simulation.law, &job.simulation.control)?;
    let seed = job.settings.ik.seed;
    let steps = tracking::follow(arm, &solver, &tool_path, seed, law.as_mut(), start, cancel)?;
    let motion = |of: fn(&Step) -> JointVector| {
        let positions = std::iter::once(*start).chain(steps.iter().map(of)).collect();
        Trajectory::through(positions, job.simulation.control.dt_s)
    };
    let (planned, executed) = (motion(|s| s.commanded), motion(|s| s.executed));
    Ok(PaperRun {
        job: job.clone(),
        tool_path,
        steps,
        planned,
        executed,
    })
}

impl PaperRun {
    /// Time of a step \[s\]: the first waypoint is one time step after the start.
    #[must_use]
    pub fn time_of(&self, step: usize) -> f64 {
        self.planned.times().get(step + 1).copied().unwrap_or(0.0)
    }

    /// The segments one after the other: the step from the start to the first waypoint, then one per segment of the tool path.
    /// A time belongs to the segment that ends at or after it.
    #[must_use]
    pub fn segments(&self) -> Vec<PlanSegment> {
        let Some(first) = self.tool_path.segments.first() else {
            return Vec::new();
        };
        let mut all = vec![PlanSegment {
            kind: SegmentKind::Depart,
            plate: first.plate,
            t_start_s: 0.0,
            t_end_s: self.time_of(0),
        }];
        let mut end = 0;
        for segment in &self.tool_path.segments {
            end += segment.waypoints.len();
            all.push(PlanSegment {
                kind: segment.kind,
                plate: segment.plate,
                t_start_s: all[all.len() - 1].t_end_s,
                t_end_s: self.time_of(end.saturating_sub(1)),
            });
        }
        all
    }

    /// The plan file of the commanded motion, sealed. There is no certificate for it.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn plan(&self) -> Result<Plan, PlanFileError> {
        let parts = PlanParts {
            provenance: Provenance::new(&self.job.name),
            order: self.tool_path.order.clone(),
            wash_paths: Vec::new(),
            segments: self.segments(),
            knots: Knots::from(&self.planned),
        };
        Plan::sealed(self.job.terms()?, parts)
    }
}
