//! Tokens that cancel, and deadlines.

use platewash_workcell::cancel::*;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

#[test]
fn clones_are_one_token() {
    let token = CancelToken::new();
    let other = token.clone();
    assert_eq!(other.check(), Ok(()));
    token.cancel();
    assert_eq!(other.check(), Err(Cancelled));
}

#[test]
fn a_deadline_cancels_once_its_time_has_passed() {
    static NOW_S: AtomicU64 = AtomicU64::new(0);
    let clock = || Duration::from_secs(NOW_S.load(Ordering::Relaxed));
    let parent = CancelToken::new();
    let [late, met] = [1, 3].map(|seconds| parent.within(Duration::from_secs(seconds), clock));
    assert!(!late.is_cancelled() && !late.is_late());
    NOW_S.store(1, Ordering::Relaxed);
    assert!(late.is_cancelled() && late.is_late() && late.clone().check().is_err());
    assert!(!met.is_cancelled() && !parent.is_cancelled());
    parent.cancel();
    assert!(met.is_cancelled() && !met.is_late());
}

#[test]
fn the_clock_of_the_system_runs() {
    let begin = system_clock();
    std::thread::sleep(Duration::from_millis(2));
    assert!(system_clock() >= begin + Duration::from_millis(2));
}
