//! A row as it was made, before it is kept.

use crate::row::Row;

/// A row, and the plan where the study keeps it.
#[derive(Debug, Clone, PartialEq)]
pub struct Made {
    /// What came of the scenario.
    pub row: Row,
    /// The plan's file, as `run` writes `plan.json`; there exactly where [`Keep::wants`](crate::Keep::wants) it.
    pub plan: Option<Vec<u8>>,
}

impl From<Row> for Made {
    /// A row whose plan is not kept.
    fn from(row: Row) -> Self {
        Self { row, plan: None }
    }
}
