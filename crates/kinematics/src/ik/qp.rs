//! The bounded step: `min ‖J Δq − e‖² + λ‖Δq‖²` subject to `q_min ≤ q + Δq ≤ q_max` and `|Δq_i| ≤ s`,
//! a strictly convex quadratic program, solved by clarabel's interior-point method.
//!
//! Where a limit is active, clamping a DLS step wastes the motion of the clamped joint; the QP
//! redistributes it over the others and still descends. Its answer is accurate to about 1e-4 rad, so the
//! last digits come from DLS on the joints that the QP left free.

use crate::ik::dls::{self, DAMPING_GAIN, Descent, Iterate, ON_LIMIT_RAD, Stop, Task};
use crate::ik::settings::IkSettings;
use crate::joints::{AXES, JointVector};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use nalgebra::{Matrix6, Vector6};

/// Smallest damping of the program.
const LEAST_DAMPING: f64 = 1e-9;
/// Share of the squared error that a program must gain at least. Otherwise the descent ends.
const LEAST_GAIN: f64 = 1e-3;
/// Squared error (m², rad²) below which DLS tries to polish.
const POLISH_BELOW: f64 = 1e-2;
/// Descends from `start` (within the limits) by bounded steps and polishes the answer.
pub(crate) fn descend(task: &Task<'_>, start: Iterate, settings: &IkSettings) -> Descent {
    let limits = task.robot.limits();
    let mut here = start;
    let mut boost = 1.0;
    let mut spent = 0;
    for _ in 0..settings.max_qp_iterations {
        if here.cost < POLISH_BELOW {
            let polished = polish(task, here, settings);
            spent += polished.iterations;
            if polished.stop == Stop::Solved {
                return Descent {
                    iterations: spent,
                    ..polished
                };
            }
        }
        let jacobian = task.jacobian(&here);
        let lambda = (DAMPING_GAIN * here.cost).max(LEAST_DAMPING) * boost;
        let bounds = [
            (limits.lower - here.q).sup(&JointVector::repeat(-settings.step_bound_rad)),
            (limits.upper - here.q).inf(&JointVector::repeat(settings.step_bound_rad)),
        ];
        spent += 1;
        let step = bounded_step(&jacobian, &here.error, lambda, &bounds);
        let gain = |step: &JointVector| 1.0 - (jacobian * step - here.error).norm_squared() / here.cost;
        let Some(step) = step.filter(|s| gain(s) > LEAST_GAIN) else {
            break;
        };
        let next = task.at(limits.clamp(&(here.q + step)));
        if next.cost < here.cost {
            here = next;
            boost = f64::max(boost * 0.1, 1.0);
        } else {
            boost *= 10.0;
        }
    }
    Descent {
        best: here,
        iterations: spent,
        stop: if task.solved(&here) {
            Stop::Solved
        } else {
            Stop::Stagnation
        },
    }
}

/// Runs DLS on the joints that do not stand on a limit, with the others set exactly onto theirs.
fn polish(task: &Task<'_>, from: Iterate, settings: &IkSettings) -> Descent {
    let limits = task.robot.limits();
    let mut q = from.q;
    let mut free = dls::ALL_FREE;
    for i in 0..AXES {
        for limit in [limits.lower[i], limits.upper[i]] {
            if (q[i] - limit).abs() < ON_LIMIT_RAD {
                (q[i], free[i]) = (limit, false);
            }
        }
    }
    dls::descend(task, q, &free, settings)
}

/// Solves the program; `None` unless clarabel reports it solved.
///
/// `bounds` are the lowest and highest steps \[rad\], finite, with lowest ≤ 0 ≤ highest.
fn bounded_step(
    jacobian: &Matrix6<f64>,
    error: &Vector6<f64>,
    lambda: f64,
    bounds: &[JointVector; 2],
) -> Option<JointVector> {
    // clarabel: min ½ xᵀPx + cᵀx  s.t.  Ax + s = b, s ≥ 0, with P's upper triangle.
    let hessian = (jacobian.tr_mul(jacobian) + Matrix6::from_diagonal_element(lambda)) * 2.0;
    let linear = jacobian.tr_mul(error) * -2.0;
    let a = CscMatrix::new(
        2 * AXES,
        AXES,
        (0..=AXES).map(|j| 2 * j).collect(),
        (0..AXES).flat_map(|j| [j, AXES + j]).collect(),
        (0..AXES).flat_map(|_| [1.0, -1.0]).collect(),
    );
    let b: Vec<f64> = bounds[1]
        .iter()
        .copied()
        .chain(bounds[0].iter().map(|lowest| -lowest))
        .collect();
    let settings = DefaultSettings {
        verbose: false,
        presolve_enable: false,
        ..DefaultSettings::default()
    };
    let cones = [NonnegativeConeT(2 * AXES)];
    let mut solver = DefaultSolver::new(&upper_triangle(&hessian), linear.as_slice(), &a, &b, &cones, settings).ok()?;
    solver.solve();
    let x = &solver.solution.x;
    (solver.solution.status == SolverStatus::Solved && x.len() == AXES).then(|| JointVector::from_column_slice(x))
}

fn upper_triangle(m: &Matrix6<f64>) -> CscMatrix<f64> {
    CscMatrix::new(
        AXES,
        AXES,
        (0..=AXES).map(|j| j * (j + 1) / 2).collect(),
        (0..AXES).flat_map(|j| 0..=j).collect(),
        (0..AXES).flat_map(|j| (0..=j).map(move |i| m[(i, j)])).collect(),
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn matrix() -> impl Strategy<Value = Matrix6<f64>> {
        prop::collection::vec(-1.0..1.0f64, 36).prop_map(|v| Matrix6::from_row_slice(&v))
    }

    fn vector(half: f64) -> impl Strategy<Value = JointVector> {
        prop::collection::vec(-half..half, 6).prop_map(|v| JointVector::from_row_slice(&v))
    }

    proptest! {
        /// The optimality conditions of a box-constrained QP: inside the bounds the gradient vanishes, at a
        /// bound it pushes outwards.
        #[test]
        fn satisfies_the_optimality_conditions(j in matrix(), e in vector(0.5), low in vector(0.3), high in vector(0.3)) {
            let (low, high, lambda) = (-low.abs(), high.abs(), 1e-3);
            let x = bounded_step(&j, &e, lambda, &[low, high]).unwrap();
            let gradient = (j.tr_mul(&j) + Matrix6::from_diagonal_element(lambda)) * x - j.tr_mul(&e);
            for i in 0..6 {
                prop_assert!(x[i] >= low[i] - 1e-7 && x[i] <= high[i] + 1e-7);
                if x[i] - low[i] > 1e-3 { prop_assert!(gradient[i] < 1e-4, "{gradient}"); }
                if high[i] - x[i] > 1e-3 { prop_assert!(gradient[i] > -1e-4, "{gradient}"); }
            }
        }
    }
}
