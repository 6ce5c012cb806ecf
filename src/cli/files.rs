//! Files that appear whole or not at all, and what belongs to whom in the folders that they go to.

use super::options::Options;
use super::output::{Reader, full_report, json};
use anyhow::{Context, Result, bail};
use platewash::CancelToken;
use platewash::workcell::atomic_file::{FolderLock, folder_of, staged_in};
use rayon::prelude::*;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::fmt::Display;
use std::io::{self, BufWriter, ErrorKind, IntoInnerError, Write};
use std::path::{Component, Path, PathBuf};
use tempfile::NamedTempFile;

/// Names in the output folder that belong to `run`, the first six, and to `plan`, and those that `simulate` writes of a plan there: so
/// no proof of an earlier call stays beside a new result.
pub const RESULTS: [&str; 10] = [
    "plan.json",
    "executed.csv",
    "certificate.json",
    "report.json",
    "report.txt",
    "page.html",
    "trajectory.csv",
    "simulated.csv",
    "simulation.json",
    "simulation.txt",
];

/// Names that belong to a scenario that was saved, behind its own name, and, the first four, to a dry run in its folder.
pub const REPORTS: [&str; 5] = [
    "plan.json",
    "certificate.json",
    "report.json",
    "report.txt",
    "page.html",
];

/// Content of a file, formatted when it is written.
type Content<'a> = Box<dyn Display + Send + Sync + 'a>;

/// Files that are written to a folder, all or none, in place of all that belong to the verb there.
pub struct Files<'a> {
    /// Folder of the files; where it is `None`, nothing is written.
    folder: Option<PathBuf>,
    /// Prefix of every file name.
    prefix: OsString,
    /// Names that belong to the verb.
    owned: &'a [&'a str],
    files: Vec<(PathBuf, Content<'a>)>,
}

impl<'a> Files<'a> {
    /// An empty set of files; `owned` are the names that belong to the verb in the folder.
    pub fn new(folder: impl Into<Option<PathBuf>>, owned: &'a [&'a str]) -> Self {
        Self {
            folder: folder.into(),
            prefix: OsString::new(),
            owned,
            files: Vec::new(),
        }
    }

    /// The same set with a prefix before every name.
    pub fn with_prefix(self, prefix: OsString) -> Self {
        Self { prefix, ..self }
    }

    /// Path of the file with this name; `None` where nothing is written.
    fn place(&self, name: &str) -> Option<PathBuf> {
        let mut file = self.prefix.clone();
        file.push(name);
        Some(self.folder.as_ref()?.join(file))
    }

    /// Paths of the files with these names; empty where nothing is written.
    pub fn places(&self, names: &[&str]) -> Vec<PathBuf> {
        names.iter().filter_map(|name| self.place(name)).collect()
    }

    /// Refuses, before any work, places of the verb's own names that could not be written after it.
    pub fn check(&self) -> Result<()> {
        check_places(&self.places(self.owned))
    }

    /// Adds a file at a place of its own.
    pub fn add_at(&mut self, place: PathBuf, content: impl Display + Send + Sync + 'a) {
        self.files.push((place, Box::new(content)));
    }

    /// Adds a file.
    pub fn add(&mut self, name: &str, content: impl Display + Send + Sync + 'a) {
        if let Some(place) = self.place(name) {
            self.add_at(place, content);
        }
    }

    /// Adds a report as data and in words.
    pub fn add_report(&mut self, name: &str, report: &(impl Serialize + Display)) -> Result<()> {
        self.add(&format!("{name}.json"), json(report)?);
        self.add(&format!("{name}.txt"), full_report(report));
        Ok(())
    }

    /// The places of the files.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|(place, _)| place.as_path())
    }

    /// Number of files of an earlier call that are removed and not replaced.
    pub fn stale(&self) -> usize {
        let is_stale = |path: &&PathBuf| path.is_file() && self.paths().all(|written| written != path.as_path());
        self.places(self.owned).iter().filter(is_stale).count()
    }

    /// Writes the files, prints an answer and says what was written.
    pub fn answer(&self, options: &Options, answer: &impl Serialize, words: impl FnOnce() -> String) -> Result<Reader> {
        self.write(&options.cancel)?;
        let reader = options.print(answer, words)?;
        let names: Vec<_> = self.paths().map(|path| path.display().to_string()).collect();
        if !names.is_empty() {
            options.say(&format!("wrote {}", names.join(", ")));
        }
        Ok(reader)
    }

    /// Writes all files or none: each goes to a temporary file beside its place, and they are renamed once all are complete. No file is
    /// written where `cancel` is set before that.
    pub fn write(&self, cancel: &CancelToken) -> Result<()> {
        self.write_if(cancel, &|| true).map(|_| ())
    }

    /// Writes the files as [`Self::write`] does, unless `still` returns false once all are complete. Returns true where they were written.
    pub fn write_if(&self, cancel: &CancelToken, still: &dyn Fn() -> bool) -> Result<bool> {
        refuse_one_place_for_two(self.paths())?;
        let locks = self.locks()?;
        let complete = self.files.par_iter().map(|(path, content)| {
            cancel.check()?;
            let write = |out: &mut dyn Write| write!(out, "{content}").with_context(|| write_failure(path));
            stage(path, write).map(|staged| (staged, path))
        });
        // Of several failures that of the first file is told.
        let complete: Vec<Result<_>> = complete.collect();
        let complete: Vec<_> = complete.into_iter().collect::<Result<_>>()?;
        cancel.check()?;
        if !still() {
            return Ok(false);
        }
        // Those of an earlier call go first, the last one first, so that at no moment files of two calls stand side by side. A folder of that
        // name is none of ours.
        let is_file = |path: &&PathBuf| std::fs::symlink_metadata(path).is_ok_and(|found| !found.is_dir());
        for path in self.places(self.owned).iter().rev().filter(is_file) {
            std::fs::remove_file(path)
                .with_context(|| format!("{}: is of an earlier call and cannot be removed", path.display()))?;
        }
        for (staged, path) in complete {
            let placed = staged.persist(path).map_err(io::Error::from);
            placed.with_context(|| write_failure(path))?;
        }
        locks.iter().for_each(FolderLock::sync);
        Ok(true)
    }

    /// The locks of the folders of the files, in one order for all callers, without leftovers in them.
    fn locks(&self) -> Result<Vec<FolderLock>> {
        let mut folders = BTreeMap::new();
        for path in self.paths() {
            folders.insert(
                place(folder_of(path)).with_context(|| write_failure(path))?,
                folder_of(path),
            );
        }
        let lock = |folder: &Path| {
            let lock = FolderLock::new(folder);
            let lock = lock.with_context(|| format!("{}: folder cannot be made", folder.display()))?;
            lock.remove_leftovers();
            Ok(lock)
        };
        folders.into_values().map(lock).collect()
    }
}

/// Writes a file by what makes it piece by piece: whole or not at all.
pub fn write_to(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
    let lock = FolderLock::new(folder_of(path)).with_context(|| write_failure(path))?;
    lock.remove_leftovers();
    let placed = stage(path, write)?.persist(path).map_err(io::Error::from);
    placed.map(drop).with_context(|| write_failure(path))
}

/// A file that is complete, and not in its place yet.
fn stage(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<NamedTempFile> {
    refuse_taken(path)?;
    let staged = staged_in(folder_of(path)).with_context(|| write_failure(path))?;
    let mut buffered = BufWriter::with_capacity(1 << 16, staged);
    write(&mut buffered)?;
    let staged = buffered.into_inner().map_err(IntoInnerError::into_error);
    let synced = staged.and_then(|staged| staged.as_file().sync_all().map(|()| staged));
    synced.with_context(|| write_failure(path))
}

fn write_failure(path: &Path) -> String {
    format!("{}: cannot be written", path.display())
}

/// Refuses, before any work, files that could not be written after it. Nothing is left behind.
pub fn check_places(files: &[PathBuf]) -> Result<()> {
    refuse_one_place_for_two(files.iter().map(PathBuf::as_path))?;
    files.iter().try_for_each(|path| refuse_place(path))
}

/// Refuses a file whose folder can neither be written nor made.
fn refuse_place(path: &Path) -> Result<()> {
    refuse_taken(path)?;
    if let Err(error) = path.symlink_metadata()
        && error.kind() == ErrorKind::InvalidFilename
    {
        return Err(error).with_context(|| write_failure(path));
    }
    let place = place(folder_of(path)).with_context(|| write_failure(path))?;
    // A link that leads nowhere does not exist, but stands in the way.
    let stands = |place: &&Path| std::fs::symlink_metadata(place).is_ok();
    let Some(nearest) = place.ancestors().find(stands) else {
        return Ok(());
    };
    let (cannot, folder) = (write_failure(path), nearest.display());
    if !nearest.is_dir() {
        bail!("{cannot}: {folder} is not a folder");
    }
    // Rights are many things; a file that is made and goes again asks for all of them.
    match staged_in(nearest) {
        Ok(_) => Ok(()),
        Err(error) => bail!("{cannot}: no file can be made in {folder}: {}", error.kind()),
    }
}

/// Refuses a place where something stands that no file may take the place of.
fn refuse_taken(path: &Path) -> Result<()> {
    let what = match path.metadata() {
        Ok(found) if found.is_dir() => "a folder",
        Ok(found) if !found.is_file() => "no regular file",
        _ => return Ok(()),
    };
    bail!("{}: it is {what}", write_failure(path));
}

/// No file may take the place of another one of the same run.
fn refuse_one_place_for_two<'a>(files: impl Iterator<Item = &'a Path>) -> Result<()> {
    let mut taken = BTreeMap::new();
    for path in files {
        let place = place(path).with_context(|| write_failure(path))?;
        if let Some(first) = taken.insert(place, path) {
            bail!(
                "{}: is also where {} is written: give --csv or --out another place",
                path.display(),
                first.file_name().map_or("a file".into(), OsStr::to_string_lossy)
            );
        }
    }
    Ok(())
}

/// Absolute path of a file, with the links of its folders followed but not a link at its own name. The folders need not exist.
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
