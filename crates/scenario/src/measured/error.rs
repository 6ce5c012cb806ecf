//! Errors of a measured plate, and places on it.

use crate::measured::bounds::{LEAST_PLATE_M, MOST_DEVIATION_M, MOST_PLATE_M};
use crate::measured::side::FaceSide;
use platewash_workcell::words::millimetres;

/// Place on a measured plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Distance from the axis \[m\].
    pub radius_m: f64,
    /// Azimuth about the axis, from x of the plate frame \[°\].
    pub azimuth_deg: f64,
    /// Coordinates in the file, in its unit.
    pub in_file: [f64; 3],
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.in_file;
        write!(
            f,
            "radius {}, azimuth {:.0}° (in the file {x:.6}, {y:.6}, {z:.6})",
            millimetres(self.radius_m),
            self.azimuth_deg
        )
    }
}

/// Reason that a mesh or points give no plate.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredError {
    /// There are no triangles with an area.
    #[error("the mesh has no triangle with an area; expected the surface of a plate, or of its face")]
    Empty,
    /// There are too few points.
    #[error("{found} points; expected {least} or more, spread over the face and along its rim")]
    Few {
        /// Number of points.
        found: usize,
        /// Least number.
        least: usize,
    },
    /// A coordinate is not a number, or too large.
    #[error("{what} {index}, counted from 0, has the coordinates {found:?}; expected numbers from -1e9 to 1e9")]
    Coordinate {
        /// "triangle" or "point".
        what: &'static str,
        /// Index of the triangle or the point.
        index: usize,
        /// Coordinates found.
        found: [f64; 3],
    },
    /// The unit is not stated, and the size does not tell it.
    #[error(
        "the file does not state its unit, and the plate measures {diameter:.4} across, a diameter from 145 mm to 365 mm in none of m, mm, \
         cm and inch: state the unit"
    )]
    Unit {
        /// Diameter in the unit of the file.
        diameter: f64,
    },
    /// The size is not that of a plate.
    #[error(
        "the plate measures {} across in the stated unit; expected {} to {}: state the unit of the file",
        millimetres(*.diameter_m),
        millimetres(LEAST_PLATE_M),
        millimetres(MOST_PLATE_M)
    )]
    Size {
        /// Diameter \[m\].
        diameter_m: f64,
    },
    /// The rim is no circle.
    #[error(
        "it is not a surface of revolution: its rim is between {} and {} from the axis, the least at {place}; expected one radius within {}: \
         only round plates can be washed, and a mesh of one needs 12 corners or more round its rim",
        millimetres(.rim_m[0]),
        millimetres(.rim_m[1]),
        millimetres(MOST_DEVIATION_M)
    )]
    NotRound {
        /// Least and greatest radius of the rim \[m\].
        rim_m: [f64; 2],
        /// Place of the least radius.
        place: Place,
    },
    /// A probed point is beyond the rim.
    #[error(
        "the rim is not round, or a point is not on the plate: it is at {place}, and the rim is {} from the axis; expected points up to {} \
         beyond: leave that point out; only round plates can be washed",
        millimetres(*.rim_m),
        millimetres(MOST_DEVIATION_M)
    )]
    BeyondRim {
        /// The point.
        place: Place,
        /// Radius of the rim: the median of the outermost points of all eighths of the turn \[m\].
        rim_m: f64,
    },
    /// A probed rim has a gap.
    #[error(
        "no point is on the rim, {} from the axis, between azimuth {:.0}° and {:.0}°, about {place}; expected one at least every {} °, within {} \
         of that radius: touch the rim all round; only round plates can be washed",
        millimetres(*.rim_m),
        .between_deg[0],
        .between_deg[1],
        .most_deg,
        millimetres(MOST_DEVIATION_M)
    )]
    RimGap {
        /// Azimuths of the points on the rim on both sides \[°\].
        between_deg: [f64; 2],
        /// Greatest difference of their azimuths \[°\].
        most_deg: f64,
        /// Middle of the rim between them.
        place: Place,
        /// Radius of the rim \[m\].
        rim_m: f64,
    },
    /// A part of the face is missing.
    #[error(
        "a part of the face is missing: nothing between radius {} and {} at azimuth {:.0}°, about {place}; expected a whole face: close \
         the hole or measure there",
        millimetres(.between_m[0]),
        millimetres(.between_m[1]),
        .place.azimuth_deg
    )]
    Missing {
        /// Least and greatest radius without a face at that azimuth \[m\].
        between_m: [f64; 2],
        /// Middle of that part.
        place: Place,
    },
    /// The face rises too steeply.
    #[error(
        "the face rises by {slope_deg:.0}° at radius {}; expected 60° or less; steeper walls, as of cups and bowls, are not washed",
        millimetres(*.radius_m)
    )]
    Steep {
        /// Radius \[m\].
        radius_m: f64,
        /// Mean slope there \[°\].
        slope_deg: f64,
    },
    /// Something stands up from the face or the rim.
    #[error(
        "something stands {} high on the face or the rim, at {place}; expected {} or less: a plate's body ends at its face, so leave out of the \
         file what is no plate, or place it as an obstacle",
        millimetres(*.height_m),
        millimetres(MOST_DEVIATION_M)
    )]
    StandsUp {
        /// Height above the face, and beyond the rim above its edge \[m\].
        height_m: f64,
        /// Place of it.
        place: Place,
    },
    /// The plate differs too much from its profile.
    #[error(
        "the plate is {} off its profile at {place}; expected {} or less: it is chipped, dented, bent or not round, or the file holds more \
         than a plate",
        millimetres(*.deviation_m),
        millimetres(MOST_DEVIATION_M)
    )]
    Rough {
        /// Greatest deviation \[m\].
        deviation_m: f64,
        /// Place of it.
        place: Place,
    },
    /// The side that would be the face is refused, and the other one is a face.
    #[error(
        "{why}. That is the side towards {tried} of the file; the other side would fit: if it is the face, state \"{other}\" as the face"
    )]
    OtherSide {
        /// Reason that the side is refused.
        why: Box<MeasuredError>,
        /// Side that was tried.
        tried: FaceSide,
        /// The other side.
        other: FaceSide,
    },
    /// The side that is washed is not told.
    #[error("{why}: state the direction of the file in which the washed face looks")]
    FaceUnclear {
        /// Reason.
        why: String,
    },
    /// The points fix no axis.
    #[error("the points fix no axis: {why}")]
    NoAxis {
        /// Reason, and advice.
        why: String,
    },
}

impl MeasuredError {
    /// The axis is not along the stated direction.
    pub(super) fn across(stated: Option<FaceSide>, off_deg: f64) -> Self {
        let stated = stated.map_or("", FaceSide::name);
        let why = format!("the plate's axis is {off_deg:.0}° from the stated {stated}, so that no side looks there");
        Self::FaceUnclear { why }
    }

    /// The plate is flat, and its axis is level in the file.
    pub(super) fn level(sides: [FaceSide; 2]) -> Self {
        let [first, second] = sides;
        let why = format!(
            "the plate is flat, and neither side looks along the file's z: one looks along {first}, one along {second}"
        );
        Self::FaceUnclear { why }
    }

    /// Both sides could be the face: the second one rises a little.
    pub(super) fn rising([upper, rising]: [FaceSide; 2]) -> Self {
        let why = format!(
            "the side towards {rising} of the file rises a little to its rim, the one towards {upper} does not, and both fit"
        );
        Self::FaceUnclear { why }
    }

    /// Both sides could be the face: the second one is much smoother. The deviations are theirs \[m\].
    pub(super) fn smoother([upper, smoother]: [FaceSide; 2], deviations_m: [f64; 2]) -> Self {
        let [rough, smooth] = deviations_m.map(millimetres);
        let why = format!(
            "the side towards {upper} of the file is {rough} off its profile, the one towards {smoother} {smooth}, so that the first one has a \
             foot or a dent, and both fit"
        );
        Self::FaceUnclear { why }
    }
}
