//! Results: to standard output, and to files that appear whole or not at all.

use super::failure::Failure;
use super::text::{self, escaped};
use anyhow::Context;
use platewash::CancelToken;
use platewash::workcell::atomic_file::{FolderLock, StagedFile, folder_of};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{BufWriter, ErrorKind, IntoInnerError, Write};
use std::path::{Component, Path, PathBuf};

/// Whether anybody still reads standard output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reader {
    /// As far as is known.
    There,
    /// It has closed its end: whatever else is printed goes nowhere.
    Gone,
}

/// Prints to standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> Result<Reader, Failure> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Ok(()) => Ok(Reader::There),
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(Reader::Gone),
        Err(e) => Err(Failure::input(
            anyhow::Error::new(e).context("standard output cannot be written"),
        )),
    }
}

/// A value as indented JSON with a final newline. NaN and infinity become `null`; control characters are escaped, those too
/// that JSON itself allows.
pub fn json(value: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(Failure::internal)?;
    let mut text = escaped(&text, |c| format!("\\u{:04x}", u32::from(c)));
    text.push('\n');
    Ok(text)
}

/// Prints a value as JSON, or as text.
pub fn print_either(as_json: bool, value: &impl Serialize, text: impl FnOnce() -> String) -> Result<Reader, Failure> {
    if as_json {
        print(&json(value)?)
    } else {
        print(&text::text(&text()))
    }
}

/// A message on standard error.
pub fn message(quiet: bool, text: &str) {
    if !quiet {
        // Nothing is left to do when standard error is closed.
        let _ = writeln!(std::io::stderr(), "{}", text::text(&text));
    }
}

/// A file and the text that is to stand in it, which may be made while it is written.
pub type File<'a> = (PathBuf, Box<dyn Display + 'a>);

/// A text file for [`write_files`].
pub fn file<'a>(path: PathBuf, content: impl Display + 'a) -> File<'a> {
    (path, Box::new(content))
}

/// Writes all files or none: each goes to a temporary file beside its place, and they are renamed once all are complete. None where
/// `cancel` says so before that.
pub fn write_files(files: &[File<'_>], cancel: &CancelToken) -> Result<(), Failure> {
    replace(files, &[], cancel)
}

/// Writes all files or none in place of `stale` ones, which go just before.
pub fn replace(files: &[File<'_>], stale: &[PathBuf], cancel: &CancelToken) -> Result<(), Failure> {
    replace_if(files, stale, cancel, &|| true).map(|_| ())
}

/// As [`replace`], unless `still` says no once all files are complete: then none is written. Whether they were.
pub fn replace_if(
    files: &[File<'_>],
    stale: &[PathBuf],
    cancel: &CancelToken,
    still: &dyn Fn() -> bool,
) -> Result<bool, Failure> {
    refuse_one_place_for_two(files.iter().map(|(path, _)| path)).map_err(Failure::input)?;
    let locks = locks(files).map_err(Failure::input)?;
    let mut complete = Vec::new();
    for (path, content) in files {
        complete.push((stage(path, content).map_err(Failure::input)?, path));
        cancel.check()?;
    }
    if !still() {
        return Ok(false);
    }
    // Those of an earlier call go first, the last one first, so that at no moment files of two calls stand side by side. A folder of that name
    // is none of ours.
    let is_file = |path: &&PathBuf| std::fs::symlink_metadata(path).is_ok_and(|found| !found.is_dir());
    for path in stale.iter().rev().filter(is_file) {
        std::fs::remove_file(path)
            .with_context(|| format!("{}: is of an earlier call and cannot be removed", path.display()))
            .map_err(Failure::input)?;
    }
    for (staged, path) in complete {
        let renamed = staged.persist(path);
        renamed
            .with_context(|| format!("{}: cannot be written", path.display()))
            .map_err(Failure::input)?;
    }
    locks.iter().for_each(FolderLock::sync);
    Ok(true)
}

/// The locks of the folders of files, in one order for all callers, without leftovers in them.
fn locks(files: &[File<'_>]) -> anyhow::Result<Vec<FolderLock>> {
    let mut folders = BTreeMap::new();
    for (path, _) in files {
        let folder = folder_of(path);
        let place = place(folder).with_context(|| format!("{}: cannot be written", path.display()))?;
        folders.insert(place, folder);
    }
    let lock = |folder: &Path| {
        let lock = FolderLock::new(folder);
        let lock = lock.with_context(|| format!("{}: folder cannot be made", folder.display()))?;
        lock.remove_leftovers();
        Ok(lock)
    };
    folders.into_values().map(lock).collect()
}

/// Refuses, before any work, files that could not be written after it. Nothing is left behind.
pub fn check_places(files: &[PathBuf]) -> Result<(), Failure> {
    let check = || {
        refuse_one_place_for_two(files.iter())?;
        files.iter().try_for_each(|path| refuse_place(path))
    };
    check().map_err(Failure::input)
}

/// Refuses a file whose folder can neither be written nor made.
fn refuse_place(path: &Path) -> anyhow::Result<()> {
    refuse_taken(path)?;
    if let Err(error) = path.symlink_metadata()
        && error.kind() == ErrorKind::InvalidFilename
    {
        return Err(error).with_context(|| format!("{}: cannot be written", path.display()));
    }
    let folder = folder_of(path);
    let place = place(folder).with_context(|| format!("{}: cannot be written", path.display()))?;
    // A link that leads nowhere does not exist, but stands in the way.
    let stands = |place: &&Path| std::fs::symlink_metadata(place).is_ok();
    let Some(nearest) = place.ancestors().find(stands) else {
        return Ok(());
    };
    let cannot = || format!("{}: cannot be written", path.display());
    if !nearest.is_dir() {
        anyhow::bail!("{}: {} is no folder", cannot(), nearest.display());
    }
    // Rights are many things; a file that is made and goes again asks for all of them.
    let made = StagedFile::in_folder(nearest).map(drop);
    made.map_err(|error| {
        anyhow::anyhow!(
            "{}: no file can be made in {}: {}",
            cannot(),
            nearest.display(),
            error.kind()
        )
    })
}

/// Refuses a place where something stands that no file may take the place of.
fn refuse_taken(path: &Path) -> anyhow::Result<()> {
    let what = match path.metadata() {
        Ok(found) if found.is_dir() => "a folder",
        Ok(found) if !found.is_file() => "no regular file",
        _ => return Ok(()),
    };
    anyhow::bail!("{}: cannot be written: it is {what}", path.display());
}

/// Writes a file by what makes it piece by piece: whole or not at all.
pub fn write_to<T>(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<T, Failure>) -> Result<T, Failure> {
    let cannot = || format!("{}: cannot be written", path.display());
    refuse_taken(path).map_err(Failure::input)?;
    let staged = StagedFile::beside(path).with_context(cannot).map_err(Failure::input)?;
    let mut staged = BufWriter::new(staged);
    let written = write(&mut staged)?;
    let staged = staged.into_inner().map_err(IntoInnerError::into_error);
    let renamed = staged.and_then(|staged| staged.sync().and_then(|()| staged.persist(path)));
    renamed.with_context(cannot).map_err(Failure::input)?;
    Ok(written)
}

fn stage(path: &Path, content: &dyn Display) -> anyhow::Result<StagedFile> {
    let cannot = || format!("{}: cannot be written", path.display());
    refuse_taken(path)?;
    let staged = StagedFile::in_folder(folder_of(path)).with_context(cannot)?;
    let mut buffered = BufWriter::new(staged);
    write!(buffered, "{content}").with_context(cannot)?;
    let staged = buffered.into_inner().map_err(IntoInnerError::into_error);
    let synced = staged.and_then(|staged| staged.sync().map(|()| staged));
    synced.with_context(cannot)
}

/// No file may take the place of another one of the same run.
fn refuse_one_place_for_two<'a>(files: impl Iterator<Item = &'a PathBuf>) -> anyhow::Result<()> {
    let mut taken = BTreeMap::new();
    for path in files {
        let place = place(path).with_context(|| format!("{}: cannot be written", path.display()))?;
        if let Some(first) = taken.insert(place, path) {
            anyhow::bail!(
                "{}: is also where {} is written: give --csv or --out another place",
                path.display(),
                first.file_name().unwrap_or(first.as_os_str()).display()
            );
        }
    }
    Ok(())
}

/// Where a file will be, links followed but for its own name, whether its folders exist yet or not.
pub fn place(path: &Path) -> std::io::Result<PathBuf> {
    let absolute = std::path::absolute(path)?;
    let mut place = PathBuf::new();
    for part in absolute.components() {
        // What does not exist yet has no links to follow.
        place = place.canonicalize().unwrap_or(place);
        match part {
            Component::ParentDir => drop(place.pop()),
            part => place.push(part),
        }
    }
    Ok(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_control_character_but_a_new_line_leaves() {
        let name = "a\u{1b}[31m\u{7f}\u{9b}2J\t\r\n\u{e9}";
        assert_eq!(text::text(&name), "a\\u{1b}[31m\\u{7f}\\u{9b}2J\\t\\r\n\u{e9}");
        let written = json(&name).unwrap();
        assert!(!written.trim_end().contains(char::is_control), "{written:?}");
        assert_eq!(serde_json::from_str::<String>(&written).unwrap(), name);
    }
}
