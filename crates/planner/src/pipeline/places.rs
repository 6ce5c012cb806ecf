//! Search for another place of a plate at which the job can wash it.

use crate::error::PlanError;
use crate::pipeline::shared::Pipeline;
use crate::pipeline::visit::{self, Turn};
use crate::placed_arm::PlacedArm;
use crate::redundancy::RedundancyError;
use crate::redundancy::places::{MovedPlate, RING_M, RINGS, Trial, nearest_washable};
use crate::transit::LiftLine;
use crate::watch::{Activity, Watch};
use nalgebra::Vector2;
use platewash_bodies::clearance::standing_overlaps;
use platewash_bodies::job::WashJob;
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::wash_path::WashPath;
use rayon::prelude::*;

/// The nearest centre found at which the job would wash a plate \[m\], on a grid of a millimetre; `None` within
/// [`SEARCHED_M`](crate::SEARCHED_M) of where it lies. The search that [`plan_with`](crate::plan_with) makes where the job asks for
/// it, whether it does or not; a plate that is washed where it lies stays there, to a millimetre.
///
/// # Errors
/// [`PlanError`] of the input, [`PlanError::Plate`] and [`PlanError::Cancelled`].
pub fn nearest_place(job: &WashJob, plate: usize, watch: &Watch<'_>) -> Result<Option<[f64; 2]>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_plate(plate)?;
    let placed = pipeline.placed()?;
    let (order, _) = pipeline.order(&placed)?;
    let (path, near) = pipeline.start_on(&placed, &order, plate)?;
    let nearest = pipeline.nearest(&placed, &path, &near)?;
    placed.check_cancelled()?;
    Ok(nearest)
}

impl Pipeline<'_> {
    /// Returns the wash path of a plate, and the configuration near which it starts \[rad\]: the last one of the plate before it, or
    /// home, if a check of a few points shows that this plate cannot be washed.
    fn start_on(
        &self,
        placed: &PlacedArm<'_>,
        order: &[usize],
        plate: usize,
    ) -> Result<(WashPath, JointVector), Cancelled> {
        let turn = order.iter().position(|&other| other == plate).unwrap_or(0);
        let path = self.path_of(placed, order, turn);
        let [mut near, _] = self.terms.home_rad;
        if self.blocked(placed, order, turn)?.is_none() {
            let before = &order[..turn];
            let washed = self.turns(placed, order, Self::washing_by_patterns, |other| {
                before.contains(&other)
            });
            let last = washed.filter_map(Result::ok).last();
            near = last.and_then(|turn| turn.washing.q.last().copied()).unwrap_or(near);
        }
        placed.check_cancelled()?;
        Ok((path, near))
    }

    /// The nearest place found at which the job would wash the plate \[m\].
    pub fn nearest(
        &self,
        placed: &PlacedArm<'_>,
        path: &WashPath,
        near: &JointVector,
    ) -> Result<Option<[f64; 2]>, Cancelled> {
        let plate = path.plate;
        let mut holds = |centre: &Vector2<f64>| {
            let centre_m = (*centre).into();
            (self.watch.tell)(&Activity::Trial { plate, centre_m });
            self.washes_at(plate, centre_m).unwrap_or(false)
        };
        let tell = |ring: u32| {
            let (of, away_m) = (RINGS, RING_M * f64::from(ring));
            (self.watch.tell)(&Activity::Relocation {
                plate,
                ring,
                of,
                away_m,
            });
        };
        match nearest_washable(&self.moved_plate(placed, path, near), &mut holds, &tell) {
            Ok(place) => Ok(place.map(Into::into)),
            Err(RedundancyError::Cancelled(cancelled)) => Err(cancelled),
            Err(_) => Ok(None),
        }
    }

    /// The plate of a wash path as a subject of the search for another place.
    pub fn moved_plate<'a>(
        &'a self,
        placed: &'a PlacedArm<'a>,
        path: &'a WashPath,
        near: &'a JointVector,
    ) -> MovedPlate<'a> {
        MovedPlate {
            placed,
            clearance: &self.clearance,
            path,
            clearance_m: self.clearance_m(),
            near,
        }
    }

    /// Checks that the job would wash a plate with its centre at `centre_m` \[m\]. It is planned as the job is, up to the
    /// transits to it and from it. Other plates that cannot be washed are left out.
    fn washes_at(&self, plate: usize, centre_m: [f64; 2]) -> Result<bool, PlanError> {
        let mut plates = self.plates.to_vec();
        plates[plate] = self.placed()?.moved(&plates[plate], centre_m);
        if !standing_overlaps(self.robot, &self.terms.workcell, &plates, None)?.is_empty() {
            return Ok(false);
        }
        let moved = self.among(&plates);
        moved.check_homes()?;
        let placed = moved.placed()?;
        let (order, _) = moved.order(&placed)?;
        let (mut lines, mut at): (Vec<[LiftLine; 2]>, _) = (Vec::new(), None);
        for turn in moved.turns(&placed, &order, Pipeline::washing_by_patterns, |_| true) {
            let Turn { path, washing, .. } = match turn {
                Ok(washed) => washed,
                Err(failed) => match failed.error {
                    RedundancyError::Cancelled(cancelled) => return Err(cancelled.into()),
                    _ if failed.path.plate != plate => continue,
                    _ => return Ok(false),
                },
            };
            if path.plate == plate {
                at = Some(lines.len());
            }
            lines.push(visit::lines(&moved, &placed, &path, &washing)?);
        }
        let lines: Vec<_> = lines.iter().map(|[entry, exit]| [entry, exit]).collect();
        let beside = |k: usize| at.is_some_and(|at| k == at || k == at + 1);
        moved.transits(&placed, &lines, beside)?;
        Ok(true)
    }
}

/// Calls a function with a plate as the subject of a search for another place: near home, on the wash path that planning would take.
///
/// # Errors
/// [`PlanError`] of the input, [`PlanError::Plate`], and those of the function.
pub(crate) fn with_moved_plate<T>(
    job: &WashJob,
    plate: usize,
    watch: &Watch<'_>,
    search: impl FnOnce(&Pipeline<'_>, &MovedPlate<'_>) -> Result<T, PlanError>,
) -> Result<T, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_plate(plate)?;
    let placed = pipeline.placed()?;
    let (order, _) = pipeline.order(&placed)?;
    let turn = order.iter().position(|&other| other == plate).unwrap_or(0);
    let path = pipeline.path_of(&placed, &order, turn);
    let [near, _] = &pipeline.terms.home_rad;
    search(&pipeline, &pipeline.moved_plate(&placed, &path, near))
}

impl Pipeline<'_> {
    /// Checks, place by place, that the plate suits with its centre there \[m\], and leaves the arm room at home.
    pub fn suitable_centres(&self, moved: &MovedPlate<'_>, centres: &[[f64; 2]]) -> Result<Vec<bool>, Cancelled> {
        let look = |trial: &mut Trial<'_>, centre: &[f64; 2]| match trial.is_suitable(&(*centre).into()) {
            Ok(suits) => Ok(suits && self.check_homes_among(trial.bodies()).is_ok()),
            Err(RedundancyError::Cancelled(cancelled)) => Err(cancelled),
            // Planning would refuse it there.
            Err(_) => Ok(false),
        };
        centres.par_iter().map_init(|| Trial::new(moved), look).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::outlook::plate_outlooks;
    use crate::pipeline::place_map::washable_map;
    use crate::redundancy::places::Chance;
    use crate::washable_map::MapArea;
    use crate::washable_map::MapPatch;
    use platewash_fixtures::{kitchen, kitchen_plate};
    use platewash_workcell::cancel::CancelToken;

    /// Each answer is that of a trial of its own, made for this place alone.
    #[test]
    fn batch_answers_equal_those_of_each_place_alone() {
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
        let placed = pipeline.placed().unwrap();
        let (order, _) = pipeline.order(&placed).unwrap();
        let turn = order.iter().position(|&other| other == 2).unwrap();
        let path = pipeline.path_of(&placed, &order, turn);
        let asked = pipeline.moved_plate(&placed, &path, &job.terms().home_rad[0]);
        let (mut yes, mut no) = (0, 0);
        for (centre, washable) in told {
            let suits = Trial::new(&asked).is_suitable(&centre.into()).unwrap();
            assert_eq!(washable, suits, "{centre:?}");
            if suits { yes += 1 } else { no += 1 }
        }
        assert!(yes > 20 && no > 20, "{yes} {no}");
    }

    /// One plate after the other over the floor around the arm.
    #[test]
    fn predicted_washability_equals_the_planned_result() {
        let (kitchen, cancel) = (kitchen(), CancelToken::new());
        let watch = Watch::silent(&cancel);
        let mut told = [0; 3];
        for k in 0..150 {
            let [x, y] = [k % 15, k / 15].map(|k| -0.68 + 0.0971 * f64::from(k));
            let mut terms = kitchen.terms().clone();
            terms.plates = vec![kitchen_plate([x, y])];
            let job = WashJob::new(kitchen.shared_arm(), terms).unwrap();
            let chance = plate_outlooks(&job, &watch).unwrap()[0].chance;
            let pipeline = Pipeline::here(&job, &watch).unwrap();
            let placed = pipeline.placed().unwrap();
            let path = pipeline.path_of(&placed, &[0], 0);
            let washing = pipeline.washing(&placed, &path, &job.terms().home_rad[0]);
            match chance {
                Chance::Washable => assert!(washing.is_ok(), "{x} {y}: {washing:?}"),
                Chance::Unwashable => assert!(washing.is_err(), "{x} {y}"),
                Chance::Unclear => {}
            }
            told[chance as usize] += 1;
        }
        assert!(told[0] > 20 && told[1] > 20, "{told:?}");
    }
}
