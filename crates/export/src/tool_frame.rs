//! A tool as a controller has it, beside the plan's.

use crate::reading::ReadTool;
use crate::refusal::Refusal;
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::Pose;
use platewash_workcell::tool::{Tool, ToolMass};

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

/// Largest difference of a part of the inertia from the plan's: as a share of its greatest part, and what digits round away \[kg·m²\].
const INERTIA_WITHIN: (f64, f64) = (1e-2, 2e-9);

/// Returns the refusal of the tool that a program states, beside what was handed over of a plan: a part that is no longer stated, or is
/// another one.
pub(crate) fn refusal(found: Option<&ReadTool>, handed_over: Option<&ReadTool>, plan: &Tool) -> Option<Refusal> {
    let Some(found) = found else {
        return handed_over.map(|_| Refusal::Load {
            reason: "the program sets no tool, as it did when it was handed over: neither its tip nor its load"
                .to_owned(),
        });
    };
    if found.tip.is_none() && handed_over.is_some_and(|tool| tool.tip.is_some()) {
        return Some(Refusal::Frame {
            reason: "the program does not set the tool's tip, as it did when it was handed over".to_owned(),
        });
    }
    found.refusal(plan)
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
        if is_near {
            return self.inertia_refusal(expected);
        }
        Some(Refusal::Load {
            reason: format!(
                "the program states a load of {:.3} kg, its centre {:.1} mm from the plan's; the plan's weighs {:.3} kg: plan with the tool \
                 as it is",
                self.mass_kg,
                1e3 * off_m,
                expected.mass_kg
            ),
        })
    }

    /// Returns the refusal where the moments and products of inertia that it states are not the plan's.
    fn inertia_refusal(&self, expected: &ToolMass) -> Option<Refusal> {
        let (moments, axes) = self.inertia?;
        let [ixx, ixy, ixz, iyy, iyz, izz] = expected.inertia_kg_m2;
        let expected = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
        let turn = axes.to_rotation_matrix();
        let found = turn.matrix() * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.matrix().transpose();
        let (most_part, most_kg_m2) = INERTIA_WITHIN;
        let off_kg_m2 = (found - expected).amax();
        (off_kg_m2 > most_part * expected.amax() + most_kg_m2).then(|| Refusal::Load {
            reason: format!(
                "the program states a load whose inertia is {off_kg_m2:.2e} kg·m² from the plan's, whose greatest part is {:.2e} kg·m²: plan \
                 with the tool as it is",
                expected.amax()
            ),
        })
    }
}
