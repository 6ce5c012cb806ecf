//! A tool as a controller has it, beside the plan's.

use crate::reading::ReadTool;
use crate::refusal::Refusal;
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::tool_mount::ToolMount;
use platewash_kinematics::{Pose, RobotModel, ToolFrame};
use platewash_workcell::tool::{Tool, ToolMass};

/// Largest difference of a tip from the plan's: \[m\], \[rad\].
const TIP_WITHIN: (f64, f64) = (5e-4, 0.01);

/// Largest difference of a mounting frame from the description's `tool0`: \[m\], \[rad\].
const MOUNT_WITHIN: (f64, f64) = (1e-4, 0.01);

/// Refuses a tool whose mounting frame cannot be the `tool0` of a controller, from which a program states the tool: z out of the arm along
/// axis 6, and at the place of the description's own `tool0`, if that is one.
///
/// # Errors
/// [`Refusal::Frame`].
pub(crate) fn check_mount(tool: &Tool, arm: &RobotModel) -> Result<(), Refusal> {
    let mount = tool.mounting_frame(arm);
    let refused = |found: String| {
        let on = ToolMount::from_text(tool.mounted_on.as_deref().unwrap_or(ToolFrame::Tool0.name()));
        Err(Refusal::Frame(format!(
            "the tool is mounted on link '{}' along its {} axis, {found}; a program states the tool from the controller's tool0, whose z \
                 axis leaves the flange along axis 6: plan with another mount (tool.mounted_on, --tool-mount LINK:AXIS)",
            on.link, on.axis
        )))
    };
    if arm.leads_out(&mount) == Some(false) {
        return refused(format!(
            "{:.1}° from axis 6 as the description turns it",
            mount.tilt_rad().to_degrees()
        ));
    }
    let Some(tool0) = arm
        .tool_frame(ToolFrame::Tool0)
        .ok()
        .filter(|tool0| arm.leads_out(tool0) != Some(false))
    else {
        return Ok(());
    };
    let off = Pose::from(&tool0.on_body().inverse().then(mount.on_body()));
    let (off_m, turned_rad) = (off.translation.vector.norm(), off.rotation.angle());
    let (most_m, most_rad) = MOUNT_WITHIN;
    match off_m <= most_m && turned_rad <= most_rad {
        true => Ok(()),
        false => refused(format!(
            "{:.1} mm and {:.1}° from the description's tool0",
            1e3 * off_m,
            turned_rad.to_degrees()
        )),
    }
}

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
    Err(Refusal::Frame(format!(
        "the tool's tip is {:.2} mm and {:.2}° from the plan's; at most {:.1} mm and {:.1}° are accepted: calibrate the tool, or plan \
             with the tool as it is",
        1e3 * off_m,
        turned_rad.to_degrees(),
        1e3 * most_m,
        most_rad.to_degrees()
    )))
}

/// Largest difference of a part of the inertia from the plan's: as a share of its greatest part, and what digits round away \[kg·m²\].
const INERTIA_WITHIN: (f64, f64) = (1e-2, 2e-9);

/// Returns the refusal of the tool that a program states, beside what was handed over of a plan: a part that is no longer stated, or is
/// another one.
pub(crate) fn refusal(found: Option<&ReadTool>, handed_over: Option<&ReadTool>, plan: &Tool) -> Option<Refusal> {
    let Some(found) = found else {
        return handed_over.map(|_| {
            Refusal::Load(
                "the program sets no tool, as it did when it was handed over: neither its tip nor its load".to_owned(),
            )
        });
    };
    if found.tip.is_none() && handed_over.is_some_and(|tool| tool.tip.is_some()) {
        return Some(Refusal::Frame(
            "the program does not set the tool's tip, as it did when it was handed over".to_owned(),
        ));
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
        Some(Refusal::Load(format!(
            "the program states a load of {:.3} kg, its centre {:.1} mm from the plan's; the plan's weighs {:.3} kg: plan with the tool \
                 as it is",
            self.mass_kg,
            1e3 * off_m,
            expected.mass_kg
        )))
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
        (off_kg_m2 > most_part * expected.amax() + most_kg_m2).then(|| Refusal::Load(format!(
                "the program states a load whose inertia is {off_kg_m2:.2e} kg·m² from the plan's, whose greatest part is {:.2e} kg·m²: plan \
                 with the tool as it is",
                expected.amax()
            )))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use platewash_kinematics::irb120::IRB120_URDF;
    use platewash_kinematics::urdf::MeshSource;
    use platewash_workcell::tool::StraightTool;

    /// The refusal of a tool on a link of the IRB 120 whose tool0 has another origin.
    fn refused(origin: &str, mount: &str) -> Option<String> {
        let tool0 = IRB120_URDF.find("<child link=\"tool0\"/>").unwrap();
        let edited = IRB120_URDF[tool0..].replacen("xyz=\"0 0 0\" rpy=\"0 1.5707963267948966 0\"", origin, 1);
        let text = format!("{}{edited}", &IRB120_URDF[..tool0]);
        let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
        let tool = Tool::from(StraightTool::default())
            .mounted(Some(mount.to_owned()))
            .on(&arm)
            .unwrap();
        check_mount(&tool, &arm).err().map(|refusal| refusal.to_string())
    }

    #[test]
    fn a_tool_is_stated_only_from_a_frame_that_can_be_the_controllers() {
        let usual = "xyz=\"0 0 0\" rpy=\"0 1.5707963267948966 0\"";
        assert_eq!(refused(usual, "tool0"), None);
        assert_eq!(refused(usual, "flange:x"), None);
        for (origin, mount, words) in [
            ("xyz=\"0 0 0\"", "tool0", "90.0° from axis 6"),
            (
                "xyz=\"0 0 0\" rpy=\"0 -1.5707963267948966 0\"",
                "tool0",
                "180.0° from axis 6",
            ),
            (usual, "flange", "90.0° from axis 6"),
            (
                "xyz=\"0.05 0 0\" rpy=\"0 1.5707963267948966 0\"",
                "flange:x",
                "50.0 mm and 0.0° from the description's tool0",
            ),
            (
                "xyz=\"0 0 0\" rpy=\"1.5707963267948966 0 1.5707963267948966\"",
                "flange:x",
                "0.0 mm and 90.0° from the description's tool0",
            ),
        ] {
            let found = refused(origin, mount).unwrap();
            assert!(
                found.contains(words) && found.contains(mount.trim_end_matches(":x")),
                "{words}: {found}"
            );
        }
        assert_eq!(refused("xyz=\"0 0 0\"", "tool0:x"), None, "turned, it leads out");
    }
}
