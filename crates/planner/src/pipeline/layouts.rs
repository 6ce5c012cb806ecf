//! Layouts of which every plate can be washed whole.

use crate::error::PlanError;
use crate::pipeline::phases::check_apart;
use crate::pipeline::shared::Pipeline;
use crate::redundancy::RedundancyError;
use crate::watch::{Activity, Watch};
use platewash_bodies::job::{JobError, WashJob};
use platewash_kinematics::RobotModel;
use platewash_workcell::job::JobTerms;
use platewash_workcell::layout::{Layout, LayoutError};
use std::sync::Arc;

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
            let unwashable = Pipeline::from_job(&job?, watch)?.first_unwashable()?;
            Ok(unwashable)
        }
    }
}

impl Pipeline<'_> {
    /// Returns the obstruction on the first plate that cannot be washed whole, in words.
    fn first_unwashable(&self) -> Result<Option<String>, PlanError> {
        let (placed, [start, _]) = (self.placed()?, &self.terms.home_rad);
        let home = self.home_tip(&placed, start);
        for plate in 0..self.plates.len() {
            match self.washing_by_patterns(&placed, &self.widest_path(plate, &home), start) {
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
