//! Kinds of transits.

use serde::Serialize;
use std::fmt;

/// How a transit goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TransitKind {
    /// From top to top in the joints.
    Direct,
    /// The same over a raised configuration.
    Raised,
    /// Round the base.
    Arc,
    /// Found by random trees.
    Sampled,
}

impl fmt::Display for TransitKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direct => "direct, in the joints",
            Self::Raised => "raised, in the joints",
            Self::Arc => "on an arc round the base",
            Self::Sampled => "sampled",
        })
    }
}
