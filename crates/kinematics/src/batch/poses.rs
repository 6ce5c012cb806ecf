//! The two forward batches: poses, and Jacobians.

use crate::batch::chain::Chain;
use crate::batch::forward::{Tips, dot, frames, frames_and_lines, gather, moment, no_lines};
use crate::batch::slices::{BatchError, CHUNK, same_length};
use crate::joints::JointVector;
use crate::lanes::{Backend, Kernel, LANES, Vector, run};
use crate::model::{Axes, Frame, Jacobian, RobotModel};
use crate::rotation::Pose;
use crate::rotation::RigidTransform;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Poses `T_base_frame` at the joint positions `q` \[rad\], in their order. Limits are not checked; a configuration
/// with NaN or ∞ in a joint between base and frame gives NaN throughout and leaves the others alone.
///
/// Agrees with [`RobotModel::pose`] within 1e-12 (m, and entries of the rotation matrix). A quaternion per pose costs
/// about as much as its forward kinematics: [`fk_into`] is the fast form.
#[must_use]
pub fn fk(robot: &RobotModel, frame: &Frame, q: &[JointVector], path: Backend) -> Vec<Pose> {
    let (mut positions, mut rotations) = (vec![[0.0; 3]; q.len()], vec![[0.0; 9]; q.len()]);
    evaluate(&Chain::new(robot, frame), q, &mut positions, &mut rotations, path);
    let pose = |(p, r): (&[f64; 3], &[f64; 9])| {
        Pose::from(&RigidTransform {
            rotation: Matrix3::from_row_slice(r),
            translation: Vector3::from(*p),
        })
    };
    positions
        .par_iter()
        .zip(&rotations)
        .with_min_len(CHUNK)
        .map(pose)
        .collect()
}

/// The same as [`fk`] without a quaternion and without an allocation per call beyond the chain's: configuration k
/// gives `positions[k]`, the frame's origin in the base frame \[m\], and `rotations[k]`, `R_base_frame` row by row.
///
/// # Errors
/// [`BatchError::Length`] when a slice is not as long as `q`; nothing is written then.
pub fn fk_into(
    robot: &RobotModel,
    frame: &Frame,
    q: &[JointVector],
    positions: &mut [[f64; 3]],
    rotations: &mut [[f64; 9]],
    path: Backend,
) -> Result<(), BatchError> {
    same_length("positions", q.len(), positions.len())?;
    same_length("rotations", q.len(), rotations.len())?;
    evaluate(&Chain::new(robot, frame), q, positions, rotations, path);
    Ok(())
}

/// The same as [`fk_into`] as homogeneous matrices: `matrices[k]` is `T_base_frame` (4 × 4) row by row, the last row
/// (0, 0, 0, 1).
///
/// # Errors
/// [`BatchError::Length`] when `matrices` is not as long as `q`; nothing is written then.
pub fn fk_matrices_into(
    robot: &RobotModel,
    frame: &Frame,
    q: &[JointVector],
    matrices: &mut [[f64; 16]],
    path: Backend,
) -> Result<(), BatchError> {
    same_length("matrices", q.len(), matrices.len())?;
    let chain = Chain::new(robot, frame);
    let chunks = q.par_chunks(CHUNK).zip(matrices.par_chunks_mut(CHUNK));
    chunks.for_each(|(q, matrices)| {
        run(
            path,
            Matrices {
                chain: &chain,
                q,
                matrices,
            },
        )
    });
    Ok(())
}

/// Geometric Jacobians (rows: m/rad, then rad/rad) of `frame` at the joint positions `q` \[rad\], in their order, in
/// the given axes: column i is `(z_i × (p − p_i), z_i)`, zero for joints beyond the frame. Agrees with
/// [`BodyPoses::jacobian`] within 1e-12.
/// NaN and ∞ as in [`fk`]: they spoil the columns of their own configuration that depend on them.
///
/// [`BodyPoses::jacobian`]: crate::BodyPoses::jacobian
#[must_use]
pub fn jacobian(robot: &RobotModel, frame: &Frame, q: &[JointVector], axes: Axes, path: Backend) -> Vec<Jacobian> {
    let mut jacobians = vec![Jacobian::zeros(); q.len()];
    differentiate(&Chain::new(robot, frame), q, &mut jacobians, axes, path);
    jacobians
}

/// The same as [`jacobian`], written to `jacobians`.
///
/// # Errors
/// [`BatchError::Length`] when `jacobians` is not as long as `q`; nothing is written then.
pub fn jacobian_into(
    robot: &RobotModel,
    frame: &Frame,
    q: &[JointVector],
    axes: Axes,
    jacobians: &mut [Jacobian],
    path: Backend,
) -> Result<(), BatchError> {
    same_length("jacobians", q.len(), jacobians.len())?;
    differentiate(&Chain::new(robot, frame), q, jacobians, axes, path);
    Ok(())
}

fn evaluate(chain: &Chain, q: &[JointVector], positions: &mut [[f64; 3]], rotations: &mut [[f64; 9]], path: Backend) {
    let chunks = q
        .par_chunks(CHUNK)
        .zip(positions.par_chunks_mut(CHUNK))
        .zip(rotations.par_chunks_mut(CHUNK));
    chunks.for_each(|((q, positions), rotations)| {
        run(
            path,
            Poses {
                chain,
                q,
                positions,
                rotations,
            },
        )
    });
}

fn differentiate(chain: &Chain, q: &[JointVector], jacobians: &mut [Jacobian], axes: Axes, path: Backend) {
    let chunks = q.par_chunks(CHUNK).zip(jacobians.par_chunks_mut(CHUNK));
    chunks.for_each(|(q, jacobians)| {
        run(
            path,
            Jacobians {
                chain,
                q,
                jacobians,
                axes,
            },
        )
    });
}

/// One chunk of poses.
struct Poses<'a> {
    chain: &'a Chain,
    q: &'a [JointVector],
    positions: &'a mut [[f64; 3]],
    rotations: &'a mut [[f64; 9]],
}

impl Kernel for Poses<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let outputs = self.positions.chunks_mut(LANES).zip(self.rotations.chunks_mut(LANES));
        for (q, (positions, rotations)) in self.q.chunks(LANES).zip(outputs) {
            let tips: Tips<V> = frames(self.chain, &gather(q));
            let ([x, y, z], zero) = ([tips.x, tips.y, tips.z], V::splat(0.0));
            let origins = V::transposed([tips.p[0], tips.p[1], tips.p[2], zero]);
            let upper = V::transposed([x[0], y[0], z[0], x[1]]);
            let lower = V::transposed([y[1], z[1], x[2], y[2]]);
            let last = z[2].to_array();
            for (l, (position, rotation)) in positions.iter_mut().zip(rotations).enumerate() {
                position.copy_from_slice(&origins[l].to_array()[..3]);
                rotation[..4].copy_from_slice(&upper[l].to_array());
                rotation[4..8].copy_from_slice(&lower[l].to_array());
                rotation[8] = last[l];
            }
        }
    }
}

/// One chunk of poses as homogeneous matrices.
struct Matrices<'a> {
    chain: &'a Chain,
    q: &'a [JointVector],
    matrices: &'a mut [[f64; 16]],
}

impl Kernel for Matrices<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        for (q, matrices) in self.q.chunks(LANES).zip(self.matrices.chunks_mut(LANES)) {
            let tips: Tips<V> = frames(self.chain, &gather(q));
            let Tips { x, y, z, p } = tips;
            let rows = [
                V::transposed([x[0], y[0], z[0], p[0]]),
                V::transposed([x[1], y[1], z[1], p[1]]),
                V::transposed([x[2], y[2], z[2], p[2]]),
            ];
            for (l, matrix) in matrices.iter_mut().enumerate() {
                for (k, row) in rows.iter().enumerate() {
                    matrix[4 * k..4 * k + 4].copy_from_slice(&row[l].to_array());
                }
                matrix[12..].copy_from_slice(&[0.0, 0.0, 0.0, 1.0]);
            }
        }
    }
}

#[inline(always)]
fn rows<V: Vector>(v: &[V; 3]) -> [[f64; LANES]; 3] {
    [v[0].to_array(), v[1].to_array(), v[2].to_array()]
}

/// One chunk of Jacobians.
struct Jacobians<'a> {
    chain: &'a Chain,
    q: &'a [JointVector],
    jacobians: &'a mut [Jacobian],
    axes: Axes,
}

impl Kernel for Jacobians<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        let mut lines = no_lines::<V>();
        for (q, jacobians) in self.q.chunks(LANES).zip(self.jacobians.chunks_mut(LANES)) {
            let tips = frames_and_lines(self.chain, &gather(q), &mut lines);
            for (i, line) in lines.iter().enumerate().take(self.chain.links.len()) {
                let (mut linear, mut angular) = (moment(line, &tips.p), line.axis);
                if self.axes == Axes::Local {
                    linear = [dot(&tips.x, &linear), dot(&tips.y, &linear), dot(&tips.z, &linear)];
                    angular = [dot(&tips.x, &angular), dot(&tips.y, &angular), dot(&tips.z, &angular)];
                }
                let (linear, angular) = (rows(&linear), rows(&angular));
                for (l, jacobian) in jacobians.iter_mut().enumerate() {
                    for a in 0..3 {
                        jacobian[(a, i)] = linear[a][l];
                        jacobian[(a + 3, i)] = angular[a][l];
                    }
                }
            }
        }
    }
}
