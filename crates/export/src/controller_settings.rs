//! Settings that change how a controller moves along the points of a program, as the program states them, and their comparison with those that
//! were handed over.
//!
//! The proof of a program's motion does not see them: a script with another look-ahead, a path tolerance that aborts earlier, stops at every
//! target. So they must be as they were exported, or safer where that is known.

use crate::program::Place;
use std::collections::HashSet;

/// Setting of a controller that changes the motion, as a program states it, or as it is where the program states nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadSetting {
    /// The line that states it, or the first that it counts for.
    pub place: Place,
    /// Name, as the program has it.
    pub name: String,
    /// Value, in words.
    pub value: String,
    /// Other values that are accepted in its place.
    pub accepted: Accepted,
}

/// Values of a setting that are accepted in the place of the one that was handed over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Accepted {
    /// The same value alone.
    Equal,
    /// This number, or a greater one.
    AtLeast(f64),
    /// This number, or a smaller one.
    AtMost(f64),
}

impl ReadSetting {
    /// Returns true where it may stand in the place of one that was handed over.
    pub(crate) fn is_accepted_for(&self, expected: &Self) -> bool {
        let accepted = match (self.accepted, expected.accepted) {
            (Accepted::AtLeast(found), Accepted::AtLeast(least)) => found >= least,
            (Accepted::AtMost(found), Accepted::AtMost(most)) => found <= most,
            // No tolerance at all is wider than any, the controller's own among them.
            (Accepted::AtLeast(found), Accepted::Equal) => found == f64::INFINITY,
            _ => false,
        };
        self.name == expected.name && (accepted || self.value == expected.value)
    }
}

/// Settings in the order of a program: each value once, at its first line.
#[derive(Debug, Default)]
pub(crate) struct SettingList {
    all: Vec<ReadSetting>,
    noted: HashSet<(String, String)>,
}

impl SettingList {
    /// Notes a setting.
    pub(crate) fn note(&mut self, name: &str, value: &str, place: &Place) {
        self.note_with(name, value, place, Accepted::Equal);
    }

    /// Notes a setting of which other values are accepted, too.
    pub(crate) fn note_with(&mut self, name: &str, value: &str, place: &Place, accepted: Accepted) {
        let (name, value) = (name.to_owned(), value.to_owned());
        if self.noted.insert((name.clone(), value.clone())) {
            self.all.push(ReadSetting {
                place: place.clone(),
                name,
                value,
                accepted,
            });
        }
    }

    /// Returns the settings.
    pub(crate) fn into_vec(self) -> Vec<ReadSetting> {
        self.all
    }
}
