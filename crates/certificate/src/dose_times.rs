//! Times at which the proved dose of places of a plate reaches the required one.
//!
//! The certificate bounds the share of a face that gets the dose, over cells. This is the same bound at single places and up to each moment:
//! the sum of [`Edges::flat`](crate::washing::face_shares::edges::Edges::flat) over a cell so small that it is a place.

use crate::error::ProveError;
use crate::judged_job::JudgedJob;
use crate::motion::tip::Arm;
use crate::plan_statements::schedule::Schedule;
use crate::plan_statements::wash_paths;
use crate::prove::{check_job, read};
use crate::report::certificate::Certificate;
use crate::washing::face_shares::bounds::Passes;
use crate::washing::face_shares::face_cell::{CellState, FaceCell};
use crate::washing::instants::Instants;
use platewash_bodies::contact::Foundation;
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::SegmentKind;
use platewash_workcell::cancel::CancelToken;
use rayon::prelude::*;

/// Half of the edge of the cell around a place \[m\].
const HALF_M: f64 = 1e-6;

/// Bound on the relative rounding error of a sum of doses.
const ROUNDING: f64 = 1e-12;

/// Times at which the dose of a plate's places is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct DoseTimes {
    /// Index of the plate.
    pub plate: usize,
    /// For each place, the earliest time at which the dose is proved, infinite where it is not proved at all \[s\].
    pub times_s: Vec<f64>,
}

/// For each plate whose certificate proves a dose, the time at which it is proved to have reached the required dose, for every height of the
/// plate and every stiffness of the sponge that the job allows, at some places. `places` tells the places of a plate from its index and its
/// rim \[m\]: x and y in the plate's frame \[m\]. `certificate` is that of the plan.
///
/// # Errors
/// As [`prove_with`](crate::prove_with).
pub fn dose_times(
    plan: &Plan,
    arm: &RobotModel,
    certificate: &Certificate,
    places: impl Fn(usize, f64) -> Vec<[f64; 2]> + Sync,
) -> Result<Vec<DoseTimes>, ProveError> {
    check_job(&plan.job)?;
    let seen = &*plan.seen_from_base();
    let job = &seen.job;
    let judged = JudgedJob::new(job, arm, wash_paths::by_plate(seen));
    // Where no share is proved, the bound on which the sum rests may not hold.
    let proved = certificate.contact.iter().filter(|contact| contact.dose.at_least > 0.0);
    let plates: Vec<usize> = proved.map(|contact| contact.plate).collect();
    let (false, Some(foundation)) = (plates.is_empty(), Foundation::from_sponge(&job.workcell.tool.sponge)) else {
        return Ok(Vec::new());
    };
    let pieces = read(&seen.knots)?;
    let Ok(schedule) = Schedule::new(seen, &pieces) else {
        return Ok(Vec::new());
    };
    let cancel = CancelToken::new();
    let arm = Arm::new(arm, &job.workcell.tool, &cancel);
    let along = arm.along(&pieces);
    let of_plate = |index: usize| {
        let plate = judged.plates().get(index)?;
        let wanted = job.contact_of(plate).filter(|wanted| wanted.dose_pa_m > 0.0)?;
        let thresholds = wanted.thresholds();
        let is_wash = |kind| kind == SegmentKind::Wash;
        let span = schedule
            .spans
            .iter()
            .find(|span| span.plate == index && is_wash(span.kind))?;
        let pieces = &along[span.pieces.clone()];
        let instants = Instants::new(&arm, pieces, plate, (&foundation, wanted.height_error_m));
        let moments = (&instants.moments[..], &instants.sags[..]);
        let passes = Passes::new(&plate.surface, &foundation, moments, &thresholds);
        let places = places(index, plate.rim_m());
        let times_s = places.par_iter().map(|place| passes.dose_time_s(*place)).collect();
        Some(DoseTimes { plate: index, times_s })
    };
    Ok(plates.into_par_iter().filter_map(of_plate).collect())
}

impl Passes<'_> {
    /// Earliest time at which the dose ∫ σ dl of a place (requirement 29) is proved, infinite where it is not \[s\].
    fn dose_time_s(&self, place: [f64; 2]) -> f64 {
        let (edges, cell) = (&self.edges, FaceCell::new(self.surface, place, HALF_M));
        let reach_m = self.reach_m(&cell);
        let mut windows = Vec::new();
        self.windows_near(&cell, &mut windows);
        let mut dose_pa_m = 0.0;
        for [first, last] in windows {
            let mut before: Option<CellState> = None;
            for look in edges.looks(first as usize..last as usize + 1) {
                let mut state = CellState::default();
                let is_near = edges.see(&cell, look, reach_m, &mut state) <= reach_m;
                if let Some(before) = before.filter(|_| is_near)
                    && let Some(gain) = edges.flat(&cell, [&before, &state])
                {
                    dose_pa_m += gain.dose.value;
                    if dose_pa_m * (1.0 - ROUNDING) >= edges.thresholds.dose_pa_m {
                        return look.t_s;
                    }
                }
                before = is_near.then_some(state);
            }
        }
        f64::INFINITY
    }
}
