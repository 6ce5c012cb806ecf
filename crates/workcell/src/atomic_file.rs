//! Files that are written completely or not at all, even if the program is killed.
//!
//! A file is written under a temporary name in its folder, flushed to the disk, and renamed. A program that is killed in between leaves its
//! temporary file; the next program that writes into the folder removes it. A temporary file is locked while it is written, so that no
//! other program removes it. Files of one folder change under a lock of the folder, which the system releases when its holder ends.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Start of the name of a temporary file.
pub const PREFIX: &str = ".platewash-";

/// Lock of a folder, held until it is dropped. Nothing else in this module changes the folder's files meanwhile.
#[derive(Debug)]
pub struct FolderLock {
    folder: PathBuf,
    /// `None` on systems that lock no folder.
    _held: Option<File>,
}

impl FolderLock {
    /// Waits for the lock of a folder. Creates the folder if it is missing.
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

    /// Removes the temporary files that killed programs left in the folder. Files that cannot be removed stay.
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

    /// Flushes the folder's entries to the disk, if the system can.
    pub fn sync(&self) {
        let _ = File::open(&self.folder).and_then(|folder| folder.sync_all());
    }
}

/// Creates a file under a temporary name in a folder; it is removed when it is dropped. The caller holds the folder's lock, or knows that
/// the folder has no leftovers.
///
/// # Errors
/// No file can be made there.
pub fn staged_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    // Temporary files are private; results are for whom the system's mask allows.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    // If files cannot be locked, leftovers stay.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Writes a file. Leftovers in its folder stay, as there may be many files to examine.
///
/// # Errors
/// The file cannot be written; an existing file is unchanged.
pub fn write(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let lock = FolderLock::new(folder_of(place))?;
    let mut file = staged_in(folder_of(place))?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(place)?;
    lock.sync();
    Ok(())
}

/// Returns the folder of a file; the working folder if the path is a name alone.
#[must_use]
pub fn folder_of(place: &Path) -> &Path {
    match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
