//! Warm inverse kinematics of many problems: damped least squares in lanes, the scalar solver for the rest.

use crate::batch::chain::Chain;
use crate::batch::forward::{Tips, frames_and_lines, no_lines, vectors};
use crate::batch::slices::{BatchError, CHUNK, same_length};
use crate::batch::step::{Bounds, LEAST_COSINE, damped_step, errors, moved};
use crate::ik::{IkError, IkSettings, IkSolution, IkSolver, Method, Start, dls};
use crate::joints::{AXES, JointVector};
use crate::lanes::{Backend, Kernel, LANES, Vector, run};
use crate::rotation::Pose;
use rayon::prelude::*;

/// Greatest number of steps of a lane; a problem that needs more is not warm.
const MOST_STEPS: usize = 8;
/// Distance inside both tolerances (m, rad) from which a lane counts as solved, so that the scalar error, which is rounded differently, is
/// inside too.
const GUARD: f64 = 1e-14;

/// Factor on the cold threshold, so that rounding calls no seed warm that the scalar solver calls cold.
const COLD_MARGIN: f64 = 1.0 + 1e-9;

/// Placeholder for an answer before it is written.
const NOT_YET: IkError = IkError::Target {
    position: [f64::NAN; 3],
};

/// Problem between two visits to the lanes.
#[derive(Clone, Copy)]
struct Problem {
    index: usize,
    q: [f64; AXES],
    steps: usize,
    clamped: f64,
}

/// Solves `targets[k]` from `seeds[k]` \[rad\] for every k, in order: [`IkSolver::solve`] for many neighbouring poses.
///
/// Problems whose seed is near the target (up to 8 steps, each lowering the error, error angle at most 0.5 rad) are
/// solved several at a time. Every other one is given to
/// [`IkSolver::solve`], so that its answer and its error are exactly those. The lanes take the scalar solver's steps,
/// with other rounding: answers are on the same branch, within the limits and within both tolerances, but not equal in
/// the last bits; with [`Backend::Portable`] the bits are the same on every machine. No answer depends on the other
/// problems, nor on the number of threads.
///
/// [`BatchError::Length`] if the numbers of seeds and targets differ. An error in one problem is in its own entry.
pub fn solve(
    solver: &IkSolver<'_>,
    targets: &[Pose],
    seeds: &[JointVector],
    path: Backend,
) -> Result<Vec<Result<IkSolution, IkError>>, BatchError> {
    let mut answers = vec![Err(NOT_YET); targets.len()];
    solve_into(solver, targets, seeds, &mut answers, path)?;
    Ok(answers)
}

/// Same as [`solve`], into a slice of the caller's, which is overwritten.
///
/// # Errors
/// [`BatchError::Length`] if the numbers of seeds, or of places for answers, differ from that of targets; nothing is written then.
pub fn solve_into(
    solver: &IkSolver<'_>,
    targets: &[Pose],
    seeds: &[JointVector],
    answers: &mut [Result<IkSolution, IkError>],
    path: Backend,
) -> Result<(), BatchError> {
    same_length("seeds", targets.len(), seeds.len())?;
    same_length("answers", targets.len(), answers.len())?;
    let chain = Chain::new(solver.robot(), solver.frame());
    let chunks = targets.par_chunks(CHUNK).zip(seeds.par_chunks(CHUNK));
    chunks
        .zip(answers.par_chunks_mut(CHUNK))
        .for_each(|((targets, seeds), answers)| {
            let mut found = [false; CHUNK];
            run(
                path,
                Chunk {
                    solver,
                    chain: &chain,
                    targets,
                    seeds,
                    answers,
                    found: &mut found,
                },
            );
            for k in (0..targets.len()).filter(|k| !found[*k]) {
                answers[k] = solver.solve(&targets[k], &seeds[k]);
            }
        });
    Ok(())
}

/// Chunk of problems. Answers that are found are written to `answers` and marked, the rest stays unchanged.
struct Chunk<'a> {
    solver: &'a IkSolver<'a>,
    chain: &'a Chain,
    targets: &'a [Pose],
    seeds: &'a [JointVector],
    answers: &'a mut [Result<IkSolution, IkError>],
    found: &'a mut [bool; CHUNK],
}

impl Kernel for Chunk<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(mut self) {
        let limits = self.solver.robot().limits();
        let settings = self.solver.settings();
        let bounds = Bounds {
            step_rad: settings.step_bound_rad,
            lower: limits.lower.into(),
            upper: limits.upper.into(),
        };
        let mut waiting: Vec<Problem> = Vec::with_capacity(2 * LANES);
        let mut fresh = 0;
        loop {
            // Problems that need more steps than their neighbours wait until they fill a block of their own.
            while waiting.len() < LANES && fresh < self.seeds.len() {
                if self.is_finite(fresh) {
                    let q = limits.clamp(&self.seeds[fresh]).into();
                    waiting.push(Problem {
                        index: fresh,
                        q,
                        steps: 0,
                        clamped: 0.0,
                    });
                }
                fresh += 1;
            }
            if waiting.is_empty() {
                return;
            }
            let count = waiting.len().min(LANES);
            let mut block = [waiting[0]; LANES];
            block[..count].copy_from_slice(&waiting[..count]);
            waiting.drain(..count);
            self.block::<V>(&bounds, settings, &block, count, &mut waiting);
        }
    }
}

impl Chunk<'_> {
    fn is_finite(&self, k: usize) -> bool {
        let target = &self.targets[k];
        let numbers = target.translation.vector.iter().chain(target.rotation.coords.iter());
        numbers.chain(self.seeds[k].iter()).all(|v| v.is_finite())
    }

    /// Writes the solution of a problem; `misses` are the errors of position and orientation (m, rad).
    #[inline(always)]
    fn answer(&mut self, index: usize, q: [f64; AXES], iterations: usize, misses: [f64; 2]) {
        self.found[index] = true;
        self.answers[index] = Ok(IkSolution {
            q: q.into(),
            iterations,
            method: Method::Dls,
            start: Start::Seed,
            position_error_m: misses[0],
            orientation_error_rad: misses[1],
        });
    }

    /// Solves the first `count` problems of a block as far as it pays: most of the lanes until they are solved or given up; the few that
    /// are left then go back to `waiting`.
    #[inline(always)]
    fn block<V: Vector>(
        &mut self,
        bounds: &Bounds,
        settings: &IkSettings,
        block: &[Problem; LANES],
        count: usize,
        waiting: &mut Vec<Problem>,
    ) {
        let targets = load_targets::<V>(block, self.targets);
        let (mut q, mut clamped) = load_joints::<V>(block);
        let mut lines = no_lines::<V>();
        let mut before = [f64::INFINITY; LANES];
        let mut active = [false; LANES];
        active[..count].fill(true);
        let most = settings.max_iterations.min(MOST_STEPS);
        for taken in 0.. {
            let tips = frames_and_lines(self.chain, &q, &mut lines);
            let now = errors(&targets, &tips);
            let (position, angle, cosine) = (now.position.to_array(), now.angle.to_array(), now.cosine.to_array());
            let streak = clamped.to_array();
            let mut left = 0;
            for l in 0..count {
                if !active[l] {
                    continue;
                }
                let (steps, cost) = (block[l].steps + taken, position[l] + angle[l]);
                let cold = steps == 0 && IkSolver::is_cold(cost * COLD_MARGIN);
                let descends = cosine[l] >= LEAST_COSINE && cost < before[l] && !cold;
                let misses = [position[l].sqrt(), angle[l].sqrt()];
                let solved = descends
                    && misses[0] + GUARD <= settings.position_tolerance_m
                    && misses[1] + GUARD <= settings.orientation_tolerance_rad;
                if solved {
                    self.answer(block[l].index, lane(&q, l), steps, misses);
                }
                active[l] = descends && !solved && steps < most && streak[l] < dls::CLAMPED_IN_A_ROW as f64;
                before[l] = cost;
                left += usize::from(active[l]);
            }
            if left == 0 {
                return;
            }
            if taken > 0 && 2 * left <= count {
                for l in (0..count).filter(|l| active[*l]) {
                    let steps = block[l].steps + taken;
                    waiting.push(Problem {
                        index: block[l].index,
                        q: lane(&q, l),
                        steps,
                        clamped: streak[l],
                    });
                }
                return;
            }
            let dq = damped_step(&tips.p, &lines, &now);
            (q, clamped) = moved(bounds, q, &dq, clamped);
        }
    }
}

#[inline(always)]
fn lane<V: Vector>(q: &[V; AXES], l: usize) -> [f64; AXES] {
    let mut out = [0.0; AXES];
    for i in 0..AXES {
        out[i] = q[i].to_array()[l];
    }
    out
}

/// Joint positions of a block, one vector per joint, and how often in a row each problem was clamped.
#[inline(always)]
fn load_joints<V: Vector>(block: &[Problem; LANES]) -> ([V; AXES], V) {
    let mut rows = [[0.0; LANES]; AXES];
    let mut clamped = [0.0; LANES];
    for l in 0..LANES {
        for i in 0..AXES {
            rows[i][l] = block[l].q[i];
        }
        clamped[l] = block[l].clamped;
    }
    (vectors(&rows), V::from_array(clamped))
}

/// Loads the targets of a block as columns and origins.
#[inline(always)]
fn load_targets<V: Vector>(block: &[Problem; LANES], poses: &[Pose]) -> Tips<V> {
    let (mut quaternions, mut origins) = ([[0.0; LANES]; 4], [[0.0; LANES]; 3]);
    for l in 0..LANES {
        let pose = &poses[block[l].index];
        for a in 0..4 {
            quaternions[a][l] = pose.rotation.coords[a];
        }
        for a in 0..3 {
            origins[a][l] = pose.translation.vector[a];
        }
    }
    let [i, j, k, w] = vectors::<V, 4>(&quaternions);
    let (ii, jj, kk, ww) = (i * i, j * j, k * k, w * w);
    let two = V::splat(2.0);
    let (ij, ik, jk) = (two * i * j, two * i * k, two * j * k);
    let (wi, wj, wk) = (two * w * i, two * w * j, two * w * k);
    Tips {
        x: [ww + ii - jj - kk, ij + wk, ik - wj],
        y: [ij - wk, ww - ii + jj - kk, jk + wi],
        z: [ik + wj, jk - wi, ww - ii - jj + kk],
        p: vectors(&origins),
    }
}
