//! Points in text: a header, then a point a line, separated by commas. Empty lines and what follows a `#` are skipped.

use super::fit::{GREATEST, MOST, Touch};
use crate::number_table::{NumberTable, Row, TableError, TableShape};

/// Columns of a drawn point, world frame \[m\].
const DRAWN: [&str; 3] = ["x_m", "y_m", "z_m"];

/// Those of a touched point: besides, base frame \[mm\], as a pendant shows them.
const TOUCHED: [&str; 6] = ["x_m", "y_m", "z_m", "touched_x_mm", "touched_y_mm", "touched_z_mm"];

/// A column that may be there besides.
const NAME: [&str; 1] = ["name"];

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
    points(text, &TOUCHED, |line, name, [x, y, z, touched @ ..]| TouchedPoint {
        line,
        name,
        touch: Touch {
            drawn_m: [x, y, z],
            touched_m: touched.map(|mm| 1e-3 * mm),
        },
    })
}

/// Points with columns `x_m,y_m,z_m` in any order, and a `name` where one is wanted.
///
/// # Errors
/// [`TableError`], with the line.
pub fn drawn_points(text: &str) -> Result<Vec<DrawnPoint>, TableError> {
    points(text, &DRAWN, |line, name, drawn_m| DrawnPoint { line, name, drawn_m })
}

/// All rows, each of which `point` makes of its line, name and numbers.
fn points<const N: usize, T>(
    text: &str,
    columns: &[&str; N],
    point: impl Fn(usize, Option<String>, [f64; N]) -> T,
) -> Result<Vec<T>, TableError> {
    let shape = TableShape {
        required: columns,
        optional: &[&NAME],
        most: 1e3 * GREATEST,
        most_rows: MOST,
        has_comments: true,
    };
    let table = NumberTable::read(text, &shape)?;
    let (name, places) = (table.places(&NAME), table.places(columns));
    let row = |row: Result<Row<'_>, TableError>| {
        let row = row?;
        let name = name.map(|[place]| row.text(place).to_owned());
        let numbers = places.map(|places| row.numbers(places)).transpose()?;
        Ok(point(row.line, name, numbers.unwrap_or([f64::NAN; N])))
    };
    table.rows().map(row).collect()
}
