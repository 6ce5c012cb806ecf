//! The plan file of a run.

use crate::run::PaperRun;
use platewash_workcell::plan::{Knots, Plan, PlanFileError, PlanParts, Provenance};

impl PaperRun {
    /// The plan file of the commanded motion, sealed. There is no certificate for it.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn plan(&self) -> Result<Plan, PlanFileError> {
        let parts = PlanParts {
            provenance: Provenance::of(&self.job.name),
            order: self.tool_path.order.clone(),
            wash_paths: Vec::new(),
            segments: self.segments(),
            knots: Knots::from(&self.planned),
        };
        Plan::sealed(self.job.terms()?, parts)
    }
}
