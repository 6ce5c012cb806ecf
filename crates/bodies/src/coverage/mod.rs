//! Share of a plate that the sponge sweeps.

mod error;
mod picture;
mod raster;

pub use crate::coverage::error::{CoverageError, MAX_CELLS};
pub use crate::coverage::picture::{CoverageRaster, RasterCell, raster};
pub use crate::coverage::raster::area_of_rectangle_in_disc;

use crate::coverage::error::check_lengths;
use crate::coverage::raster::{Capsule, Raster, UnsweptArea, capsules};
use serde::{Deserialize, Serialize};

/// Least edge of the cells as a part of the plate's radius, so that every call ends soon.
pub const SMALLEST_CELL: f64 = 1e-5;

/// Rounding added to both sides of the bounds, as a part of the disc's area.
const ROUNDING: f64 = 1e-11;

/// Relative amount by which a required share may be missed: the rounding of everything that leads to a share.
const SLACK: f64 = 1e-9;

/// True if a share is at least the required one, up to rounding. Proof and simulation both use this test. False for NaN.
#[must_use]
pub fn reaches(share: f64, required: f64) -> bool {
    share >= required - SLACK * required.abs().max(1e-3)
}

/// Swept part of a disc, as fractions of the disc's area, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// Best estimate. Of the smallest undecided cells the swept share of eight columns counts, so that the sponge's edge and the plate's
    /// rim are both at their true positions, even in the same cell.
    pub fraction: f64,
    /// Lower bound on the true value.
    pub lower: f64,
    /// Upper bound on the true value.
    pub upper: f64,
}

impl Coverage {
    /// Width of the interval that contains the true value.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.upper - self.lower
    }
}

/// Computes the part of a disc that a round sponge sweeps while its centre follows a polyline.
///
/// `polyline` and `centre` are in one plane frame \[m\]; `radius_m` is the disc's radius, `sponge_radius_m` the sponge's. `cell_m` is the edge
/// of the smallest cells, at least 1e-5 of the disc's radius; the error falls in proportion. An empty polyline
/// sweeps nothing, one of a single point the sponge's own disc; repeated points are allowed.
///
/// The swept area is the union of capsules, one per segment. Square cells are halved while they are neither wholly within one capsule nor
/// wholly outside of all, down to `cell_m`. Only cells that remain undecided enter the error, so that [`Coverage::lower`] and
/// [`Coverage::upper`] are proven (rounding included, for points within about a hundred radii). Areas along the rim of the disc are exact.
///
/// # Errors
///
/// [`CoverageError`] for a number that is not finite, a length that is not greater than zero, or cells that are too small.
pub fn coverage(
    polyline: &[[f64; 2]],
    centre: [f64; 2],
    radius_m: f64,
    sponge_radius_m: f64,
    cell_m: f64,
) -> Result<Coverage, CoverageError> {
    coverage_of_strokes(&[polyline], centre, radius_m, sponge_radius_m, cell_m)
}

/// Same as [`coverage`] for several polylines, between which the sponge does not touch: the union of the parts swept by each.
///
/// # Errors
///
/// As [`coverage`]; the index of a point counts through all polylines.
pub fn coverage_of_strokes<P: AsRef<[[f64; 2]]>>(
    polylines: &[P],
    centre: [f64; 2],
    radius_m: f64,
    sponge_radius_m: f64,
    cell_m: f64,
) -> Result<Coverage, CoverageError> {
    let points = polylines.iter().flat_map(|line| line.as_ref());
    validate(points, centre, radius_m, sponge_radius_m, cell_m)?;
    let capsules: Vec<Capsule> = polylines
        .iter()
        .flat_map(|line| capsules(line.as_ref(), centre))
        .collect();
    let uncovered = Raster::new(&capsules, radius_m, sponge_radius_m, cell_m).uncovered();
    Ok(as_fractions(&uncovered, std::f64::consts::PI * radius_m * radius_m))
}

fn as_fractions(unswept: &UnsweptArea, disc_area: f64) -> Coverage {
    let covered = |uncovered_area: f64, rounding: f64| (1.0 - uncovered_area / disc_area + rounding).clamp(0.0, 1.0);
    let (lower, upper) = (covered(unswept.at_most, -ROUNDING), covered(unswept.at_least, ROUNDING));
    Coverage {
        fraction: covered(unswept.estimate, 0.0).max(lower).min(upper),
        lower,
        upper,
    }
}

fn validate<'a>(
    points: impl Iterator<Item = &'a [f64; 2]>,
    centre: [f64; 2],
    radius_m: f64,
    sponge_radius_m: f64,
    cell_m: f64,
) -> Result<(), CoverageError> {
    let lengths = [
        ("radius_m", radius_m),
        ("sponge_radius_m", sponge_radius_m),
        ("cell_m", cell_m),
    ];
    check_lengths(points, centre, &lengths)?;
    let smallest_m = SMALLEST_CELL * radius_m;
    if cell_m < smallest_m {
        Err(CoverageError::CellTooSmall { cell_m, smallest_m })
    } else {
        Ok(())
    }
}
