//! A live run as those who watch it share it: one tells, many follow, each from where it is.

use super::limits::{FOLLOWERS, ROWS_AN_EVENT};
use platewash_workcell::cancel::CancelToken;
use serde::Serialize;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A sample as the page takes it: t \[s\], six q \[rad\], six q̇ \[rad/s\], six torques \[N·m\], distance of the tip from the planned one \[m\].
pub type Row = [f64; 20];

/// Where the events of a live run are.
pub const EVENTS: &str = "/events";

/// Time between two looks at whether whoever waits gives up.
const LOOK: Duration = Duration::from_millis(50);

/// How far a run has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LiveState {
    /// It has not begun.
    Waiting,
    /// It is under way.
    Running,
    /// It has ended.
    Done,
}

/// What came of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LiveEnd {
    /// The report's first line, or why there is none.
    pub headline: String,
    /// Whether every plate is washed; `None` where that is not judged.
    pub washed: Option<bool>,
}

/// A live run, shared.
#[derive(Debug)]
pub struct Live {
    tag: String,
    told: Mutex<Told>,
    changed: Condvar,
}

#[derive(Debug)]
struct Told {
    state: LiveState,
    rows: Vec<Row>,
    end: Option<LiveEnd>,
    followers: usize,
    /// Followers there have ever been, and those who know the end.
    ever: usize,
    know_the_end: usize,
    is_closed: bool,
}

impl Live {
    /// A run that has not begun. `tag` tells runs apart, as a plan's hash does: a page of one is not told of another. Its letters and
    /// digits count.
    #[must_use]
    pub fn new(tag: &str) -> Arc<Self> {
        Arc::new(Self {
            tag: tag.chars().filter(char::is_ascii_alphanumeric).collect(),
            told: Mutex::new(Told {
                state: LiveState::Waiting,
                rows: Vec::new(),
                end: None,
                followers: 0,
                ever: 0,
                know_the_end: 0,
                is_closed: false,
            }),
            changed: Condvar::new(),
        })
    }

    /// Where the page of this run finds its events.
    #[must_use]
    pub fn events(&self) -> String {
        format!("{EVENTS}?run={}", self.tag)
    }

    /// Whether the query of a request is that of this run.
    pub(super) fn is_asked_for(&self, query: &str) -> bool {
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

    /// Tells followers that nobody serves them any more.
    pub(super) fn close(&self) {
        self.tell(|told| told.is_closed = true);
    }

    /// Waits until a page follows, for so long at most and no longer than `token` allows; whether one does.
    pub fn wait_for_page(&self, patience: Duration, token: &CancelToken) -> bool {
        self.wait(patience, token, |told| told.ever > 0)
    }

    /// Once the run has ended, waits until all pages that follow know, for so long at most and no longer than `token` allows. One that has
    /// lost its connection gets the time to come back. Where no page ever followed, there is nothing to wait for.
    pub fn wait_until_told(&self, patience: Duration, token: &CancelToken) -> bool {
        self.wait(patience, token, |told| {
            told.ever == 0 || (told.followers == 0 && told.know_the_end > 0)
        })
    }

    /// One who follows from behind the event of that id, or from the beginning; none where there are as many as can be.
    pub(super) fn follow(self: &Arc<Self>, last_event_id: Option<&str>) -> Option<Follower> {
        let mut told = self.lock();
        if told.followers >= FOLLOWERS {
            return None;
        }
        told.followers += 1;
        told.ever += 1;
        drop(told);
        self.changed.notify_all();
        let last = last_event_id.and_then(|id| id.parse::<usize>().ok());
        Some(Follower {
            live: self.clone(),
            state: None,
            next: last.map_or(0, |last| last.saturating_add(1)),
        })
    }

    fn wait(&self, patience: Duration, token: &CancelToken, until: impl Fn(&Told) -> bool) -> bool {
        let begin = Instant::now();
        let mut told = self.lock();
        while !until(&told) {
            if token.is_cancelled() || begin.elapsed() >= patience {
                return false;
            }
            told = self.woken(told, LOOK);
        }
        true
    }

    fn tell(&self, news: impl FnOnce(&mut Told)) {
        news(&mut self.lock());
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Told> {
        self.told.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn woken<'a>(&'a self, told: MutexGuard<'a, Told>, patience: Duration) -> MutexGuard<'a, Told> {
        let woken = self.changed.wait_timeout(told, patience);
        woken.unwrap_or_else(PoisonError::into_inner).0
    }
}

/// What a follower is told next.
#[derive(Debug, PartialEq)]
pub enum News {
    /// How far the run has come.
    State(LiveState),
    /// Samples, and the index of the last one.
    Samples(Vec<Row>, usize),
    /// The end: it comes last.
    End(LiveEnd),
    /// Nothing for now.
    Silence,
    /// Nobody is served any more.
    Closed,
}

/// One who follows a run.
#[derive(Debug)]
pub struct Follower {
    live: Arc<Live>,
    state: Option<LiveState>,
    /// The next sample that it is told of.
    next: usize,
}

impl Follower {
    /// What it is told next: at once where there is something, otherwise within the time given.
    pub fn news(&mut self, patience: Duration) -> News {
        let live = self.live.clone();
        let begin = Instant::now();
        let mut told = live.lock();
        loop {
            if let Some(news) = self.due(&told) {
                return news;
            }
            let left = patience.saturating_sub(begin.elapsed());
            if left.is_zero() {
                return News::Silence;
            }
            told = live.woken(told, left);
        }
    }

    fn due(&mut self, told: &Told) -> Option<News> {
        if told.is_closed {
            return Some(News::Closed);
        }
        // That it is done is told behind all samples.
        let is_new = self.state != Some(told.state);
        let has_more = self.next < told.rows.len();
        if is_new && (told.state != LiveState::Done || !has_more) {
            self.state = Some(told.state);
            return Some(News::State(told.state));
        }
        if has_more {
            let end = told.rows.len().min(self.next + ROWS_AN_EVENT);
            let rows = told.rows[self.next..end].to_vec();
            self.next = end;
            return Some(News::Samples(rows, end - 1));
        }
        told.end.clone().map(News::End)
    }

    /// Notes that it has been told of the end.
    pub fn knows_the_end(&self) {
        self.live.tell(|told| told.know_the_end += 1);
    }
}

impl Drop for Follower {
    fn drop(&mut self) {
        self.live.tell(|told| told.followers -= 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOW: Duration = Duration::ZERO;

    fn row(n: usize) -> Row {
        [n as f64; 20]
    }

    fn end() -> LiveEnd {
        LiveEnd {
            headline: "WASHED".to_owned(),
            washed: Some(true),
        }
    }

    /// All that is told, up to the first silence or the end.
    fn all(follower: &mut Follower) -> Vec<News> {
        let mut all = Vec::new();
        loop {
            match follower.news(NOW) {
                News::Silence => return all,
                News::End(end) => {
                    all.push(News::End(end));
                    return all;
                }
                news => all.push(news),
            }
        }
    }

    #[test]
    fn who_is_there_from_the_start_is_told_as_it_goes() {
        let live = Live::new("a");
        let mut follower = live.follow(None).unwrap();
        assert_eq!(all(&mut follower), [News::State(LiveState::Waiting)]);
        live.begin();
        live.push(row(0));
        live.push(row(1));
        assert_eq!(
            all(&mut follower),
            [News::State(LiveState::Running), News::Samples(vec![row(0), row(1)], 1)]
        );
        live.push(row(2));
        live.finish(end());
        let last = [
            News::Samples(vec![row(2)], 2),
            News::State(LiveState::Done),
            News::End(end()),
        ];
        assert_eq!(all(&mut follower), last);
    }

    #[test]
    fn who_comes_late_or_again_is_told_what_it_missed_and_no_more() {
        let live = Live::new("a");
        live.begin();
        let n = 2 * ROWS_AN_EVENT + 3;
        (0..n).for_each(|k| live.push(row(k)));
        live.finish(end());
        for (last, first) in [
            (None, 0),
            (Some("0"), 1),
            (Some("700"), 701),
            (Some("x"), 0),
            (Some("-1"), 0),
        ] {
            let mut next = first;
            let news = all(&mut live.follow(last).unwrap());
            for news in &news[..news.len() - 2] {
                let News::Samples(rows, last) = news else {
                    panic!("{news:?} among the samples");
                };
                assert!(rows.len() <= ROWS_AN_EVENT && rows[0] == row(next));
                next = last + 1;
            }
            assert_eq!(next, n);
            assert_eq!(news[news.len() - 2..], [News::State(LiveState::Done), News::End(end())]);
        }
        for beyond in ["1002", "1003", &u64::MAX.to_string()] {
            let news = all(&mut live.follow(Some(beyond)).unwrap());
            assert_eq!(news, [News::State(LiveState::Done), News::End(end())], "{beyond}");
        }
    }

    #[test]
    fn there_are_only_so_many_followers_and_one_that_leaves_makes_room() {
        let live = Live::new("a");
        let mut followers: Vec<_> = (0..FOLLOWERS).map(|_| live.follow(None).unwrap()).collect();
        assert!(live.follow(None).is_none());
        followers.pop();
        assert!(live.follow(None).is_some());
    }

    #[test]
    fn a_run_waits_for_a_page_and_for_all_to_know_its_end() {
        let (live, token) = (Live::new("a"), CancelToken::new());
        assert!(!live.wait_for_page(NOW, &token));
        live.finish(end());
        assert!(live.wait_until_told(NOW, &token), "nobody ever followed");
        let follower = live.follow(None).unwrap();
        assert!(live.wait_for_page(NOW, &token));
        assert!(!live.wait_until_told(NOW, &token), "it does not know yet");
        drop(follower);
        assert!(!live.wait_until_told(NOW, &token), "it may come again");
        let again = live.follow(Some("0")).unwrap();
        again.knows_the_end();
        drop(again);
        assert!(live.wait_until_told(NOW, &token));
    }

    #[test]
    fn a_wait_is_given_up_when_told_so() {
        let (live, token) = (Live::new("a"), CancelToken::new());
        token.cancel();
        assert!(!live.wait_for_page(Duration::from_secs(1000), &token));
    }

    #[test]
    fn a_run_is_known_by_its_tag() {
        let live = Live::new("a1&b=\r\n?é");
        assert_eq!(live.events(), "/events?run=a1b");
        assert!(live.is_asked_for("run=a1b") && !live.is_asked_for("run=a1") && !live.is_asked_for(""));
    }
}
