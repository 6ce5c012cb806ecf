//! Damped least squares: `Δq = (JᵀJ + λI)⁻¹ Jᵀ e`.

use super::linear::solve_spd;
use super::settings::IkSettings;
use super::task::{Descent, Iterate, Stop, Task};
use crate::{AXES, JointVector};
use nalgebra::{Matrix6, Vector6};

/// Smallest damping: keeps the normal matrix definite at an exact singularity without slowing convergence.
pub(crate) const LEAST_DAMPING: f64 = 1e-11;
/// Stagnation: the error norm fell by less than 10 % (its square by less than 19 %) …
const STAGNATION_RATIO: f64 = 0.81;
/// … within this many iterations.
const STAGNATION_WINDOW: usize = 8;
/// An active limit: this many accepted steps in a row were clamped.
pub(crate) const CLAMPED_IN_A_ROW: usize = 3;

/// Joints that may move; the others are held where they are.
pub(super) type Free = [bool; AXES];

/// Every joint may move.
pub(super) const ALL_FREE: Free = [true; AXES];

/// Descends from `start` (within the limits) moving the free joints only.
pub(super) fn descend(task: &Task<'_>, start: Iterate, free: &Free, settings: &IkSettings) -> Descent {
    let limits = task.robot.limits();
    let mut here = start;
    let mut boost = 1.0;
    let mut clamped = 0;
    let mut milestone = here.cost;
    for iterations in 0..settings.max_iterations {
        let stopped = |stop| Descent {
            best: here,
            iterations,
            stop,
        };
        if task.solved(&here) {
            return stopped(Stop::Solved);
        }
        if clamped >= CLAMPED_IN_A_ROW {
            return stopped(Stop::ActiveLimit);
        }
        if iterations > 0 && iterations % STAGNATION_WINDOW == 0 {
            if here.cost > milestone * STAGNATION_RATIO {
                return stopped(Stop::Stagnation);
            }
            milestone = here.cost;
        }
        let jacobian = task.jacobian(&here);
        let lambda = settings.damping.lambda(here.cost, &jacobian).max(LEAST_DAMPING) * boost;
        let Some(step) = step(&jacobian, &here.error, lambda, free) else {
            return stopped(Stop::Stagnation);
        };
        let aim = here.q + bounded(step, settings.step_bound_rad);
        let next = task.at(limits.clamp(&aim));
        if next.cost < here.cost {
            clamped = if next.q == aim { 0 } else { clamped + 1 };
            boost = f64::max(boost * 0.1, 1.0);
            here = next;
        } else {
            boost *= 10.0;
        }
    }
    let stop = if task.solved(&here) {
        Stop::Solved
    } else {
        Stop::Iterations
    };
    Descent {
        best: here,
        iterations: settings.max_iterations,
        stop,
    }
}

/// The damped step on the free joints; `None` when the normal matrix is not positive definite (NaN).
fn step(jacobian: &Matrix6<f64>, error: &Vector6<f64>, lambda: f64, free: &Free) -> Option<JointVector> {
    let mut jacobian = *jacobian;
    for (mut column, _) in jacobian.column_iter_mut().zip(free).filter(|(_, free)| !**free) {
        column.fill(0.0);
    }
    let normal = jacobian.tr_mul(&jacobian) + Matrix6::from_diagonal_element(lambda);
    solve_spd(&normal, &jacobian.tr_mul(error))
}

/// The step shortened so that no joint moves more than `bound` \[rad\]; its direction is kept.
fn bounded(step: JointVector, bound: f64) -> JointVector {
    let largest = step.amax();
    if largest > bound {
        step * (bound / largest)
    } else {
        step
    }
}
