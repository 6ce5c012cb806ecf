//! A plan under a control law: settings, execution, report; `tune` tries many frequencies and dampings.

mod execution;
mod question;
mod settings;

pub use crate::simulation::execution::{ExecutionObject, FinishedSimulation, simulate};
pub use crate::simulation::question::Question;
pub use crate::simulation::settings::SettingsObject;

use crate::arrays::{Count, ExpectedShape, Numbers};
use crate::errors;
use crate::exception;
use crate::plan::PlanObject;
use crate::value::records;
use crate::work::patiently;
use platewash::Failure;
use platewash::simulator::simulate::{TuneOutcome, TuneRow};
use pyo3::prelude::*;
use pyo3::types::PyList;
use serde::Serialize;

/// Largest number of settings of one call.
const MOST_SETTINGS: usize = 10_000;

const NUMBERS: ExpectedShape = ExpectedShape {
    item: &[],
    count: Count::Stack,
};

/// Outcome of one setting: a frequency and a damping ratio.
#[derive(Debug, Serialize)]
struct Row {
    frequency_rad_s: f64,
    damping_ratio: f64,
    #[serde(flatten)]
    outcome: Outcome,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Outcome {
    Simulated(TuneOutcome),
    Refused { verdict: &'static str, reason: String },
}

impl From<TuneRow> for Row {
    fn from(row: TuneRow) -> Self {
        Self {
            frequency_rad_s: row.frequency_rad_s,
            damping_ratio: row.damping_ratio,
            outcome: match row.outcome {
                Ok(outcome) => Outcome::Simulated(outcome),
                Err(error) => Outcome::Refused {
                    verdict: "refused",
                    reason: Failure::from(error).to_string(),
                },
            },
        }
    }
}

/// Simulates a plan, or the plan file of that path, with every pair of a frequency, shape (F,) [rad/s], and a damping ratio, shape (D,), gains given outright
/// being left out. One record a pair, in the order of the frequencies, then of the dampings: `frequency_rad_s`,
/// `damping_ratio`, `verdict` (`"washed"`, `"swept"`, `"not_washed"`, `"not_swept"`, `"dry_run"`, `"refused"`), `tip_rms_m`, `tip_max_m`, `torque_max_n_m`, `work_j` and
/// `least_swept`, or `reason` for what is refused. Works on all processors.
///
/// Raises InputError for a law without a plant, and what `simulate` raises for a plan whose arm must be given.
#[pyfunction]
#[pyo3(signature = (plan, frequencies_rad_s, damping_ratios=None, robot=None, settings=None))]
pub fn tune<'py>(
    py: Python<'py>,
    plan: &Bound<'py, PyAny>,
    frequencies_rad_s: &Bound<'py, PyAny>,
    damping_ratios: Option<&Bound<'py, PyAny>>,
    robot: Option<&Bound<'py, PyAny>>,
    settings: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyList>> {
    let plan = PlanObject::given("plan", plan)?;
    let frequencies = numbers("frequencies_rad_s", frequencies_rad_s)?;
    let dampings = damping_ratios.map_or_else(|| Ok(vec![1.0]), |given| numbers("damping_ratios", given))?;
    let question = Question::new(&plan, robot, settings)?;
    if question.settings.law.is_kinematic() {
        let law = question.settings.law.name();
        let problem =
            format!("law \"{law}\" has no frequency to tune: use \"pd\", \"pd_gravity\" or \"computed_torque\"");
        return Err(exception::input(py, "settings", &problem));
    }
    let rows = frequencies.len().saturating_mul(dampings.len());
    if rows > MOST_SETTINGS {
        let problem = format!("{rows} settings; at most {MOST_SETTINGS} at a time");
        return Err(exception::input(py, "frequencies_rad_s", &problem));
    }
    let rows = patiently(py, move |cancel| {
        let Question { plan, arm, settings } = &question;
        platewash::tune(plan, arm, settings, &frequencies, &dampings, cancel)
    })?;
    let rows = rows.map_err(|e| errors::failure(py, &e.into()))?;
    records(py, &rows.into_iter().map(Row::from).collect::<Vec<_>>())
}

fn numbers(name: &'static str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    Ok(Numbers::read(name, value, NUMBERS)?.values()?.to_vec())
}
