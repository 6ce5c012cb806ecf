//! From a row's values to what came of them: planned and proved, by the row alone.

use crate::error::StudyError;
use crate::row::{Outcome, Row};
use crate::study::{RowAddress, Study, changed};
use platewash_certificate::prove_with;
use platewash_kinematics::RobotModel;
use platewash_planner::{Watch, plan_with};
use platewash_scenario::{Draft, Failure, Scenario};
use platewash_workcell::cancel::CancelToken;
use serde_json::Value;
use std::collections::{BTreeMap, HashMap};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// Most arms that are kept.
const MOST_ARMS: usize = 64;

/// The files of an arm: URDF, SRDF, folders of its meshes.
type ArmFiles = (Option<PathBuf>, Option<PathBuf>, Vec<PathBuf>);

/// Makes rows of a study. What many rows share is kept: arms, and the scenario of rows that differ in their seed alone.
pub struct Resolver<'a> {
    study: &'a Study,
    arms: Mutex<HashMap<ArmFiles, Arc<RobotModel>>>,
    last: Mutex<Option<Read>>,
}

/// A scenario with the values that it was made of, but for the seed.
type Read = ((usize, BTreeMap<String, Value>), Arc<Scenario>);

impl<'a> Resolver<'a> {
    /// Of a study; nothing is read yet.
    #[must_use]
    pub fn new(study: &'a Study) -> Self {
        Self {
            study,
            arms: Mutex::default(),
            last: Mutex::default(),
        }
    }

    /// What comes of a row: the same for every order and thread. A panic is an outcome of its own. `None` where the token cancels.
    ///
    /// # Errors
    /// [`StudyError::NoRow`].
    pub fn row(&self, index: u64, cancel: &CancelToken) -> Result<Option<Row>, StudyError> {
        let address = self.study.row(index)?;
        let name = self.study.bases[address.base].name.clone();
        let row = Row::new(index, address.key.clone(), name, address.axes.clone());
        let done = catch_unwind(AssertUnwindSafe(|| self.done(row.clone(), &address, cancel)));
        Ok(done.unwrap_or_else(|panic| Some(row.ended(Outcome::Crashed, words_of(&*panic)))))
    }

    fn done(&self, row: Row, address: &RowAddress, cancel: &CancelToken) -> Option<Row> {
        let scenario = match self.scenario(address) {
            Ok(scenario) => scenario,
            Err(problem) => return Some(row.ended(Outcome::Error, problem)),
        };
        let watch = Watch::silent(cancel);
        let planned = || -> Result<_, Failure> {
            let arm = self.arm(&scenario)?;
            let layout = scenario.place(&arm, &watch)?;
            let planned = plan_with(&scenario.job_on(&arm, &layout)?, &watch)?;
            let certificate = prove_with(&planned.plan, &arm, cancel)?;
            Ok((planned, certificate))
        };
        match planned() {
            Ok((planned, certificate)) => Some(row.planned(&planned, &certificate)),
            Err(error) if error.is_cancelled() => None,
            Err(error) => Some(row.failed(&error)),
        }
    }

    /// The row's scenario, which is parsed once for all seeds in turn.
    fn scenario(&self, address: &RowAddress) -> Result<Scenario, String> {
        let mut values = address.axes.clone();
        let seed = values.remove("seed").and_then(|seed| seed.as_u64());
        let what = (address.base, values);
        let kept = self.kept(&what);
        // Nothing is made while others wait: whoever comes at the same time makes it, too.
        let scenario = match kept {
            Some(scenario) => scenario,
            None => {
                let base = &self.study.bases[address.base];
                let text = changed(&base.text, &what.1)?;
                let draft = Draft::new(&text).and_then(|draft| draft.scenario(&base.name, base.folder.as_deref()));
                let scenario = Arc::new(draft.map_err(|error| error.to_string())?);
                *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some((what, scenario.clone()));
                scenario
            }
        };
        let mut scenario = Scenario::clone(&scenario);
        scenario.seed = seed.unwrap_or(scenario.seed);
        Ok(scenario)
    }

    /// The scenario of these values, where it was the last one that was read.
    fn kept(&self, what: &(usize, BTreeMap<String, Value>)) -> Option<Arc<Scenario>> {
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let (of, scenario) = last.as_ref()?;
        (of == what).then(|| scenario.clone())
    }

    fn arm(&self, scenario: &Scenario) -> Result<Arc<RobotModel>, Failure> {
        let robot = &scenario.robot;
        let files = (robot.urdf.clone(), robot.srdf.clone(), robot.package_path.clone());
        let locked = || self.arms.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(arm) = locked().get(&files) {
            return Ok(arm.clone());
        }
        let arm = scenario.arm()?;
        let mut arms = locked();
        if arms.len() >= MOST_ARMS {
            arms.clear();
        }
        Ok(arms.entry(files).or_insert(arm).clone())
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
