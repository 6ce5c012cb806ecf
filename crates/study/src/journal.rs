//! The folder of a study: its file, its manifest, its rows as they are done, and how long each took.

use crate::done::Done;
use crate::error::StudyError;
use crate::kept::{MANIFEST, PARTS, ROWS, check_unchanged, each_row, read_manifest, rows_sha256};
use crate::lines::{self, Lines};
use crate::made::Made;
use crate::manifest::Manifest;
use crate::row::Row;
use crate::study::Study;
use crate::whole::write_whole;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::Duration;

const STUDY: &str = "study.toml";
const TIMINGS: &str = "timings.jsonl";
/// The folder of the plans that a study keeps.
const PLANS: &str = "plans";

/// The rows of a study that are done, in its folder. Nobody else appends to it while this is there.
pub struct Journal {
    folder: PathBuf,
    manifest: Manifest,
    rows: Lines<File>,
    timings: Lines<File>,
    done: Done,
}

impl Journal {
    /// Opens the folder of a study, made where there is none. Rows that it has are done; a last one that is torn goes.
    ///
    /// # Errors
    /// [`StudyError`]: the folder keeps another study, or rows that are none of this one; another process works on it; the disk.
    pub fn open(folder: &Path, study: &Study) -> Result<Self, StudyError> {
        fs::create_dir_all(folder).map_err(StudyError::disk(folder, "cannot be made"))?;
        let given = Manifest::of(study);
        let [manifest, rows] = [MANIFEST, ROWS].map(|name| folder.join(name));
        let mut kept = given;
        if manifest.exists() {
            let given = std::mem::replace(&mut kept, read_manifest(folder)?);
            if let Some((what, kept, given)) = kept.difference(&given) {
                let folder = folder.to_owned();
                return Err(StudyError::Other {
                    folder,
                    what,
                    kept,
                    given,
                });
            }
            check_unchanged(folder, &kept)?;
        } else if rows.exists() && fs::metadata(&rows).is_ok_and(|found| found.len() > 0) {
            return Err(StudyError::Kept {
                file: rows,
                problem: format!("has rows, and no {MANIFEST} beside it says of which study; give another folder"),
            });
        }
        let opened = lines::open(&rows).map_err(StudyError::disk(&rows, "cannot be opened"))?;
        match opened.try_lock() {
            Ok(()) => {}
            Err(fs::TryLockError::WouldBlock) => {
                let folder = folder.to_owned();
                return Err(StudyError::Busy { folder });
            }
            Err(fs::TryLockError::Error(error)) => return Err(StudyError::disk(&rows, "cannot be locked")(error)),
        }
        if !manifest.exists() {
            write_whole(&folder.join(STUDY), study.text.as_bytes())?;
            write_whole(&folder.join(PARTS), study.parts().to_json().as_bytes())?;
            kept.write(&manifest)?;
        }
        let mut done = Done::none_of(study.rows());
        let whole = each_row(&rows, &opened, |_, row, line| {
            let is_of_study = study.row(row.index).is_ok_and(|address| address.key == row.key);
            if is_of_study && done.add(row.index) {
                return Ok(());
            }
            let problem = match is_of_study {
                true => format!("line {line}: row {} is there before", row.index),
                false => format!(
                    "line {line}: row {} with key {} is none of this study",
                    row.index, row.key
                ),
            };
            let file = rows.clone();
            Err(StudyError::Kept { file, problem })
        })?;
        let path = folder.join(TIMINGS);
        let cannot = || StudyError::disk(&path, "cannot be opened");
        let timings = lines::open(&path).map_err(cannot())?;
        let timed = lines::read(&timings, cannot(), |_, _| Ok(()))?;
        Ok(Self {
            folder: folder.to_owned(),
            manifest: kept,
            rows: Lines::after(opened, whole).map_err(StudyError::disk(&rows, "cannot be written"))?,
            timings: Lines::after(timings, timed).map_err(cannot())?,
            done,
        })
    }

    /// How many rows are done.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done.count()
    }

    /// The rows that are missing, in order; what is appended later stays among them.
    pub fn missing(&self, study: &Study) -> impl Iterator<Item = u64> + Send + use<> {
        let done = self.done.clone();
        (0..study.rows()).filter(move |index| !done.has(*index))
    }

    /// Appends a row, whole, and keeps its plan where there is one; a row that is there already is left out. How long it took goes to a
    /// file of its own.
    ///
    /// # Errors
    /// [`StudyError::Disk`]; the rows before stay whole.
    pub fn append(&mut self, made: &Made, took: Duration) -> Result<(), StudyError> {
        self.keep(made.row.index, &made.row.line(), made.plan.as_deref(), took)
    }

    /// Appends a row that another process made, by its [line](Row::line), as [`append`](Self::append) would.
    ///
    /// # Errors
    /// [`StudyError::Sent`]: it is no row of this study; [`StudyError::Disk`].
    pub fn append_line(
        &mut self,
        study: &Study,
        line: &[u8],
        plan: Option<&[u8]>,
        took: Duration,
    ) -> Result<(), StudyError> {
        let row: Row = serde_json::from_slice(line).map_err(|error| StudyError::Sent {
            problem: error.to_string(),
        })?;
        let (index, key) = (row.index, &row.key);
        if !study.row(index).is_ok_and(|address| address.key == *key) {
            return Err(StudyError::Sent {
                problem: format!("row {index} with key {key} is none of this study"),
            });
        }
        self.keep(index, &row.line(), plan, took)
    }

    fn keep(&mut self, index: u64, line: &str, plan: Option<&[u8]>, took: Duration) -> Result<(), StudyError> {
        if self.done.has(index) {
            return Ok(());
        }
        // Before its row: where that is, the plan is.
        if let Some(plan) = plan {
            let plans = self.folder.join(PLANS);
            fs::create_dir_all(&plans).map_err(StudyError::disk(&plans, "cannot be made"))?;
            write_whole(&plans.join(format!("{index}.json")), plan)?;
        }
        let path = self.folder.join(ROWS);
        self.rows
            .append(line)
            .map_err(StudyError::disk(&path, "cannot be written"))?;
        self.done.add(index);
        let timing = format!("{{\"index\":{index},\"wall_s\":{:?}}}", took.as_secs_f64());
        let path = self.folder.join(TIMINGS);
        self.timings
            .append(&timing)
            .map_err(StudyError::disk(&path, "cannot be written"))
    }

    /// Waits until the disk has all rows, and ends the study where they are all there, which its manifest says from then on, with their
    /// hash. Whether they are.
    ///
    /// # Errors
    /// [`StudyError::Disk`].
    pub fn finish(&mut self) -> Result<bool, StudyError> {
        let path = self.folder.join(ROWS);
        self.rows.sync().map_err(StudyError::disk(&path, "cannot be written"))?;
        if self.done.count() < self.manifest.rows {
            return Ok(false);
        }
        if self.manifest.rows_sha256.is_none() {
            self.manifest.rows_sha256 = Some(rows_sha256(&self.folder)?);
            self.manifest.write(&self.folder.join(MANIFEST))?;
        }
        Ok(true)
    }
}
