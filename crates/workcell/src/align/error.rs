//! Why points give no mount.

use crate::words::millimetres;

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
