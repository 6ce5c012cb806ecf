//! What the page asks.

use serde::Deserialize;
use serde_json::Value;

/// What the scenario with some changes looks like, planned and proved.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// Changes to it, in order.
    pub edits: Vec<Edit>,
    /// How far to go.
    pub want: Want,
    /// Id of the arm that the page has.
    pub arm: Option<String>,
}

/// A change to a scenario.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// The key.
    pub key: String,
    /// Its new value; `None` takes it out.
    pub value: Option<Value>,
}

/// How far to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Want {
    /// To the guess.
    Preview,
    /// To the proof.
    Proof,
}

/// Where a plate could be washed, the others as they lie.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MapQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// The plate.
    pub plate: usize,
}

/// To write the scenario, and what comes of it beside it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SaveQuestion {
    /// The page that asks.
    pub session: String,
    /// The scenario.
    pub text: String,
    /// SHA-256 of what the page takes to stand on disk; `None` for nothing.
    pub disk: Option<String>,
    /// Whether to write whatever stands there.
    pub force: bool,
}

/// Whether what stands on disk has changed.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DiskQuestion {
    /// The page that asks.
    pub session: String,
    /// SHA-256 of what the page takes to stand there.
    pub disk: Option<String>,
}
