//! Where a plate could be washed, the others as they lie.

use super::shared::Pipeline;
use crate::error::PlanError;
use crate::redundancy::RedundancyError;
use crate::redundancy::elsewhere::{Elsewhere, Trial};
use crate::washable_map::{IN_A_PATCH, Levels, MapArea, MapPatch, Square};
use crate::watch::Watch;
use nalgebra::Vector2;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::WashJob;
use rayon::prelude::*;

/// Where a plate could be washed, the others as they lie: squares of an area, coarse ones first, told of in patches as they come.
///
/// A square counts as washable where the plate, with its centre in the middle, overlaps neither another plate nor the base, a policy
/// of tilts washes it whole from home, and the arm is clear at home. That is a guess, as [`outlook`](crate::outlook) is: transits are
/// not looked at, and a search may wash more. Every square told of was looked at; the finer ones are those along the border of what
/// the coarser ones told, so that what lies within one coarse square alone may be missed.
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
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_plate(plate)?;
    map.check()?;
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let turn = order.iter().position(|&other| other == plate).unwrap_or(0);
    let path = pipeline.path_of(&scene, &order, turn);
    let [near, _] = &pipeline.terms.home_rad;
    let asked = pipeline.elsewhere(&scene, &path, near);
    let here = Vector2::from(scene.centre_in_world(&pipeline.plates[plate]));
    let mut levels = Levels::new(map);
    while let Some((step_m, mut squares)) = levels.next() {
        let away = |square: &Square| (Vector2::from(levels.centre(step_m, *square)) - here).norm();
        squares.sort_by(|a, b| away(a).total_cmp(&away(b)));
        let mut answers: Vec<(Square, bool)> = Vec::with_capacity(squares.len());
        for some in squares.chunks(IN_A_PATCH) {
            let centres: Vec<[f64; 2]> = some.iter().map(|square| levels.centre(step_m, *square)).collect();
            let washable = pipeline.suited(&asked, &centres)?;
            answers.extend(some.iter().copied().zip(washable.iter().copied()));
            let of_answer = |wanted: bool| {
                let told = centres.iter().zip(&washable).filter(|(_, answer)| **answer == wanted);
                told.map(|(centre, _)| *centre).collect()
            };
            tell(MapPatch {
                step_m,
                washable_m: of_answer(true),
                unwashable_m: of_answer(false),
                done: answers.len(),
                of: squares.len(),
            });
        }
        levels.add(answers);
    }
    Ok(())
}

impl Pipeline<'_> {
    /// Whether the plate suits with its centre there \[m\], and leaves the arm room at home: place by place.
    fn suited(&self, asked: &Elsewhere<'_>, centres: &[[f64; 2]]) -> Result<Vec<bool>, Cancelled> {
        let look = |trial: &mut Trial<'_>, centre: &[f64; 2]| match trial.suits(&(*centre).into()) {
            Ok(suits) => Ok(suits && self.check_homes_among(trial.bodies()).is_ok()),
            Err(RedundancyError::Cancelled(cancelled)) => Err(cancelled),
            // Planning would refuse it there.
            Err(_) => Ok(false),
        };
        centres.par_iter().map_init(|| Trial::new(asked), look).collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use platewash_workcell::cancel::CancelToken;
    use platewash_workcell::fixtures::kitchen;

    /// Each answer is that of a trial of its own, made for this place alone.
    #[test]
    fn answers_are_those_of_each_place_alone() {
        let (job, cancel) = (kitchen(), CancelToken::new());
        let watch = Watch::silent(&cancel);
        let area = MapArea {
            step_m: 0.03,
            ..MapArea::within_reach(&job, 2).unwrap()
        };
        let mut told: Vec<([f64; 2], bool)> = Vec::new();
        let mut tell = |patch: MapPatch| {
            told.extend(patch.washable_m.iter().map(|centre| (*centre, true)));
            told.extend(patch.unwashable_m.iter().map(|centre| (*centre, false)));
        };
        washable_map(&job, 2, &area, &mut tell, &watch).unwrap();
        let pipeline = Pipeline::here(&job, &watch).unwrap();
        let scene = pipeline.scene().unwrap();
        let (order, _) = pipeline.order(&scene).unwrap();
        let turn = order.iter().position(|&other| other == 2).unwrap();
        let path = pipeline.path_of(&scene, &order, turn);
        let asked = pipeline.elsewhere(&scene, &path, &job.terms().home_rad[0]);
        let (mut yes, mut no) = (0, 0);
        for (centre, washable) in told {
            let suits = Trial::new(&asked).suits(&centre.into()).unwrap();
            assert_eq!(washable, suits, "{centre:?}");
            if suits { yes += 1 } else { no += 1 }
        }
        assert!(yes > 20 && no > 20, "{yes} {no}");
    }
}
