//! Why points give no mount.

use crate::words::{millimetres, printable};

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// m
    Metre,
    /// mm
    Millimetre,
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Metre => "metres",
            Self::Millimetre => "millimetres",
        })
    }
}

/// Why touched points give no mount. Points count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AlignError {
    /// Fewer than three points, or more than anybody touches.
    #[error("{found} points; at least 3 that are not in line, and at most {most}, give a mount")]
    Count {
        /// How many.
        found: usize,
        /// How many are possible.
        most: usize,
    },
    /// A coordinate that is not finite or out of this world.
    #[error("point {point}: its coordinates must be numbers from -{most} to {most} m; found {found}")]
    Coordinate {
        /// Index of the point.
        point: usize,
        /// The coordinate \[m\].
        found: f64,
        /// What it may be at most \[m\].
        most: f64,
    },
    /// Two points in one place.
    #[error("points {} and {} are {} apart as they are {how}; touch points that are farther apart than {}", .points[0], .points[1], millimetres(*.apart_m), millimetres(*.least_m))]
    Coincident {
        /// Their indices.
        points: [usize; 2],
        /// How far they are apart \[m\].
        apart_m: f64,
        /// How far they must be apart \[m\].
        least_m: f64,
        /// Drawn or touched.
        how: &'static str,
    },
    /// All points are nearly in line.
    #[error(
        "the points, as they are {how}, lie within {} of one line, so that the turn about it is not known; touch one at least {} beside it",
        millimetres(*.beside_m),
        millimetres(*.least_m)
    )]
    InLine {
        /// How far the points are from it, root mean square \[m\].
        beside_m: f64,
        /// How far they must be \[m\].
        least_m: f64,
        /// Drawn or touched.
        how: &'static str,
    },
    /// Lengths that differ by a factor of a thousand.
    #[error(
        "the points are {ratio:.6} times as far apart as touched as they are drawn: the {which} coordinates seem to be in {found}; \
         expected {expected}"
    )]
    Units {
        /// Lengths touched over lengths drawn.
        ratio: f64,
        /// Drawn or touched.
        which: &'static str,
        /// What they seem to be in.
        found: Unit,
        /// What they should be in.
        expected: Unit,
    },
    /// A mirror image fits, and no rotation does.
    #[error(
        "a mirror image of the points fits to {}, and no rotation better than {}: an axis of the drawing points the other way, or two \
         points are exchanged",
        millimetres(*.mirrored_m),
        millimetres(*.rotated_m)
    )]
    Mirrored {
        /// Root mean square of what is left with a mirror \[m\].
        mirrored_m: f64,
        /// The same with a rotation \[m\].
        rotated_m: f64,
    },
    /// The table would hang from the ceiling.
    #[error(
        "the table would lie upside down at the arm, its z tilted by {tilt_deg:.1}° against the base's: touched in another order than \
         drawn, or an axis of the drawing points the other way"
    )]
    UpsideDown {
        /// Angle between both z axes \[°\].
        tilt_deg: f64,
    },
}

/// Why a text is no table of points. Lines count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// No line at all.
    #[error("line 1: it is empty; expected the header \"{expected}\"")]
    Empty {
        /// The header.
        expected: String,
    },
    /// A header without rows.
    #[error("line {line}: it has a header and no points")]
    NoRows {
        /// The header's line.
        line: usize,
    },
    /// Columns that are separated by something else.
    #[error(
        "line {line}: columns are separated by {found:?}; expected commas between them, and a point for decimals: \"{expected}\""
    )]
    Separator {
        /// The header's line.
        line: usize,
        /// What separates them.
        found: char,
        /// The header.
        expected: String,
    },
    /// A column that is missing, unknown or there twice.
    #[error("line {line}: column \"{}\" is {what}; expected the header \"{expected}\"", printable(.column))]
    Header {
        /// The line.
        line: usize,
        /// The column.
        column: String,
        /// What is wrong with it.
        what: &'static str,
        /// The header.
        expected: String,
    },
    /// A row of another length than the header.
    #[error(
        "line {line}: found {found} columns; expected {expected}, as the header has; decimals take a point, as commas separate columns"
    )]
    Columns {
        /// The line.
        line: usize,
        /// As many as the header has.
        expected: usize,
        /// As many as it has.
        found: usize,
    },
    /// A cell that is no finite number.
    #[error("line {line}, column {column}: expected a finite number, with a point for decimals; found \"{}\"", printable(.found))]
    Number {
        /// The line.
        line: usize,
        /// The column's name.
        column: String,
        /// What stands there.
        found: String,
    },
    /// More rows than are read.
    #[error("line {line}: more than {most} points")]
    TooMany {
        /// The first line that is too many.
        line: usize,
        /// How many are read.
        most: usize,
    },
}
