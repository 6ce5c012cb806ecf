//! The paper's program re-measured.

use crate::errors;
use crate::value::to_record;
use crate::work::patiently;
use platewash::planner::reproduce::ReproduceSettings;
use pyo3::prelude::*;
use std::ops::ControlFlow;

/// Most layouts a region, as of the command.
const MOST_LAYOUTS: usize = 10_000;
/// Most layouts begun a dead-end rate, as of the command.
const MOST_DRAWS: usize = 1_000_000;

/// Measures what the paper's program does, over `layouts` layouts in each of its two regions and `draws` layouts begun for
/// each dead-end rate. A record whose `rows` hold `key`, `group`, `quantity`, `unit`, `paper`, `measured` and
/// `half_width_95`; its text is the table. The answer does not depend on the number of threads.
#[pyfunction]
#[pyo3(signature = (layouts=400, draws=20_000, seed=1))]
pub fn reproduce(py: Python<'_>, layouts: usize, draws: usize, seed: u64) -> PyResult<Bound<'_, PyAny>> {
    for (name, value, most) in [("layouts", layouts, MOST_LAYOUTS), ("draws", draws, MOST_DRAWS)] {
        if !(1..=most).contains(&value) {
            return Err(errors::input(
                py,
                name,
                &format!("must be from 1 to {most}; found {value}"),
            ));
        }
    }
    let settings = ReproduceSettings { layouts, draws, seed };
    let measured = patiently(py, move |cancel| {
        let go_on = |_, _| {
            if cancel.is_asked() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        platewash::reproduce(&settings, &go_on)
    })?;
    let measured = measured.map_err(|e| errors::plan(py, &e))?;
    to_record(py, &measured, Some(measured.to_string()))
}
