//! Work from the scenario to the proof, one line per step: the parts of the cell, an outlook, the plan and its proof, or the
//! reason that there is none, and places at which plates could lie.

use crate::answer_writer::{AnswerWriter, End};
use crate::edited_scenario::{EditedScenario, LastResult, PlacedJob, changed, place_job};
use crate::moves::moves;
use crate::protocol::{
    ArmLine, CellLine, CellParts, CellQuestion, FindingLine, LastStage, MapLine, MapQuestion, PlanParts, PlateChance,
    PlateProof, UnwashableReport,
};
use crate::refusal::plain;
use platewash_certificate::{Certificate, prove_with};
use platewash_motion::plan::Plan;
use platewash_planner::{
    Chance, MapArea, MapPatch, PlanError, PlannedJob, PlateOutlook, SEARCHED_M, UnwashablePlate, Watch, nearest_place,
    plan_here, plate_outlooks, unwashable_plates, washable_map,
};
use platewash_scenario::Failure;
use platewash_viewer::view::{self, View, ViewExtras};
use platewash_workcell::layout::Finding;
use platewash_workcell::verdict::Verdict;
use platewash_workcell::words::plate_name;
use std::sync::Arc;

/// Meaning of a map, in words for the page.
const MEANING: &str = "Where a plate of this size could lie, the others as they are: at the middle of each square it has room, and \
                       configurations were found for all of its wash path. Not planned, not proved.";

/// Answers a question for a cell.
pub fn answer(edited: &EditedScenario, question: &CellQuestion, answer: &mut AnswerWriter<'_>) {
    if let Err(end) = answer_cell(edited, question, answer) {
        let too_long = "this cell takes longer than a minute to plan and prove; `platewash run` takes its time";
        answer.end(&end, too_long);
    }
}

fn answer_cell(edited: &EditedScenario, question: &CellQuestion, answer: &mut AnswerWriter<'_>) -> Result<(), End> {
    let changed = changed(edited, &question.text, &question.edits, &answer.gone)?;
    answer.step("read");
    answer.line(&CellLine::Scenario {
        text: &changed.text,
        stated: &changed.stated,
        values: &changed.values,
        ms: answer.ms(),
    });
    let placed = place_job(edited, changed.scenario?, &answer.gone)?;
    answer.step("place");
    tell_parts(&placed, question.arm.as_deref(), answer);
    if question.want == LastStage::Preview {
        return match tell_preview(&placed, answer) {
            // Where no guess can be made, as where the arm is not clear at home, why.
            Some(error) => tell_unplanned(&placed, error, false, answer).map(drop),
            None => Ok(()),
        };
    }
    // The guess while it is planned; where none can be made, planning says why.
    let (mut planned, gone) = (None, answer.gone.clone());
    rayon::in_place_scope(|scope| {
        scope.spawn(|_| planned = Some(plan_here(&placed.job, &Watch::silent(&gone))));
        if !question.guessed {
            tell_preview(&placed, answer);
        }
    });
    answer.step("plan");
    let (plan, certificate, headline) = match planned {
        Some(Ok(planned)) => tell_plan(&placed, planned, answer)?,
        Some(Err(error)) => (None, None, tell_unplanned(&placed, error, true, answer)?),
        None => return Err(End::Failed("planning did not begin".to_owned())),
    };
    edited.remember(|| LastResult {
        text: changed.text,
        scenario: placed.scenario,
        plan,
        certificate,
        headline,
    });
    Ok(())
}

/// Sends the parts of the cell; `arm` is the id of the arm that the page has.
fn tell_parts(placed: &PlacedJob, arm: Option<&str>, answer: &mut AnswerWriter<'_>) {
    let PlacedJob {
        scenario,
        loaded,
        layout,
        job,
    } = placed;
    let view = View::of_job(job, &scenario.task_region(job.arm()));
    let id = loaded.id.as_str();
    let plates = &layout.plates;
    answer.step("show cell");
    answer.line(&CellLine::Cell(Box::new(CellParts {
        heading: &view.heading,
        arm: (arm != Some(id)).then_some(ArmLine { id, arm: &view.arm }),
        arm_id: id,
        tool: &view.tool,
        surroundings: &view.surroundings,
        plates: &view.plates,
        centres_m: plates.iter().map(|plate| plate.centre_xy()).collect(),
        radius_m: plates.iter().map(|plate| plate.rim_m()).collect(),
        listed: scenario.lists_plates(),
        moves: moves(scenario),
        pose_rad: view.pose_rad,
        findings: layout.findings.iter().map(FindingLine::from).collect(),
        ms: answer.ms(),
    })));
}

/// Tells a guess; why none can be made, where that is so.
fn tell_preview(placed: &PlacedJob, answer: &mut AnswerWriter<'_>) -> Option<PlanError> {
    let found = plate_outlooks(&placed.job, &Watch::silent(&answer.gone));
    answer.step("preview");
    let plates = match found {
        Ok(found) => found.iter().map(PlateChance::from).collect(),
        Err(error) => return Some(error),
    };
    answer.line(&CellLine::Preview {
        plates,
        ms: answer.ms(),
    });
    None
}

/// A plan, its proof, and the first line of the result.
type PlanAndProof = (Option<Arc<Plan>>, Option<Arc<Certificate>>, String);

/// Tells a plan, then its proof.
fn tell_plan(placed: &PlacedJob, planned: PlannedJob, answer: &mut AnswerWriter<'_>) -> Result<PlanAndProof, End> {
    let arm = &placed.loaded.arm;
    let plan = planned.plan;
    let view = View::of_plan(&plan, arm, &ViewExtras::default()).map_err(|error| End::Failed(error.to_string()))?;
    answer.gone.check()?;
    answer.step("show plan");
    answer.line(&CellLine::Plan(Box::new(PlanParts {
        heading: &view.heading,
        headline: format!("planned, not proved yet: {:.2} s", plan.duration_s()),
        paths: &view.paths,
        segments: &view.segments,
        motion: &view.motion,
        clearance: &view.clearance,
        coverage: &view.coverage,
        ms: answer.ms(),
    })));
    answer.step("tell plan");
    let certificate = prove_with(&plan, arm, &answer.gone).map_err(Failure::from)?;
    answer.step("prove");
    let shown = view::Certificate::new(&certificate);
    let proved = view.coverage.iter().filter_map(|coverage| {
        let at_least = coverage.proved_by(&certificate)?;
        let plate = coverage.plate;
        Some(PlateProof { plate, at_least })
    });
    answer.line(&CellLine::Proof {
        certificate: &shown,
        headline: &shown.headline,
        proved: proved.collect(),
        ms: answer.ms(),
    });
    let headline = certificate.headline.clone();
    Ok((Some(plan.into()), Some(certificate.into()), headline))
}

/// Tells why a job was not planned and, where that is wanted, where each plate that stands in the way could lie; the first line of it.
fn tell_unplanned(
    placed: &PlacedJob,
    error: PlanError,
    is_wanted: bool,
    answer: &mut AnswerWriter<'_>,
) -> Result<String, End> {
    let scenario = &placed.scenario;
    let failure = Failure::from(error);
    // Other places of the plates follow in lines of their own.
    let Some(report) = failure.report_without_places(&scenario.name, scenario.seed) else {
        return Err(failure.into());
    };
    let gone = answer.gone.clone();
    let planning = Watch::silent(&gone);
    let plates = match is_wanted {
        true => unwashable_plates(&placed.job, &planning),
        false => Ok(Vec::new()),
    };
    // Where a plate cannot be looked into, as where the arm is not clear at home, the report says why.
    let plates = match plates {
        Err(PlanError::Cancelled(_)) => return Err(End::GivenUp),
        other => other.unwrap_or_default(),
    };
    answer.step("explain");
    let mut shown: Vec<_> = plates.iter().map(UnwashableReport::from).collect();
    for of_report in &report.plates {
        if shown.iter().all(|plate| plate.plate != of_report.plate) {
            shown.push(UnwashableReport::unreachable_by_transit(
                of_report.plate,
                &report.reason,
            ));
        }
    }
    shown.sort_unstable_by_key(|plate| plate.plate);
    answer.line(&CellLine::Unplanned {
        headline: &report.headline,
        reason: &report.reason,
        proved: report.verdict == Verdict::Infeasible,
        plates: &shown,
        ms: answer.ms(),
    });
    for plate in plates.iter().map(|plate| plate.plate) {
        let nearest_m = nearest_place(&placed.job, plate, &planning)?;
        answer.step("place elsewhere");
        answer.line(&CellLine::Place {
            plate,
            nearest_m,
            searched_m: SEARCHED_M,
            ms: answer.ms(),
        });
    }
    Ok(report.headline)
}

/// Answers a question for a map: places at which a plate could be washed, sent as they are found.
pub fn map(edited: &EditedScenario, question: &MapQuestion, answer: &mut AnswerWriter<'_>) {
    let answered = answer_map(edited, question, answer);
    answer.step("map");
    match answered {
        Ok(()) => answer.line(&MapLine::MapDone {
            words: MEANING,
            ms: answer.ms(),
        }),
        Err(end) => {
            let too_long = "the map was not finished within two minutes: what is drawn is what was looked at";
            answer.end(&end, too_long);
        }
    }
}

fn answer_map(edited: &EditedScenario, question: &MapQuestion, answer: &mut AnswerWriter<'_>) -> Result<(), End> {
    let gone = answer.gone.clone();
    let scenario = changed(edited, &question.text, &[], &gone)?.scenario?;
    let placed = place_job(edited, scenario, &gone)?;
    let (plate, count) = (question.plate, placed.layout.plates.len());
    if plate >= count {
        return Err(plain(format!("there is no {}: the cell has {count}", plate_name(plate))).into());
    }
    let mut tell = |patch: MapPatch| {
        answer.line(&MapLine::Map {
            step_m: patch.step_m,
            washable_m: &patch.washable_m,
            unwashable_m: &patch.unwashable_m,
            done: patch.done,
            of: patch.of,
        });
    };
    let area = MapArea::within_reach(&placed.job, plate)?;
    washable_map(&placed.job, plate, &area, &mut tell, &Watch::silent(&gone))?;
    Ok(())
}

impl From<&UnwashablePlate> for UnwashableReport {
    fn from(plate: &UnwashablePlate) -> Self {
        Self {
            plate: plate.plate,
            proved: plate.is_proved(),
            words: plate.reason_text(),
            causes: plate.causes.iter().map(ToString::to_string).collect(),
            share: plate.share,
            free_m: plate.free_m.clone(),
            dead_m: plate.dead_m.clone(),
        }
    }
}

impl UnwashableReport {
    /// A plate that could be washed if the arm got there and away.
    fn unreachable_by_transit(plate: usize, reason: &str) -> Self {
        Self {
            plate,
            words: reason.to_owned(),
            ..Self::default()
        }
    }
}

impl From<&PlateOutlook> for PlateChance {
    fn from(outlook: &PlateOutlook) -> Self {
        Self {
            plate: outlook.plate,
            chance: outlook.chance,
            words: match outlook.chance {
                Chance::Washable => "washable by itself, as far as a quick look tells",
                Chance::Unwashable => "not washable whole, as far as a quick look tells",
                Chance::Unclear => "a quick look does not tell",
            },
        }
    }
}

impl From<&Finding> for FindingLine {
    fn from(finding: &Finding) -> Self {
        let plates = match *finding {
            Finding::SpacingBroken { a, b, .. } | Finding::PlatesOverlap { a, b, .. } => vec![a, b],
            Finding::TooCloseToBase { plate, .. }
            | Finding::OverlapsBase { plate, .. }
            | Finding::LeavesRegion { plate, .. } => vec![plate],
            _ => Vec::new(),
        };
        Self {
            words: finding.to_string(),
            plates,
        }
    }
}
