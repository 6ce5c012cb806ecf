//! From the scenario to the proof, a line a step.

use crate::draft::changed;
use crate::end::End;
use crate::moves::moves;
use crate::placed::{Placed, placed};
use crate::protocol::{
    ArmLine, CellLine, CellParts, CellQuestion, FindingLine, PlanParts, PlateChance, PlateProof, Refusal, Want,
};
use crate::stopwatch::Stopwatch;
use crate::subject::{Latest, Subject};
use crate::told::Told;
use crate::unplanned;
use platewash_certificate::prove_with;
use platewash_planner::{Chance, PlanError, Planned, PlateOutlook, Watch, outlook, plan_here};
use platewash_scenario::Failure;
use platewash_viewer::view::{Beside, Certificate, View};
use platewash_workcell::cancel::{CancelToken, Deadline};
use platewash_workcell::layout::Finding;
use std::sync::Arc;

/// Answers the question.
pub fn answer(
    subject: &Subject,
    question: &CellQuestion,
    told: &mut Told<'_>,
    gone: &CancelToken,
    deadline: &Deadline,
) {
    let mut watch = Stopwatch::start();
    let answering = Answering {
        subject,
        question,
        gone,
    };
    match answering.answer(told, &mut watch) {
        Ok(()) => {}
        Err(End::Refused(refusal)) => {
            let ms = watch.all();
            told.line(&CellLine::Refused(&Refusal { ms, ..refusal }));
        }
        Err(End::GivenUp) if deadline.is_missed() => told.line(&CellLine::Failed {
            words: "this cell takes longer than a minute to plan and prove; `platewash run` takes its time",
        }),
        Err(End::GivenUp) => told.line(&CellLine::Superseded),
        Err(End::Failed(words)) => told.line(&CellLine::Failed { words: &words }),
    }
}

struct Answering<'a> {
    subject: &'a Subject,
    question: &'a CellQuestion,
    gone: &'a CancelToken,
}

impl Answering<'_> {
    fn answer(&self, told: &mut Told<'_>, watch: &mut Stopwatch) -> Result<(), End> {
        let changed = changed(self.subject, &self.question.text, &self.question.edits, self.gone)?;
        watch.step("read");
        told.line(&CellLine::Scenario {
            text: &changed.text,
            stated: &changed.stated,
            values: &changed.values,
            ms: watch.all(),
        });
        let placed = placed(self.subject, changed.scenario?, self.gone)?;
        watch.step("place");
        self.tell_cell(&placed, told, watch);
        match self.question.want {
            Want::Preview => self.tell_preview(&placed, told, watch),
            Want::Proof => self.tell_all(&placed, &changed.text, told, watch),
        }
    }

    /// A guess; where none can be made, as where the arm is not clear at home, why.
    fn tell_preview(&self, placed: &Placed, told: &mut Told<'_>, watch: &mut Stopwatch) -> Result<(), End> {
        let found = outlook(&placed.job, &Watch::silent(self.gone));
        watch.step("preview");
        match found {
            Ok(found) => {
                told.line(&CellLine::Preview {
                    plates: found.iter().map(PlateChance::from).collect(),
                    ms: watch.all(),
                });
                Ok(())
            }
            Err(error) if self.question.want == Want::Preview => {
                unplanned::tell(placed, error, false, told, watch, self.gone).map(|_| ())
            }
            // Planning says it.
            Err(_) => Ok(()),
        }
    }

    /// The guess while it is planned, then the plan, then its proof.
    fn tell_all(&self, placed: &Placed, text: &str, told: &mut Told<'_>, watch: &mut Stopwatch) -> Result<(), End> {
        let mut planned = None;
        let previewed = rayon::in_place_scope(|scope| {
            scope.spawn(|_| planned = Some(plan_here(&placed.job, &Watch::silent(self.gone))));
            self.tell_preview(placed, told, watch)
        });
        previewed?;
        watch.step("plan");
        match planned {
            Some(Ok(planned)) => self.tell_plan(placed, text, planned, told, watch),
            Some(Err(error)) => self.unplanned(placed, text, error, told, watch),
            None => Err(End::Failed("planning did not begin".to_owned())),
        }
    }

    fn tell_cell(&self, placed: &Placed, told: &mut Told<'_>, watch: &mut Stopwatch) {
        let Placed {
            scenario,
            loaded,
            layout,
            job,
        } = placed;
        let view = View::of_job(job, &scenario.task_region());
        let id = loaded.id.as_str();
        let is_new = self.question.arm.as_deref() != Some(id);
        let plates = &layout.plates;
        watch.step("show cell");
        told.line(&CellLine::Cell(Box::new(CellParts {
            heading: &view.heading,
            arm: is_new.then_some(ArmLine { id, arm: &view.arm }),
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
            ms: watch.all(),
        })));
    }

    fn tell_plan(
        &self,
        placed: &Placed,
        text: &str,
        planned: Planned,
        told: &mut Told<'_>,
        watch: &mut Stopwatch,
    ) -> Result<(), End> {
        let arm = &placed.loaded.arm;
        let plan = Arc::new(planned.plan);
        let view = View::of_plan(&plan, arm, &Beside::default()).map_err(|error| End::Failed(error.to_string()))?;
        self.gone.check()?;
        watch.step("show plan");
        told.line(&CellLine::Plan(Box::new(PlanParts {
            heading: &view.heading,
            headline: format!("planned, not proved yet: {:.2} s", plan.duration_s()),
            paths: &view.paths,
            segments: &view.segments,
            motion: &view.motion,
            clearance: &view.clearance,
            coverage: &view.coverage,
            ms: watch.all(),
        })));
        watch.step("tell plan");
        let certificate = prove_with(&plan, arm, self.gone).map_err(Failure::from)?;
        watch.step("prove");
        let shown = Certificate::new(&certificate);
        let proved = view.coverage.iter().filter_map(|coverage| {
            let at_least = coverage.proved_by(&certificate)?;
            let plate = coverage.plate;
            Some(PlateProof { plate, at_least })
        });
        told.line(&CellLine::Proof {
            certificate: &shown,
            headline: &shown.headline,
            proved: proved.collect(),
            ms: watch.all(),
        });
        self.subject.remember(|| Latest {
            text: text.to_owned(),
            scenario: placed.scenario.clone(),
            plan: Some(plan),
            headline: certificate.headline.clone(),
            certificate: Some(Arc::new(certificate)),
        });
        Ok(())
    }

    fn unplanned(
        &self,
        placed: &Placed,
        text: &str,
        error: PlanError,
        told: &mut Told<'_>,
        watch: &mut Stopwatch,
    ) -> Result<(), End> {
        let headline = unplanned::tell(placed, error, true, told, watch, self.gone)?;
        self.subject.remember(|| Latest {
            text: text.to_owned(),
            scenario: placed.scenario.clone(),
            plan: None,
            certificate: None,
            headline,
        });
        Ok(())
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
