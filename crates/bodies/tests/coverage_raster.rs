//! The picture of a swept plate: its cells keep the proven bounds.

use platewash_bodies::coverage::*;
use proptest::prelude::*;

proptest! {
    #[test]
    fn the_raster_keeps_the_proven_bounds(
        polyline in prop::collection::vec(prop::array::uniform2(-0.2..0.2f64), 0..12),
        centre in prop::array::uniform2(-0.05..0.05f64),
        sponge in 0.005..0.1f64,
        cells in 1..80usize,
    ) {
        let radius = 0.145;
        let exact = coverage(&polyline, centre, radius, sponge, 1e-3).unwrap();
        let raster = raster(&polyline, centre, radius, sponge, cells).unwrap();
        let area = (2.0 * radius / cells as f64).powi(2) / (std::f64::consts::PI * radius * radius);
        let share = |states: &[RasterCell]| area * raster.cells.iter().filter(|c| states.contains(c)).count() as f64;
        // Cells on the rim reach beyond the disc, so that only sums with them are upper bounds.
        prop_assert!(share(&[RasterCell::Swept, RasterCell::Partly, RasterCell::Missed]) >= 1.0 - 1e-9);
        prop_assert!(share(&[RasterCell::Swept, RasterCell::Partly]) >= exact.lower - 1e-9);
        prop_assert!(share(&[RasterCell::Missed, RasterCell::Partly]) >= 1.0 - exact.upper - 1e-9);
        prop_assert_eq!(raster.cells.len(), cells * cells);
    }
}

#[test]
fn rejects_senseless_input() {
    let call = |polyline: &[[f64; 2]], radius, cells| raster(polyline, [0.0; 2], radius, 0.02, cells);
    assert_eq!(call(&[], 0.1, 0), Err(CoverageError::Cells { cells: 0 }));
    assert_eq!(call(&[], 0.1, 5000), Err(CoverageError::Cells { cells: 5000 }));
    assert!(matches!(call(&[], f64::NAN, 5), Err(CoverageError::NotPositive { .. })));
    assert_eq!(
        call(&[[0.0, f64::INFINITY]], 0.1, 5),
        Err(CoverageError::PathNotFinite { index: 0 })
    );
    assert!(
        call(&[], 0.1, 1)
            .unwrap()
            .cells
            .iter()
            .all(|c| *c == RasterCell::Missed)
    );
}
