//! A live run that several pages follow: one sender, many followers, each from its own position, by server-sent events.

use crate::answer::{self, Refusal};
use crate::deadline::{Deadline, HEARTBEAT, LOOK, SHORT};
use platewash_workcell::cancel::CancelToken;
use serde::Serialize;
use std::io::{Result, Write};
use std::net::TcpStream;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use ts_rs::TS;

/// A sample as the page takes it: t \[s\], six q \[rad\], six q̇ \[rad/s\], six torques \[N·m\], distance of the tip from the planned one \[m\].
pub type Row = [f64; 20];

/// Path of the events of a live run.
pub const EVENTS: &str = "/events";

/// Most pages that follow a run.
const FOLLOWERS: usize = 16;

/// Rows of one event.
const ROWS_AN_EVENT: usize = 500;

/// Time after which a page that has lost the connection comes again \[ms\].
const RETRY_MS: u32 = 500;

/// Progress of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum LiveState {
    /// The run has not begun.
    #[default]
    Waiting,
    /// The run is under way.
    Running,
    /// The run has ended.
    Done,
}

/// Event `state`.
#[derive(Debug, Serialize, TS)]
pub struct StateEvent {
    /// Progress of the run.
    state: LiveState,
}

/// Event `samples`: its `id` is the index of the last one, so that a page that connects again gets what it missed.
#[derive(Debug, Serialize, TS)]
pub struct SamplesEvent {
    /// Rows of `t_s`, six `q_rad`, six `qd_rad_s`, six `torque_n_m` (zeros under a kinematic law), `error_m`.
    samples: Vec<Row>,
}

/// Result of a run, as the event `done`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, TS)]
pub struct LiveEnd {
    /// The report's first line, or why there is none.
    pub headline: String,
    /// True where every plate is washed; `None` where that is not judged.
    pub washed: Option<bool>,
}

/// A live run, shared.
#[derive(Debug)]
pub struct LiveRun {
    tag: String,
    log: Mutex<LiveLog>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct LiveLog {
    state: LiveState,
    rows: Vec<Row>,
    end: Option<LiveEnd>,
    followers: usize,
    /// Followers there have ever been, and those who know the end.
    ever: usize,
    know_the_end: usize,
    is_closed: bool,
}

impl LiveRun {
    /// A run that has not begun. `tag` distinguishes runs, as a plan's hash does: a page of one run gets no events of another
    /// one. Its letters and digits count.
    #[must_use]
    pub fn new(tag: &str) -> Arc<Self> {
        Arc::new(Self {
            tag: tag.chars().filter(char::is_ascii_alphanumeric).collect(),
            log: Mutex::default(),
            changed: Condvar::default(),
        })
    }

    /// Path at which the page of this run finds its events.
    #[must_use]
    pub fn events(&self) -> String {
        format!("{EVENTS}?run={}", self.tag)
    }

    /// Checks that the query of a request is the one of this run.
    pub(crate) fn is_asked_for(&self, query: &str) -> bool {
        query.strip_prefix("run=") == Some(&self.tag)
    }

    /// Tells that the run begins.
    pub fn begin(&self) {
        self.tell(|told| told.state = LiveState::Running);
    }

    /// Tells a sample.
    pub fn push(&self, row: Row) {
        self.tell(|told| told.rows.push(row));
    }

    /// Tells how the run ended; nothing follows.
    pub fn finish(&self, end: LiveEnd) {
        self.tell(|told| {
            told.state = LiveState::Done;
            told.end = Some(end);
        });
    }

    /// Tells followers that the server has ended.
    pub(crate) fn close(&self) {
        self.tell(|told| told.is_closed = true);
    }

    /// Waits until a page follows, for so long at most and no longer than `token` allows; whether one does.
    pub fn wait_for_page(&self, patience: Duration, token: &CancelToken) -> bool {
        self.wait(patience, token, |told| told.ever > 0)
    }

    /// Once the run has ended, waits until all pages that follow have its end, at most for `patience` and as long as `token`
    /// allows. A page that has lost its connection gets the time to come back. Without followers there is nothing to wait for.
    pub fn wait_until_told(&self, patience: Duration, token: &CancelToken) -> bool {
        self.wait(patience, token, |told| {
            told.ever == 0 || (told.followers == 0 && told.know_the_end > 0)
        })
    }

    /// Sends the run as events to its end, from behind the event with the given id or from the beginning. Each event has its own
    /// deadline: a client that is too slow for one is dropped; when it connects again it gets the events that it missed.
    pub(crate) fn send(&self, stream: &TcpStream, last_event_id: Option<&str>) -> Result<()> {
        let out = || Deadline::after(stream, SHORT);
        let Some(_follower) = self.enter() else {
            return Refusal::Followed.write(&mut out(), true);
        };
        let last = last_event_id.and_then(|id| id.parse::<usize>().ok());
        let (mut next, mut known) = (last.map_or(0, |last| last.saturating_add(1)), None);
        answer::stream(&mut out(), answer::EVENTS)?;
        write(&mut out(), &format!("retry: {RETRY_MS}\n\n"))?;
        loop {
            let told = self.lock();
            let is_old = |log: &mut LiveLog| {
                !log.is_closed && known == Some(log.state) && log.rows.len() <= next && log.end.is_none()
            };
            let woken = self.changed.wait_timeout_while(told, HEARTBEAT, is_old);
            let told = woken.unwrap_or_else(PoisonError::into_inner).0;
            let (state, is_closed) = (told.state, told.is_closed);
            let samples: Vec<Row> = told.rows.iter().skip(next).take(ROWS_AN_EVENT).copied().collect();
            let end = told.end.clone().filter(|_| samples.is_empty());
            drop(told);
            if is_closed {
                return Ok(());
            }
            // The end is sent after all samples.
            let is_due = known != Some(state) && (state != LiveState::Done || samples.is_empty());
            if is_due {
                known = Some(state);
                event(&mut out(), "state", None, &StateEvent { state })?;
            }
            if !samples.is_empty() {
                next += samples.len();
                event(&mut out(), "samples", Some(next - 1), &SamplesEvent { samples })?;
            } else if let Some(end) = end {
                event(&mut out(), "done", None, &end)?;
                self.tell(|told| told.know_the_end += 1);
                return Ok(());
            } else if !is_due {
                // A write shows if the client is still there.
                write(&mut out(), ":\n\n")?;
            }
        }
    }

    /// A place for one more follower; `None` where there are as many as can be.
    fn enter(&self) -> Option<Follower<'_>> {
        let mut told = self.lock();
        if told.followers >= FOLLOWERS {
            return None;
        }
        told.followers += 1;
        told.ever += 1;
        drop(told);
        self.changed.notify_all();
        Some(Follower(self))
    }

    fn wait(&self, patience: Duration, token: &CancelToken, until: impl Fn(&LiveLog) -> bool) -> bool {
        let begin = Instant::now();
        let mut told = self.lock();
        while !until(&told) {
            if token.is_cancelled() || begin.elapsed() >= patience {
                return false;
            }
            let woken = self.changed.wait_timeout(told, LOOK);
            told = woken.unwrap_or_else(PoisonError::into_inner).0;
        }
        true
    }

    fn tell(&self, news: impl FnOnce(&mut LiveLog)) {
        news(&mut self.lock());
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, LiveLog> {
        self.log.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// All rows so far.
    #[cfg(test)]
    pub(crate) fn rows(&self) -> Vec<Row> {
        self.lock().rows.clone()
    }
}

/// One who follows a run, until it is dropped.
struct Follower<'a>(&'a LiveRun);

impl Drop for Follower<'_> {
    fn drop(&mut self) {
        self.0.tell(|told| told.followers -= 1);
    }
}

fn event(out: &mut impl Write, name: &str, id: Option<usize>, data: &impl Serialize) -> Result<()> {
    let id = id.map_or_else(String::new, |id| format!("id: {id}\n"));
    // JSON has no line breaks of its own.
    let data = serde_json::to_string(data)?;
    write(out, &format!("event: {name}\n{id}data: {data}\n\n"))
}

fn write(out: &mut impl Write, text: &str) -> Result<()> {
    out.write_all(text.as_bytes())?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW: Duration = Duration::ZERO;

    #[test]
    fn bounds_followers_and_frees_the_place_of_one_that_leaves() {
        let live = LiveRun::new("a");
        let mut followers: Vec<_> = (0..FOLLOWERS).map(|_| live.enter().unwrap()).collect();
        assert!(live.enter().is_none());
        followers.pop();
        assert!(live.enter().is_some());
    }

    #[test]
    fn a_run_waits_for_a_page_and_until_all_received_its_end() {
        let (live, token) = (LiveRun::new("a"), CancelToken::new());
        assert!(!live.wait_for_page(NOW, &token));
        let (headline, washed) = ("WASHED".to_owned(), Some(true));
        live.finish(LiveEnd { headline, washed });
        assert!(live.wait_until_told(NOW, &token), "nobody ever followed");
        let follower = live.enter().unwrap();
        assert!(live.wait_for_page(NOW, &token));
        assert!(!live.wait_until_told(NOW, &token), "it does not know yet");
        drop(follower);
        assert!(!live.wait_until_told(NOW, &token), "it may come again");
        live.tell(|told| told.know_the_end += 1);
        assert!(live.wait_until_told(NOW, &token));
    }

    #[test]
    fn a_wait_can_be_cancelled() {
        let (live, token) = (LiveRun::new("a"), CancelToken::new());
        token.cancel();
        assert!(!live.wait_for_page(Duration::from_secs(1000), &token));
    }

    #[test]
    fn a_run_is_known_by_its_tag() {
        let live = LiveRun::new("a1&b=\r\n?é");
        assert_eq!(live.events(), "/events?run=a1b");
        assert!(live.is_asked_for("run=a1b") && !live.is_asked_for("run=a1") && !live.is_asked_for(""));
    }
}
