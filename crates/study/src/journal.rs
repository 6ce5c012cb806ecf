//! The folder of a study: its file, its manifest, its rows as they are done, and how long each took.

use crate::error::StudyError;
use crate::folder_reader::{PARTS, ROWS, check_unchanged, each_row, hashed, read_manifest};
use crate::lines::{self, Lines};
use crate::manifest::MANIFEST;
use crate::manifest::Manifest;
use crate::row::RowWithPlan;
use crate::study::Study;
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
    /// Flag of each row: true for those that are done.
    has: Vec<bool>,
    done: u64,
    /// Files to which rows and timings are appended; `None` for a finished study, which is not touched.
    files: Option<[Lines<File>; 2]>,
}

impl Journal {
    /// Opens the folder of a study, and makes it where there is none. Its rows count as done; an incomplete last row is removed.
    /// A finished study is not touched.
    ///
    /// # Errors
    /// [`StudyError`]: the folder keeps another study, files of another origin, or rows that are none of this one; another process works on it;
    /// the disk.
    pub fn open(folder: &Path, study: &Study) -> Result<Self, StudyError> {
        fs::create_dir_all(folder).map_err(StudyError::disk(folder, "cannot be made"))?;
        if let Some(manifest) = kept_manifest(folder, study)?
            && manifest.rows_sha256.is_some()
        {
            check_unchanged(folder, &manifest)?;
            return Ok(Self {
                folder: folder.to_owned(),
                has: vec![true; manifest.rows as usize],
                done: manifest.rows,
                manifest,
                files: None,
            });
        }
        let [path, timed] = [ROWS, TIMINGS].map(|name| folder.join(name));
        let rows = lines::open(&path)?;
        rows.try_lock().map_err(|error| match error {
            fs::TryLockError::WouldBlock => StudyError::Busy {
                folder: folder.to_owned(),
            },
            fs::TryLockError::Error(error) => StudyError::disk(&path, "cannot be locked")(error),
        })?;
        for folder in [folder, &folder.join(PLANS)] {
            if folder.is_dir() {
                let lock = FolderLock::new(folder).map_err(StudyError::disk(folder, "cannot be opened"))?;
                lock.remove_leftovers();
            }
        }
        // Somebody else may have been here until now.
        let kept = kept_manifest(folder, study)?;
        if kept.as_ref().is_some_and(|manifest| manifest.rows_sha256.is_some()) {
            return Self::open(folder, study);
        }
        let manifest = state(folder, study, kept)?;
        let (has, whole) = each_row(&path, &rows, &manifest, |_, row, line| {
            let of_study = study.row(row.index)?;
            let scenario = &study.bases[of_study.base].name;
            if (&of_study.key, scenario, &of_study.axes) == (&row.key, &row.scenario, &row.axes) {
                return Ok(());
            }
            let problem = format!(
                "line {line}: row {} with key {} is none of this study",
                row.index, row.key
            );
            Err(StudyError::damaged_file(&path, Some(line), problem))
        })?;
        let timings = lines::open(&timed)?;
        let timings_whole = lines::read(&timed, &timings, |_, _| Ok(()))?;
        Ok(Self {
            folder: folder.to_owned(),
            manifest,
            done: has.iter().filter(|has| **has).count() as u64,
            has,
            files: Some([
                Lines::after(&path, rows, whole)?,
                Lines::after(&timed, timings, timings_whole)?,
            ]),
        })
    }

    /// Number of rows that are done.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done
    }

    /// Number of rows of the study.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.manifest.rows
    }

    /// Returns the rows that are missing, in order; rows that are appended later stay in the list.
    pub fn missing(&self) -> impl Iterator<Item = u64> + Send + use<> {
        let missing = (0..).zip(self.has.clone()).filter(|(_, has)| !has);
        missing.map(|(index, _)| index)
    }

    /// Appends a row, whole, and keeps its plan where there is one; a row that is there already is left out. Its duration, where
    /// known, goes to a file of its own.
    ///
    /// # Errors
    /// [`StudyError::Disk`]; the rows before stay whole.
    pub fn append(&mut self, row: &RowWithPlan, took: impl Into<Option<Duration>>) -> Result<(), StudyError> {
        let index = row.row.index;
        let Some(([rows, timings], has)) = self.files.as_mut().zip(self.has.get_mut(index as usize)) else {
            return Ok(());
        };
        if *has {
            return Ok(());
        }
        // Before its row: where that is, the plan is.
        if let Some(plan) = &row.plan {
            let plans = self.folder.join(PLANS);
            fs::create_dir_all(&plans).map_err(StudyError::disk(&plans, "cannot be made"))?;
            lines::write_whole(&plans.join(format!("{index}.json")), plan)?;
        }
        rows.append(&row.row.line())?;
        *has = true;
        self.done += 1;
        match took.into() {
            Some(took) => timings.append(&format!("{{\"index\":{index},\"wall_s\":{:?}}}", took.as_secs_f64())),
            None => Ok(()),
        }
    }

    /// Waits until the disk has all rows. If all rows of the study are there, it marks the study as finished in the manifest,
    /// with their hash. Returns true in that case.
    ///
    /// # Errors
    /// [`StudyError::Disk`].
    pub fn finish(&mut self) -> Result<bool, StudyError> {
        let Some([rows, _]) = &mut self.files else {
            return Ok(true);
        };
        rows.sync()?;
        if self.done < self.manifest.rows {
            return Ok(false);
        }
        // The rows on disk count, not those in memory.
        let (places, sha256) = hashed(&self.folder, &self.manifest)?;
        let (count, written) = (places.len() as u64, self.manifest.rows);
        if count < written {
            let problem = format!(
                "has {count} rows, though {written} were written: another program has changed it; run the same command again"
            );
            return Err(StudyError::damaged_file(&self.folder.join(ROWS), None, problem));
        }
        self.manifest.rows_sha256 = Some(sha256);
        self.manifest.write(&self.folder)?;
        self.files = None;
        Ok(true)
    }
}

/// Files of a study's folder that are written at the beginning, beside its manifest.
fn texts(study: &Study) -> [(&'static str, String); 2] {
    [(STUDY, study.text.clone()), (PARTS, study.parts().to_json())]
}

/// Writes the study's texts where the folder lacks them, and its manifest where there is none. Returns the manifest.
fn state(folder: &Path, study: &Study, kept: Option<Manifest>) -> Result<Manifest, StudyError> {
    for (name, text) in texts(study) {
        let file = folder.join(name);
        if !fs::read(&file).is_ok_and(|found| found == text.as_bytes()) {
            lines::write_whole(&file, text.as_bytes())?;
        }
    }
    if let Some(manifest) = kept {
        return Ok(manifest);
    }
    let manifest = Manifest::new(study);
    manifest.write(folder)?;
    Ok(manifest)
}

/// The manifest in a folder, where there is one.
///
/// # Errors
/// [`StudyError`]: it is of another study; without one, there are files of another origin by the names of a study's.
fn kept_manifest(folder: &Path, study: &Study) -> Result<Option<Manifest>, StudyError> {
    if folder.join(MANIFEST).exists() {
        let kept = read_manifest(folder)?;
        return match kept.difference(&Manifest::new(study)) {
            None => Ok(Some(kept)),
            Some((what, kept, given)) => Err(StudyError::Other {
                folder: folder.to_owned(),
                what,
                kept,
                given,
            }),
        };
    }
    // An earlier process may have ended before it wrote the manifest, and left these files.
    let own = texts(study)
        .into_iter()
        .chain([(ROWS, String::new()), (TIMINGS, String::new())]);
    for (name, own) in own {
        let file = folder.join(name);
        if fs::read(&file).is_ok_and(|found| found != own.as_bytes()) {
            let problem = format!("is there, and no {MANIFEST} beside it says of which study; give another folder");
            return Err(StudyError::damaged_file(&file, None, problem));
        }
    }
    Ok(None)
}
