//! Unit of a file, and points in text.

use crate::measured::bounds::{LEAST_PLATE_M, MOST_PLATE_M};
use crate::measured::error::MeasuredError;
use nalgebra::Point3;
use platewash_workcell::number_table::{NumberTable, TableError, TableShape};
use platewash_workcell::words::without_mark;
use serde::{Deserialize, Serialize};

/// Least and greatest diameter of a plate whose unit is guessed \[m\]. Their ratio is below 2.54, that of inch and cm, so that no two units
/// fit.
const GUESSED_M: [f64; 2] = [0.145, 0.365];

/// Unit of the lengths in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unit {
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetre,
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Inches.
    #[serde(rename = "inch")]
    Inch,
}

impl Unit {
    /// All units.
    pub const ALL: [Self; 4] = [Self::Metre, Self::Centimetre, Self::Millimetre, Self::Inch];

    /// Length of the unit \[m\].
    #[must_use]
    pub fn length_m(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 1e-2,
            Self::Millimetre => 1e-3,
            Self::Inch => 0.0254,
        }
    }

    /// Short name: `m`, `cm`, `mm` or `inch`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Inch => "inch",
        }
    }

    /// Returns the unit of a short name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// Returns the stated unit, or the only one in which a diameter is that of a plate.
    pub(super) fn determine(stated: Option<Self>, diameter: f64) -> Result<Self, MeasuredError> {
        let within = |unit: Self, [least, most]: [f64; 2]| (least..=most).contains(&(diameter * unit.length_m()));
        match stated {
            Some(unit) if within(unit, [LEAST_PLATE_M, MOST_PLATE_M]) => Ok(unit),
            Some(unit) => Err(MeasuredError::Size {
                diameter_m: diameter * unit.length_m(),
            }),
            None => {
                let mut fitting = Self::ALL.into_iter().filter(|unit| within(*unit, GUESSED_M));
                fitting.next().ok_or(MeasuredError::Unit { diameter })
            }
        }
    }
}

/// Columns of a point, with the unit that they state.
const COLUMNS: [([&str; 3], Option<Unit>); 3] = [
    (["x", "y", "z"], None),
    (["x_m", "y_m", "z_m"], Some(Unit::Metre)),
    (["x_mm", "y_mm", "z_mm"], Some(Unit::Millimetre)),
];

/// Greatest number of points in a text.
const MOST_ROWS: usize = 100_000;

/// Reads points with columns `x,y,z`, or `x_m,y_m,z_m` or `x_mm,y_mm,z_mm`, which state the unit, in any order, and an optional `name`.
/// Returns the unit, too, if it is stated.
///
/// # Errors
/// [`TableError`], with the line.
pub fn probe_points(text: &str) -> Result<(Vec<Point3<f64>>, Option<Unit>), TableError> {
    let lines = without_mark(text).lines();
    let mut lines = lines.map(|line| line.split('#').next().unwrap_or_default());
    let header = lines.find(|line| !line.trim().is_empty()).unwrap_or_default();
    let has = |(names, _): &&([&str; 3], Option<Unit>)| header.split(',').any(|cell| names.contains(&cell.trim()));
    let (columns, unit) = COLUMNS.iter().find(has).unwrap_or(&COLUMNS[0]);
    let shape = TableShape {
        required: columns,
        optional: &[&["name"]],
        most: 1e9,
        most_rows: MOST_ROWS,
        has_comments: true,
    };
    let table = NumberTable::read(text, &shape)?;
    let places = table.places(columns).unwrap_or_default();
    let points: Result<Vec<_>, _> = table
        .rows()
        .map(|row| Ok(Point3::from(row?.numbers(places)?)))
        .collect();
    Ok((points?, *unit))
}
