//! Real time.

use platewash_workcell::cancel::CancelToken;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Time between two looks at whether whoever waits gives up.
const LOOK: Duration = Duration::from_millis(20);

/// A clock that motion is held back to: it shows as many seconds as have passed since it was started.
#[derive(Debug)]
pub struct Pace {
    start: Instant,
}

impl Pace {
    /// Starts at 0 s now.
    pub fn start() -> Self {
        Self { start: Instant::now() }
    }

    /// Waits until the clock shows a time \[s\], no longer than `token` allows; how late it is then \[s\].
    pub fn wait(&self, t_s: f64, token: &CancelToken) -> f64 {
        loop {
            let left = left(self.start.elapsed(), t_s);
            if left.is_zero() || token.is_cancelled() {
                return (self.start.elapsed().as_secs_f64() - t_s).max(0.0);
            }
            sleep(left.min(LOOK));
        }
    }
}

/// Time from what the clock shows to a time \[s\]; none to one that is past or no number.
fn left(shown: Duration, t_s: f64) -> Duration {
    // A time too long for the clock is not reached; nobody waits for it to the end.
    let due = if t_s > 0.0 {
        Duration::try_from_secs_f64(t_s).unwrap_or(Duration::MAX)
    } else {
        Duration::ZERO
    };
    due.saturating_sub(shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_is_left_until_it_is_due() {
        let second = Duration::from_secs(1);
        assert_eq!(left(second, 1.5), Duration::from_millis(500));
        for past in [1.0, 0.5, 0.0, -1.0, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(left(second, past), Duration::ZERO, "{past}");
        }
        assert_eq!(left(second, f64::INFINITY), Duration::MAX - second);
        assert_eq!(left(second, 1e300), Duration::MAX - second);
    }

    #[test]
    fn nothing_is_early_and_who_gives_up_does_not_wait() {
        let (pace, token) = (Pace::start(), CancelToken::new());
        pace.wait(0.05, &token);
        assert!(pace.start.elapsed() >= Duration::from_millis(50));
        token.cancel();
        assert_eq!(pace.wait(1e9, &token), 0.0);
    }
}
