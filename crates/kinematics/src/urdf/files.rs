//! Source of input files: the disk, files that were read from it before, or none, for a page in a browser.

use crate::urdf::file::{self, FileError};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Files by name, as they were read.
pub type HeldFiles = BTreeMap<PathBuf, Arc<[u8]>>;

/// Source of input files, and the folders with installed packages. It has no effect on the contents, so all sources compare as equal.
#[derive(Debug, Clone, Default)]
pub struct Files {
    source: FileSource,
    installed: Vec<PathBuf>,
    /// Texts that stand in place of files.
    texts: BTreeMap<PathBuf, Arc<str>>,
}

#[derive(Debug, Clone, Default)]
enum FileSource {
    #[default]
    Disk,
    /// The disk; everything that is read is kept, and so is the first file that could not be read.
    Recorded(Arc<Mutex<Record>>),
    Held(Arc<HeldFiles>),
    None,
}

#[derive(Debug, Default)]
struct Record {
    held: HeldFiles,
    refused: Option<(PathBuf, FileError)>,
}

impl PartialEq for Files {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Files {}

impl Files {
    /// Returns the disk as a source that keeps everything that is read; [`recorded`](Self::recorded) returns it.
    #[must_use]
    pub fn recording() -> Self {
        Self::from_source(FileSource::Recorded(Arc::default()))
    }

    /// Returns files that were read before, under the same names, as a source; no other files exist in it.
    #[must_use]
    pub fn held(files: Arc<HeldFiles>) -> Self {
        Self::from_source(FileSource::Held(files))
    }

    /// Returns a source without files, for a host that has none.
    #[must_use]
    pub fn none() -> Self {
        Self::from_source(FileSource::None)
    }

    fn from_source(source: FileSource) -> Self {
        Self {
            source,
            ..Self::default()
        }
    }

    /// Returns the source with folders in which packages are installed (`FOLDER/NAME`), such as those that ROS names. They are looked at
    /// last.
    #[must_use]
    pub fn with_installed(self, folders: Vec<PathBuf>) -> Self {
        Self {
            installed: folders,
            ..self
        }
    }

    /// Returns the source with a text in place of a file, such as a xacro file with its expansion.
    #[must_use]
    pub fn with_text(mut self, path: &Path, text: &str) -> Self {
        self.texts.insert(path.to_owned(), text.into());
        self
    }

    /// Returns the folders in which packages are installed.
    pub(crate) fn installed(&self) -> &[PathBuf] {
        &self.installed
    }

    /// Returns the files that were read so far, if this source records them.
    ///
    /// # Errors
    /// The first file that exists and could not be read, with the reason.
    pub fn recorded(&self) -> Result<HeldFiles, (PathBuf, FileError)> {
        let FileSource::Recorded(record) = &self.source else {
            return Ok(HeldFiles::new());
        };
        let record = record.lock().unwrap_or_else(PoisonError::into_inner);
        match &record.refused {
            Some(refused) => Err(refused.clone()),
            None => Ok(record.held.clone()),
        }
    }

    /// True if this source has no files at all.
    pub(crate) fn are_none(&self) -> bool {
        matches!(self.source, FileSource::None)
    }

    /// True if there is such a regular file.
    #[must_use]
    pub fn is_file(&self, path: &Path) -> bool {
        match &self.source {
            FileSource::Disk => path.is_file(),
            FileSource::Held(files) => files.contains_key(path),
            FileSource::None => false,
            FileSource::Recorded(record) => {
                let is_there = path.is_file();
                if is_there {
                    // It may be refused by its name alone, which whoever has no files must do, too.
                    let mut record = record.lock().unwrap_or_else(PoisonError::into_inner);
                    record.held.entry(path.to_owned()).or_insert_with(|| Arc::from([]));
                }
                is_there
            }
        }
    }

    /// Same as [`file::read_bytes`].
    ///
    /// # Errors
    /// [`FileError`], without the file's name.
    pub fn read_bytes(&self, path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
        match self.texts.get(path) {
            Some(text) if text.len() as u64 > limit => return Err(FileError::TooLong { limit }),
            Some(text) => return Ok(text.as_bytes().to_vec()),
            None => {}
        }
        match &self.source {
            FileSource::Disk => file::read_bytes(path, limit),
            FileSource::Recorded(record) => {
                let read = file::read_bytes(path, limit);
                let mut record = record.lock().unwrap_or_else(PoisonError::into_inner);
                match &read {
                    Ok(bytes) => drop(record.held.insert(path.to_owned(), bytes.as_slice().into())),
                    Err(error) => drop(record.refused.get_or_insert_with(|| (path.to_owned(), error.clone()))),
                }
                read
            }
            FileSource::Held(files) => match files.get(path) {
                Some(bytes) if bytes.len() as u64 > limit => Err(FileError::TooLong { limit }),
                Some(bytes) => Ok(bytes.to_vec()),
                None => Err(FileError::System {
                    detail: "it is not among the files that were read before".to_owned(),
                    kind: std::io::ErrorKind::NotFound,
                    code: None,
                }),
            },
            FileSource::None => Err(FileError::NoFiles),
        }
    }

    /// Same as [`file::read_text`].
    ///
    /// # Errors
    /// [`FileError`], without the file's name.
    pub fn read_text(&self, path: &Path, limit: u64) -> Result<String, FileError> {
        file::text(self.read_bytes(path, limit)?)
    }
}
