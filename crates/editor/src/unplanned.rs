//! Why there is no plan: which plates, which parts of them, and where else they could lie.

use crate::end::End;
use crate::placed::Placed;
use crate::protocol::{CellLine, Unwashable};
use crate::stopwatch::Stopwatch;
use crate::told::Told;
use platewash_planner::{
    InfeasibleReport, PlanError, SEARCHED_M, UnwashablePlate, Watch, nearest_place, unwashable_plates,
};
use platewash_scenario::Failure;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::verdict::Verdict;

/// Tells why a job was not planned and, where that is wanted, where each plate that stands in the way could lie; the first line of it.
pub fn tell(
    placed: &Placed,
    error: PlanError,
    is_wanted: bool,
    told: &mut Told<'_>,
    watch: &mut Stopwatch,
    gone: &CancelToken,
) -> Result<String, End> {
    let scenario = &placed.scenario;
    let Some(report) = InfeasibleReport::new(&scenario.name, scenario.seed, &error) else {
        return Err(error.into());
    };
    let report = report.explained(reason(error));
    let planning = Watch::silent(gone);
    let plates = match is_wanted {
        true => unwashable_plates(&placed.job, &planning),
        false => Ok(Vec::new()),
    };
    // Where a plate cannot be looked into, as where the arm is not clear at home, the report says why.
    let plates = match plates {
        Err(PlanError::Cancelled(_)) => return Err(End::GivenUp),
        other => other.unwrap_or_default(),
    };
    watch.step("explain");
    let mut shown: Vec<_> = plates.iter().map(Unwashable::from).collect();
    for of_report in &report.plates {
        if shown.iter().all(|plate| plate.plate != of_report.plate) {
            shown.push(Unwashable::reached_in_vain(of_report.plate, &report.reason));
        }
    }
    shown.sort_by_key(|plate| plate.plate);
    told.line(&CellLine::Unplanned {
        headline: &report.headline,
        reason: &report.reason,
        proved: report.verdict == Verdict::Infeasible,
        plates: &shown,
        ms: watch.all(),
    });
    for plate in plates.iter().map(|plate| plate.plate) {
        let nearest_m = nearest_place(&placed.job, plate, &planning)?;
        watch.step("place elsewhere");
        told.line(&CellLine::Place {
            plate,
            nearest_m,
            searched_m: SEARCHED_M,
            ms: watch.all(),
        });
    }
    Ok(report.headline)
}

/// Why there is no plan, without another place for a plate: that is told behind it.
fn reason(error: PlanError) -> String {
    match error {
        PlanError::Unwashable(plate) => plate.why().to_string(),
        other => Failure::from(other).to_string(),
    }
}

impl From<&UnwashablePlate> for Unwashable {
    fn from(plate: &UnwashablePlate) -> Self {
        Self {
            plate: plate.plate,
            proved: plate.conclusion.is_proved(),
            words: plate.why().to_string(),
            causes: plate.causes.iter().map(|cause| cause.words(plate.conclusion)).collect(),
            share: plate.share,
            free_m: plate.free_m.clone(),
            dead_m: plate.dead_m.clone(),
        }
    }
}

impl Unwashable {
    /// A plate that could be washed if the arm got there and away.
    fn reached_in_vain(plate: usize, reason: &str) -> Self {
        Self {
            plate,
            proved: false,
            words: reason.to_owned(),
            causes: Vec::new(),
            share: None,
            free_m: Vec::new(),
            dead_m: Vec::new(),
        }
    }
}
