//! The swept part of a disc as a regular raster, for display.

use crate::coverage::error::{CoverageError, MAX_CELLS, check_lengths};
use crate::coverage::raster::{Capsule, capsules};
use rayon::prelude::*;

/// State of a cell of a raster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RasterCell {
    /// The cell lies wholly outside the disc.
    Outside,
    /// The sponge sweeps no part of the cell.
    Missed,
    /// The cell is swept in part, or by more than one segment of the path together.
    Partly,
    /// One segment of the path sweeps the cell wholly.
    Swept,
}

/// Raster over the square around a disc.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverageRaster {
    /// Cells row by row, y ascending, `x_m.len()` per row.
    pub cells: Vec<RasterCell>,
    /// x of the cells' middles, in the polyline's frame \[m\].
    pub x_m: Vec<f64>,
    /// y of the cells' middles, in the polyline's frame \[m\].
    pub y_m: Vec<f64>,
}

/// Returns the swept part of a disc as a raster of `cells` × `cells`; the other arguments are those of
/// [`coverage`](crate::coverage::coverage). A cell that is called swept or missed is so wholly; no cell outside the disc is called either.
///
/// # Errors
/// [`CoverageError`] as for [`coverage`](crate::coverage::coverage), and [`CoverageError::Cells`] for a raster without cells or with
/// more than [`MAX_CELLS`] along an edge.
pub fn raster(
    polyline: &[[f64; 2]],
    centre: [f64; 2],
    radius_m: f64,
    sponge_radius_m: f64,
    cells: usize,
) -> Result<CoverageRaster, CoverageError> {
    check_lengths(
        polyline.iter(),
        centre,
        &[("radius_m", radius_m), ("sponge_radius_m", sponge_radius_m)],
    )?;
    if !(1..=MAX_CELLS).contains(&cells) {
        return Err(CoverageError::Cells { cells });
    }
    let capsules = capsules(polyline, centre);
    let half = radius_m / cells as f64;
    let middle = |k: usize| -radius_m + half * (2 * k + 1) as f64;
    let row = |j: usize| {
        let y = middle(j);
        // A little more than half the diagonal, so that what is left out is out of reach of every cell.
        let reach = sponge_radius_m + 1.5 * half;
        let near: Vec<&Capsule> = capsules.iter().filter(|c| c.comes_near_height(y, reach)).collect();
        let state = move |i| state([middle(i), y], half, radius_m, sponge_radius_m, &near);
        (0..cells).map(state).collect::<Vec<_>>()
    };
    Ok(CoverageRaster {
        cells: (0..cells).into_par_iter().flat_map_iter(row).collect(),
        x_m: (0..cells).map(|k| centre[0] + middle(k)).collect(),
        y_m: (0..cells).map(|k| centre[1] + middle(k)).collect(),
    })
}

/// Returns the state of the cell about `middle`, all relative to the disc's centre.
fn state(middle: [f64; 2], half: f64, radius: f64, sponge: f64, capsules: &[&Capsule]) -> RasterCell {
    let nearest = middle.map(|c| (c.abs() - half).max(0.0));
    if nearest[0] * nearest[0] + nearest[1] * nearest[1] >= radius * radius {
        return RasterCell::Outside;
    }
    let half_diagonal = half * std::f64::consts::SQRT_2;
    let least = capsules
        .iter()
        .map(|c| c.distance_squared(middle))
        .fold(f64::INFINITY, f64::min);
    let (within, reach) = (sponge - half_diagonal, sponge + half_diagonal);
    if within > 0.0 && least <= within * within {
        RasterCell::Swept
    } else if least >= reach * reach {
        RasterCell::Missed
    } else {
        RasterCell::Partly
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_cell_has_the_state_of_its_points(
            polyline in prop::collection::vec(prop::array::uniform2(-0.2..0.2f64), 1..6),
            sponge in 0.01..0.1f64,
            at in (0..20usize, 0..20usize),
            inside in prop::array::uniform2(-1.0..1.0f64),
        ) {
            let raster = raster(&polyline, [0.0; 2], 0.145, sponge, 20).unwrap();
            let half = 0.145 / 20.0;
            let point = [raster.x_m[at.0] + half * inside[0], raster.y_m[at.1] + half * inside[1]];
            let distance = capsules(&polyline, [0.0; 2]).iter().map(|c| c.distance_squared(point).sqrt()).fold(f64::INFINITY, f64::min);
            match raster.cells[at.1 * 20 + at.0] {
                RasterCell::Swept => prop_assert!(distance <= sponge + 1e-12),
                RasterCell::Missed => prop_assert!(distance >= sponge - 1e-12),
                RasterCell::Outside => prop_assert!(point[0].hypot(point[1]) >= 0.145 - 1e-12),
                RasterCell::Partly => (),
            }
        }
    }
}
