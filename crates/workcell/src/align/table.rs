//! Points in text: a header, then a point a line, separated by commas. Empty lines and what follows a `#` are skipped.

use super::error::TableError;
use super::fit::{MOST, Touch};

/// Columns of a drawn point, world frame \[m\].
const DRAWN: [&str; 3] = ["x_m", "y_m", "z_m"];

/// Columns of a touched point besides, base frame \[mm\], as a pendant shows them.
const TOUCHED: [&str; 3] = ["touched_x_mm", "touched_y_mm", "touched_z_mm"];

/// A column that may be there besides.
const NAME: &str = "name";

/// Longest text of a cell that a message repeats, in characters.
const LONGEST: usize = 40;

/// What spreadsheets put between columns elsewhere.
const OTHER_SEPARATORS: [char; 2] = [';', '\t'];

/// What a spreadsheet puts before everything else.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// A point with its line.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchedPoint {
    /// The line, from 1.
    pub line: usize,
    /// Its name, where the text has names.
    pub name: Option<String>,
    /// What is known of it.
    pub touch: Touch,
}

/// A point of the drawing alone.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnPoint {
    /// The line, from 1.
    pub line: usize,
    /// Its name, where the text has names.
    pub name: Option<String>,
    /// Where it is, world frame \[m\].
    pub drawn_m: [f64; 3],
}

/// Points with columns `x_m,y_m,z_m,touched_x_mm,touched_y_mm,touched_z_mm` in any order, and a `name` where one is wanted.
///
/// # Errors
/// [`TableError`], with the line.
pub fn touched_points(text: &str) -> Result<Vec<TouchedPoint>, TableError> {
    let names: Vec<&str> = DRAWN.into_iter().chain(TOUCHED).collect();
    let rows = rows(text, &names)?;
    let point = |row: Row| {
        let [x, y, z, touched @ ..] = <[f64; 6]>::try_from(row.values).unwrap_or([f64::NAN; 6]);
        TouchedPoint {
            line: row.line,
            name: row.name,
            touch: Touch {
                drawn_m: [x, y, z],
                touched_m: touched.map(|mm| 1e-3 * mm),
            },
        }
    };
    Ok(rows.into_iter().map(point).collect())
}

/// Points with columns `x_m,y_m,z_m` in any order, and a `name` where one is wanted.
///
/// # Errors
/// [`TableError`], with the line.
pub fn drawn_points(text: &str) -> Result<Vec<DrawnPoint>, TableError> {
    let point = |row: Row| DrawnPoint {
        line: row.line,
        name: row.name,
        drawn_m: <[f64; 3]>::try_from(row.values).unwrap_or([f64::NAN; 3]),
    };
    Ok(rows(text, &DRAWN)?.into_iter().map(point).collect())
}

/// A row: as many values as there are columns asked for, in their order.
struct Row {
    line: usize,
    name: Option<String>,
    values: Vec<f64>,
}

fn rows(text: &str, wanted: &[&str]) -> Result<Vec<Row>, TableError> {
    let expected = || wanted.join(",");
    let text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
    let lines = text.lines().enumerate().map(|(i, line)| {
        let content = line.split('#').next().unwrap_or_default();
        (i + 1, content.trim())
    });
    let mut lines = lines.filter(|(_, content)| !content.is_empty());
    let Some((header_line, header)) = lines.next() else {
        return Err(TableError::Empty { expected: expected() });
    };
    if let Some(found) = OTHER_SEPARATORS.into_iter().find(|other| header.contains(*other)) {
        return Err(TableError::Separator {
            line: header_line,
            found,
            expected: expected(),
        });
    }
    let header: Vec<&str> = header.split(',').map(str::trim).collect();
    let wrong = |column: &str, what| TableError::Header {
        line: header_line,
        column: column.to_owned(),
        what,
        expected: expected(),
    };
    for (i, column) in header.iter().enumerate() {
        if !wanted.contains(column) && *column != NAME {
            return Err(wrong(column, "unknown"));
        }
        if header[..i].contains(column) {
            return Err(wrong(column, "there twice"));
        }
    }
    let place = |column: &str| header.iter().position(|other| *other == column);
    let places: Vec<(usize, &str)> = wanted
        .iter()
        .map(|column| {
            place(column)
                .map(|at| (at, *column))
                .ok_or_else(|| wrong(column, "missing"))
        })
        .collect::<Result<_, _>>()?;
    let name = place(NAME);
    let mut all = Vec::new();
    for (line, content) in lines {
        let cells: Vec<&str> = content.split(',').map(str::trim).collect();
        if cells.len() != header.len() {
            return Err(TableError::Columns {
                line,
                expected: header.len(),
                found: cells.len(),
            });
        }
        if all.len() == MOST {
            return Err(TableError::TooMany { line, most: MOST });
        }
        let number = |(at, column): &(usize, &str)| {
            let parsed = cells[*at].parse::<f64>().ok().filter(|number| number.is_finite());
            parsed.ok_or_else(|| TableError::Number {
                line,
                column: (*column).to_owned(),
                found: cells[*at].chars().take(LONGEST).collect(),
            })
        };
        all.push(Row {
            line,
            name: name.map(|at| cells[at].to_owned()),
            values: places.iter().map(number).collect::<Result<_, _>>()?,
        });
    }
    if all.is_empty() {
        return Err(TableError::NoRows { line: header_line });
    }
    Ok(all)
}
