//! The paper's program on the plates of a plan, for the page that shows both on one clock.

use platewash_kinematics::{Pose, RobotModel};
use platewash_motion::plan::{Plan, Process};
use platewash_paper::{self as paper, PaperJob, PaperPart};
use platewash_viewer::view::{Beside, ExecutedMotion};
use platewash_workcell::layout::Layout;
use platewash_workcell::verdict::Verdict;
use std::sync::Arc;

/// The paper's program on the plates of a plan. `None` where it knows nothing of the cell, as it is for an IRB 120 on a floor, and where
/// it ends with an error.
pub fn paper_beside(plan: &Plan, arm: &RobotModel) -> Option<Beside> {
    let job = &plan.job;
    let is_known = arm.name() == "irb120" && job.workcell.mount == Pose::identity();
    if plan.process == Process::Paper || job.dry_run.is_some() || !is_known {
        return None;
    }
    let layout = Layout::from_plates(job.plates.clone());
    let job = PaperJob::of_part(PaperPart::Appendix, Arc::new(arm.clone()), layout, job.seed).ok()?;
    let run = paper::run(&job).ok()?;
    let report = run.report().ok()?;
    let is_swept = report.verdict == Verdict::Swept;
    let executed = ExecutedMotion::followed(&run.executed, job.simulation.law, &report.headline, is_swept);
    Beside::new(run.plan().ok()?, arm, &executed).ok()
}
