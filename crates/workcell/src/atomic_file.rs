//! Files that appear whole or not at all, whatever ends the program.
//!
//! A file is written under a temporary name in its folder, flushed to the disk, and renamed. A program that is killed in between leaves its
//! temporary file; whoever writes into the folder next removes it. A temporary file is locked while somebody writes it, so that nobody else's
//! is removed. Files of one folder change under a lock of the folder, which the system releases when its holder ends.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// How the name of a temporary file begins.
pub const PREFIX: &str = ".platewash-";

/// A lock of a folder, held until it is dropped: nobody else of this module changes its files.
#[derive(Debug)]
pub struct FolderLock {
    folder: PathBuf,
    /// `None` on systems that lock no folder.
    _held: Option<File>,
}

impl FolderLock {
    /// Waits for the lock of a folder, which is made where it is missing.
    ///
    /// # Errors
    /// The folder cannot be made.
    pub fn new(folder: &Path) -> io::Result<Self> {
        std::fs::create_dir_all(folder)?;
        let held = File::open(folder).ok().filter(|folder| folder.lock().is_ok());
        Ok(Self {
            folder: folder.to_owned(),
            _held: held,
        })
    }

    /// Removes the temporary files that programs left in the folder when they were killed. What cannot be removed stays.
    pub fn remove_leftovers(&self) {
        let files = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let left = files.filter(|file| file.file_name().to_string_lossy().starts_with(PREFIX));
        for path in left.map(|file| file.path()).filter(|path| path.is_file()) {
            let is_left = File::open(&path).is_ok_and(|file| file.try_lock().is_ok());
            if is_left {
                let _ = std::fs::remove_file(path);
            }
        }
    }

    /// Flushes the names in the folder to the disk, where the system can.
    pub fn sync(&self) {
        let _ = File::open(&self.folder).and_then(|folder| folder.sync_all());
    }
}

/// A file under a temporary name, which goes when this is dropped.
#[derive(Debug)]
pub struct StagedFile {
    file: NamedTempFile,
}

impl StagedFile {
    /// A file in a folder. For holders of its lock, or of a folder without leftovers.
    ///
    /// # Errors
    /// No file can be made there.
    pub fn in_folder(folder: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX);
        // Temporary files are private; results are for whom the system's mask allows.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder)?;
        // Where files cannot be locked, leftovers stay.
        let _ = file.as_file().try_lock();
        Ok(Self { file })
    }

    /// A file beside a place, whose folder is made where it is missing. Leftovers in the folder are removed.
    ///
    /// # Errors
    /// No file can be made there.
    pub fn beside(place: &Path) -> io::Result<Self> {
        let lock = FolderLock::new(folder_of(place))?;
        lock.remove_leftovers();
        Self::in_folder(folder_of(place))
    }

    /// Flushes the file to the disk.
    ///
    /// # Errors
    /// The disk is full, or fails.
    pub fn sync(&self) -> io::Result<()> {
        self.file.as_file().sync_all()
    }

    /// Gives the file its name, in place of the file that has it.
    ///
    /// # Errors
    /// The name cannot be taken.
    pub fn persist(self, place: &Path) -> io::Result<()> {
        self.file.persist(place).map(drop).map_err(|error| error.error)
    }
}

impl Write for StagedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a file. Leftovers in its folder stay: there may be many files to look through.
///
/// # Errors
/// It cannot be written; what was there is there still.
pub fn write(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let lock = FolderLock::new(folder_of(place))?;
    let mut file = StagedFile::in_folder(folder_of(place))?;
    file.write_all(bytes)?;
    file.sync()?;
    file.persist(place)?;
    lock.sync();
    Ok(())
}

/// The folder of a file; the working folder where the path is a name alone.
#[must_use]
pub fn folder_of(place: &Path) -> &Path {
    match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let files = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = files
            .map(|file| file.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn leftovers_go_and_files_that_are_being_written_stay() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("a.txt");
        std::fs::write(folder.path().join(".platewash-left"), "x").unwrap();
        std::fs::write(folder.path().join("mine"), "x").unwrap();
        let mut writing = StagedFile::beside(&place).unwrap();
        writing.write_all(b"first").unwrap();
        write(&place, b"second").unwrap();
        FolderLock::new(folder.path()).unwrap().remove_leftovers();
        assert_eq!(names(folder.path()).len(), 3, "{:?}", names(folder.path()));
        writing.persist(&place).unwrap();
        assert_eq!(names(folder.path()), ["a.txt", "mine"]);
        assert_eq!(std::fs::read(&place).unwrap(), b"first");
    }

    #[test]
    fn a_folder_is_changed_by_one_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let held = FolderLock::new(folder.path()).unwrap();
        let place = folder.path().join("a.txt");
        std::thread::scope(|scope| {
            let other = scope.spawn(|| write(&place, b"x"));
            std::thread::sleep(std::time::Duration::from_millis(50));
            assert!(!place.exists());
            drop(held);
            other.join().unwrap().unwrap();
        });
        assert!(place.exists());
    }
}
