//! Recognition of an arm: the structures are tried in turn. A structure that the arm does not have at all keeps the reason found before.

use crate::ik::analytic::arm::AnalyticArm;
use crate::ik::analytic::closed_form::ClosedForm;
use crate::ik::analytic::geometry::Geometry;
use crate::ik::analytic::mismatch::StructureMismatch;
use crate::ik::analytic::parallel::arm::ParallelAxesArm;
use crate::ik::analytic::spherical::arm::SphericalWristArm;
use crate::model::RobotModel;
use std::sync::Arc;

impl AnalyticArm {
    /// Recognises the arm from the folded chain of the model.
    ///
    /// # Errors
    /// [`StructureMismatch`]: the first property of the [module](super)'s lists that fails by more than the rounding of the description's
    /// numbers. Where axes 2, 3 and 4 are parallel it is from the second list, else from the first.
    pub fn recognise(robot: &RobotModel) -> Result<Self, StructureMismatch> {
        let geometry = &Geometry::from_robot(robot);
        let form = SphericalWristArm::recognise(geometry).map(shared).or_else(|mismatch| {
            ParallelAxesArm::recognise(geometry)
                .unwrap_or(Err(mismatch))
                .map(shared)
        })?;
        Ok(Self { form })
    }
}

fn shared(form: impl ClosedForm + 'static) -> Arc<dyn ClosedForm> {
    Arc::new(form)
}
