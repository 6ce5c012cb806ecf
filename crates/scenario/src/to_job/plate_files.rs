//! Plates and soils out of the files that a scenario names, once they were read.

use platewash_workcell::job::{MeasuredShape, Soil};
use std::path::PathBuf;
use std::sync::Arc;

/// Plates and soils out of the files that a scenario names, once they were read; empty before.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlateFiles {
    pub(super) read: Option<Arc<ReadFiles>>,
}

impl PlateFiles {
    /// The files that were read.
    pub(crate) fn paths(&self) -> &[PathBuf] {
        self.read.as_ref().map_or(&[], |files| &files.paths)
    }

    /// True where the plates are the rows of a table.
    #[must_use]
    pub fn have_places(&self) -> bool {
        self.read.as_ref().is_some_and(|files| files.have_places)
    }

    /// True once the files were read.
    pub(crate) fn are_read(&self) -> bool {
        self.read.is_some()
    }
}

/// Plates and soils that were read out of files.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ReadFiles {
    /// The files.
    pub(super) paths: Vec<PathBuf>,
    pub(super) measured: Vec<MeasuredShape>,
    /// Index of the measured shape of each `[[plate]]` section; without sections, that of `[layout]`.
    pub(super) of_section: Vec<Option<usize>>,
    pub(super) soils: Vec<Soil>,
    pub(super) have_places: bool,
}
