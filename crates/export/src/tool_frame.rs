//! A tool as a controller has it, beside the plan's.

use crate::reading::ReadTool;
use crate::refusal::Refusal;
use platewash_kinematics::Pose;
use platewash_workcell::tool::Tool;

/// Largest difference of a tip from the plan's: \[m\], \[rad\].
const TIP_WITHIN: (f64, f64) = (5e-4, 0.01);

/// Largest difference of a mass from the plan's, as a part of it, and of a centre of mass \[m\].
const LOAD_WITHIN: (f64, f64) = (1e-3, 1e-4);

/// Refuses a tip, `T_flange_tip`, that is not the plan's.
///
/// # Errors
/// [`Refusal::Frame`].
pub(crate) fn check(found: &Pose, expected: &Pose) -> Result<(), Refusal> {
    let (most_m, most_rad) = TIP_WITHIN;
    let off_m = (found.translation.vector - expected.translation.vector).norm();
    let turned_rad = found.rotation.angle_to(&expected.rotation);
    if off_m <= most_m && turned_rad <= most_rad {
        return Ok(());
    }
    Err(Refusal::Frame {
        reason: format!(
            "the tool's tip is {:.2} mm and {:.2}° from the plan's; at most {:.1} mm and {:.1}° are accepted: calibrate the tool, or plan \
             with the tool as it is",
            1e3 * off_m,
            turned_rad.to_degrees(),
            1e3 * most_m,
            most_rad.to_degrees()
        ),
    })
}

impl ReadTool {
    /// Returns the refusal if it is not the tool of a plan.
    pub(crate) fn refusal(&self, plan: &Tool) -> Option<Refusal> {
        let tip = self.tip.as_ref().and_then(|tip| check(tip, &plan.tip).err());
        tip.or_else(|| self.load(plan))
    }

    fn load(&self, plan: &Tool) -> Option<Refusal> {
        let (most_part, most_m) = LOAD_WITHIN;
        let expected = plan.mass.as_ref()?;
        let off_kg = (self.mass_kg - expected.mass_kg).abs();
        let off_m = (0..3)
            .map(|i| (self.com_m[i] - expected.com_m[i]).abs())
            .fold(0.0, f64::max);
        let is_near = off_kg <= most_part * expected.mass_kg && off_m <= most_m;
        (!is_near).then(|| Refusal::Load {
            reason: format!(
                "the program states a load of {:.3} kg, its centre {:.1} mm from the plan's; the plan's weighs {:.3} kg: plan with the tool \
                 as it is",
                self.mass_kg,
                1e3 * off_m,
                expected.mass_kg
            ),
        })
    }
}
