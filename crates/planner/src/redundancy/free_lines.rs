//! Whether the lines over the ends of a wash path must be clear.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether lines must be clear, and whether that ever stood in the way.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    must_be_clear: bool,
    stood_in_the_way: Arc<AtomicBool>,
}

impl Lines {
    /// Those that must be clear.
    pub fn clear() -> Self {
        Self {
            must_be_clear: true,
            stood_in_the_way: Arc::default(),
        }
    }

    /// Those that need not be: that they are not is for whoever plans them to tell.
    pub fn any() -> Self {
        Self {
            must_be_clear: false,
            ..Self::clear()
        }
    }

    /// Whether they must be clear.
    pub fn must_be_clear(&self) -> bool {
        self.must_be_clear
    }

    /// A line was refused because it is not clear.
    pub fn stand_in_the_way(&self) {
        self.stood_in_the_way.store(true, Ordering::Relaxed);
    }

    /// Whether a line was refused because it is not clear.
    pub fn stood_in_the_way(&self) -> bool {
        self.stood_in_the_way.load(Ordering::Relaxed)
    }
}
