//! Poses from 4 × 4 matrices.

use crate::exception::Input;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use platewash::Pose;

/// Largest accepted entry of RᵀR − I; entries of R rounded to six decimals give 2e-6. A matrix within this bound is replaced by the nearest
/// rotation.
const ROUNDED: f64 = 1e-5;

/// Largest entry of RᵀR − I that needs no nearest rotation, as it is below the tolerance of any solver.
const EXACT: f64 = 1e-7;

/// Quaternion of NaN, in place of that of a matrix that is no pose.
const NO_POSE: Quaternion<f64> = Quaternion {
    coords: nalgebra::Vector4::new(f64::NAN, f64::NAN, f64::NAN, f64::NAN),
};

/// A pose `T_base_frame` from a 4 × 4 matrix, row by row.
///
/// # Errors
/// A matrix that is no pose; the error states the fault in words.
pub fn pose(matrix: &[f64]) -> Result<Pose, Input> {
    let Ok(m) = <&[f64; 16]>::try_from(matrix) else {
        return Err(Input("16 numbers are needed".to_owned()));
    };
    Ok(scaled(m, multiple(m)?))
}

/// Poses `T_base_frame` from many matrices; they replace the contents of `poses`, and `room` is scratch. A matrix that is no pose becomes
/// a pose of NaN.
///
/// Roots and divisions have a loop of their own: they depend on each other within one pose, but not from pose to pose.
pub fn poses(matrices: &[[f64; 16]], room: &mut Vec<Quaternion<f64>>, poses: &mut Vec<Pose>) {
    room.clear();
    room.extend(matrices.iter().map(|matrix| multiple(matrix).unwrap_or(NO_POSE)));
    poses.clear();
    poses.extend(matrices.iter().zip(room).map(|(matrix, q)| scaled(matrix, *q)));
}

/// A pose with a matrix's translation and a multiple of its quaternion.
fn scaled(m: &[f64; 16], quaternion: Quaternion<f64>) -> Pose {
    let rotation = UnitQuaternion::new_normalize(quaternion);
    Pose::from_parts(Vector3::new(m[3], m[7], m[11]).into(), rotation)
}

/// A multiple of the quaternion of a matrix that is a pose.
fn multiple(m: &[f64; 16]) -> Result<Quaternion<f64>, Input> {
    if let Some(found) = m.iter().find(|v| !v.is_finite()) {
        return Err(Input(format!("entries must be finite; found {found}")));
    }
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        let row = &m[12..];
        return Err(Input(format!("the last row must be (0, 0, 0, 1); found {row:?}")));
    }
    let rows = [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
    if surely_rotation(&rows) {
        return Ok(quaternion(&rows));
    }
    Ok(quaternion(&nearest_rotation(&rows)?))
}

/// True where three rows are a rotation to within [`EXACT`]: two unit rows at right angles, and their product.
fn surely_rotation(&[a, b, c, d, e, f, g, h, i]: &[f64; 9]) -> bool {
    let off = [
        a * a + b * b + c * c - 1.0,
        d * d + e * e + f * f - 1.0,
        a * d + b * e + c * f,
        b * f - c * e - g,
        c * d - a * f - h,
        a * e - b * d - i,
    ];
    // Not a comparison with the largest: NaN must not pass.
    off.iter().all(|off| off.abs() < EXACT)
}

/// The rotation nearest to three rows that are nearly one, in the sum of squares: the orthogonal factor of the polar decomposition,
/// by the iteration R ← R (3 I − RᵀR) / 2, which squares the error (Björck and Bowie, SIAM J. Numer. Anal. 8, 1971).
fn nearest_rotation(rows: &[f64; 9]) -> Result<[f64; 9], Input> {
    let mut rotation = Matrix3::from_row_slice(rows);
    let gram = |r: &Matrix3<f64>| r.tr_mul(r);
    let off = (gram(&rotation) - Matrix3::identity()).amax();
    if off > ROUNDED {
        return Err(Input(format!(
            "the upper left 3 × 3 must be a rotation; its columns are {off:.1e} from orthonormal, and up to {ROUNDED:.0e} is taken for \
             rounding: give more digits, or its nearest rotation, U @ Vt of U, s, Vt = np.linalg.svd(target[:3, :3])"
        )));
    }
    if rotation.determinant() < 0.0 {
        return Err(Input("the upper left 3 × 3 is a reflection, no rotation".to_owned()));
    }
    for _ in 0..2 {
        rotation *= (Matrix3::identity() * 3.0 - gram(&rotation)) * 0.5;
    }
    let [x, y, z] = rotation.transpose().data.0;
    Ok([x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]])
}

/// A multiple of the quaternion of a rotation: of the four rows of `4 q qᵀ`, which the entries of the matrix add up to, the one with the
/// largest diagonal (Shepperd, J. Guidance and Control 1, 1978). No branches: they cost more than the rest.
fn quaternion(&[a, b, c, d, e, f, g, h, i]: &[f64; 9]) -> Quaternion<f64> {
    let squares = [1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i];
    let (wx, wy, wz) = (h - f, c - g, d - b);
    let (xy, xz, yz) = (b + d, c + g, f + h);
    let rows = [
        [squares[0], wx, wy, wz],
        [wx, squares[1], xy, xz],
        [wy, xy, squares[2], yz],
        [wz, xz, yz, squares[3]],
    ];
    let first = usize::from(squares[1] > squares[0]);
    let second = 2 + usize::from(squares[3] > squares[2]);
    let [w, x, y, z] = rows[if squares[second] > squares[first] {
        second
    } else {
        first
    }];
    Quaternion::new(w, x, y, z)
}
