//! Data of a program, its `main`, and its checks before it moves.
//!
//! The tool as RAPID states it: tip frame and load, in mm, kg and kg·m².

use crate::dialect::start_within::{START_WITHIN, start_within_deg};
use crate::joint_3::Joint3;
use crate::program::Program;
use crate::rapid::write::motion::{OWN_ZONE, Routine, target, zone};
use crate::rapid::write::number::number;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use platewash_workcell::tool::{Tool, ToolMass};

/// The data and `main`, with places for what depends on the program.
const START: &str = include_str!("start.mod");

/// The checks before the arm moves. Where one fails the program ends: `EXIT` cannot be passed by starting it again, `Stop` can.
const CHECKS: &str = include_str!("checks.mod");

/// The tool, the share of the speed, the start, a zone that has no name, and the procedure that runs everything, once.
pub fn data_and_main(program: &Program<'_>, routines: &[Routine]) -> String {
    // The shortest decimal of a single: the controller reads exactly the intended value.
    let share = (program.speed_share as f32).to_string();
    let start = program.points.first().map(|point| point.q_rad).unwrap_or_default();
    let calls: String = routines
        .iter()
        .map(|routine| format!("    {};\n", routine.name))
        .collect();
    START
        .replace("{tool}", &tooldata(program.tool()))
        .replace("{share}", &share)
        .replace("{start}", &target(program.joint_3, &start))
        .replace("{zone}", &own_zone(program.corner_m))
        .replace(START_WITHIN, &start_within_deg(&program.plan.job).to_string())
        .replace("{calls}", &calls)
}

fn own_zone(radius_m: f64) -> String {
    if zone(radius_m) != OWN_ZONE {
        return String::new();
    }
    let radius_mm = radius_m * 1e3;
    let [tip, more, angle] = [radius_mm, 1.5 * radius_mm, 0.15 * radius_mm].map(|value| number(value, 6));
    format!(
        "  ! Corners at targets that are no stops.\n  CONST zonedata {OWN_ZONE}:=[FALSE,{tip},{more},{more},{angle},{more},{angle}];\n"
    )
}

/// Returns the checks, with the largest distance from the start \[°\]. Joint 3 is checked as the description has it: where axis 3 is
/// counted with axis 2, as far off as axis 3 is more than axis 2.
pub fn checks(within_deg: f64, joint_3: Joint3) -> String {
    let with_joint_2 = match joint_3 {
        Joint3::WithJoint2 => "+(now.robax.rax_2-pwStart.robax.rax_2)",
        Joint3::Independent => "",
    };
    let checks = CHECKS.replace(START_WITHIN, &within_deg.to_string());
    checks.replace("{with_joint_2}", with_joint_2)
}

/// Decimals of millimetres, beyond those of a `num` at 100 mm.
const MM_DECIMALS: usize = 6;
/// Decimals of parts of quaternions, of kilograms and of moments of inertia.
const DECIMALS: usize = 9;

/// The aggregate of a `tooldata`.
pub fn tooldata(tool: &Tool) -> String {
    let position = millimetres(tool.tip.translation.vector.into());
    let orientation = quaternion(&tool.tip.rotation);
    format!("[TRUE,[{position},{orientation}],{}]", load(tool.mass.as_ref()))
}

fn load(mass: Option<&ToolMass>) -> String {
    let Some(mass) = mass else {
        // Load that a controller takes for no load at all; such a tool is refused earlier.
        return "[0.001,[0,0,0.001],[1,0,0,0],0,0,0]".to_owned();
    };
    let (axes, moments) = principal(mass.inertia_kg_m2);
    let [ix, iy, iz] = moments.map(|moment| number(moment.max(0.0), DECIMALS));
    let (kg, com) = (number(mass.mass_kg, DECIMALS), millimetres(mass.com_m));
    format!("[{kg},{com},{},{ix},{iy},{iz}]", quaternion(&axes))
}

/// Axes in which an inertia has no products, and its moments about them: ixx, ixy, ixz, iyy, iyz, izz → `R diag(ix, iy, iz) Rᵀ`.
fn principal(inertia: [f64; 6]) -> (UnitQuaternion<f64>, [f64; 3]) {
    let [ixx, ixy, ixz, iyy, iyz, izz] = inertia;
    if [ixy, ixz, iyz] == [0.0; 3] {
        return (UnitQuaternion::identity(), [ixx, iyy, izz]);
    }
    let eigen = SymmetricEigen::new(Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz));
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let [first, second, _] = order.map(|index| turned_up(eigen.eigenvectors.column(index).into()));
    // The third axis makes them right-handed.
    let axes = Matrix3::from_columns(&[first, second, first.cross(&second)]);
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    (rotation, order.map(|index| eigen.eigenvalues[index]))
}

/// An axis of two directions: the one in which its largest part is positive.
fn turned_up(axis: Vector3<f64>) -> Vector3<f64> {
    if axis[axis.iamax()] < 0.0 { -axis } else { axis }
}

fn millimetres(metres: [f64; 3]) -> String {
    let [x, y, z] = metres.map(|m| number(m * 1e3, MM_DECIMALS));
    format!("[{x},{y},{z}]")
}

fn quaternion(rotation: &UnitQuaternion<f64>) -> String {
    let q = rotation.quaternion();
    let length = q.norm();
    // Of two quaternions for one rotation, the one that begins with a positive part.
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let [w, x, y, z] = [q.w, q.i, q.j, q.k].map(|part| number(sign * part / length, DECIMALS));
    format!("[{w},{x},{y},{z}]")
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_fixtures::kitchen_tool;
    use proptest::prelude::*;

    #[test]
    fn writes_the_kitchen_tool_in_rapid() {
        // 0.3 (3 · 0.02² + 0.15²) / 12 = 5.925e-4, 0.3 · 0.02² / 2 = 6e-5.
        let text = "[TRUE,[[0,0,150],[1,0,0,0]],[0.3,[0,0,75],[1,0,0,0],0.0005925,0.0005925,0.00006]]";
        assert_eq!(tooldata(&kitchen_tool()), text);
    }

    proptest! {
        #[test]
        fn principal_axes_recover_the_inertia(parts in proptest::array::uniform6(-1.0..1.0_f64)) {
            let (axes, moments) = principal(parts);
            let r = axes.to_rotation_matrix();
            let back = r.matrix() * Matrix3::from_diagonal(&Vector3::from(moments)) * r.matrix().transpose();
            let [ixx, ixy, ixz, iyy, iyz, izz] = parts;
            let inertia = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
            prop_assert!((back - inertia).amax() < 1e-12);
            prop_assert!((r.matrix().determinant() - 1.0).abs() < 1e-12);
        }
    }
}
