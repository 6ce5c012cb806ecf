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
            Self::Direct => "straight in joint space",
            Self::Raised => "in joint space over a raised point",
            Self::Arc => "on an arc around the base",
            Self::Sampled => "found by sampling",
        })
    }
}
