//! Data of a program, its `main`, and its checks before it moves.
//!
//! The tool as RAPID states it: tip frame and load, in mm, kg and kg·m².

use crate::dialect::Program;
use crate::maker_joints::Joint3;
use crate::rapid::write::motion::{Routine, target, zone};
use crate::rapid::write::{Lines, MOST, RUNNING, SHARE, number};
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use platewash_kinematics::JointVector;
use platewash_workcell::tool::{Tool, ToolMass};

/// The tool, the share of the speed, the start, and a zone that has no name.
pub fn data(lines: &mut Lines, program: &Program<'_>) {
    lines.comment(1, "The tool: its tip from the flange, and its load.");
    lines.line(1, &format!("PERS tooldata pwTool:={};", tooldata(program.tool())));
    lines.comment(
        1,
        "Share of the plan's speed; every time is divided by it. It may be lowered here or on the pendant.",
    );
    // The shortest decimal of a single: the controller reads exactly the intended value.
    let share = program.speed_share as f32;
    lines.line(1, &format!("PERS num {SHARE}:={share};"));
    lines.comment(
        1,
        "What it was judged for: it may be no more. For a faster program export another one.",
    );
    lines.line(1, &format!("CONST num {MOST}:={share};"));
    lines.comment(1, "The share of this run, which does not change before it ends.");
    lines.line(1, &format!("VAR num {RUNNING}:=0;"));
    lines.comment(1, "Where the arm must stand.");
    let start = program
        .points
        .first()
        .map_or_else(JointVector::zeros, |point| point.q_rad);
    lines.line(
        1,
        &format!("CONST jointtarget pwStart:={};", target(program.joint_3, &start)),
    );
    if let Some(radius_mm) = zone(program).radius_mm() {
        let [tip, more, angle] = [radius_mm, 1.5 * radius_mm, 0.15 * radius_mm].map(|value| number(value, 6));
        lines.comment(1, "Corners at targets that are no stops.");
        lines.line(
            1,
            &format!("CONST zonedata pwZone:=[FALSE,{tip},{more},{more},{angle},{more},{angle}];"),
        );
    }
}

/// The procedure that runs everything, once.
pub fn main(lines: &mut Lines, routines: &[Routine], within_deg: f64) {
    lines.comment(1, "The whole plan, once.");
    lines.line(1, "PROC main()");
    lines.line(2, "pwCheckShare;");
    lines.line(2, "pwCheckStart;");
    lines.comment(
        2,
        &format!("To the start itself, which is {within_deg} deg away at most."),
    );
    lines.line(2, "MoveAbsJ pwStart\\NoEOffs,v20,fine,pwTool\\WObj:=wobj0;");
    for routine in routines {
        lines.line(2, &format!("{};", routine.name()));
    }
    lines.comment(2, "Also in continuous mode the plan is not run again by itself.");
    lines.line(2, "EXIT;");
    lines.line(1, "ENDPROC");
}

/// Writes the checks before the arm moves. Where a check fails the program ends: `EXIT` cannot be passed by starting it again,
/// `Stop` can. Joint 3 is checked as the description has it: where axis 3 is counted with axis 2, as far off as axis 3 is more than axis 2.
pub fn checks(lines: &mut Lines, within_deg: f64, joint_3: Joint3) {
    lines.blank();
    lines.line(1, "PROC pwCheckShare()");
    lines.line(2, &format!("IF {SHARE}>0 AND {SHARE}<={MOST} THEN"));
    lines.line(3, &format!("{RUNNING}:={SHARE};"));
    lines.line(3, "RETURN;");
    lines.line(2, "ENDIF");
    lines.line(2, "TPErase;");
    lines.line(2, &format!("TPWrite \"{SHARE} is \"+ValToStr({SHARE})+\".\";"));
    lines.line(
        2,
        &format!("TPWrite \"It must be above 0 and at most \"+ValToStr({MOST})+\". Nothing has moved.\";"),
    );
    lines.line(2, "EXIT;");
    lines.line(1, "ENDPROC");
    lines.blank();
    lines.line(1, "PROC pwCheckStart()");
    lines.line(2, "VAR jointtarget now;");
    lines.line(2, "now:=CJointT();");
    for joint in 1..=6 {
        let with = match (joint, joint_3) {
            (3, Joint3::WithJoint2) => "+(now.robax.rax_2-pwStart.robax.rax_2)",
            _ => "",
        };
        lines.line(
            2,
            &format!("pwCheckJoint {joint},now.robax.rax_{joint},pwStart.robax.rax_{joint}{with};"),
        );
    }
    lines.line(1, "ENDPROC");
    lines.blank();
    lines.line(1, "PROC pwCheckJoint(num joint,num found,num expected)");
    lines.line(2, &format!("IF Abs(found-expected)<={within_deg} RETURN;"));
    lines.line(2, "TPErase;");
    lines.line(
        2,
        "TPWrite \"Joint \"+NumToStr(joint,0)+\" stands at \"+NumToStr(found,4)+\" deg.\";",
    );
    lines.line(2, "TPWrite \"The program starts at \"+NumToStr(expected,4)+\" deg.\";");
    lines.line(
        2,
        &format!("TPWrite \"That is more than {within_deg} deg away: jog the arm there.\";"),
    );
    lines.line(
        2,
        "TPWrite \"Then set the program pointer to main. Nothing has moved.\";",
    );
    lines.line(2, "EXIT;");
    lines.line(1, "ENDPROC");
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
    use platewash_workcell::fixtures::kitchen_tool;
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
