//! Whoever waits for planning.

use crate::activity::Activity;
use platewash_workcell::cancel::CancelToken;
use std::fmt;

/// Who hears what planning is busy with; it is called often, and must not take long.
pub type Listener<'a> = &'a (dyn Fn(&Activity) + Sync);

/// Whoever waits for planning: hears of it, and may give it up.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Hears what planning is busy with.
    pub tell: Listener<'a>,
    /// Tells it to give up.
    pub cancel: &'a CancelToken,
}

impl<'a> Watch<'a> {
    /// Nobody listens.
    #[must_use]
    pub fn silent(cancel: &'a CancelToken) -> Self {
        Self { tell: &|_| (), cancel }
    }
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch")
            .field("cancel", self.cancel)
            .finish_non_exhaustive()
    }
}
