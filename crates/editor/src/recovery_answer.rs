//! The way on after a stop of the cell's plan: planned and proved, and shown.

use crate::answer_writer::{AnswerWriter, End};
use crate::edited_scenario::{EditedScenario, changed, place_job};
use crate::protocol::{RecoveryLine, RecoveryQuestion};
use crate::refusal::plain;
use platewash_certificate::prove_with;
use platewash_kinematics::JointVector;
use platewash_motion::plan::Plan;
use platewash_planner::{Recovered, RecoveryError, Watch, plan_here, recover};
use platewash_scenario::Failure;
use platewash_viewer::view::{View, ViewExtras};

/// Answers a question for a recovery.
pub fn answer(edited: &EditedScenario, question: &RecoveryQuestion, answer: &mut AnswerWriter<'_>) {
    if let Err(end) = answer_recovery(edited, question, answer) {
        answer.end(
            &end,
            "this recovery takes longer than a minute; `platewash recover` takes its time",
        );
    }
}

fn answer_recovery(
    edited: &EditedScenario,
    question: &RecoveryQuestion,
    answer: &mut AnswerWriter<'_>,
) -> Result<(), End> {
    let gone = answer.gone.clone();
    let watch = Watch::silent(&gone);
    let scenario = changed(edited, &question.text, &[], &gone)?.scenario?;
    let placed = place_job(edited, scenario, &gone)?;
    let arm = &placed.loaded.arm;
    let plan = plan_here(&placed.job, &watch)?.plan;
    let proof = |plan: &Plan| prove_with(plan, arm, &gone).map_err(Failure::from);
    let parent = proof(&plan)?;
    if !parent.passes() {
        return Err(plain(format!("a recovery is one of a proved plan; {}", parent.headline)).into());
    }
    answer.step("plan");
    let at = match question.at_deg {
        Some(at_deg) => Some(JointVector::from(at_deg.map(f64::to_radians))),
        None => plan
            .knots
            .motion()
            .ok()
            .and_then(|motion| Some(motion.at(question.stopped_s?)?.q)),
    };
    let at = at.ok_or_else(|| plain("a recovery needs where the arm stands, or when it was stopped".to_owned()))?;
    let recovered = recover(&plan, arm, &at, question.stopped_s, &watch);
    let Recovered { stop, home, rest, .. } = recovered.map_err(|error| match error {
        RecoveryError::Plan(error) => End::from(error),
        error => plain(error.to_string()).into(),
    })?;
    let certificate = proof(&home)?;
    let rest = rest.map(|rest| proof(&rest)).transpose()?;
    answer.step("recover");
    let extras = ViewExtras {
        certificate: Some(&certificate),
        ..ViewExtras::default()
    };
    let view = View::of_plan(&home, arm, &extras).map_err(|error| End::Failed(error.to_string()))?;
    answer.line(&RecoveryLine::Recovery {
        proved: certificate.passes() && rest.as_ref().is_none_or(|rest| rest.passes()),
        stop: stop.to_string(),
        rest: rest.map(|rest| rest.headline),
        view: Box::new(view),
        ms: answer.ms(),
    });
    Ok(())
}
