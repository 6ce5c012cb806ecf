//! The paper's program re-measured.

use crate::value::to_record;
use crate::work::patiently;
use crate::{argument, errors};
use platewash::paper::reproduce::{ReproduceSettings, reproduce as measure};
use pyo3::prelude::*;
use std::ops::ControlFlow;

/// Most layouts a region, as of the command.
const MOST_LAYOUTS: u64 = 10_000;
/// Most layouts begun a dead-end rate, as of the command.
const MOST_DRAWS: u64 = 1_000_000;

/// Measures what the paper's program does, over `layouts` layouts in each of its two regions and `draws` layouts begun for
/// each dead-end rate. A record whose `rows` hold `key`, `group`, `quantity`, `unit`, `paper`, `measured` and
/// `half_width_95`; its text is the table. The answer does not depend on the number of threads.
#[pyfunction]
#[pyo3(
    signature = (layouts=None, draws=None, seed=None),
    text_signature = "(layouts=400, draws=20000, seed=1)"
)]
pub fn reproduce<'py>(
    py: Python<'py>,
    layouts: Option<&Bound<'py, PyAny>>,
    draws: Option<&Bound<'py, PyAny>>,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let layouts = layouts.map_or(Ok(400), |given| argument::count("layouts", given, [1, MOST_LAYOUTS]))?;
    let draws = draws.map_or(Ok(20_000), |given| argument::count("draws", given, [1, MOST_DRAWS]))?;
    let seed = seed.map_or(Ok(1), |given| argument::seed("seed", given))?;
    let settings = ReproduceSettings { layouts, draws, seed };
    let measured = patiently(py, move |cancel| {
        let go_on = |_, _| {
            if cancel.is_cancelled() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        measure(&settings, &go_on)
    })?;
    let measured = measured.map_err(|e| errors::failure(py, &e.into()))?;
    to_record(py, &measured, Some(measured.to_string()))
}
