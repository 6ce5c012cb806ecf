//! Changes between two texts of a program, line by line; points by the lines that name them.

use crate::program::ProgramFile;
use crate::reading::{Reading, number_length};
use crate::step::{Step, by_line, rounding_s};
use platewash_workcell::words::{shortened, without_mark};
use serde::Serialize;
use similar::{Algorithm, DiffTag, capture_diff_slices};
use std::collections::{HashMap, HashSet};

/// Greatest number of characters of a line that are shown.
const TOLD: usize = 80;

/// Something that a program says otherwise than the one that was handed over.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Change {
    /// File and line, as `FILE:LINE`; of a line that is missing the one before it.
    pub place: String,
    /// Subject of the change, e.g. `joint 3`.
    pub what: String,
    /// Value in the line.
    pub found: String,
    /// Value that was handed over.
    pub expected: String,
}

/// A program: its files and its reading.
type ParsedProgram<'a> = (&'a [ProgramFile], &'a Reading);

/// Lists the differences between the lines of two programs.
pub(crate) fn changes(found: ParsedProgram<'_>, expected: ParsedProgram<'_>) -> Vec<Change> {
    let steps = [found, expected].map(|(_, reading)| by_line(reading));
    let rounding_s = rounding_s(found.1, expected.1);
    let mut all = Vec::new();
    for file in found.0 {
        let expected = same_file(file, expected.0);
        let in_order = expected.and_then(|expected| in_columns_of(&file.text, &expected.text));
        let in_order = in_order.map(|text| ProgramFile {
            name: file.name.clone(),
            text,
        });
        let texts = Texts {
            found: in_order.as_ref().unwrap_or(file),
            expected,
            steps: &steps,
            rounding_s,
        };
        texts.changes(&mut all);
    }
    all
}

/// The file of a program that another file is: of those of its kind, or else of all, the one with the most equal lines, and of several the one of
/// its name. A new name is no change.
pub(crate) fn same_file<'a>(file: &ProgramFile, expected: &'a [ProgramFile]) -> Option<&'a ProgramFile> {
    let kind = |name: &str| match name.rsplit_once('.').map(|(_, kind)| kind.to_ascii_lowercase()) {
        Some(kind) if kind == "yml" => Some("yaml".to_owned()),
        kind => kind,
    };
    let lines: HashSet<&str> = file.text.lines().map(str::trim_end).collect();
    let alike = |other: &&ProgramFile| {
        let count = other.text.lines().filter(|line| lines.contains(line)).count();
        (count, other.name == file.name)
    };
    let of_kind = expected.iter().filter(|other| kind(&other.name) == kind(&file.name));
    of_kind.max_by_key(alike).or_else(|| expected.iter().max_by_key(alike))
}

/// The text of a table with its columns in the order of another one; `None` where it is no table of the same columns, or has them so.
fn in_columns_of(found: &str, expected: &str) -> Option<String> {
    let cells = |line: &str| {
        line.trim_end()
            .split(',')
            .map(|cell| cell.trim().to_owned())
            .collect::<Vec<_>>()
    };
    let [found_names, names] = [found, expected].map(|text| without_mark(text).lines().next().map(cells));
    let (found_names, names) = (found_names?, names?);
    let places: Option<Vec<usize>> = names
        .iter()
        .map(|name| found_names.iter().position(|other| other == name))
        .collect();
    let places = places.filter(|_| found_names.len() == names.len() && found_names != names)?;
    let row = |line: &str| {
        let cells = cells(line);
        let moved: Option<Vec<&str>> = places
            .iter()
            .map(|place| cells.get(*place).map(String::as_str))
            .collect();
        moved.map_or_else(|| line.to_owned(), |moved| moved.join(","))
    };
    Some(found.lines().map(row).collect::<Vec<_>>().join("\n"))
}

/// One file beside the one that was handed over.
struct Texts<'a> {
    found: &'a ProgramFile,
    expected: Option<&'a ProgramFile>,
    steps: &'a [HashMap<(&'a str, usize), Vec<Step<'a>>>; 2],
    rounding_s: f64,
}

/// A line with contents: its number, from 1, its text as it stands, and its text without the parts that do not count.
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
                self.change(line.number, "line", shown_line(line.text), nothing)
            }));
            all.extend(old[both..].iter().map(|line| {
                let missing = shown_line(line.text);
                self.change(last, "line that is missing behind it", String::new(), missing)
            }));
        }
    }

    /// Lists the changes of a line that replaces another one: the differences of its points, or the other line.
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
            all.push(self.change(new.number, "line", shown_line(new.text), shown_line(old.text)));
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

/// A line for display: without spaces around it, and not too long.
fn shown_line(text: &str) -> String {
    shortened(text.trim(), TOLD)
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn comparison_ignores_spaces_and_spellings_of_numbers() {
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
