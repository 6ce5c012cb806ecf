//! The spirals that the paper's program commands, which its plan file does not state.

use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use platewash_paper::{PaperError, PaperJob, run_with};
use platewash_viewer::figures::IdealPath;
use platewash_workcell::cancel::CancelToken;
use std::sync::Arc;

/// The commanded path on each plate of a plan of the paper's program, in the order of washing: the program is run again.
///
/// # Errors
/// [`PaperError`] for a plan that is none of the paper's program, and for work that was given up.
pub fn paper_spirals(plan: &Plan, arm: &Arc<RobotModel>, cancel: &CancelToken) -> Result<Vec<IdealPath>, PaperError> {
    let run = run_with(&PaperJob::of_plan(plan, arm.clone())?, cancel)?;
    let segments = run.tool_path.segments.into_iter();
    let washes = segments.filter(|segment| segment.kind == SegmentKind::Wash);
    let ideal = washes.map(|segment| IdealPath {
        plate: segment.plate,
        points: segment.waypoints,
    });
    Ok(ideal.collect())
}
