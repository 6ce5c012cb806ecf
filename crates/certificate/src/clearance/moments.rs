//! Clearance that a plan must keep at a single moment, by the rule of the certificate, for a viewer. No proof rests on it.

use crate::clearance::exclusions::Exclusions;
use crate::clearance::pairs::may_touch;
use crate::error::ProveError;
use crate::judged_job::JudgedJob;
use crate::plan_statements::wash_paths;
use platewash_bodies::clearance::{ClearanceModel, NearestBodies};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_workcell::Workcell;

/// The pairs of bodies that count in each segment of a plan: all but those that follow from the arm and its SRDF, those that the job
/// waives, and the sponge with the plates that it may touch in that segment.
#[derive(Debug, Clone)]
pub struct ClearanceRule {
    model: ClearanceModel,
    /// Plates that the sponge may touch, for each segment.
    touchable: Vec<Vec<usize>>,
}

impl ClearanceRule {
    /// Builds the rule for a plan. The plan need not be provable: its segments are taken as stated.
    ///
    /// # Errors
    /// [`ProveError`] for a job with which nothing can be computed, or a shape that is none.
    pub fn new(plan: &Plan, arm: &RobotModel) -> Result<Self, ProveError> {
        plan.job.validate().map_err(ProveError::Job)?;
        let plan = &*plan.seen_from_base();
        let judged = JudgedJob::new(&plan.job, arm, wash_paths::by_plate(plan));
        let exclusions = Exclusions::find(&judged)?;
        let world = Workcell {
            exclusions: exclusions.own.into_iter().chain(exclusions.waived).collect(),
            ..plan.job.workcell.clone()
        };
        let plates = 0..plan.job.plates.len();
        let touchable = |(kind, on)| {
            plates
                .clone()
                .filter(|&plate| may_touch(&judged, kind, on, plate))
                .collect()
        };
        let segments = plan.segments.iter().map(|segment| (segment.kind, segment.plate));
        Ok(Self {
            model: ClearanceModel::new(arm, &world, &plan.job.plates)?,
            touchable: segments.map(touchable).collect(),
        })
    }

    /// Names of the bodies, in the order of [`NearestBodies::bodies`].
    #[must_use]
    pub fn body_names(&self) -> Vec<&str> {
        self.model.body_names()
    }

    /// Returns the nearest of the pairs that count at `q` \[rad\] in a segment, or outside of all segments. `None` where no pair counts.
    #[must_use]
    pub fn nearest(&self, q: &JointVector, segment: Option<usize>) -> Option<NearestBodies> {
        let touchable = segment.and_then(|segment| self.touchable.get(segment));
        self.model.nearest(q, touchable.map_or(&[], |plates| plates.as_slice()))
    }
}
