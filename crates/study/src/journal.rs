//! The folder of a study: its file, its manifest, its rows as they are done, and how long each took.

use crate::done::Done;
use crate::error::StudyError;
use crate::kept::{MANIFEST, PARTS, ROWS, check_unchanged, each_row, read_manifest, rows_sha256};
use crate::lines::{self, Lines};
use crate::load::of_parts;
use crate::made::Made;
use crate::manifest::Manifest;
use crate::outcome::Outcome;
use crate::row::Row;
use crate::study::Study;
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_workcell::atomic_file::FolderLock;
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
    done: Done,
    /// Where rows are appended; nothing of a study that is finished is touched.
    files: Option<Appended>,
}

struct Appended {
    rows: Lines<File>,
    timings: Lines<File>,
}

impl Journal {
    /// Opens the folder of a study, made where there is none. Rows that it has are done; a last one that is torn goes. Of a study that is
    /// finished nothing is touched.
    ///
    /// # Errors
    /// [`StudyError`]: the folder keeps another study, files of another origin, or rows that are none of this one; another process works on it;
    /// the disk.
    pub fn open(folder: &Path, study: &Study) -> Result<Self, StudyError> {
        fs::create_dir_all(folder).map_err(StudyError::disk(folder, "cannot be made"))?;
        let kept = kept_manifest(folder, study)?;
        if let Some(manifest) = kept.filter(|manifest| manifest.rows_sha256.is_some()) {
            check_unchanged(folder, &manifest)?;
            return Ok(Self {
                folder: folder.to_owned(),
                done: Done::all_of(manifest.rows),
                manifest,
                files: None,
            });
        }
        let path = folder.join(ROWS);
        let rows = lines::open(&path).map_err(StudyError::disk(&path, "cannot be opened"))?;
        match rows.try_lock() {
            Ok(()) => {}
            Err(fs::TryLockError::WouldBlock) => {
                let folder = folder.to_owned();
                return Err(StudyError::Busy { folder });
            }
            Err(fs::TryLockError::Error(error)) => return Err(StudyError::disk(&path, "cannot be locked")(error)),
        }
        for folder in [folder, &folder.join(PLANS)]
            .into_iter()
            .filter(|folder| folder.is_dir())
        {
            let lock = FolderLock::new(folder).map_err(StudyError::disk(folder, "cannot be opened"))?;
            lock.remove_leftovers();
        }
        // Somebody else may have been here until now.
        let manifest = match kept_manifest(folder, study)? {
            Some(manifest) if manifest.rows_sha256.is_some() => return Self::open(folder, study),
            Some(manifest) => manifest,
            None => Manifest::of(study),
        };
        restate(folder, study, &manifest)?;
        let stated = folder.join(MANIFEST);
        if !stated.exists() {
            manifest.write(&stated)?;
        }
        let mut done = Done::none_of(study.rows());
        let whole = each_row((&path, &rows), &manifest, |_, row, line| {
            let of_study = study.row(row.index)?;
            let scenario = &study.bases[of_study.base].name;
            if (&of_study.key, scenario, &of_study.axes) != (&row.key, &row.scenario, &row.axes) {
                return Err(StudyError::Kept {
                    file: path.clone(),
                    problem: format!(
                        "line {line}: row {} with key {} is none of this study",
                        row.index, row.key
                    ),
                });
            }
            done.add(row.index);
            Ok(())
        })?;
        let timed = folder.join(TIMINGS);
        let cannot = || StudyError::disk(&timed, "cannot be opened");
        let timings = lines::open(&timed).map_err(cannot())?;
        let timings_whole = lines::read(&timings, cannot(), |_, _| Ok(()))?;
        Ok(Self {
            folder: folder.to_owned(),
            manifest,
            done,
            files: Some(Appended {
                rows: Lines::after(rows, whole).map_err(StudyError::disk(&path, "cannot be written"))?,
                timings: Lines::after(timings, timings_whole).map_err(cannot())?,
            }),
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
        self.keep(made.row.index, &made.row.line(), made.plan.as_deref(), Some(took))
    }

    /// Appends a row that is not worked on any more, with why. Nobody knows how long it took.
    ///
    /// # Errors
    /// [`StudyError::NoRow`]; [`StudyError::Disk`].
    pub fn append_ended(
        &mut self,
        study: &Study,
        index: u64,
        outcome: Outcome,
        reason: &str,
    ) -> Result<(), StudyError> {
        let row = study.ended(index, outcome, reason)?;
        self.keep(index, &row.line(), None, None)
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
        self.keep(index, &row.line(), plan, Some(took))
    }

    fn keep(&mut self, index: u64, line: &str, plan: Option<&[u8]>, took: Option<Duration>) -> Result<(), StudyError> {
        let Some(files) = self.files.as_mut().filter(|_| !self.done.has(index)) else {
            return Ok(());
        };
        // Before its row: where that is, the plan is.
        if let Some(plan) = plan {
            let plans = self.folder.join(PLANS);
            fs::create_dir_all(&plans).map_err(StudyError::disk(&plans, "cannot be made"))?;
            let file = plans.join(format!("{index}.json"));
            lines::write_whole(&file, plan)?;
        }
        let path = self.folder.join(ROWS);
        files
            .rows
            .append(line)
            .map_err(StudyError::disk(&path, "cannot be written"))?;
        self.done.add(index);
        let Some(took) = took else {
            return Ok(());
        };
        let timing = format!("{{\"index\":{index},\"wall_s\":{:?}}}", took.as_secs_f64());
        let path = self.folder.join(TIMINGS);
        files
            .timings
            .append(&timing)
            .map_err(StudyError::disk(&path, "cannot be written"))
    }

    /// Waits until the disk has all rows, and ends the study where they are all there, which its manifest says from then on, with their
    /// hash. Whether they are.
    ///
    /// # Errors
    /// [`StudyError::Disk`].
    pub fn finish(&mut self) -> Result<bool, StudyError> {
        let Some(files) = &mut self.files else {
            return Ok(true);
        };
        let path = self.folder.join(ROWS);
        files
            .rows
            .sync()
            .map_err(StudyError::disk(&path, "cannot be written"))?;
        if self.done.count() < self.manifest.rows {
            return Ok(false);
        }
        // What stands there is what counts.
        let (count, sha256) = rows_sha256(&self.folder, &self.manifest)?;
        if count < self.manifest.rows {
            return Err(StudyError::Kept {
                file: path,
                problem: format!(
                    "has {count} rows, though {} were written: somebody else has changed it; the same command makes those that are gone",
                    self.manifest.rows
                ),
            });
        }
        self.manifest.rows_sha256 = Some(sha256);
        self.manifest.write(&self.folder.join(MANIFEST))?;
        self.files = None;
        Ok(true)
    }
}

/// Writes the study anew where the folder does not have it whole any more. Paths may stand there by another name of the same file.
fn restate(folder: &Path, study: &Study, manifest: &Manifest) -> Result<(), StudyError> {
    let text_is_there = fs::read(folder.join(STUDY)).is_ok_and(|text| sha256_hex(&text) == manifest.study_sha256);
    if text_is_there && of_parts(&folder.join(PARTS), manifest).is_ok() {
        return Ok(());
    }
    for (name, text) in texts(study) {
        lines::write_whole(&folder.join(name), text.as_bytes())?;
    }
    Ok(())
}

/// What stands in a study's folder beside its manifest from the beginning.
fn texts(study: &Study) -> [(&'static str, String); 2] {
    [(STUDY, study.text.clone()), (PARTS, study.parts().to_json())]
}

/// The manifest in a folder, where there is one.
///
/// # Errors
/// [`StudyError`]: it is of another study; without one, there are files of another origin by the names of a study's.
fn kept_manifest(folder: &Path, study: &Study) -> Result<Option<Manifest>, StudyError> {
    if folder.join(MANIFEST).exists() {
        let kept = read_manifest(folder)?;
        return match kept.difference(&Manifest::of(study)) {
            None => Ok(Some(kept)),
            Some((what, kept, given)) => Err(StudyError::Other {
                folder: folder.to_owned(),
                what,
                kept,
                given,
            }),
        };
    }
    // Whoever was ended before the manifest was there has left these.
    let texts = texts(study);
    let own = texts.iter().map(|(name, text)| (*name, text.as_bytes()));
    let own = own.chain([(ROWS, &b""[..]), (TIMINGS, b"")]);
    let is_other = |(name, own): &(&str, &[u8])| {
        let file = folder.join(name);
        let length = fs::metadata(&file).map(|found| found.len());
        length.is_ok_and(|length| length != own.len() as u64 || fs::read(&file).is_ok_and(|found| found != *own))
    };
    match { own }.find(is_other) {
        None => Ok(None),
        Some((name, _)) => Err(StudyError::Kept {
            file: folder.join(name),
            problem: format!("is there, and no {MANIFEST} beside it says of which study; give another folder"),
        }),
    }
}
