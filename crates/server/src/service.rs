//! Who answers questions of the page.

use platewash_workcell::cancel::CancelToken;
use std::fmt::Debug;

/// Answers questions of the page.
///
/// A question is a POST of JSON. It comes here once it is known to be the page's own and short enough, and its turn has come.
pub trait Service: Debug + Send + Sync {
    /// Returns the limits of the question under this path, from `/` to `?`; `None` where there is no question.
    fn knows(&self, path: &str) -> Option<QuestionLimits>;

    /// Answers a question, each on its own thread; the number of questions of long work at a time is limited. Each line goes to
    /// `tell` when it is known: JSON without a line break, as an empty line has no meaning. `tell` returns when the system has
    /// taken all of it. `gone` is cancelled when the client has left, is too slow, or the server ends: then this must return
    /// soon, as its turn lasts until it does.
    fn answer(
        &self,
        path: &str,
        question: &[u8],
        tell: &mut dyn FnMut(String) -> Result<(), NoListener>,
        gone: &CancelToken,
    );

    /// Token that the page sends with its questions, so that others cannot ask: see [`token`](crate::token()).
    fn token(&self) -> &str;
}

/// Facts about a question that are known before it is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QuestionLimits {
    /// True for long work, of which only a limited number runs at a time.
    pub is_work: bool,
    /// Longest question \[bytes\].
    pub most_bytes: usize,
}

/// Nobody listens any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the client has left")]
pub struct NoListener;
