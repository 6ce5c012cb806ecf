//! Poses from 4 × 4 matrices.

use crate::errors::Input;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use platewash::Pose;

/// Entries of a rotation matrix may be this far from orthonormal.
const ORTHONORMAL: f64 = 1e-6;

/// A pose `T_base_frame` from a 4 × 4 matrix, row by row.
///
/// # Errors
/// What is wrong with it, in words.
pub fn pose(matrix: &[f64]) -> Result<Pose, Input> {
    let Ok(m) = <&[f64; 16]>::try_from(matrix) else {
        return Err(Input("16 numbers are needed".to_owned()));
    };
    Ok(scaled(m, multiple(m)?))
}

/// The same of many, into `poses` in place of what was there; `room` is scratch.
///
/// Roots and divisions wait for each other within one pose, but not from pose to pose: they have a loop of their own.
///
/// # Errors
/// The first matrix that is no pose, and what is wrong with it.
pub fn poses(
    matrices: &[[f64; 16]],
    room: &mut Vec<Quaternion<f64>>,
    poses: &mut Vec<Pose>,
) -> Result<(), (usize, Input)> {
    room.clear();
    for (k, matrix) in matrices.iter().enumerate() {
        room.push(multiple(matrix).map_err(|e| (k, e))?);
    }
    poses.clear();
    poses.extend(matrices.iter().zip(room).map(|(matrix, q)| scaled(matrix, *q)));
    Ok(())
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
    if !surely_rotation(&rows) {
        rotation_or_why(&rows)?;
    }
    Ok(quaternion(&rows))
}

/// Whether three rows are a rotation to well within [`ORTHONORMAL`]: two unit rows at right angles, and their product.
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
    off.iter().all(|off| off.abs() < 0.1 * ORTHONORMAL)
}

/// Refuses three rows that are no rotation.
fn rotation_or_why(rows: &[f64; 9]) -> Result<(), Input> {
    let rotation = Matrix3::from_row_slice(rows);
    let off = (rotation.tr_mul(&rotation) - Matrix3::identity()).amax();
    if off > ORTHONORMAL {
        return Err(Input(format!(
            "the upper left 3 × 3 must be a rotation; its columns are {off:.1e} from orthonormal"
        )));
    }
    if rotation.determinant() < 0.0 {
        return Err(Input("the upper left 3 × 3 is a reflection, no rotation".to_owned()));
    }
    Ok(())
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
