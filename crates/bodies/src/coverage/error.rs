//! Invalid numbers in a request, and the check that finds them.

use thiserror::Error;

/// Greatest number of cells along an edge of a raster.
pub const MAX_CELLS: usize = 4096;

/// Invalid number in a request.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CoverageError {
    /// A point of the path is not finite.
    #[error("point {index} of the path is not finite")]
    PathNotFinite {
        /// Index of the point, from 0.
        index: usize,
    },
    /// The centre of the disc is not finite.
    #[error("the centre of the disc is not finite")]
    CentreNotFinite,
    /// A length is not finite or not greater than zero.
    #[error("{quantity} = {value_m} m is not a finite length greater than zero")]
    NotPositive {
        /// Name of the length.
        quantity: &'static str,
        /// Value \[m\].
        value_m: f64,
    },
    /// The cells are so small that the raster would take too long.
    #[error("cell_m = {cell_m} m is less than {smallest_m} m, 1e-5 of the disc's radius")]
    CellTooSmall {
        /// Edge of the cells \[m\].
        cell_m: f64,
        /// Least edge for this disc \[m\].
        smallest_m: f64,
    },
    /// The raster has no cells, or too many.
    #[error("a raster has from 1 to {MAX_CELLS} cells along an edge; found {cells}")]
    Cells {
        /// Number of cells along an edge.
        cells: usize,
    },
}

/// Refuses points that are not finite and lengths that are not greater than zero.
pub(super) fn check_lengths<'a>(
    mut points: impl Iterator<Item = &'a [f64; 2]>,
    centre: [f64; 2],
    lengths: &[(&'static str, f64)],
) -> Result<(), CoverageError> {
    let finite = |p: &[f64; 2]| p.iter().all(|c| c.is_finite());
    if let Some(index) = points.position(|p| !finite(p)) {
        return Err(CoverageError::PathNotFinite { index });
    }
    if !finite(&centre) {
        return Err(CoverageError::CentreNotFinite);
    }
    match lengths.iter().find(|(_, v)| !(v.is_finite() && *v > 0.0)) {
        Some(&(quantity, value_m)) => Err(CoverageError::NotPositive { quantity, value_m }),
        None => Ok(()),
    }
}
