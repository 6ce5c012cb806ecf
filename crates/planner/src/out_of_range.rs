//! A value outside of its range.

/// A value outside of its range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{name} must be in [{least}, {most}]; found {found}")]
pub struct OutOfRange {
    /// Its name in the planner's settings, in a map's, or in the input of a search.
    pub name: &'static str,
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub most: f64,
    /// Value given.
    pub found: f64,
}

impl OutOfRange {
    /// Refuses a value outside of its range, or NaN.
    pub(crate) fn check(name: &'static str, found: f64, [least, most]: [f64; 2]) -> Result<(), Self> {
        if (least..=most).contains(&found) {
            return Ok(());
        }
        Err(Self {
            name,
            least,
            most,
            found,
        })
    }
}
