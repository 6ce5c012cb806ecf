//! Tables of numbers as text: a header with a unit in each name, then a row a line, commas between columns.

use crate::words::{count_with_noun, quoted, shortened, without_mark};

/// Longest text of a cell that a message repeats, in characters.
const LONGEST: usize = 40;

/// Column separators of spreadsheets in other locales.
const OTHER_SEPARATORS: [char; 2] = [';', '\t'];

/// Columns of a table, and rules for reading it.
#[derive(Debug, Clone, Copy)]
pub struct TableShape<'s> {
    /// Columns that must be present, in any order.
    pub required: &'s [&'s str],
    /// Groups of columns of which all or none must be present.
    pub optional: &'s [&'s [&'s str]],
    /// Greatest absolute value of a number.
    pub most: f64,
    /// Greatest number of rows.
    pub most_rows: usize,
    /// True if empty lines are skipped, and comments that start with `#`.
    pub has_comments: bool,
}

/// Error in a table, with its line and column.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}{}: {reason}", in_column(.column.as_ref()))]
pub struct TableError {
    /// Line number, from 1.
    pub line: usize,
    /// Column number, from 1, and column name.
    pub column: Option<(usize, String)>,
    /// Description of the error, and of the expected value.
    pub reason: String,
}

fn in_column(column: Option<&(usize, String)>) -> String {
    column.map_or_else(String::new, |(number, name)| format!(", column {number} ({name})"))
}

impl TableError {
    /// Returns the reason with the column, for messages that name the line themselves.
    #[must_use]
    pub fn without_line(&self) -> String {
        let column = in_column(self.column.as_ref());
        match column.strip_prefix(", ") {
            Some(column) => format!("{column}: {}", self.reason),
            None => self.reason.clone(),
        }
    }
}

/// Table whose header was read.
#[derive(Debug)]
pub struct NumberTable<'a> {
    names: Vec<&'a str>,
    rows: Vec<(usize, &'a str)>,
    most: f64,
}

/// Row of a table.
#[derive(Debug)]
pub struct Row<'t> {
    /// Line number, from 1.
    pub line: usize,
    names: &'t [&'t str],
    cells: Vec<&'t str>,
    most: f64,
}

/// Returns the line of a table's header, from 1, and the names in it; `None` for a text without lines. Empty lines, and comments that start
/// with `#`, are skipped where there may be any.
#[must_use]
pub fn header(text: &str, has_comments: bool) -> Option<(usize, Vec<&str>)> {
    let (line, header) = lines(text, has_comments).next()?;
    let mut names = cells(header);
    names.pop_if(|last| last.is_empty());
    Some((line, names))
}

/// The lines of a text with their numbers, from 1.
fn lines(text: &str, has_comments: bool) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(without_mark(text).lines());
    let lines = lines.map(move |(line, text)| match has_comments {
        true => (line, text.split('#').next().unwrap_or_default()),
        false => (line, text),
    });
    lines.filter(move |(_, text)| !(has_comments && text.trim().is_empty()))
}

/// The cells of a line, without spaces and quotation marks around them.
fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(bare).collect()
}

fn bare(cell: &str) -> &str {
    let cell = cell.trim();
    let inner = cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"'));
    inner.map_or(cell, str::trim)
}

/// Returns the names of the columns in a header, without an empty one behind its last comma.
///
/// # Errors
/// [`TableError`] for an empty header, other separators, and columns that are unknown, missing or repeated.
fn column_names<'a>(line: usize, header: &'a str, shape: &TableShape<'_>) -> Result<Vec<&'a str>, TableError> {
    let expected = shape.required.join(",");
    if header.trim().is_empty() {
        return refused(line, format!("it is empty; expected the header \"{expected}\""));
    }
    if let Some(found) = OTHER_SEPARATORS.into_iter().find(|other| header.contains(*other)) {
        let reason = format!(
            "columns are separated by {found:?}; expected commas between them, and a point for decimals: \"{expected}\""
        );
        return refused(line, reason);
    }
    let mut names = cells(header);
    names.pop_if(|last| last.is_empty());
    let wrong = |column: &str, what: &str| {
        let column = quoted(&shortened(column, LONGEST));
        refused(
            line,
            format!("column {column} is {what}; expected the header \"{expected}\""),
        )
    };
    for (k, column) in names.iter().enumerate() {
        if !shape.required.contains(column) && !shape.optional.iter().any(|group| group.contains(column)) {
            return wrong(column, "unknown");
        }
        if names[..k].contains(column) {
            return wrong(column, "there twice");
        }
    }
    let is_there = |column: &&&str| names.contains(*column);
    let begun = shape
        .optional
        .iter()
        .filter(|group| group.iter().any(|column| is_there(&column)));
    let missing = [shape.required]
        .iter()
        .chain(begun)
        .flat_map(|group| group.iter())
        .find(|column| !is_there(column));
    if let Some(missing) = missing {
        return wrong(missing, "missing");
    }
    Ok(names)
}

fn refused<T>(line: usize, reason: String) -> Result<T, TableError> {
    let column = None;
    Err(TableError { line, column, reason })
}

fn in_cell<T>(names: &[&str], line: usize, place: usize, reason: String) -> Result<T, TableError> {
    let name = names.get(place).copied().unwrap_or_default().to_owned();
    let column = Some((place + 1, name));
    Err(TableError { line, column, reason })
}

impl<'a> NumberTable<'a> {
    /// Reads the header of a table with at least one row.
    ///
    /// # Errors
    /// [`TableError`] with the line.
    pub fn read(text: &'a str, shape: &TableShape<'_>) -> Result<Self, TableError> {
        let mut lines = lines(text, shape.has_comments);
        let (header_line, header) = lines.next().unwrap_or((1, ""));
        let names = column_names(header_line, header, shape)?;
        let rows: Vec<_> = lines.take(shape.most_rows + 1).collect();
        match rows
            .get(shape.most_rows)
            .or(rows.is_empty().then_some(&(header_line, "")))
        {
            Some((line, _)) if rows.is_empty() => refused(*line, "it has a header and no rows".to_owned()),
            Some((line, _)) => refused(
                *line,
                format!(
                    "it has more than {}, the most that are read",
                    count_with_noun(shape.most_rows, "row")
                ),
            ),
            None => Ok(Self {
                names,
                rows,
                most: shape.most,
            }),
        }
    }

    /// Returns the positions of columns; `None` unless all of them are present.
    #[must_use]
    pub fn places<const N: usize>(&self, names: &[&str; N]) -> Option<[usize; N]> {
        let places: Option<Vec<usize>> = names
            .iter()
            .map(|name| self.names.iter().position(|other| other == name))
            .collect();
        places?.try_into().ok()
    }

    /// Returns an error about a cell of a line.
    ///
    /// # Errors
    /// [`TableError`], always.
    pub fn refused<T>(&self, line: usize, place: usize, reason: String) -> Result<T, TableError> {
        in_cell(&self.names, line, place, reason)
    }

    /// Returns the rows, each with as many cells as the header; an empty one behind a last comma does not count.
    pub fn rows(&self) -> impl Iterator<Item = Result<Row<'_>, TableError>> {
        self.rows.iter().map(|(line, text)| {
            let expected = self.names.len();
            let mut cells = cells(text);
            if cells.len() == expected + 1 {
                cells.pop_if(|last| last.is_empty());
            }
            let found = cells.len();
            if found != expected {
                let found = count_with_noun(found, "column");
                let reason =
                    format!("found {found}; expected {expected}, as the header has; decimals take a point, as commas separate columns");
                return refused(*line, reason);
            }
            Ok(Row {
                line: *line,
                names: &self.names,
                cells,
                most: self.most,
            })
        })
    }
}

impl Row<'_> {
    /// Returns the text of a cell.
    #[must_use]
    pub fn text(&self, place: usize) -> &str {
        self.cells.get(place).copied().unwrap_or_default()
    }

    /// Returns the numbers in some columns.
    ///
    /// # Errors
    /// [`TableError`] for a cell that is not a number within the bounds.
    pub fn numbers<const N: usize>(&self, places: [usize; N]) -> Result<[f64; N], TableError> {
        let mut numbers = [0.0; N];
        for (number, place) in numbers.iter_mut().zip(places) {
            // Rust reads "inf" and "nan", too.
            match self.text(place).parse::<f64>() {
                Ok(found) if found.abs() <= self.most => *number = found,
                _ => {
                    let (most, found) = (self.most, self.quoted(place));
                    return self.refused(
                        place,
                        format!(
                            "expected a number from -{most:e} to {most:e}, with a point for decimals; found {found}"
                        ),
                    );
                }
            }
        }
        Ok(numbers)
    }

    /// Returns the text of a cell for a message: quoted, and shortened.
    #[must_use]
    pub fn quoted(&self, place: usize) -> String {
        quoted(&shortened(self.text(place), LONGEST))
    }

    /// Returns an error about a cell of the row.
    ///
    /// # Errors
    /// [`TableError`], always.
    pub fn refused<T>(&self, place: usize, reason: String) -> Result<T, TableError> {
        in_cell(self.names, self.line, place, reason)
    }

    /// Checks that the row's time is after that of the row before.
    ///
    /// # Errors
    /// [`TableError`] if it is not.
    pub fn check_after(&self, place: usize, t_s: f64, before_s: Option<f64>) -> Result<(), TableError> {
        match before_s {
            Some(before_s) if t_s <= before_s => self.refused(
                place,
                format!("{t_s} s must come after {before_s} s, the time of the row before"),
            ),
            _ => Ok(()),
        }
    }
}
