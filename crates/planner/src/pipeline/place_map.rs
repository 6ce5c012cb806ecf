//! Map of the places at which a plate could be washed, with the others in place.

use crate::error::PlanError;
use crate::pipeline::places::with_moved_plate;
use crate::washable_map::{IN_A_PATCH, Levels, MapArea, MapPatch, Square};
use crate::watch::Watch;
use nalgebra::Vector2;
use platewash_bodies::job::WashJob;

/// Maps the places at which a plate could be washed, with the others in place: squares of an area, coarse ones first, sent in
/// patches.
///
/// A square counts as washable where the plate, with its centre in the middle, overlaps neither another plate nor the base, a policy
/// of tilts washes it whole from home, and the arm is clear at home. This is an estimate, as [`plate_outlooks`](crate::plate_outlooks) is:
/// transits are not checked, and a search may wash more. Every reported square was checked. The finer ones are those along the
/// border in the answers of the coarser ones, so that a detail within one coarse square may be missed.
///
/// Squares, answers and their order in patches are the same for any number of threads: of each size, the nearest to where the plate
/// lies come first.
///
/// # Errors
/// [`PlanError`] of the input, [`PlanError::Plate`], [`PlanError::Setting`] for an area that is none or has too many squares, and
/// [`PlanError::Cancelled`].
pub fn washable_map(
    job: &WashJob,
    plate: usize,
    map: &MapArea,
    tell: &mut dyn FnMut(MapPatch),
    watch: &Watch<'_>,
) -> Result<(), PlanError> {
    fill(&mut Levels::new(map), job, plate, tell, watch)
}

/// Fills the levels of a map as [`washable_map`] does; where it ends early, those begun have the answers so far.
pub(crate) fn fill(
    levels: &mut Levels<'_>,
    job: &WashJob,
    plate: usize,
    tell: &mut dyn FnMut(MapPatch),
    watch: &Watch<'_>,
) -> Result<(), PlanError> {
    with_moved_plate(job, plate, watch, |pipeline, asked| {
        levels.area.check()?;
        let here = Vector2::from(asked.placed.centre_in_world(&pipeline.plates[plate]));
        while let Some((step_m, mut squares)) = levels.next() {
            let away = |square: &Square| (Vector2::from(levels.centre(step_m, *square)) - here).norm();
            squares.sort_by(|a, b| away(a).total_cmp(&away(b)));
            let mut done = 0;
            for some in squares.chunks(IN_A_PATCH) {
                let centres: Vec<[f64; 2]> = some.iter().map(|square| levels.centre(step_m, *square)).collect();
                let washable = pipeline.suitable_centres(asked, &centres)?;
                levels.add(some.iter().copied().zip(washable.iter().copied()));
                done += some.len();
                let of_answer = |wanted: bool| {
                    let told = centres.iter().zip(&washable).filter(|(_, answer)| **answer == wanted);
                    told.map(|(centre, _)| *centre).collect()
                };
                tell(MapPatch {
                    step_m,
                    washable_m: of_answer(true),
                    unwashable_m: of_answer(false),
                    done,
                    of: squares.len(),
                });
            }
        }
        Ok(())
    })
}
