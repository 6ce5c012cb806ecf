//! What to expect of each plate, before anything is planned.

use super::shared::Pipeline;
use crate::error::PlanError;
use crate::outlook::PlateOutlook;
use crate::redundancy::{Chance, Task, chance};
use crate::scene::Scene;
use crate::watch::Watch;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::WashJob;
use rayon::prelude::*;

/// The chance of each plate to be washed, by its index: each by itself, from home, along the wash path that planning would take.
/// A guess for the eye, in milliseconds.
///
/// One that is told to be unwashable is one that [`plan`](crate::plan) fails for, if not for another. One that is told to be washable
/// may still fail: transits are not looked at, and the arm may come from elsewhere. Plates that overlap are washed all the same; that
/// they do is a finding of the layout, and refused by [`plan`](crate::plan) where the job allows none to.
///
/// # Errors
/// [`PlanError`] of the input, an end configuration that is not clear, and [`PlanError::Cancelled`].
pub fn outlook(job: &WashJob, watch: &Watch<'_>) -> Result<Vec<PlateOutlook>, PlanError> {
    let pipeline = Pipeline::here(job, watch)?;
    pipeline.check_homes()?;
    let scene = pipeline.scene()?;
    let (order, _) = pipeline.order(&scene)?;
    let turns = (0..order.len()).into_par_iter();
    let outlooks: Result<Vec<PlateOutlook>, Cancelled> =
        turns.map(|k| pipeline.outlook_on(&scene, &order, k)).collect();
    let mut outlooks = outlooks?;
    outlooks.sort_by_key(|outlook| outlook.plate);
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use platewash_workcell::cancel::CancelToken;
    use platewash_workcell::fixtures::{kitchen, kitchen_plate};

    /// One plate after the other over the floor around the arm.
    #[test]
    fn what_is_told_of_a_plate_is_what_comes_of_its_washing() {
        let (kitchen, cancel) = (kitchen(), CancelToken::new());
        let watch = Watch::silent(&cancel);
        let mut told = [0; 3];
        for k in 0..150 {
            let [x, y] = [k % 15, k / 15].map(|k| -0.68 + 0.0971 * f64::from(k));
            let mut terms = kitchen.terms().clone();
            terms.plates = vec![kitchen_plate([x, y])];
            let job = WashJob::new(kitchen.shared_arm(), terms).unwrap();
            let chance = outlook(&job, &watch).unwrap()[0].chance;
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
