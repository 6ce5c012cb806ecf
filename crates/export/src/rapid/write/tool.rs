//! The tool as RAPID states it: tip frame and load, in mm, kg and kg·m².

use super::line::number;
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use platewash_workcell::tool::{Tool, ToolMass};

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
        // What a controller takes for nothing at all; such a tool is refused before.
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
    fn the_kitchen_tool_in_rapid() {
        // 0.3 (3 · 0.02² + 0.15²) / 12 = 5.925e-4, 0.3 · 0.02² / 2 = 6e-5.
        let text = "[TRUE,[[0,0,150],[1,0,0,0]],[0.3,[0,0,75],[1,0,0,0],0.0005925,0.0005925,0.00006]]";
        assert_eq!(tooldata(&kitchen_tool()), text);
    }

    proptest! {
        #[test]
        fn principal_axes_give_the_inertia_back(parts in proptest::array::uniform6(-1.0..1.0_f64)) {
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
