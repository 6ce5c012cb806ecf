//! A plate for which no way was found to wash it whole: why.

use super::nearest_place::nearest_place;
use super::shared::Pipeline;
use super::visits::Failed;
use crate::activity::Activity;
use crate::error::PlanError;
use crate::redundancy::washable::{self, Points, Washable};
use crate::redundancy::{Conclusion, RedundancyError, Task};
use crate::scene::Scene;
use crate::unwashable::{PlaceSearch, UnwashablePlate};
use crate::watch::Watch;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::WashJob;
use rayon::prelude::*;

/// Every plate of a job that cannot be washed whole or that no way was found for, with all that stands in the way, by their
/// index. Where another could lie is not looked for, nor how the arm gets from one to the next: a job of which nothing is
/// listed here may still not be planned.
///
/// The one that [`plan_here`](crate::plan_here) reports is among them, with the same words.
///
/// # Errors
/// [`PlanError`] of the input, an end configuration that is not clear, and [`PlanError::Cancelled`].
pub fn unwashable_plates(job: &WashJob, watch: &Watch<'_>) -> Result<Vec<UnwashablePlate>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_homes()?;
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let failed = pipeline.failed(&scene, &order)?;
    let why = |failed: Failed| pipeline.look_into(&scene, failed);
    let plates: Result<Vec<UnwashablePlate>, Cancelled> = failed.into_par_iter().map(why).collect();
    let mut plates = plates?;
    plates.sort_by_key(|plate| plate.plate);
    Ok(plates)
}

/// The other plates of a job that [`plan_with`](crate::plan_with) fails for `first`: those of [`unwashable_plates`], where that looked for
/// another place each with its own, found with those before it, `first` among them, where they could be washed.
///
/// # Errors
/// As [`unwashable_plates`].
pub fn other_unwashable_plates(
    job: &WashJob,
    first: &UnwashablePlate,
    watch: &Watch<'_>,
) -> Result<Vec<UnwashablePlate>, PlanError> {
    let mut others = unwashable_plates(job, watch)?;
    others.retain(|other| other.plate != first.plate);
    let PlaceSearch::Within(_) = first.place_search else {
        return Ok(others);
    };
    let mut plates = job.terms().plates.clone();
    let mut before = first;
    for other in &mut others {
        if let Some(nearest_m) = before.nearest_m {
            plates[before.plate] = plates[before.plate].moved_to(nearest_m);
        }
        // Places that were found suit obstacles and plates too.
        let job = job.on_plates(plates.clone())?;
        other.nearest_m = nearest_place(&job, other.plate, watch)?;
        other.place_search = first.place_search;
        before = other;
    }
    Ok(others)
}

impl Pipeline<'_> {
    /// All plates for which no configurations are found: those that a few points tell, and the others as they are washed.
    fn failed(&self, scene: &Scene<'_>, order: &[usize]) -> Result<Vec<Failed>, Cancelled> {
        let turns = (0..order.len()).into_par_iter();
        let blocked: Result<Vec<_>, Cancelled> = turns.map(|k| self.blocked(scene, order, k)).collect();
        let mut failed: Vec<Failed> = blocked?.into_iter().flatten().collect();
        let known: Vec<usize> = failed.iter().map(|failed| failed.path.plate).collect();
        let others = self.turns(scene, order, |plate| !known.contains(&plate));
        failed.extend(others.filter_map(Result::err).map(|failed| *failed));
        scene.check_cancelled()?;
        Ok(failed)
    }

    /// Looks into a plate for which no configurations were found.
    pub fn unwashable(&self, scene: &Scene<'_>, failed: Failed) -> PlanError {
        match self.with_place(scene, failed) {
            Ok(plate) => PlanError::Unwashable(Box::new(plate)),
            Err(cancelled) => cancelled.into(),
        }
    }

    /// Why, and where else it could lie if that is to be looked for.
    fn with_place(&self, scene: &Scene<'_>, failed: Failed) -> Result<UnwashablePlate, Cancelled> {
        let (path, near) = (failed.path, failed.near);
        let plate = self.look_into(scene, failed)?;
        let nearest_m = match self.place_search {
            PlaceSearch::Within(_) => self.nearest(scene, &path, &near)?,
            PlaceSearch::Off | PlaceSearch::Later => None,
        };
        scene.check_cancelled()?;
        Ok(UnwashablePlate { nearest_m, ..plate })
    }

    /// Why, without a search for another place.
    fn look_into(&self, scene: &Scene<'_>, failed: Failed) -> Result<UnwashablePlate, Cancelled> {
        let Failed { path, near, error } = failed;
        if let RedundancyError::Cancelled(cancelled) = error {
            return Err(cancelled);
        }
        let plate = path.plate;
        (self.watch.tell)(&Activity::Cause { plate });
        let part = match Task::new(scene, &path, self.clearance_m(), &near) {
            Ok(task) if self.explains => Some(washable::washable_part(&task)?),
            _ => None,
        };
        let (share, causes, conclusion, points) = match part {
            Some(Washable::Part {
                share,
                causes,
                conclusion,
                points,
            }) => (Some(share), causes, conclusion, points),
            _ => (None, Vec::new(), Conclusion::NotFound, Points::default()),
        };
        Ok(UnwashablePlate {
            plate,
            centre_m: scene.centre_in_world(&self.plates[plate]),
            error,
            conclusion,
            share,
            causes,
            free_m: points.free_m,
            dead_m: points.dead_m,
            nearest_m: None,
            place_search: self.place_search,
        })
    }
}
