//! Another program's motion on the same plates, to be shown beside the plan on one clock.

use super::coverage::PlateCoverage;
use super::error::ViewError;
use super::execution::{ExecutedMotion, Execution};
use super::numbers::Numbers;
use super::tips::Tips;
use platewash_kinematics::RobotModel;
use platewash_workcell::plan::Plan;
use serde::Serialize;

/// Cells of all rasters together, about.
const CELLS: usize = 9_000;

/// Executed motion of another program, with the arm of the plan and no tool.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    pub fn new(plan: &Plan, robot: &RobotModel, executed: &ExecutedMotion) -> Result<Self, ViewError> {
        let motion = plan.knots.motion()?;
        let shown = Execution::new(executed, plan, &Tips::new(plan, robot, &motion), None, CELLS)?;
        Ok(Self {
            headline: shown.told.headline.unwrap_or_default(),
            duration_s: plan.duration_s(),
            t_s: shown.t_s,
            q_rad: shown.q_rad,
            coverage: shown.coverage,
        })
    }
}
