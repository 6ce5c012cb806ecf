//! How near the arm comes to itself and to what stands around it.

use crate::run::PaperRun;
use crate::tracking::Step;
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::clearance::{ClearanceModel, PairClearance, is_clear};
use platewash_workcell::trajectory::SegmentKind;
use serde::Serialize;

/// The nearest approach of two bodies, and when.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClosestApproach {
    /// When \[s\].
    pub t_s: f64,
    /// What and where.
    #[serde(flatten)]
    pub pair: PairClearance,
}

/// How near the arm comes at one step.
pub(super) struct Nearness {
    /// The nearest pair.
    pub nearest: Option<ClosestApproach>,
    /// All pairs that keep too little clearance.
    pub too_near: Vec<ClosestApproach>,
}

/// How near the arm comes at one step, commanded and executed.
pub(super) struct StepApproach {
    pub planned: Nearness,
    pub executed: Nearness,
}

/// How near the arm comes at every step, commanded and executed.
pub(super) fn approaches(
    run: &PaperRun,
    clearance: &ClearanceModel,
    cancel: &CancelToken,
) -> Result<Vec<StepApproach>, Cancelled> {
    let at = |(k, step): (usize, &Step)| {
        let working = worked_on(run, k);
        let nearness = |q| nearness(clearance, q, &working, run, k);
        cancel.check()?;
        Ok(StepApproach {
            planned: nearness(&step.commanded),
            executed: nearness(&step.executed),
        })
    };
    run.steps.iter().enumerate().map(at).collect()
}

fn nearness(clearance: &ClearanceModel, q: &JointVector, working: &[usize], run: &PaperRun, step: usize) -> Nearness {
    let required_m = run.job.requirements.clearance_m;
    let timed = |pair| ClosestApproach {
        t_s: run.time_of(step),
        pair,
    };
    let nearest = clearance.smallest(q, working);
    // Nearly all configurations keep their distance; only the others are looked at pair by pair.
    let too_near = match &nearest {
        Some(pair) if !is_clear(pair.distance_m, required_m) => clearance.too_near(q, working, required_m),
        _ => Vec::new(),
    };
    Nearness {
        nearest: nearest.map(timed),
        too_near: too_near.into_iter().map(timed).collect(),
    }
}

/// The plate that the sponge may touch at a step: the one it washes; on the way, the one it leaves for the first half and
/// the one it comes to for the second.
fn worked_on(run: &PaperRun, step: usize) -> [usize; 1] {
    let segments = &run.tool_path.segments;
    let index = run.steps[step].segment;
    let segment = &segments[index];
    let first_half = || {
        let before: usize = segments[..index].iter().map(|s| s.waypoints.len()).sum();
        2 * (step - before) < segment.waypoints.len()
    };
    match (segment.kind, index.checked_sub(1)) {
        (SegmentKind::Transit, Some(left)) if first_half() => [segments[left].plate],
        _ => [segment.plate],
    }
}

/// The nearest of several approaches (the first of equals).
pub(super) fn nearest<'a>(approaches: impl Iterator<Item = &'a ClosestApproach>) -> Option<ClosestApproach> {
    approaches
        .min_by(|a, b| a.pair.distance_m.total_cmp(&b.pair.distance_m))
        .cloned()
}
