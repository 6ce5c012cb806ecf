//! A layout of given centres, with every rule that they break.

use crate::layout::count::check_count;
use crate::layout::error::LayoutError;
use crate::layout::findings;
use crate::layout::footprint::BaseFootprint;
use crate::layout::placed_plates::{Layout, LayoutSource};
use crate::layout::plate_geometry::PlateGeometry;
use crate::layout::region::Region;
use crate::layout::spacing::Spacing;

/// Builds a layout from given centres (`[x, y]` \[m\], base frame) and reports every rule that they break. `region` is `None` if no region
/// was given.
///
/// # Errors
///
/// [`LayoutError::InvalidInput`] or [`LayoutError::InvalidPosition`] for an invalid number. A bad layout is not an error but has findings.
pub fn check_explicit(
    positions_m: &[[f64; 2]],
    region: Option<&Region>,
    spacing: &Spacing,
    geometry: &PlateGeometry,
    base: Option<&BaseFootprint>,
) -> Result<Layout, LayoutError> {
    region.map_or(Ok(()), Region::validate)?;
    spacing.validate()?;
    geometry.validate()?;
    base.map_or(Ok(()), BaseFootprint::validate)?;
    check_count(positions_m.len())?;
    if let Some(plate) = positions_m.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
        return Err(LayoutError::InvalidPosition { plate });
    }
    let plates = geometry.plates(positions_m);
    let mut findings = findings::broken_rules(&plates, region, spacing);
    findings.extend(findings::overlaps(&plates, base));
    Ok(Layout {
        plates,
        source: LayoutSource::Explicit,
        findings,
    })
}
