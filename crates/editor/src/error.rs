//! Why there is nothing to edit.

use platewash_scenario::ScenarioError;
use platewash_viewer::page::PageError;

/// Why there is nothing to edit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EditorError {
    /// The scenario cannot be read.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// It cannot be carried out so far that there is anything to show.
    #[error(transparent)]
    Failure(#[from] platewash_scenario::Failure),
    /// The page cannot be made.
    #[error(transparent)]
    Page(#[from] PageError),
    /// The system gives no random numbers for a token.
    #[error("no token can be made: {0}")]
    Token(String),
}
