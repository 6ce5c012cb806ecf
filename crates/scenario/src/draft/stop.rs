//! Reason that a text is not changed.

/// Reason that a text is not changed.
pub(crate) enum Stop {
    /// The value is there already.
    Same,
    /// Something else stands where the key would go.
    Blocked,
    /// A list has no such section.
    NoRow(&'static str),
    /// Something else would be changed, too.
    Unplaced,
}
