//! The folder of a study: its file, its manifest, its rows as they are done, and how long each took.

use crate::error::StudyError;
use crate::lines::{self, Lines};
use crate::manifest::{FORMAT, Manifest};
use crate::row::Row;
use crate::study::Study;
use std::fs::{self, File};
use std::io::{BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::Path;
use std::time::Duration;

const MANIFEST: &str = "manifest.json";
const STUDY: &str = "study.toml";
const ROWS: &str = "rows.jsonl";
const TIMINGS: &str = "timings.jsonl";

/// The rows of a study that are done, in its folder. Nobody else appends to it while this is there.
pub struct Journal {
    folder: std::path::PathBuf,
    rows: Lines<File>,
    timings: Lines<File>,
    done: Done,
}

/// Which rows are done: a bit each.
pub(crate) struct Done {
    bits: Vec<u64>,
    count: u64,
}

impl Done {
    fn none_of(rows: u64) -> Self {
        Self {
            bits: vec![0; rows.div_ceil(64) as usize],
            count: 0,
        }
    }

    fn has(&self, index: u64) -> bool {
        let word = self.bits.get((index / 64) as usize);
        word.is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    /// Whether it was not there before, and could be.
    fn add(&mut self, index: u64) -> bool {
        let is_new = !self.has(index);
        match self.bits.get_mut((index / 64) as usize) {
            Some(word) if is_new => {
                *word |= 1 << (index % 64);
                self.count += 1;
                true
            }
            _ => false,
        }
    }
}

impl Journal {
    /// Opens the folder of a study, made where there is none; `file` is the study file as it was given. Rows that it has are done; a
    /// last one that is torn goes.
    ///
    /// # Errors
    /// [`StudyError`]: the folder keeps another study, or rows that are none of this one; another process works on it; the disk.
    pub fn open(folder: &Path, study: &Study, file: &str) -> Result<Self, StudyError> {
        fs::create_dir_all(folder).map_err(StudyError::disk(folder, "cannot be made"))?;
        let given = Manifest::of(study, file);
        let [manifest, rows] = [MANIFEST, ROWS].map(|name| folder.join(name));
        if manifest.exists() {
            let kept = read_manifest(folder)?;
            if let Some((what, kept, given)) = kept.difference(&given) {
                let folder = folder.to_owned();
                return Err(StudyError::Other {
                    folder,
                    what,
                    kept,
                    given,
                });
            }
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
            let text = serde_json::to_string_pretty(&given).map_err(|error| StudyError::Kept {
                file: manifest.clone(),
                problem: error.to_string(),
            })?;
            write_whole(&manifest, format!("{text}\n").as_bytes())?;
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
            rows: Lines::after(opened, whole).map_err(StudyError::disk(&rows, "cannot be written"))?,
            timings: Lines::after(timings, timed).map_err(cannot())?,
            done,
        })
    }

    /// How many rows are done.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done.count
    }

    /// The rows that are missing, in order; what is appended later stays among them.
    pub fn missing(&self, study: &Study) -> impl Iterator<Item = u64> + Send + use<> {
        let done = Done {
            bits: self.done.bits.clone(),
            count: self.done.count,
        };
        (0..study.rows()).filter(move |index| !done.has(*index))
    }

    /// Appends a row, whole; one that is there already is left out. How long it took goes to a file of its own.
    ///
    /// # Errors
    /// [`StudyError::Disk`]; the rows before stay whole.
    pub fn append(&mut self, row: &Row, took: Duration) -> Result<(), StudyError> {
        if self.done.has(row.index) {
            return Ok(());
        }
        let path = self.folder.join(ROWS);
        let line = serde_json::to_string(row);
        let line = line.map_err(|error| StudyError::disk(&path, "cannot be written")(error.into()))?;
        self.rows
            .append(&line)
            .map_err(StudyError::disk(&path, "cannot be written"))?;
        self.done.add(row.index);
        let timing = format!("{{\"index\":{},\"wall_s\":{:?}}}", row.index, took.as_secs_f64());
        let path = self.folder.join(TIMINGS);
        self.timings
            .append(&timing)
            .map_err(StudyError::disk(&path, "cannot be written"))
    }

    /// Waits until the disk has all rows.
    ///
    /// # Errors
    /// [`StudyError::Disk`].
    pub fn sync(&mut self) -> Result<(), StudyError> {
        let path = self.folder.join(ROWS);
        self.rows.sync().map_err(StudyError::disk(&path, "cannot be written"))
    }
}

/// The manifest in a folder.
///
/// # Errors
/// [`StudyError`]: there is none, or one that this program does not know.
pub fn read_manifest(folder: &Path) -> Result<Manifest, StudyError> {
    let file = folder.join(MANIFEST);
    let text = fs::read_to_string(&file).map_err(StudyError::disk(&file, "cannot be read"))?;
    let wrong = |problem: String| StudyError::Kept {
        file: file.clone(),
        problem,
    };
    let manifest: Manifest = serde_json::from_str(&text).map_err(|error| wrong(format!("is no manifest: {error}")))?;
    if manifest.format != FORMAT {
        return Err(wrong(format!("format must be {FORMAT}; found {:?}", manifest.format)));
    }
    Ok(manifest)
}

/// Tells the rows of a folder, in the order in which they were done.
pub(crate) fn rows(folder: &Path, mut each: impl FnMut(&Row)) -> Result<(), StudyError> {
    let (path, file) = opened(folder)?;
    each_row(&path, &file, |_, row, _| {
        each(&row);
        Ok(())
    })?;
    Ok(())
}

/// Writes the rows of a folder as JSON Lines in the order of their indices: the same bytes, however they came to be. How many there are.
///
/// # Errors
/// [`StudyError`]: no study, or a disk that fails; `to` is called `name` then.
pub fn export(folder: &Path, to: &mut dyn Write, name: &Path) -> Result<u64, StudyError> {
    let (path, file) = opened(folder)?;
    let mut places = Vec::new();
    each_row(&path, &file, |at, row, _| {
        places.push((row.index, at));
        Ok(())
    })?;
    places.sort_unstable();
    let mut from = BufReader::new(&file);
    let cannot = || StudyError::disk(&path, "cannot be read");
    let (mut here, mut line) = (u64::MAX, Vec::new());
    for (_, at) in &places {
        if here != *at {
            from.seek(SeekFrom::Start(*at)).map_err(cannot())?;
        }
        line.clear();
        here = at + from.read_until(b'\n', &mut line).map_err(cannot())? as u64;
        to.write_all(&line)
            .map_err(StudyError::disk(name, "cannot be written"))?;
    }
    to.flush().map_err(StudyError::disk(name, "cannot be written"))?;
    Ok(places.len() as u64)
}

fn opened(folder: &Path) -> Result<(std::path::PathBuf, File), StudyError> {
    read_manifest(folder)?;
    let path = folder.join(ROWS);
    let file = File::open(&path).map_err(StudyError::disk(&path, "cannot be opened"))?;
    Ok((path, file))
}

/// Tells each row with its place in the file and its line, from 1; the length of all whole lines.
fn each_row(
    path: &Path,
    file: &File,
    mut each: impl FnMut(u64, Row, usize) -> Result<(), StudyError>,
) -> Result<u64, StudyError> {
    let mut number = 0;
    lines::read(file, StudyError::disk(path, "cannot be read"), |at, line| {
        number += 1;
        let row = serde_json::from_slice(line).map_err(|error| StudyError::Kept {
            file: path.to_owned(),
            problem: format!("line {number} is no row: {error}"),
        })?;
        each(at, row, number)
    })
}

/// Writes a file that is there whole or not at all.
fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    let staged = path.with_extension("new");
    let written = File::create(&staged).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written.map_err(StudyError::disk(&staged, "cannot be written"))?;
    fs::rename(&staged, path).map_err(StudyError::disk(path, "cannot be written"))
}
