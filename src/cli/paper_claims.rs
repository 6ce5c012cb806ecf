//! A plan of the paper's program followed again: what it was to follow, and what came of what the paper takes for granted.

use nalgebra::Vector3;
use platewash::paper::reproduce::dead_end_share;
use platewash::paper::{PaperError, PaperJob, PaperPart, run_with};
use platewash::viewer::figures::Claim;
use platewash::workcell::segment::SegmentKind;
use platewash::{CancelToken, Plan, RobotModel};
use std::sync::Arc;

/// What is known of a run of the paper's program.
pub struct Followed {
    /// By plate, what the tip was to follow, world frame \[m\].
    pub ideal: Vec<(usize, Vec<Vector3<f64>>)>,
    /// What is taken for granted, and what came of it.
    pub claims: Vec<Claim>,
}

/// Follows the job of a plan again. Claims are made of the plan's own motion: none where the program makes another one now.
pub fn follow(plan: &Plan, arm: &Arc<RobotModel>, cancel: &CancelToken) -> Result<Followed, PaperError> {
    let job = PaperJob::of_plan(plan, arm.clone())?;
    let run = run_with(&job, cancel)?;
    let washes = run
        .tool_path
        .segments
        .iter()
        .filter(|segment| segment.kind == SegmentKind::Wash);
    let ideal = washes
        .map(|segment| (segment.plate, segment.waypoints.clone()))
        .collect();
    let same = run.planned.positions() == plan.knots.q_rad;
    let claims = if same {
        run.report_with(cancel)?.claims(&run)
    } else {
        Vec::new()
    };
    let claims = claims.into_iter().map(|claim| Claim {
        about: claim.about.to_owned(),
        claimed: claim.claimed,
        measured: claim.measured,
        holds: claim.holds,
    });
    let claims: Vec<Claim> = claims.collect();
    let first = if claims.is_empty() { None } else { places_found(plan)? };
    Ok(Followed {
        ideal,
        claims: first.into_iter().chain(claims).collect(),
    })
}

/// Layouts that are begun to see how often none is found.
const DRAWS: usize = 4000;

/// How often the paper's sampling finds places at all, where the plan is of one of its own two regions.
fn places_found(plan: &Plan) -> Result<Option<Claim>, PaperError> {
    let name = |part: PaperPart| format!("paper-{}", part.name());
    let Some(part) = PaperPart::ALL
        .into_iter()
        .find(|part| name(*part) == plan.provenance.scenario)
    else {
        return Ok(None);
    };
    let share = dead_end_share(part, DRAWS, plan.job.seed)?;
    Ok(Some(Claim {
        about: "places for the plates are found".to_owned(),
        claimed: "drawing again until all fit".to_owned(),
        measured: format!(
            "{:.0} % of {DRAWS} runs come to where none fits, and never end",
            100.0 * share
        ),
        holds: share == 0.0,
    }))
}
