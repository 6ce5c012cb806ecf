//! Neighbouring rows of a batch of inverse kinematics: the problems, a thread's desk, and the places for the answers.

use crate::{errors, pose};
use nalgebra::Quaternion;
use platewash::kinematics::batch::{self, Backend, BatchError};
use platewash::{IkError, IkSolution, IkSolver, JointVector, Pose};

/// Rows to a unit of work: their poses and answers stay in a processor's cache.
const CHUNK: usize = 512;

/// Rows that are not solved, with the word for the cause.
pub type Causes = Vec<(usize, &'static str)>;

/// Seeds of a batch.
#[derive(Clone, Copy)]
pub enum Seeds<'a> {
    /// One for all targets.
    One(JointVector),
    /// One a target.
    Each(&'a [JointVector]),
}

/// What is to be solved.
#[derive(Clone, Copy)]
pub struct Problems<'a> {
    /// How.
    pub solver: &'a IkSolver<'a>,
    /// Targets `T_base_frame`, row by row.
    pub matrices: &'a [[f64; 16]],
    /// From where.
    pub seeds: Seeds<'a>,
}

/// What a thread works with, chunk after chunk.
pub struct Desk {
    room: Vec<Quaternion<f64>>,
    targets: Vec<Pose>,
    seeds: Vec<JointVector>,
    answers: Vec<Result<IkSolution, IkError>>,
}

impl Desk {
    /// A desk for the problems.
    #[must_use]
    pub fn new(problems: &Problems<'_>) -> Self {
        let not_yet = IkError::Target {
            position: [f64::NAN; 3],
        };
        Self {
            room: Vec::with_capacity(CHUNK),
            targets: Vec::with_capacity(CHUNK),
            seeds: match problems.seeds {
                Seeds::One(seed) => vec![seed; CHUNK],
                Seeds::Each(_) => Vec::new(),
            },
            answers: vec![Err(not_yet); CHUNK],
        }
    }
}

/// Places for the answers of neighbouring rows.
pub struct Rows<'a> {
    /// Index of the first.
    pub first: usize,
    /// Configurations \[rad\].
    pub q: &'a mut [JointVector],
    /// Whether the target is reached.
    pub solved: &'a mut [bool],
    /// Linear systems and quadratic programs.
    pub iterations: &'a mut [i64],
    /// Distances \[m\].
    pub position_error_m: &'a mut [f64],
    /// Angles \[rad\].
    pub orientation_error_rad: &'a mut [f64],
}

impl<'a> Rows<'a> {
    /// Cuts off the first `n` rows.
    pub fn split(self, n: usize) -> (Self, Self) {
        let (q, q_rest) = self.q.split_at_mut(n);
        let (solved, solved_rest) = self.solved.split_at_mut(n);
        let (iterations, iterations_rest) = self.iterations.split_at_mut(n);
        let (position, position_rest) = self.position_error_m.split_at_mut(n);
        let (orientation, orientation_rest) = self.orientation_error_rad.split_at_mut(n);
        let rows = |first, q, solved, iterations, position_error_m, orientation_error_rad| Self {
            first,
            q,
            solved,
            iterations,
            position_error_m,
            orientation_error_rad,
        };
        (
            rows(self.first, q, solved, iterations, position, orientation),
            rows(
                self.first + n,
                q_rest,
                solved_rest,
                iterations_rest,
                position_rest,
                orientation_rest,
            ),
        )
    }

    /// Units of work.
    #[must_use]
    pub fn chunks(self) -> Vec<Self> {
        let mut all = Vec::with_capacity(self.q.len().div_ceil(CHUNK));
        let mut rest = self;
        while rest.q.len() > CHUNK {
            let (chunk, others) = rest.split(CHUNK);
            all.push(chunk);
            rest = others;
        }
        all.push(rest);
        all
    }

    /// Solves these rows, a unit of work.
    ///
    /// # Errors
    /// What must not happen, in words.
    pub fn solve(&mut self, desk: &mut Desk, problems: &Problems<'_>) -> Result<Causes, BatchError> {
        let (first, n) = (self.first, self.q.len());
        let matrices = &problems.matrices[first..first + n];
        pose::poses(matrices, &mut desk.room, &mut desk.targets);
        let seeds = match problems.seeds {
            Seeds::One(_) => &desk.seeds[..n],
            Seeds::Each(seeds) => &seeds[first..first + n],
        };
        let answers = &mut desk.answers[..n];
        batch::solve_into(problems.solver, &desk.targets, seeds, answers, Backend::Detected)?;
        let mut causes = Causes::new();
        for (k, answer) in answers.iter().enumerate() {
            if let Some(cause) = self.put(k, answer) {
                causes.push((first + k, cause));
            }
        }
        Ok(causes)
    }

    /// Writes an answer down; the word for why it is none.
    fn put(&mut self, k: usize, answer: &Result<IkSolution, IkError>) -> Option<&'static str> {
        let not_a_number = JointVector::repeat(f64::NAN);
        let (q, iterations, [position, orientation], cause) = match answer {
            Ok(s) => (s.q, s.iterations, [s.position_error_m, s.orientation_error_rad], None),
            Err(IkError::NotSolved(f)) => {
                let missed = [f.position_error_m, f.orientation_error_rad];
                (f.q, f.iterations, missed, Some(errors::cause(&f.cause).0))
            }
            Err(IkError::Seed { .. }) => (not_a_number, 0, [f64::NAN; 2], Some("seed")),
            Err(_) => (not_a_number, 0, [f64::NAN; 2], Some("target")),
        };
        self.solved[k] = answer.is_ok();
        self.q[k] = q;
        self.iterations[k] = iterations as i64;
        (self.position_error_m[k], self.orientation_error_rad[k]) = (position, orientation);
        cause
    }
}
