//! The folder of a study while somebody works on it.

use crate::study::StudyObject;
use crate::work::patiently_by;
use crate::{argument, errors, exception};
use platewash::CancelToken;
use platewash::study::{self, Journal, Outcome, RowMaker, RowWithPlan, Study, StudyError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Least time between two calls of the progress callback.
const TOLD_EVERY: Duration = Duration::from_millis(100);
/// Longest wait for interrupted rows; they give up within milliseconds.
const LONGEST: Duration = Duration::from_secs(10);
/// Reason recorded for a row that killed its workers.
const KILLED: &str = "its worker process died twice while it worked on this row alone; it is not tried again";

/// The rows of a study in a folder. Nobody else appends to it until it is closed.
#[pyclass(frozen, module = "pyplatewash._core", name = "StudyJournal")]
pub struct StudyJournalObject {
    study: Arc<Study>,
    held: Mutex<Option<OpenJournal>>,
}

struct OpenJournal {
    journal: Journal,
    /// Rows that were missing when the folder was opened, and have not been handed out.
    missing: Box<dyn Iterator<Item = u64> + Send>,
}

impl StudyJournalObject {
    fn locked(&self) -> MutexGuard<'_, Option<OpenJournal>> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn with<T>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&mut OpenJournal, &Study) -> Result<T, StudyError>,
    ) -> PyResult<T> {
        let mut held = self.locked();
        match held.as_mut() {
            Some(held) => ask(held, &self.study).map_err(|error| errors::study(py, error)),
            None => Err(exception::named(py, "StudyError", "the study's folder is closed")),
        }
    }
}

#[pymethods]
impl StudyJournalObject {
    /// Opens the folder, made where there is none.
    #[new]
    fn new(py: Python<'_>, folder: &Bound<'_, PyAny>, study: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (folder, study) = (argument::path("out", folder)?, StudyObject::given(study)?);
        let journal = Journal::open(&folder, &study).map_err(|error| errors::study(py, error))?;
        let missing = Box::new(journal.missing());
        let held = Mutex::new(Some(OpenJournal { journal, missing }));
        Ok(Self { study, held })
    }

    /// Number of rows that are done.
    #[getter]
    fn done(&self, py: Python<'_>) -> PyResult<u64> {
        self.with(py, |held, _| Ok(held.journal.done()))
    }

    /// The next of the missing rows, up to the given number; each is handed out once.
    fn missing(&self, py: Python<'_>, most: usize) -> PyResult<Vec<u64>> {
        self.with(py, |held, _| Ok(held.missing.by_ref().take(most).collect()))
    }

    /// Keeps a row of another process, by its line.
    fn append(
        &self,
        py: Python<'_>,
        line: &Bound<'_, PyBytes>,
        wall_s: f64,
        plan: Option<&Bound<'_, PyBytes>>,
    ) -> PyResult<()> {
        let took = Duration::try_from_secs_f64(wall_s).unwrap_or_default();
        let plan = plan.map(|plan| plan.as_bytes().to_vec());
        self.with(py, |held, study| {
            let row = study.parse_row(line.as_bytes())?;
            held.journal.append(&RowWithPlan { row, plan }, took)
        })
    }

    /// Keeps that a row killed its workers.
    fn killed(&self, py: Python<'_>, index: u64) -> PyResult<()> {
        self.with(py, |held, study| {
            let row = study.ended(index, Outcome::Crashed, KILLED)?;
            held.journal.append(&row.into(), None)
        })
    }

    /// Waits until the disk has all rows, and ends the study where they are all there. Whether they are.
    fn finish(&self, py: Python<'_>) -> PyResult<bool> {
        self.with(py, |held, _| held.journal.finish())
    }

    /// Works on all rows that are missing on so many threads; `told` is called with (done, rows) now and then.
    fn work(&self, py: Python<'_>, threads: usize, told: Py<PyAny>) -> PyResult<()> {
        let taken = self.locked().take();
        let Some(mut held) = taken else {
            return Err(exception::named(py, "StudyError", "the study's folder is closed"));
        };
        let study = self.study.clone();
        let (raised, heard) = (Arc::new(Mutex::new(None)), CancelToken::new());
        let (raises, gives_up) = (raised.clone(), heard.clone());
        let (back, returned) = channel();
        let worked = patiently_by(py, threads, &heard, move |cancel| {
            let maker = RowMaker::new(study);
            let mut last: Option<Instant> = None;
            let tell = |at: study::Progress| {
                if at.done < at.rows && last.is_some_and(|last| last.elapsed() < TOLD_EVERY) {
                    return;
                }
                last = Some(Instant::now());
                let answer = Python::attach(|py| told.call1(py, (at.done, at.rows)).map(drop));
                if let Err(error) = answer {
                    *raises.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                    gives_up.cancel();
                }
            };
            let make = |index: u64, cancel: &CancelToken| maker.row(index, cancel);
            let done = study::run(&mut held.journal, cancel, make, tell);
            // Who was interrupted still waits for the folder.
            let _ = back.send(held);
            done
        });
        let returned = Mutex::new(returned);
        let held = py.detach(|| {
            returned
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .recv_timeout(LONGEST)
        });
        *self.locked() = held.ok();
        let done = worked?;
        if let Some(error) = raised.lock().unwrap_or_else(PoisonError::into_inner).take() {
            return Err(error);
        }
        done.map_err(|error| errors::study(py, error))
    }

    /// Lets the folder go.
    fn close(&self) {
        drop(self.locked().take());
    }
}
