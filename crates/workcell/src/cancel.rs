//! Cancelling long work.
//!
//! Deadlines for work.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::Builder;
use std::time::{Duration, Instant};

/// Token that cancels long work. Clones share one state; the thread that waits keeps a clone.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

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

    /// Cancels all work that uses this token.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// True if the work is cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Returns an error if the work is cancelled.
    ///
    /// # Errors
    /// [`Cancelled`] after the first [`CancelToken::cancel`].
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

/// Interval at which another token is polled.
const LOOK: Duration = Duration::from_millis(50);

/// Deadline that cancels a token after some time, unless it is dropped before.
#[derive(Debug)]
pub struct Deadline {
    shared: Arc<SharedState>,
}

#[derive(Debug, Default)]
struct SharedState {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default, Clone, Copy)]
struct State {
    is_over: bool,
    is_missed: bool,
}

impl Deadline {
    /// Starts a deadline. If the system gives no thread, there is no deadline.
    #[must_use]
    pub fn after(time: Duration, token: &CancelToken) -> Self {
        Self::following(time, token, &CancelToken::new())
    }

    /// Starts a deadline that also cancels the token soon after another one is cancelled.
    #[must_use]
    pub fn following(time: Duration, token: &CancelToken, other: &CancelToken) -> Self {
        let other = other.clone();
        let shared: Arc<SharedState> = Arc::default();
        let (theirs, token) = (shared.clone(), token.clone());
        let until = Instant::now() + time;
        let wait = move || {
            let mut state = theirs.state.lock().unwrap_or_else(PoisonError::into_inner);
            while !state.is_over {
                let left = until.saturating_duration_since(Instant::now());
                if left.is_zero() || other.is_cancelled() {
                    state.is_missed = left.is_zero();
                    token.cancel();
                    return;
                }
                let woken = theirs.changed.wait_timeout(state, left.min(LOOK));
                state = woken.unwrap_or_else(PoisonError::into_inner).0;
            }
        };
        let _ = Builder::new().name("deadline".to_owned()).spawn(wait);
        Self { shared }
    }

    /// True if the deadline has passed.
    #[must_use]
    pub fn is_missed(&self) -> bool {
        self.state().is_missed
    }

    fn state(&self) -> State {
        *self.shared.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Deadline {
    fn drop(&mut self) {
        let mut state = self.shared.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.is_over = true;
        drop(state);
        self.shared.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_are_one_token() {
        let token = CancelToken::new();
        let other = token.clone();
        assert_eq!(other.check(), Ok(()));
        token.cancel();
        assert_eq!(other.check(), Err(Cancelled));
    }

    #[test]
    fn a_deadline_cancels_only_when_it_passes() {
        let (late, met) = (CancelToken::new(), CancelToken::new());
        let missed = Deadline::after(Duration::from_millis(1), &late);
        drop(Deadline::after(Duration::from_millis(100), &met));
        let begin = Instant::now();
        while !late.is_cancelled() {
            assert!(begin.elapsed() < Duration::from_secs(60));
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(missed.is_missed());
        std::thread::sleep(Duration::from_millis(150));
        assert!(!met.is_cancelled());
    }
}
