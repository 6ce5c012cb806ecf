//! A new question of a page ends those before it.

use platewash_workcell::cancel::CancelToken;
use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Kinds of work that a page can have under way, one of each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Lane {
    /// Guesses, while something moves.
    Preview,
    /// Plans and proofs.
    Proof,
    /// Maps.
    Map,
}

/// Length of the name of a session: a shorter one might be guessed by another page, which could end its questions then.
const LENGTH: RangeInclusive<usize> = 16..=64;

/// Work that pages have under way.
#[derive(Debug, Default)]
pub struct Sessions {
    running: Mutex<HashMap<(String, Lane), RunningTask>>,
}

#[derive(Debug)]
struct RunningTask {
    number: u64,
    token: CancelToken,
}

/// A question that is under way until this is dropped.
#[derive(Debug)]
pub struct Turn<'a> {
    sessions: &'a Sessions,
    key: (String, Lane),
    number: u64,
}

/// Checks that a text is a valid name of a session.
pub fn is_name(session: &str) -> bool {
    LENGTH.contains(&session.len()) && session.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

impl Sessions {
    /// Begins a question of a page; `token` is cancelled by the next one of the same lane. A question for a proof ends a map, which is of
    /// the cell as it was.
    pub fn begin(&self, session: &str, lane: Lane, token: &CancelToken) -> Turn<'_> {
        let mut running = self.lock();
        if lane == Lane::Proof
            && let Some(map) = running.get(&(session.to_owned(), Lane::Map))
        {
            map.token.cancel();
        }
        let key = (session.to_owned(), lane);
        let before = running.get(&key);
        let number = before.map_or(0, |before| before.number + 1);
        if let Some(before) = before {
            before.token.cancel();
        }
        let token = token.clone();
        running.insert(key.clone(), RunningTask { number, token });
        Turn {
            sessions: self,
            key,
            number,
        }
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<(String, Lane), RunningTask>> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        let mut running = self.sessions.lock();
        if running.get(&self.key).is_some_and(|last| last.number == self.number) {
            running.remove(&self.key);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_question_ends_only_the_one_before_of_its_page_and_lane() {
        let sessions = Sessions::default();
        let tokens: Vec<_> = (0..6).map(|_| CancelToken::new()).collect();
        let ended = || tokens.iter().map(CancelToken::is_cancelled).collect::<Vec<_>>();
        let map = sessions.begin("a", Lane::Map, &tokens[0]);
        let preview = sessions.begin("a", Lane::Preview, &tokens[1]);
        let other = sessions.begin("b", Lane::Proof, &tokens[2]);
        assert_eq!(ended(), [false; 6]);
        let proof = sessions.begin("a", Lane::Proof, &tokens[3]);
        assert_eq!(ended(), [true, false, false, false, false, false]);
        let next = sessions.begin("a", Lane::Proof, &tokens[4]);
        // The one that was ended leaves later than its successor came.
        drop(proof);
        let last = sessions.begin("a", Lane::Proof, &tokens[5]);
        assert_eq!(ended(), [true, false, false, true, true, false]);
        drop((map, preview, other, next, last));
        assert!(sessions.lock().is_empty());
    }

    #[test]
    fn session_names_are_plain_and_random() {
        for name in [
            "",
            "a",
            &"a".repeat(15),
            &"a b".repeat(6),
            &"ä".repeat(16),
            &"a/b".repeat(6),
            &"a".repeat(65),
        ] {
            assert!(!is_name(name), "{name}");
        }
        assert!(is_name(&"a1Z".repeat(20)) && is_name(&"a".repeat(16)));
    }
}
