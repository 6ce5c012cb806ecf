//! Coverage by sponge radius.

use crate::part::PaperPart;
use crate::tool_path::ToolPath;
use platewash_workcell::coverage::{Coverage, CoverageError, CoverageSettings, coverage};
use platewash_workcell::plate::Plate;

/// Sponge radii for which coverage is measured \[mm\].
pub(super) const SPONGES_MM: [u32; 8] = [10, 15, 20, 25, 30, 35, 40, 45];

/// No coverage.
pub(super) const NOTHING: Coverage = Coverage {
    fraction: 0.0,
    lower: 0.0,
    upper: 0.0,
};

/// Coverage of a plate by a path of the tip, by sponge radius.
pub(super) fn by_sponge(
    path: &[[f64; 2]],
    plate: &Plate,
    settings: &CoverageSettings,
) -> Result<[Coverage; SPONGES_MM.len()], CoverageError> {
    let mut all = [NOTHING; SPONGES_MM.len()];
    for (covered, sponge) in all.iter_mut().zip(SPONGES_MM) {
        *covered = coverage(
            path,
            plate.centre_xy(),
            plate.rim_m(),
            1e-3 * f64::from(sponge),
            settings,
        )?;
    }
    Ok(all)
}

/// Coverage of a plate of the paper's appendix had the tip followed the waypoints, by sponge radius.
pub(super) fn ideal_coverage() -> Result<[Coverage; SPONGES_MM.len()], CoverageError> {
    let part = PaperPart::Appendix;
    let size = part.geometry();
    let plate = Plate::level_disc([0.3, 0.0, size.height_m], size.surface.rim_m(), size.thickness_m);
    let path = ToolPath::new(&part.settings(), &[plate]);
    let spiral: Vec<_> = path
        .segments
        .iter()
        .flat_map(|s| &s.waypoints)
        .map(|p| [p.x, p.y])
        .collect();
    by_sponge(&spiral, &plate, &CoverageSettings { cell_m: 1e-4 })
}
