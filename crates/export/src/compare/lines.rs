//! Two texts, line by line.

use super::change::Change;
use super::steps::{self, Step};
use crate::file::ProgramFile;
use crate::reading::Reading;
use crate::tokens::number_length;
use platewash_workcell::words::shortened;
use similar::{Algorithm, DiffOp, capture_diff_slices};
use std::collections::HashMap;

/// Most characters of a line that are told.
const TOLD: usize = 80;

/// A program: its files, and what they say.
type Said<'a> = (&'a [ProgramFile], &'a Reading);

/// What the lines of one program say otherwise than those of another one.
pub(super) fn changes(found: Said<'_>, expected: Said<'_>) -> Vec<Change> {
    let steps = [found, expected].map(|(_, reading)| steps::by_line(reading));
    let rounding_s = steps::rounding_s(found.1, expected.1);
    let mut all = Vec::new();
    for file in found.0 {
        let other = counterpart(file, found.0, expected.0);
        let texts = Texts {
            found: file,
            expected: other,
            steps: &steps,
            rounding_s,
        };
        texts.changes(&mut all);
    }
    all
}

/// The file that was handed over as this one: that of its name, or of its place where it was renamed.
fn counterpart<'a>(file: &ProgramFile, found: &[ProgramFile], expected: &'a [ProgramFile]) -> Option<&'a ProgramFile> {
    let named = expected.iter().find(|other| other.name == file.name);
    // A single file under another name, of a program of one file.
    let only = (found.len() == 1).then_some(expected).and_then(|all| match all {
        [one] => Some(one),
        _ => None,
    });
    named.or(only)
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
        let plain = |lines: &[Line<'_>]| lines.iter().map(|line| line.plain.clone()).collect::<Vec<_>>();
        let differences = capture_diff_slices(Algorithm::Myers, &plain(&expected), &plain(&found));
        for difference in differences {
            let (_, old, new) = difference.as_tag_tuple();
            let (old, new) = (&expected[old], &found[new.clone()]);
            if matches!(difference, DiffOp::Equal { .. }) {
                continue;
            }
            let pairs = old.len().min(new.len());
            let before = new.first().map_or(1, |line| line.number);
            old.iter().zip(new).for_each(|(old, new)| self.changed(new, old, all));
            for line in &new[pairs..] {
                all.push(self.change(line.number, "line", told(line.text), "no such line".to_owned()));
            }
            let last = new
                .last()
                .map_or_else(|| self.before(&found, &difference), |line| line.number);
            for line in &old[pairs..] {
                let at = if new.is_empty() { last } else { before.max(last) };
                all.push(self.change(at, "line that is missing behind it", String::new(), told(line.text)));
            }
        }
    }

    /// The number of the line before lines that are missing.
    fn before(&self, found: &[Line<'_>], difference: &DiffOp) -> usize {
        let next = difference.new_range().start;
        next.checked_sub(1)
            .and_then(|i| found.get(i))
            .map_or(1, |line| line.number)
    }

    /// A line in place of another one: what it says otherwise of its points, or that it is another one.
    fn changed(&self, new: &Line<'_>, old: &Line<'_>, all: &mut Vec<Change>) {
        let [found, expected] = self.steps;
        let found = found.get(&(self.found.name.as_str(), new.number)).into_iter().flatten();
        let expected = self
            .expected
            .and_then(|file| expected.get(&(file.name.as_str(), old.number)));
        let mut told_any = false;
        for (a, b) in found.zip(expected.into_iter().flatten()) {
            for (what, found, expected) in a.differences(b, self.rounding_s) {
                all.push(self.change(new.number, &what, found, expected));
                told_any = true;
            }
        }
        if !told_any {
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
