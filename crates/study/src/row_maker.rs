//! Maker of rows: from a row's values to its result, planned and proved, from the row alone.

use crate::error::StudyError;
use crate::row::{Outcome, Row, RowWithPlan};
use crate::study::{RowAddress, Study};
use platewash_certificate::{Certificate, prove_with};
use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::Files;
use platewash_planner::{PlannedJob, Watch, plan_with};
use platewash_scenario::{Cache, Failure, Scenario, Solids};
use platewash_workcell::cancel::CancelToken;
use serde_json::Value;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// Most arms that are kept.
const MOST_ARMS: usize = 64;

/// A scenario's layout, planned and proved, with an arm that was loaded for it.
///
/// # Errors
/// [`Failure`] of the layout, of planning or of the proof; cancelled.
pub fn judged(
    scenario: &Scenario,
    arm: &Arc<RobotModel>,
    cancel: &CancelToken,
) -> Result<(PlannedJob, Certificate), Failure> {
    let watch = Watch::silent(cancel);
    let layout = scenario.place(arm, &watch)?;
    let planned = plan_with(&scenario.job_on(arm, &layout)?, &watch)?;
    let certificate = prove_with(&planned.plan, arm, cancel)?;
    Ok((planned, certificate))
}

/// A row with the results of its layout, and the plan where there is one; `None` where it was given up.
pub(crate) fn row_of(
    row: Row,
    judged: Result<(PlannedJob, Certificate), Failure>,
) -> Option<(Row, Option<PlannedJob>)> {
    match judged {
        Ok((planned, certificate)) => Some((row.planned(&planned, &certificate), Some(planned))),
        Err(error) if error.is_cancelled() => None,
        Err(error) => Some((row.failed(&error), None)),
    }
}

/// Makes rows of a study. It keeps data that many rows share: arms, and the scenario of rows that differ in their seed alone.
pub struct RowMaker {
    study: Arc<Study>,
    /// Meshes that were cut, for all scenarios.
    solids: Solids,
    /// The arms, by what decides them.
    arms: Cache<String, Arc<RobotModel>, MOST_ARMS>,
    /// The last scenario, by the values that it was made of, but for the seed.
    last: Cache<(usize, BTreeMap<String, Value>), Arc<Scenario>, 1>,
    /// [`judged`]; a test has another.
    judge: Judge,
}

/// Function from a scenario with its arm to a plan and its certificate.
type Judge = fn(&Scenario, &Arc<RobotModel>, &CancelToken) -> Result<(PlannedJob, Certificate), Failure>;

impl RowMaker {
    /// Maker of the rows of a study; nothing is read yet.
    #[must_use]
    pub fn new(study: Arc<Study>) -> Self {
        Self {
            study,
            solids: Solids::default(),
            arms: Cache::default(),
            last: Cache::default(),
            judge: judged,
        }
    }

    /// Computes a row: the same for every order and thread. A panic is an outcome of its own. `None` where the token cancels.
    ///
    /// # Errors
    /// [`StudyError::NoRow`].
    pub fn row(&self, index: u64, cancel: &CancelToken) -> Result<Option<RowWithPlan>, StudyError> {
        let address = self.study.row(index)?;
        let name = self.study.bases[address.base].name.clone();
        let row = Row::new(index, address.key.clone(), name, address.axes.clone());
        let done = catch_unwind(AssertUnwindSafe(|| self.done(row.clone(), &address, cancel)));
        Ok(done.unwrap_or_else(|panic| Some(row.ended(Outcome::Crashed, words_of(&*panic)).into())))
    }

    fn done(&self, row: Row, address: &RowAddress, cancel: &CancelToken) -> Option<RowWithPlan> {
        let scenario = match self.scenario(address) {
            Ok(scenario) => scenario,
            Err(problem) => return Some(row.ended(Outcome::Error, problem).into()),
        };
        let judged = self
            .arm(&scenario)
            .and_then(|arm| (self.judge)(&scenario, &arm, cancel));
        match row_of(row, judged)? {
            (row, Some(planned)) => Some(self.row_with_plan(row, &planned)),
            (row, None) => Some(row.into()),
        }
    }

    /// A row with its plan, where the study keeps it.
    fn row_with_plan(&self, row: Row, planned: &PlannedJob) -> RowWithPlan {
        if !self.study.plans.keeps_plan_of(&row) {
            return row.into();
        }
        match planned.plan.to_json() {
            Ok(plan) => RowWithPlan {
                row,
                plan: Some(plan.into_bytes()),
            },
            Err(error) => row.ended(Outcome::Error, error.to_string()).into(),
        }
    }

    /// The row's scenario, which is parsed once for all seeds in turn.
    fn scenario(&self, address: &RowAddress) -> Result<Scenario, String> {
        let mut values = address.axes.clone();
        let seed = values.remove("seed").and_then(|seed| seed.as_u64());
        let made = self.last.get_or_make((address.base, values.clone()), || {
            let mut scenario = self.study.bases[address.base].scenario(&values)?;
            scenario.solids = self.solids.clone();
            scenario.files = Files::held(self.study.files.clone());
            let read = scenario.plates_read().map_err(|error| error.to_string())?;
            Ok::<_, String>(Arc::new(read.into_owned()))
        });
        let mut scenario = Scenario::clone(&*made?);
        scenario.seed = seed.unwrap_or(scenario.seed);
        Ok(scenario)
    }

    fn arm(&self, scenario: &Scenario) -> Result<Arc<RobotModel>, Failure> {
        let robot = &scenario.robot;
        let source = (
            &robot.urdf,
            &robot.srdf,
            &robot.package_path,
            robot.visual_shapes,
            &robot.split_links,
            &robot.fixed,
        );
        self.arms.get_or_make(format!("{source:?}"), || scenario.arm())
    }
}

fn words_of(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!(
        "the program failed: {}",
        text.as_deref().unwrap_or("it does not say why")
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::panic)]

    use super::*;
    use crate::folder_reader::{read_manifest, rows};
    use crate::journal::Journal;
    use crate::run::run;
    use platewash_workcell::cancel::Cancelled;
    use std::path::Path;

    /// A planner that fails on seed 2, and else has no plan.
    fn broken(scenario: &Scenario, _: &Arc<RobotModel>, _: &CancelToken) -> Result<(PlannedJob, Certificate), Failure> {
        match scenario.seed {
            2 => panic!("index {} is none", 7),
            _ => Err(Failure::NoContact { height_m: 0.0 }),
        }
    }

    #[test]
    fn a_planner_that_panics_is_the_outcome_of_its_row_and_the_others_go_on() {
        let text = "format = \"platewash-study/1\"\nname = \"p\"\nscenario = \"kitchen\"\n[[axis]]\nkey = \"seed\"\nseeds = \"1..4\"\n";
        let study = Arc::new(Study::parse(text, "p.toml", Path::new("")).unwrap());
        let maker = RowMaker {
            judge: broken,
            ..RowMaker::new(study.clone())
        };
        let folder = tempfile::tempdir().unwrap();
        let mut journal = Journal::open(folder.path(), &study).unwrap();
        let cancel = CancelToken::new();
        run(&mut journal, &cancel, |index, cancel| maker.row(index, cancel), |_| ()).unwrap();
        let mut ended = vec![None; 4];
        let manifest = read_manifest(folder.path()).unwrap();
        rows(folder.path(), &manifest, |_, row| {
            ended[row.index as usize] = Some((row.outcome, row.reason))
        })
        .unwrap();
        let crashed = Some("the program failed: index 7 is none".to_owned());
        assert_eq!(ended[1], Some((Outcome::Crashed, crashed)));
        for index in [0, 2, 3] {
            assert_eq!(ended[index].as_ref().map(|(outcome, _)| *outcome), Some(Outcome::Error));
        }
    }

    #[test]
    fn a_cancelled_row_is_not_recorded() {
        fn given_up(_: &Scenario, _: &Arc<RobotModel>, _: &CancelToken) -> Result<(PlannedJob, Certificate), Failure> {
            Err(Failure::Prove(platewash_certificate::ProveError::Cancelled(Cancelled)))
        }
        let text = "format = \"platewash-study/1\"\nname = \"p\"\nscenario = \"kitchen\"\n";
        let study = Arc::new(Study::parse(text, "p.toml", Path::new("")).unwrap());
        let maker = RowMaker {
            judge: given_up,
            ..RowMaker::new(study)
        };
        assert_eq!(maker.row(0, &CancelToken::new()).unwrap(), None);
    }
}
