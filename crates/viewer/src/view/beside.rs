//! Another program's motion on the same plates, to be shown beside the plan on one clock.

use super::coverage::PlateCoverage;
use super::error::ViewError;
use super::execution::{ExecutedMotion, Execution};
use super::numbers::Numbers;
use super::tips::Tips;
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use serde::Serialize;
use ts_rs::TS;

/// Cells of all rasters together, about.
const CELLS: usize = 9_000;

/// Time after a waypoint at which a wash is taken to begin, so that the waypoint before the first one is not part of it \[s\].
const JUST_AFTER_S: f64 = 1e-9;

/// Executed motion of another program, with the arm of the plan and no tool.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Beside {
    /// First line of the report on it.
    pub headline: String,
    /// Duration \[s\].
    pub duration_s: f64,
    /// \[n\] \[s\].
    pub t_s: Numbers,
    /// \[n, 6\] \[rad\].
    pub q_rad: Numbers,
    /// Swept area of the plates. Nothing of it is proved.
    pub coverage: Vec<PlateCoverage>,
}

impl Beside {
    /// The motion that a control law makes of another program's plan.
    ///
    /// # Errors
    /// [`ViewError`] for a plan that is no motion, or another plan's motion.
    pub fn new(mut plan: Plan, robot: &RobotModel, executed: &ExecutedMotion) -> Result<Self, ViewError> {
        let washes = plan
            .segments
            .iter_mut()
            .filter(|segment| segment.kind == SegmentKind::Wash);
        // The program's report measures the way from the first waypoint of a plate on, without the step that leads there.
        washes.for_each(|segment| segment.t_start_s += JUST_AFTER_S);
        let motion = plan.knots.motion()?;
        let shown = Execution::new(executed, &plan, &Tips::new(&plan, robot, &motion), None, CELLS)?;
        Ok(Self {
            headline: shown.told.headline.unwrap_or_default(),
            duration_s: plan.duration_s(),
            t_s: shown.t_s,
            q_rad: shown.q_rad,
            coverage: shown.coverage,
        })
    }
}
