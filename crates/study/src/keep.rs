//! Which plans a study keeps beside its rows.

use crate::outcome::Outcome;
use crate::row::Row;
use serde::{Deserialize, Serialize};

/// Which plans a study keeps beside its rows: the key `plans` of a study file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Keep {
    /// No plan: a row has its hash, and `study scenario` makes it again.
    #[default]
    None,
    /// The plans that are not proved.
    Failed,
    /// Every plan.
    All,
}

impl Keep {
    /// Whether the plan of a row is kept; a row without one has none to keep.
    #[must_use]
    pub fn wants(self, row: &Row) -> bool {
        row.plan.is_some()
            && match self {
                Self::None => false,
                Self::Failed => row.outcome == Outcome::NotProved,
                Self::All => true,
            }
    }
}
