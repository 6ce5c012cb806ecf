//! Cancelling long work: on demand, or after some time.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

/// Reads the time since some fixed moment. It never goes back.
pub type Clock = fn() -> Duration;

/// The [`Clock`] of the system. Programs without one, such as those in a browser, bring their own.
#[must_use]
pub fn system_clock() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Token that cancels long work. Clones share one state; the thread that waits keeps a clone.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<State>);

#[derive(Debug, Default)]
struct State {
    is_cancelled: AtomicBool,
    deadline: Option<Deadline>,
}

#[derive(Debug)]
struct Deadline {
    clock: Clock,
    until: Duration,
    parent: CancelToken,
}

/// The work was cancelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

impl CancelToken {
    /// Returns a token that is not cancelled.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns a token that is cancelled with this one, or once `time` has passed on the clock.
    #[must_use]
    pub fn within(&self, time: Duration, clock: Clock) -> Self {
        let deadline = Deadline {
            clock,
            until: clock() + time,
            parent: self.clone(),
        };
        Self(Arc::new(State {
            is_cancelled: AtomicBool::new(false),
            deadline: Some(deadline),
        }))
    }

    /// Cancels all work that uses this token, or one that was made of it.
    pub fn cancel(&self) {
        self.0.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// True if the work is cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        let is_over = |deadline: &Deadline| deadline.parent.is_cancelled() || deadline.has_passed();
        self.0.is_cancelled.load(Ordering::Relaxed) || self.0.deadline.as_ref().is_some_and(is_over)
    }

    /// True if the time of the token has passed, and nobody cancelled it before.
    #[must_use]
    pub fn is_late(&self) -> bool {
        let is_late = |deadline: &Deadline| !deadline.parent.is_cancelled() && deadline.has_passed();
        !self.0.is_cancelled.load(Ordering::Relaxed) && self.0.deadline.as_ref().is_some_and(is_late)
    }

    /// Returns an error if the work is cancelled.
    ///
    /// # Errors
    /// [`Cancelled`] after the first [`CancelToken::cancel`], and once the time of the token has passed.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

impl Deadline {
    fn has_passed(&self) -> bool {
        (self.clock)() >= self.until
    }
}
