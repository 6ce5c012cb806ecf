//! What a folder keeps, read: its manifest, its rows in the order in which they were done or in that of their indices.

use crate::error::StudyError;
use crate::lines;
use crate::manifest::{FORMAT, Manifest};
use crate::row::Row;
use platewash_kinematics::fingerprint::Sha256;
use std::fs::{self, File};
use std::io::{BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The manifest's name.
pub(crate) const MANIFEST: &str = "manifest.json";
/// The name of the file of all that the study names.
pub(crate) const PARTS: &str = "study.json";
/// The name of the file of rows.
pub(crate) const ROWS: &str = "rows.jsonl";

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
/// [`StudyError`]: no study; rows that were changed since it was finished, of which nothing is written; or a disk that fails: `to` is
/// called `name` then.
pub fn export(folder: &Path, to: &mut dyn Write, name: &Path) -> Result<u64, StudyError> {
    check(folder)?;
    in_order(folder, to, name)
}

fn in_order(folder: &Path, to: &mut dyn Write, name: &Path) -> Result<u64, StudyError> {
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

/// SHA-256 of the rows of a folder as [`export`] writes them.
pub(crate) fn rows_sha256(folder: &Path) -> Result<String, StudyError> {
    let mut hash = Hash::default();
    in_order(folder, &mut hash, folder)?;
    Ok(hash.0.hex())
}

/// Refuses the folder of a finished study whose rows are not those that it was finished with.
///
/// # Errors
/// [`StudyError`]: these rows; no study; or a file that cannot be read.
pub fn check(folder: &Path) -> Result<(), StudyError> {
    check_unchanged(folder, &read_manifest(folder)?)
}

/// [`check`], for a manifest that was read.
pub(crate) fn check_unchanged(folder: &Path, manifest: &Manifest) -> Result<(), StudyError> {
    let Some(stated) = &manifest.rows_sha256 else {
        return Ok(());
    };
    let found = rows_sha256(folder)?;
    if found == *stated {
        return Ok(());
    }
    Err(StudyError::Kept {
        file: folder.join(ROWS),
        problem: format!(
            "the rows were changed since the study was finished: their SHA-256 is {found}, {MANIFEST} states {stated}"
        ),
    })
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
    let file = File::open(&path).map_err(StudyError::disk(&path, "cannot be opened"))?;
    Ok((path, file))
}

/// Tells each row with its place in the file and its line, from 1; the length of all whole lines.
pub(crate) fn each_row(
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
