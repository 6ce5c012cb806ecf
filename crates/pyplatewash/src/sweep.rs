//! Many layouts of one scenario, each planned and proved.

use crate::value::records;
use crate::work::patiently;
use crate::{argument, errors, scenario};
use platewash::Failure;
use platewash::scenario::Program;
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::ops::ControlFlow;

/// Plans and proves a scenario once a seed: one record a seed, with the fields of a study's rows: `axes` (`{"seed": n}`), `outcome`
/// (`"proved"`, `"not_proved"`, `"infeasible"`, `"not_found"`, `"error"`), `duration_s`, `swept`, `pressed`, `clearance_m`, `reason`
/// and so on. Works on all processors.
///
/// Raises InputError for a scenario of the paper's program; ScenarioError or PlanError for one that is wrong for every seed.
#[pyfunction]
pub fn sweep<'py>(
    py: Python<'py>,
    scenario: &Bound<'_, PyAny>,
    seeds: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyList>> {
    let scenario = scenario::given(scenario)?;
    scenario::of_program(py, &scenario, Program::Certified)?;
    let seeds = argument::each("seeds", seeds, "a list of seeds", argument::seed)?;
    let rows = patiently(py, move |cancel| {
        let rows = platewash::sweep(&scenario, seeds.into_iter(), cancel, &mut |_| ControlFlow::Continue(()))?;
        cancel.check()?;
        Ok::<_, Failure>(rows)
    })?;
    records(py, &rows.map_err(|e| errors::failure(py, &e))?)
}
