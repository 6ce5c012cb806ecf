//! Why a scenario is refused, with the key and the line at fault.

use crate::protocol::Refusal;
use platewash_scenario::keys::KEYS;
use platewash_scenario::{EditError, Failure, ScenarioError};

/// A refusal of a scenario's text.
pub fn of_scenario(error: &ScenarioError) -> Refusal {
    Refusal {
        key: error.key().map(ToOwned::to_owned),
        line: error.line,
        ..plain(error.problem.to_string())
    }
}

/// Refusal of a scenario's job.
pub fn of_failure(failure: &Failure) -> Refusal {
    match failure {
        Failure::Scenario(error) => of_scenario(error),
        // Files and the folders of meshes belong to it.
        Failure::Arm(error) => at("robot.urdf", &error.to_string()),
        other => about(other.to_string()),
    }
}

/// A refusal of a change.
pub fn of_edit(key: &str, error: &EditError) -> Refusal {
    let line = match error {
        EditError::Blocked { line, .. } => Some(*line),
        _ => None,
    };
    Refusal {
        line,
        ..at(key, &error.to_string())
    }
}

/// A refusal whose words name the keys that decide it, if any.
pub fn about(words: String) -> Refusal {
    let named = KEYS.iter().filter_map(|key| Some((words.find(key.path)?, key.path)));
    // The longest of those that begin first: one key's path may be the beginning of another's.
    let first = named.min_by_key(|(at, path)| (*at, usize::MAX - path.len()));
    Refusal {
        key: first.map(|(_, path)| path.to_owned()),
        ..plain(words)
    }
}

/// A refusal of a key.
pub fn at(key: &str, words: &str) -> Refusal {
    Refusal {
        key: Some(key.to_owned()),
        ..plain(words.to_owned())
    }
}

/// Greatest number of characters of a refusal: it may quote the refused text.
const LONGEST: usize = 2000;

/// A refusal that is about no key.
pub fn plain(words: String) -> Refusal {
    let words = match words.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", &words[..end]),
        None => words,
    };
    Refusal {
        words,
        key: None,
        line: None,
    }
}
