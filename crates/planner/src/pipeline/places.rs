//! Search for another place of a plate at which the job can wash it.
//!
//! Also here: map of the places at which a plate could be washed, with the others in place; outlook on each plate, before
//! anything is planned.
//!
//! Layouts of which every plate can be washed whole.

use crate::error::PlanError;
use crate::outlook::PlateOutlook;
use crate::pipeline::phases::check_apart;
use crate::pipeline::shared::Pipeline;
use crate::pipeline::visit::{self, Turn};
use crate::redundancy::places::{MovedPlate, RING_M, RINGS, Trial, nearest_washable};
use crate::redundancy::{Chance, RedundancyError, Task, chance};
use crate::scene::Scene;
use crate::transit::LiftLine;
use crate::washable_map::{IN_A_PATCH, Levels, MapArea, MapPatch, Square};
use crate::watch::{Activity, Watch};
use nalgebra::Vector2;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::clearance::standing_overlaps;
use platewash_workcell::job::{JobError, JobTerms, WashJob};
use platewash_workcell::layout::{Layout, LayoutError};
use platewash_workcell::wash_path::WashPath;
use rayon::prelude::*;
use std::sync::Arc;

/// The nearest centre found at which the job would wash a plate \[m\], on a grid of a millimetre; `None` within
/// [`SEARCHED_M`](crate::SEARCHED_M) of where it lies. The search that [`plan_with`](crate::plan_with) makes where the job asks for
/// it, whether it does or not; a plate that is washed where it lies stays there, to a millimetre.
///
/// # Errors
/// [`PlanError`] of the input, [`PlanError::Plate`] and [`PlanError::Cancelled`].
pub fn nearest_place(job: &WashJob, plate: usize, watch: &Watch<'_>) -> Result<Option<[f64; 2]>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_plate(plate)?;
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let (path, near) = pipeline.start_on(&scene, &order, plate)?;
    let nearest = pipeline.nearest(&scene, &path, &near)?;
    scene.check_cancelled()?;
    Ok(nearest)
}

impl Pipeline<'_> {
    /// Returns the wash path of a plate, and the configuration near which it starts \[rad\]: the last one of the plate before it, or
    /// home, if a check of a few points shows that this plate cannot be washed.
    fn start_on(&self, scene: &Scene<'_>, order: &[usize], plate: usize) -> Result<(WashPath, JointVector), Cancelled> {
        let turn = order.iter().position(|&other| other == plate).unwrap_or(0);
        let path = self.path_of(scene, order, turn);
        let [mut near, _] = self.terms.home_rad;
        if self.blocked(scene, order, turn)?.is_none() {
            let before = &order[..turn];
            let washed = self.turns(scene, order, Self::washing_by_patterns, |other| before.contains(&other));
            let last = washed.filter_map(Result::ok).last();
            near = last.and_then(|turn| turn.washing.q.last().copied()).unwrap_or(near);
        }
        scene.check_cancelled()?;
        Ok((path, near))
    }

    /// The nearest place found at which the job would wash the plate \[m\].
    pub fn nearest(
        &self,
        scene: &Scene<'_>,
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
        match nearest_washable(&self.moved_plate(scene, path, near), &mut holds, &tell) {
            Ok(place) => Ok(place.map(Into::into)),
            Err(RedundancyError::Cancelled(cancelled)) => Err(cancelled),
            Err(_) => Ok(None),
        }
    }

    /// The plate of a wash path as a subject of the search for another place.
    pub fn moved_plate<'a>(
        &'a self,
        scene: &'a Scene<'a>,
        path: &'a WashPath,
        near: &'a JointVector,
    ) -> MovedPlate<'a> {
        MovedPlate {
            scene,
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
        plates[plate] = self.scene()?.moved(&plates[plate], centre_m);
        if !standing_overlaps(self.robot, &self.terms.workcell, &plates, None)?.is_empty() {
            return Ok(false);
        }
        let moved = self.among(&plates);
        moved.check_homes()?;
        let scene = moved.scene()?;
        let (order, _) = moved.order(&scene)?;
        let (mut lines, mut at): (Vec<[LiftLine; 2]>, _) = (Vec::new(), None);
        for turn in moved.turns(&scene, &order, Pipeline::washing_by_patterns, |_| true) {
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
            lines.push(visit::lines(&moved, &scene, &path, &washing)?);
        }
        let lines: Vec<_> = lines.iter().map(|[entry, exit]| [entry, exit]).collect();
        let beside = |k: usize| at.is_some_and(|at| k == at || k == at + 1);
        moved.transits(&scene, &lines, beside)?;
        Ok(true)
    }
}

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
        let here = Vector2::from(asked.scene.centre_in_world(&pipeline.plates[plate]));
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
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let turn = order.iter().position(|&other| other == plate).unwrap_or(0);
    let path = pipeline.path_of(&scene, &order, turn);
    let [near, _] = &pipeline.terms.home_rad;
    search(&pipeline, &pipeline.moved_plate(&scene, &path, near))
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

/// The chance of each plate to be washed, by its index: each by itself, from home, along the wash path that planning would take.
/// A guess for the eye, in milliseconds.
///
/// A plate that is reported as unwashable makes [`plan`](crate::plan) fail, for this reason or for another one. A plate that is
/// reported as washable may still fail: transits are not checked, and the arm may come from elsewhere. Plates that overlap are
/// washed all the same; the overlap is a finding of the layout, and [`plan`](crate::plan) refuses it where the job does not allow
/// it.
///
/// # Errors
/// [`PlanError`] of the input, an end configuration that is not clear, and [`PlanError::Cancelled`].
pub fn plate_outlooks(job: &WashJob, watch: &Watch<'_>) -> Result<Vec<PlateOutlook>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_homes()?;
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let turns = (0..order.len()).into_par_iter();
    let outlooks: Result<Vec<PlateOutlook>, Cancelled> =
        turns.map(|k| pipeline.outlook_on(&scene, &order, k)).collect();
    let mut outlooks = outlooks?;
    outlooks.sort_unstable_by_key(|outlook| outlook.plate);
    Ok(outlooks)
}

impl Pipeline<'_> {
    /// The chance of the `k`-th plate of an order.
    fn outlook_on(&self, scene: &Scene<'_>, order: &[usize], k: usize) -> Result<PlateOutlook, Cancelled> {
        let (path, [near, _]) = (self.path_of(scene, order, k), &self.terms.home_rad);
        let chance = match Task::new(scene, &path, self.clearance_m(), near) {
            Ok(task) => chance(&task)?,
            // Numbers that planning refuses: it says which.
            Err(_) => Chance::Unclear,
        };
        let plate = order[k];
        Ok(PlateOutlook { plate, chance })
    }
}

/// Layouts drawn before it is given up.
const MOST_LAYOUTS: usize = 200;

/// Draws layouts until every plate of one can be washed whole under `terms`, whose own plates are ignored.
///
/// # Errors
/// [`PlanError::Layout`] of the draws, [`PlanError::NoneWashable`] when no drawn layout can be washed, and the errors of
/// [`check`](crate::check).
pub fn draw_washable_layout(
    arm: &Arc<RobotModel>,
    terms: &JobTerms,
    draw: &mut dyn FnMut() -> Result<Layout, LayoutError>,
    watch: &Watch<'_>,
) -> Result<Layout, PlanError> {
    Pipeline::new(arm, (&terms.seen_from_base(), &terms.workcell.mount), &[], watch)?.check_homes()?;
    let (mut drawn, most) = (0, MOST_LAYOUTS);
    loop {
        watch.cancel.check()?;
        drawn += 1;
        (watch.tell)(&Activity::Layout { drawn, most });
        let layout = draw()?;
        let terms = JobTerms {
            plates: layout.plates.clone(),
            ..terms.clone()
        };
        let last = match first_refused(arm, terms, watch)? {
            None => return Ok(layout),
            Some(last) => last,
        };
        if drawn == most {
            return Err(PlanError::NoneWashable { layouts: drawn, last });
        }
    }
}

/// Returns the obstruction that keeps the plates of a layout from being washed, in words: a plate shares its place with another
/// or with an obstacle, or cannot be washed whole.
fn first_refused(arm: &Arc<RobotModel>, terms: JobTerms, watch: &Watch<'_>) -> Result<Option<String>, PlanError> {
    if let Err(overlap) = check_apart(arm, &terms) {
        return Ok(Some(overlap.to_string()));
    }
    match WashJob::new(arm.clone(), terms) {
        Err(standing @ (JobError::Standing(_) | JobError::StillNear { .. })) => Ok(Some(standing.to_string())),
        job => {
            let unwashable = Pipeline::of(&job?, watch)?.first_unwashable()?;
            Ok(unwashable)
        }
    }
}

impl Pipeline<'_> {
    /// Returns the obstruction on the first plate that cannot be washed whole, in words.
    fn first_unwashable(&self) -> Result<Option<String>, PlanError> {
        let (scene, [start, _]) = (self.scene()?, &self.terms.home_rad);
        let home = self.home_tip(&scene, start);
        for plate in 0..self.plates.len() {
            match self.washing_by_patterns(&scene, &self.widest_path(plate, &home), start) {
                Ok(turn) => {
                    if let Err(error) = self.check_promise(&turn) {
                        return Ok(Some(error.to_string()));
                    }
                }
                Err(RedundancyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                Err(error) => return Ok(Some(error.to_string())),
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::cancel::CancelToken;
    use platewash_workcell::fixtures::{kitchen, kitchen_plate};

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
        let scene = pipeline.scene().unwrap();
        let (order, _) = pipeline.order(&scene).unwrap();
        let turn = order.iter().position(|&other| other == 2).unwrap();
        let path = pipeline.path_of(&scene, &order, turn);
        let asked = pipeline.moved_plate(&scene, &path, &job.terms().home_rad[0]);
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
            let scene = pipeline.scene().unwrap();
            let path = pipeline.path_of(&scene, &[0], 0);
            let washing = pipeline.washing(&scene, &path, &job.terms().home_rad[0]);
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
