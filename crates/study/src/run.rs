//! Many rows at once: rayon's threads make them, one thread of its own keeps them.

use crate::error::StudyError;
use crate::journal::Journal;
use crate::row::RowWithPlan;
use platewash_workcell::cancel::{CancelToken, Cancelled};
use rayon::prelude::*;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::{Duration, Instant};

/// Rows that may wait to be kept.
const WAITING: usize = 64;

/// Progress of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Rows that are kept, those of earlier calls among them.
    pub done: u64,
    /// All rows.
    pub rows: u64,
    /// Rows a second in this call.
    pub per_s: f64,
    /// Time left at this rate \[s\].
    pub left_s: f64,
}

/// Works on the rows that the journal does not have, on rayon's threads, keeps each as soon as it is done, and reports each to
/// `told`. `make` is [`RowMaker::row`](crate::RowMaker::row), or another function that makes a row: it returns `None` when it is
/// cancelled.
///
/// # Errors
/// [`StudyError`]: a row could not be made or kept, or the token cancelled. The rows that were kept by then stay.
pub fn run(
    journal: &mut Journal,
    cancel: &CancelToken,
    make: impl Fn(u64, &CancelToken) -> Result<Option<RowWithPlan>, StudyError> + Sync,
    told: impl FnMut(Progress) + Send,
) -> Result<(), StudyError> {
    let missing = journal.missing();
    let (sender, receiver) = sync_channel(WAITING);
    std::thread::scope(|scope| {
        let keeping = scope.spawn(move || keep(&receiver, journal, told));
        // A bridge hands the rows out one after the other, so that the first ones are done first.
        let made = missing.par_bridge().try_for_each_with(sender, |sender, index| {
            let began = Instant::now();
            cancel.check()?;
            let row = make(index, cancel)?.ok_or(Cancelled)?;
            // The receiver is gone once rows are no longer kept: the code below reports that.
            sender.send((row, began.elapsed())).map_err(|_| Cancelled.into())
        });
        match keeping.join() {
            Ok(kept) => kept.and(made),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Writes rows until all workers have ended.
fn keep(
    rows: &Receiver<(RowWithPlan, Duration)>,
    journal: &mut Journal,
    mut told: impl FnMut(Progress),
) -> Result<(), StudyError> {
    let (began, before, total) = (Instant::now(), journal.done(), journal.rows());
    for (made, took) in rows {
        journal.append(&made, took)?;
        let done = journal.done();
        let per_s = (done - before) as f64 / began.elapsed().as_secs_f64().max(1e-9);
        told(Progress {
            done,
            rows: total,
            per_s,
            left_s: (total - done) as f64 / per_s,
        });
    }
    journal.finish()?;
    Ok(())
}
