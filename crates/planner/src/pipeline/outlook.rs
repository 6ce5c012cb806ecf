//! Outlook on each plate, before anything is planned.

use crate::error::PlanError;
use crate::outlook::PlateOutlook;
use crate::pipeline::shared::Pipeline;
use crate::placed_arm::PlacedArm;
use crate::redundancy::{Chance, Task, chance};
use crate::watch::Watch;
use platewash_bodies::job::WashJob;
use platewash_workcell::cancel::Cancelled;
use rayon::prelude::*;

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
    let placed = pipeline.placed()?;
    let (order, _) = pipeline.order(&placed)?;
    let turns = (0..order.len()).into_par_iter();
    let outlooks: Result<Vec<PlateOutlook>, Cancelled> =
        turns.map(|k| pipeline.outlook_on(&placed, &order, k)).collect();
    let mut outlooks = outlooks?;
    outlooks.sort_unstable_by_key(|outlook| outlook.plate);
    Ok(outlooks)
}

impl Pipeline<'_> {
    /// The chance of the `k`-th plate of an order.
    fn outlook_on(&self, placed: &PlacedArm<'_>, order: &[usize], k: usize) -> Result<PlateOutlook, Cancelled> {
        let (path, [near, _]) = (self.path_of(placed, order, k), &self.terms.home_rad);
        let chance = match Task::new(placed, &path, self.clearance_m(), near) {
            Ok(task) => chance(&task)?,
            // Numbers that planning refuses: it says which.
            Err(_) => Chance::Unclear,
        };
        let plate = order[k];
        Ok(PlateOutlook { plate, chance })
    }
}
