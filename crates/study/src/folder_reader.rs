//! Reader of a folder: its manifest, its rows in the order in which they were done or by index.

use crate::error::StudyError;
use crate::lines;
use crate::manifest::{FORMAT, MANIFEST, Manifest, ManifestAxis};
use crate::row::{ROW_SCHEMA, Row};
use crate::study::MOST_ROWS;
use platewash_kinematics::fingerprint::Sha256;
use platewash_workcell::json;
use std::fs::{self, File};
use std::io::{BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The name of the file of all that the study names.
pub(crate) const PARTS: &str = "study.json";
/// The name of the file of rows.
pub(crate) const ROWS: &str = "rows.jsonl";
/// The words of a file of rows that the disk does not give.
const UNREAD: &str = "cannot be read";

/// The manifest in a folder.
///
/// # Errors
/// [`StudyError`]: there is none, or one that this program does not know.
pub fn read_manifest(folder: &Path) -> Result<Manifest, StudyError> {
    let file = folder.join(MANIFEST);
    let text = fs::read_to_string(&file).map_err(StudyError::disk(
        &file,
        "cannot be read, so this is not the folder of a study",
    ))?;
    let wrong = |problem: String| Err(StudyError::damaged_file(&file, None, problem));
    let manifest: Manifest = match json::read(&text) {
        Ok(manifest) => manifest,
        Err(error) => return wrong(format!("is no manifest: {error}")),
    };
    if manifest.format != FORMAT {
        return wrong(format!("format must be {FORMAT}; found {:?}", manifest.format));
    }
    if !(1..=MOST_ROWS).contains(&manifest.rows) {
        return wrong(format!("rows must be from 1 to {MOST_ROWS}; found {}", manifest.rows));
    }
    Ok(manifest)
}

/// Index and place \[bytes\] of each row in the file of a folder's rows, in the order of the indices.
pub type Places = Vec<(u64, u64)>;

/// Tells the rows of a folder, in the order in which they were done.
pub(crate) fn rows(folder: &Path, manifest: &Manifest, mut each: impl FnMut(u64, Row)) -> Result<(), StudyError> {
    let (path, file) = opened(folder)?;
    each_row(&path, &file, manifest, |at, row, _| {
        each(at, row);
        Ok(())
    })?;
    Ok(())
}

/// Returns the number of rows in a folder, and the number of rows of its study; the rows of a finished study are not read.
///
/// # Errors
/// [`StudyError`]: no study, or rows that are none.
pub fn count_rows(folder: &Path) -> Result<(u64, u64), StudyError> {
    let (manifest, mut done) = (read_manifest(folder)?, 0);
    if manifest.rows_sha256.is_some() {
        return Ok((manifest.rows, manifest.rows));
    }
    rows(folder, &manifest, |_, _| done += 1)?;
    Ok((done, manifest.rows))
}

/// Writes the rows of a folder as JSON Lines in the order of their indices: the same bytes, for any order in which they were
/// done. Returns their number.
///
/// # Errors
/// As [`check`], and nothing is written then; or a disk that fails: `to` is called `name` then.
pub fn export(folder: &Path, to: &mut dyn Write, name: &Path) -> Result<u64, StudyError> {
    let places = check(folder)?;
    in_order(folder, &places, to, name)?;
    Ok(places.len() as u64)
}

fn in_order(folder: &Path, places: &Places, to: &mut dyn Write, name: &Path) -> Result<(), StudyError> {
    let (path, file) = opened(folder)?;
    let mut from = BufReader::new(&file);
    let (mut here, mut line) = (u64::MAX, Vec::new());
    for (_, at) in places {
        if here != *at {
            from.seek(SeekFrom::Start(*at))
                .map_err(StudyError::disk(&path, UNREAD))?;
        }
        line.clear();
        let length = from.read_until(b'\n', &mut line);
        here = at + length.map_err(StudyError::disk(&path, UNREAD))? as u64;
        to.write_all(&line)
            .map_err(StudyError::disk(name, "cannot be written"))?;
    }
    to.flush().map_err(StudyError::disk(name, "cannot be written"))
}

/// The rows of a folder, and the SHA-256 of them as [`export`] writes them.
pub(crate) fn hashed(folder: &Path, manifest: &Manifest) -> Result<(Places, String), StudyError> {
    let (places, mut hash) = (places(folder, manifest)?, Hash::default());
    in_order(folder, &places, &mut hash, folder)?;
    Ok((places, hash.0.hex()))
}

fn places(folder: &Path, manifest: &Manifest) -> Result<Places, StudyError> {
    let mut places = Places::new();
    rows(folder, manifest, |at, row| places.push((row.index, at)))?;
    places.sort_unstable();
    Ok(places)
}

/// Checks the rows of a folder, one by one. The rows of a finished study are refused if it was finished with others.
///
/// # Errors
/// [`StudyError`]: these rows, or one that is none; no study; or a file that cannot be read.
pub fn check(folder: &Path) -> Result<Places, StudyError> {
    check_unchanged(folder, &read_manifest(folder)?)
}

/// [`check`], for a manifest that was read.
pub(crate) fn check_unchanged(folder: &Path, manifest: &Manifest) -> Result<Places, StudyError> {
    let Some(stated) = &manifest.rows_sha256 else {
        return places(folder, manifest);
    };
    let (places, found) = hashed(folder, manifest)?;
    if found != *stated {
        let problem = format!(
            "the rows were changed since the study was finished: their SHA-256 is {found}, {MANIFEST} states {stated}"
        );
        return Err(StudyError::damaged_file(&folder.join(ROWS), None, problem));
    }
    Ok(places)
}

#[derive(Default)]
struct Hash(Sha256);

impl Write for Hash {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.add(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

fn opened(folder: &Path) -> Result<(PathBuf, File), StudyError> {
    let path = folder.join(ROWS);
    let file = File::open(&path).map_err(StudyError::disk(&path, UNREAD))?;
    Ok((path, file))
}

/// Tells each row of a study with its place in the file and its line, from 1; which rows are there, and the length of all whole lines.
/// Each of them is there once at most, as this program writes it.
pub(crate) fn each_row(
    path: &Path,
    file: &File,
    manifest: &Manifest,
    mut each: impl FnMut(u64, Row, usize) -> Result<(), StudyError>,
) -> Result<(Vec<bool>, u64), StudyError> {
    let rows = manifest.rows;
    let (mut number, mut seen) = (0, vec![false; rows as usize]);
    let whole = lines::read(path, file, |at, line| {
        number += 1;
        let wrong = |problem: String| Err(StudyError::damaged_file(path, Some(number), problem));
        let row: Row = match serde_json::from_slice(line) {
            Ok(row) => row,
            Err(error) => return wrong(format!("is no row: {error}")),
        };
        let index = row.index;
        if row.schema != ROW_SCHEMA {
            let schema = row.schema;
            return wrong(format!(
                "is a row of schema {schema}; this program reads schema {ROW_SCHEMA}"
            ));
        }
        let Some(seen) = seen.get_mut(index as usize) else {
            return wrong(format!("row {index} is none of {rows}, counted from 0"));
        };
        let mut axes = manifest.axes.iter();
        let is_stated = |axis: &ManifestAxis| row.axes.get(&axis.key).is_some_and(|value| axis.kind.fits(value));
        if row.axes.len() != manifest.axes.len() || !axes.all(is_stated) {
            return wrong(format!("row {index} has other axes than {MANIFEST} states"));
        }
        if row.line().as_bytes() != line {
            return wrong(format!("row {index} is not as it was written"));
        }
        if std::mem::replace(seen, true) {
            return wrong(format!("row {index} is there before"));
        }
        each(at, row, number)
    })?;
    Ok((seen, whole))
}
