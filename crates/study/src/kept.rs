//! What a folder keeps, read: its manifest, its rows in the order in which they were done or in that of their indices.

use crate::done::Done;
use crate::error::StudyError;
use crate::lines;
use crate::manifest::{FORMAT, Manifest};
use crate::row::{ROW_SCHEMA, Row};
use crate::study::MOST_ROWS;
use platewash_kinematics::fingerprint::Sha256;
use platewash_workcell::json;
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
    let text = fs::read_to_string(&file).map_err(StudyError::disk(
        &file,
        "cannot be read, so that this is no study's folder",
    ))?;
    let wrong = |problem: String| StudyError::Kept {
        file: file.clone(),
        problem,
    };
    let manifest: Manifest = json::read(&text).map_err(|error| wrong(format!("is no manifest: {error}")))?;
    if manifest.format != FORMAT {
        return Err(wrong(format!("format must be {FORMAT}; found {:?}", manifest.format)));
    }
    if !(1..=MOST_ROWS).contains(&manifest.rows) {
        return Err(wrong(format!(
            "rows must be from 1 to {MOST_ROWS}; found {}",
            manifest.rows
        )));
    }
    Ok(manifest)
}

/// Tells the rows of a folder, in the order in which they were done.
pub(crate) fn rows(folder: &Path, manifest: &Manifest, mut each: impl FnMut(&Row)) -> Result<(), StudyError> {
    let (path, file) = opened(folder)?;
    each_row((&path, &file), manifest, |_, row, _| {
        each(&row);
        Ok(())
    })?;
    Ok(())
}

/// How many rows a folder has, and how many its study has; of one that is finished they are not looked at.
///
/// # Errors
/// [`StudyError`]: no study, or rows that are none.
pub fn counted(folder: &Path) -> Result<(u64, u64), StudyError> {
    let (manifest, mut done) = (read_manifest(folder)?, 0);
    if manifest.rows_sha256.is_some() {
        return Ok((manifest.rows, manifest.rows));
    }
    rows(folder, &manifest, |_| done += 1)?;
    Ok((done, manifest.rows))
}

/// Writes the rows of a folder as JSON Lines in the order of their indices: the same bytes, however they came to be. How many there are.
///
/// # Errors
/// [`StudyError`]: no study; rows that were changed since it was finished, of which nothing is written; or a disk that fails: `to` is
/// called `name` then.
pub fn export(folder: &Path, to: &mut dyn Write, name: &Path) -> Result<u64, StudyError> {
    let manifest = read_manifest(folder)?;
    check_unchanged(folder, &manifest)?;
    in_order(folder, &manifest, to, name)
}

fn in_order(folder: &Path, manifest: &Manifest, to: &mut dyn Write, name: &Path) -> Result<u64, StudyError> {
    let (path, file) = opened(folder)?;
    let mut places = Vec::new();
    each_row((&path, &file), manifest, |at, row, _| {
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

/// How many rows a folder has, and the SHA-256 of them as [`export`] writes them.
pub(crate) fn rows_sha256(folder: &Path, manifest: &Manifest) -> Result<(u64, String), StudyError> {
    let mut hash = Hash::default();
    let count = in_order(folder, manifest, &mut hash, folder)?;
    Ok((count, hash.0.hex()))
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
    let (_, found) = rows_sha256(folder, manifest)?;
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

/// Tells each row of a study with its place in the file and its line, from 1; the length of all whole lines. Each of them is there
/// once at most, as this program writes it.
pub(crate) fn each_row(
    (path, file): (&Path, &File),
    manifest: &Manifest,
    mut each: impl FnMut(u64, Row, usize) -> Result<(), StudyError>,
) -> Result<u64, StudyError> {
    let rows = manifest.rows;
    let (mut number, mut seen) = (0, Done::none_of(rows));
    let mut axes: Vec<_> = manifest.axes.iter().map(|axis| &axis.key).collect();
    axes.sort_unstable();
    lines::read(file, StudyError::disk(path, "cannot be read"), |at, line| {
        number += 1;
        let wrong = |problem: String| StudyError::Kept {
            file: path.to_owned(),
            problem: format!("line {number}: {problem}"),
        };
        let row: Row = serde_json::from_slice(line).map_err(|error| wrong(format!("is no row: {error}")))?;
        if row.schema != ROW_SCHEMA {
            return Err(wrong(format!(
                "is a row of schema {}; this program reads schema {ROW_SCHEMA}",
                row.schema
            )));
        }
        if row.index >= rows {
            return Err(wrong(format!("row {} is none of {rows}, counted from 0", row.index)));
        }
        if !row.axes.keys().eq(axes.iter().copied()) {
            return Err(wrong(format!(
                "row {} has other axes than {MANIFEST} states",
                row.index
            )));
        }
        if row.line().as_bytes() != line {
            return Err(wrong(format!("row {} is not as it was written", row.index)));
        }
        if !seen.add(row.index) {
            return Err(wrong(format!("row {} is there before", row.index)));
        }
        each(at, row, number)
    })
}
