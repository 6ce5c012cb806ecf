//! The paper's program, measured again.

use crate::value::to_record;
use crate::work::patiently;
use crate::{argument, errors};
use platewash::paper::reproduce::{ReproduceSettings, reproduce as measure};
use pyo3::prelude::*;

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
    let count = |name, given: Option<&Bound<'py, PyAny>>, usual: usize, most: usize| {
        given.map_or(Ok(usual), |given| argument::count(name, given, [1, most as u64]))
    };
    let usual = ReproduceSettings::default();
    let settings = ReproduceSettings {
        layouts: count("layouts", layouts, usual.layouts, ReproduceSettings::MOST_LAYOUTS)?,
        draws: count("draws", draws, usual.draws, ReproduceSettings::MOST_DRAWS)?,
        seed: seed.map_or(Ok(usual.seed), |given| argument::seed("seed", given))?,
    };
    let measured = patiently(py, move |cancel| measure(&settings, cancel, &|_, _| ()))?;
    let measured = measured.map_err(|e| errors::failure(py, &e.into()))?;
    to_record(py, &measured, Some(measured.to_string()))
}
