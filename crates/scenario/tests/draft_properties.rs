//! Changes of scenario texts: what must hold for each of them, in any order, in any text.

use crate::texts::{change, nonsense, text, texts};
use platewash_scenario::keys::Key;
use platewash_scenario::{Draft, EditError, Scenario};
use proptest::prelude::*;
use serde_json::Value;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// Where `toml` itself finds the value of a key, or of the section of a key.
fn place(text: &str, path: &str) -> Option<Range<usize>> {
    let table = DeTable::parse(text).unwrap();
    let mut names = path.split('.');
    let first = table.get_ref().get(names.next()?)?;
    let value = names.try_fold(first, |value, name| value.get_ref().as_table()?.get(name))?;
    Some(value.span())
}

/// Whether the section of a key stands within braces on several lines, whose comments would be lost where a key comes or goes.
fn is_in_long_braces(text: &str, path: &str) -> bool {
    let section = path.split('.').next().unwrap();
    place(text, section).is_some_and(|at| text[at.clone()].starts_with('{') && text[at].contains('\n'))
}

fn is_scalar(text: &str, path: &str) -> bool {
    place(text, path).is_some_and(|at| !matches!(&text[at.start..=at.start], "[" | "{"))
}

/// Numbers to the bit.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => a.as_f64().unwrap().to_bits() == b.as_f64().unwrap().to_bits(),
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        _ => a == b,
    }
}

/// A text whose lines all end alike has no other ends afterwards, and its mark stays.
fn ends_stay(before: &str, after: &str) -> Result<(), TestCaseError> {
    let bare = |text: &str| text.replace("\r\n", "").contains('\n');
    prop_assert!(bare(before) || !before.contains('\n') || !bare(after), "{after:?}");
    prop_assert_eq!(before.starts_with('\u{feff}'), after.starts_with('\u{feff}'));
    if !before.is_empty() && before != "\u{feff}" && !after.trim_start_matches('\u{feff}').is_empty() {
        prop_assert_eq!(
            before.ends_with('\n'),
            after.ends_with('\n'),
            "{:?} {:?}",
            before,
            after
        );
    }
    Ok(())
}

fn others_stay(before: &Draft, after: &Draft, key: &Key) -> Result<(), TestCaseError> {
    let without = |draft: &Draft| {
        let mut stated = draft.stated();
        stated.remove(key.path);
        stated
    };
    prop_assert_eq!(without(before), without(after));
    Ok(())
}

/// What is before and behind a value stays byte for byte; what is new is whole lines, or within the braces of its section.
fn surroundings_stay(before: &str, after: &str, key: &Key) -> Result<(), TestCaseError> {
    let shared = |a: &str, b: &str| {
        let head = a.bytes().zip(b.bytes()).take_while(|(a, b)| a == b).count();
        let rest = a.len().min(b.len()) - head;
        let tail = a
            .bytes()
            .rev()
            .zip(b.bytes().rev())
            .take(rest)
            .take_while(|(a, b)| a == b)
            .count();
        head..a.len() - tail
    };
    if before == after {
        return Ok(());
    }
    let changed = shared(before, after);
    if let Some(at) = place(before, key.path) {
        prop_assert!(
            at.start <= changed.start && changed.end <= at.end,
            "{before:?} {after:?}"
        );
        return Ok(());
    }
    let section = key.path.split('.').next().unwrap();
    if let Some(at) = place(before, section).filter(|at| before[at.clone()].starts_with('{')) {
        prop_assert!(
            at.start <= changed.start && changed.end <= at.end,
            "{before:?} {after:?}"
        );
        return Ok(());
    }
    // All old lines are there, one behind the other.
    let unmarked = |text: &'_ str| text.trim_start_matches('\u{feff}').to_owned();
    let (before, after) = (unmarked(before), unmarked(after));
    let mut lines = after.lines();
    for line in before.lines() {
        prop_assert!(lines.any(|l| l == line), "{line:?} of {before:?} is not in {after:?}");
    }
    Ok(())
}

/// Taken out are the lines of the key and nothing else, or something within its braces.
fn rest_stays(before: &str, after: &str, key: &Key) -> Result<(), TestCaseError> {
    let Some(at) = place(before, key.path) else {
        prop_assert_eq!(before, after);
        return Ok(());
    };
    let section = key.path.split('.').next().unwrap();
    let braces = place(before, section).filter(|at| section != key.path && before[at.clone()].starts_with('{'));
    if let Some(braces) = braces {
        prop_assert!(after.starts_with(&before[..braces.start]), "{after:?}");
        prop_assert!(after.ends_with(&before[braces.end..]), "{after:?}");
        return Ok(());
    }
    let line = |at: usize| before[..at].matches('\n').count();
    let gone = line(at.start)..=line(at.end - 1);
    let kept = before.lines().enumerate().filter(|(n, _)| !gone.contains(n));
    let kept: Vec<_> = kept.map(|(_, line)| line.trim_start_matches('\u{feff}')).collect();
    let left: Vec<_> = after
        .lines()
        .map(|line| line.trim_start_matches('\u{feff}'))
        .filter(|l| kept != [""; 0] || !l.is_empty())
        .collect();
    prop_assert_eq!(kept, left);
    Ok(())
}

#[test]
fn an_unchanged_draft_keeps_its_text() {
    for (name, text) in texts() {
        let mut draft = Draft::new(text).unwrap();
        assert_eq!(draft.text(), text, "{name}");
        for (key, value) in draft.clone().stated() {
            // Values that no file may have cannot be set, either.
            let _ = draft.set(&key, Some(&value));
            let fits = Draft::new(text).unwrap().set(&key, Some(&value)).is_ok();
            assert!(!fits || name == "mistakes" || draft.text() == text, "{name}: {key}");
        }
        if name != "mistakes" {
            assert_eq!(draft.text(), text, "{name}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn a_change_changes_its_key_and_nothing_else(text in text(), changes in prop::collection::vec(change(), 1..14)) {
        let mut draft = Draft::new(text).unwrap();
        for (key, value) in changes {
            let before = draft.clone();
            if let Err(error) = draft.set(key.path, value.as_ref()) {
                prop_assert!(is_in_long_braces(before.text(), key.path), "{}", error);
                prop_assert_eq!(draft.text(), before.text());
                continue;
            }
            let (old, new) = (before.text(), draft.text());
            prop_assert_eq!(&Draft::new(new).unwrap(), &draft);
            others_stay(&before, &draft, &key)?;
            ends_stay(old, new)?;
            match &value {
                Some(value) => {
                    let found = draft.stated()[key.path].clone();
                    prop_assert!(same(&found, value), "{}: {} is not {}", key.path, found, value);
                    surroundings_stay(old, new, &key)?;
                    if is_scalar(old, key.path) {
                        let (was, is) = (place(old, key.path).unwrap(), place(new, key.path).unwrap());
                        prop_assert_eq!(&old[..was.start], &new[..is.start]);
                        prop_assert_eq!(&old[was.end..], &new[is.end..]);
                    }
                }
                None => {
                    prop_assert!(!draft.stated().contains_key(key.path));
                    rest_stays(old, new, &key)?;
                }
            }
            // Once more changes nothing.
            let once = draft.clone();
            draft.set(key.path, value.as_ref()).unwrap();
            prop_assert_eq!(draft.text(), once.text());
        }
    }

    #[test]
    fn removing_and_adding_a_key_states_the_same(text in text(), (key, value) in change()) {
        let mut draft = Draft::new(text).unwrap();
        let before = draft.stated();
        if is_in_long_braces(text, key.path) {
            return Ok(());
        }
        draft.set(key.path, None).unwrap();
        let out = draft.text().to_owned();
        if let Some(old) = before.get(key.path).filter(|_| !text.contains("unknown")) {
            draft.set(key.path, Some(old)).unwrap();
            prop_assert_eq!(draft.stated(), before);
            draft.set(key.path, None).unwrap();
            // Its section may be there now where dotted keys alone were, or where braces were empty.
            prop_assert!(!draft.stated().contains_key(key.path));
        }
        if let Some(value) = value {
            draft.set(key.path, Some(&value)).unwrap();
            draft.set(key.path, None).unwrap();
            prop_assert_eq!(Draft::new(&out).unwrap().stated(), draft.stated());
        }
    }

    /// Nothing panics, nothing that is refused changes anything, and what is taken is what files may have.
    #[test]
    fn treats_nonsense_as_files_do(text in text(), (key, _) in change(), value in nonsense()) {
        let mut draft = Draft::new(text).unwrap();
        match draft.set(key.path, Some(&value)) {
            Ok(()) => {
                let found = draft.stated()[key.path].clone();
                prop_assert!(same(&found, &value), "{} {}", found, value);
                let line = format!("{} = {}", key.path, toml_of(draft.text(), key.path));
                let alone = Scenario::parse(&line, "case").err();
                // Its range is kept; that it contradicts other keys is another matter.
                let message = alone.map(|e| e.to_string()).unwrap_or_default();
                prop_assert!(!message.contains(&key.domain.describe()), "{}", message);
            }
            Err(EditError::Refused(problem)) => {
                prop_assert_eq!(problem.key(), Some(key.path));
                prop_assert!(problem.to_string().contains(&key.domain.describe()));
                prop_assert!(problem.to_string().chars().count() < 4000);
                prop_assert_eq!(draft.text(), text);
            }
            Err(other) => prop_assert!(is_in_long_braces(text, key.path), "{}", other),
        }
    }

    /// Texts that are damaged at random are refused, or can be changed, or say which line is in the way.
    #[test]
    fn damaged_texts_never_panic(
        text in text(),
        cuts in prop::collection::vec((any::<prop::sample::Index>(), "[\\[\\]{}=.,#\"'\n\ra-z0-9 ]{0,3}"), 1..5),
        (key, value) in change(),
    ) {
        let mut damaged = text.to_owned();
        for (at, new) in cuts {
            let places: Vec<_> = damaged.char_indices().map(|(at, _)| at).chain([damaged.len()]).collect();
            let at = places[at.index(places.len())];
            let end = (at + 1..=damaged.len()).find(|end| damaged.is_char_boundary(*end)).unwrap_or(at);
            damaged.replace_range(at..end, &new);
        }
        if let Ok(mut draft) = Draft::new(&damaged) {
            let before = draft.clone();
            match draft.set(key.path, value.as_ref()) {
                Ok(()) => others_stay(&before, &draft, &key)?,
                Err(EditError::Blocked { line, .. }) => {
                    prop_assert!(line <= damaged.lines().count());
                    prop_assert_eq!(&draft, &before);
                }
                Err(EditError::Unplaced { .. }) => prop_assert_eq!(&draft, &before),
                Err(other) => prop_assert!(false, "{} in {:?}", other, damaged),
            }
        }
    }
}

fn toml_of(text: &str, path: &str) -> String {
    let at = place(text, path).unwrap();
    assert!(DeValue::parse(&text[at.clone()]).is_ok());
    text[at].to_owned()
}
