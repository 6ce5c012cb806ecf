//! Slices of a batch: their lengths, and the chunks of work.

/// Number of configurations per unit of work for the thread pool. It is fixed, so that nothing depends on the number of threads.
pub(super) const CHUNK: usize = 512;

/// Slices whose lengths do not match.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
    /// One slice is longer or shorter than the first.
    #[error("{name}: {expected} entries are needed; found {found}")]
    Length {
        /// Name of the slice.
        name: &'static str,
        /// Expected length.
        expected: usize,
        /// Length found.
        found: usize,
    },
}

pub(super) fn same_length(name: &'static str, expected: usize, found: usize) -> Result<(), BatchError> {
    if expected == found {
        Ok(())
    } else {
        Err(BatchError::Length { name, expected, found })
    }
}
