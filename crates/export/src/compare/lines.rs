//! Two texts, line by line.

use super::steps::{self, Step};
use crate::file::ProgramFile;
use crate::reading::Reading;
use crate::tokens::number_length;
use platewash_workcell::words::shortened;
use serde::Serialize;
use similar::{Algorithm, DiffTag, capture_diff_slices};
use std::collections::HashMap;

/// Most characters of a line that are told.
const TOLD: usize = 80;

/// Something that a program says otherwise than the one that was handed over.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Change {
    /// File and line, as `FILE:LINE`; of a line that is missing the one before it.
    pub place: String,
    /// What it is about, e.g. `joint 3`.
    pub what: String,
    /// What the line says.
    pub found: String,
    /// What was handed over.
    pub expected: String,
}

/// A program: its files, and what they say.
type Said<'a> = (&'a [ProgramFile], &'a Reading);

/// What the lines of one program say otherwise than those of another one.
pub(super) fn changes(found: Said<'_>, expected: Said<'_>) -> Vec<Change> {
    let steps = [found, expected].map(|(_, reading)| steps::by_line(reading));
    let rounding_s = steps::rounding_s(found.1, expected.1);
    let mut all = Vec::new();
    for file in found.0 {
        let named = expected.0.iter().find(|other| other.name == file.name);
        // A single file under another name, of a program of one file.
        let only = match (found.0, expected.0) {
            ([_], [only]) => Some(only),
            _ => None,
        };
        let texts = Texts {
            found: file,
            expected: named.or(only),
            steps: &steps,
            rounding_s,
        };
        texts.changes(&mut all);
    }
    all
}

/// One file beside the one that was handed over.
struct Texts<'a> {
    found: &'a ProgramFile,
    expected: Option<&'a ProgramFile>,
    steps: &'a [HashMap<(&'a str, usize), Vec<Step<'a>>>; 2],
    rounding_s: f64,
}

/// A line that says something: its number, from 1, as it stands, and without what does not count.
struct Line<'a> {
    number: usize,
    text: &'a str,
    plain: String,
}

impl Texts<'_> {
    fn changes(&self, all: &mut Vec<Change>) {
        let found = lines(&self.found.text);
        let expected = self.expected.map_or_else(Vec::new, |file| lines(&file.text));
        let [old, new] = [&expected, &found].map(|lines| lines.iter().map(|line| &line.plain).collect::<Vec<_>>());
        for difference in capture_diff_slices(Algorithm::Myers, &old, &new) {
            let (tag, old, new) = difference.as_tag_tuple();
            if tag == DiffTag::Equal {
                continue;
            }
            let last = found[..new.end].last().map_or(1, |line| line.number);
            let (old, new) = (&expected[old], &found[new]);
            let both = old.len().min(new.len());
            old.iter().zip(new).for_each(|(old, new)| self.changed(new, old, all));
            all.extend(new[both..].iter().map(|line| {
                let nothing = "no such line".to_owned();
                self.change(line.number, "line", told(line.text), nothing)
            }));
            all.extend(old[both..].iter().map(|line| {
                let missing = told(line.text);
                self.change(last, "line that is missing behind it", String::new(), missing)
            }));
        }
    }

    /// A line in place of another one: what it says otherwise of its points, or that it is another one.
    fn changed(&self, new: &Line<'_>, old: &Line<'_>, all: &mut Vec<Change>) {
        let [found, expected] = self.steps;
        let found = found.get(&(self.found.name.as_str(), new.number));
        let expected = self
            .expected
            .and_then(|file| expected.get(&(file.name.as_str(), old.number)));
        let points = found
            .zip(expected)
            .into_iter()
            .flat_map(|(found, expected)| found.iter().zip(expected));
        let told_before = all.len();
        for (what, found, expected) in points.flat_map(|(a, b)| a.differences(b, self.rounding_s)) {
            all.push(self.change(new.number, &what, found, expected));
        }
        if all.len() == told_before {
            all.push(self.change(new.number, "line", told(new.text), told(old.text)));
        }
    }

    fn change(&self, line: usize, what: &str, found: String, expected: String) -> Change {
        Change {
            place: format!("{}:{line}", self.found.name),
            what: what.to_owned(),
            found,
            expected,
        }
    }
}

/// The lines of a text that say something.
fn lines(text: &str) -> Vec<Line<'_>> {
    let line = |(i, text)| Line {
        number: i + 1,
        text,
        plain: plain(text),
    };
    let all = text.trim_start_matches('\u{feff}').lines().enumerate().map(line);
    all.filter(|line| !line.plain.is_empty()).collect()
}

/// A line without spaces that say nothing, its numbers in one spelling: 9E9 is 9E+09, and 0.5000 is 0.5.
fn plain(text: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.trim();
    while let Some(c) = rest.chars().next() {
        if c.is_whitespace() {
            rest = rest.trim_start();
            // Two words, or two numbers, are not one.
            if plain.ends_with(is_word) && rest.starts_with(is_word) {
                plain.push(' ');
            }
            continue;
        }
        let length = if plain.ends_with(is_word) {
            0
        } else {
            number_length(rest)
        };
        let taken = length.max(c.len_utf8());
        match rest[..length].parse::<f64>() {
            Ok(number) => plain.push_str(&number.to_string()),
            Err(_) => plain.push_str(&rest[..taken]),
        }
        rest = &rest[taken..];
    }
    plain
}

/// A line as it is told: without spaces around it, and not too long.
fn told(text: &str) -> String {
    shortened(text.trim(), TOLD)
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn spaces_and_spellings_of_numbers_do_not_count() {
        for (a, b) in [
            ("MoveAbsJ [[1.0000,-0.50],[9E9]]", "  MoveAbsJ [ [1,-0.5],[9E+09] ]\t"),
            ("\\T:=0.030898/pwShare", "\\T:=3.0898e-2 / pwShare"),
            ("joint_1: 1.0", "joint_1: 1"),
            ("1.0\t5.0E-03", "1 0.005"),
            (".5,e5", "0.5 , e5"),
        ] {
            assert_eq!(plain(a), plain(b));
        }
        for (a, b) in [
            ("joint_1", "joint_01"),
            ("v100", "v0100"),
            ("1.5", "15"),
            ("z5", "z50"),
            ("1e", "1"),
            ("a1.0", "a1"),
            ("0.1 2", "0.12"),
            ("RETURN x", "RETURNx"),
            ("e5", "e05"),
        ] {
            assert_ne!(plain(a), plain(b));
        }
    }
}
