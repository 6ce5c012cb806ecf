//! The worker that makes rows of a study, on a thread of its own and without any file of the study.

use crate::study::restored;
use crate::work::patiently_by;
use crate::{argument, errors};
use platewash::CancelToken;
use platewash::study::{Outcome, RowMaker, Study};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::Arc;
use std::time::Instant;

/// A row's line, the seconds that it took, and the bytes of its plan where the study keeps it.
type RowTuple<'py> = (Bound<'py, PyBytes>, f64, Option<Bound<'py, PyBytes>>);

/// Makes rows of a study, each on one thread of its own, whatever number of threads calls it.
#[pyclass(frozen, module = "pyplatewash._core", name = "StudyWorker")]
pub struct StudyWorkerObject {
    study: Arc<Study>,
    maker: Arc<RowMaker>,
    cancel: CancelToken,
}

#[pymethods]
impl StudyWorkerObject {
    /// Makes the worker of a study from the parts of the study.
    #[new]
    fn new(py: Python<'_>, parts: &Bound<'_, PyBytes>) -> PyResult<Self> {
        let study = restored(parts)
            .map(Arc::new)
            .map_err(|error| errors::study(py, error))?;
        Ok(Self {
            maker: Arc::new(RowMaker::new(study.clone())),
            study,
            cancel: CancelToken::new(),
        })
    }

    /// Makes a row; None where it was cancelled.
    fn make<'py>(&self, py: Python<'py>, index: &Bound<'_, PyAny>) -> PyResult<Option<RowTuple<'py>>> {
        let index = argument::count("index", index, argument::ANY_COUNT)? as u64;
        let maker = self.maker.clone();
        let began = Instant::now();
        let made = patiently_by(py, 1, &self.cancel, move |cancel| maker.row(index, cancel))?;
        let Some(made) = made.map_err(|error| errors::study(py, error))? else {
            return Ok(None);
        };
        let line = made.row.line();
        let plan = made.plan.map(|plan| PyBytes::new(py, &plan));
        Ok(Some((
            PyBytes::new(py, line.as_bytes()),
            began.elapsed().as_secs_f64(),
            plan,
        )))
    }

    /// A row of a planner that does nothing: what an engine costs by itself is measured with it.
    fn unplanned<'py>(&self, py: Python<'py>, index: &Bound<'_, PyAny>) -> PyResult<Option<RowTuple<'py>>> {
        let index = argument::count("index", index, argument::ANY_COUNT)? as u64;
        if self.cancel.is_cancelled() {
            return Ok(None);
        }
        let row = self.study.ended(index, Outcome::NotFound, "nothing was planned");
        let line = row.map_err(|error| errors::study(py, error))?.line();
        Ok(Some((PyBytes::new(py, line.as_bytes()), 0.0, None)))
    }

    /// Gives up what it works on, and all that comes.
    fn stop(&self) {
        self.cancel.cancel();
    }
}
