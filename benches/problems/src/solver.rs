//! One interface for every solver that is measured.

use platewash_kinematics::JointVector;

/// A solver that has been given its targets in the form it likes best, so that no conversion is timed.
pub trait Solver {
    /// Name for tables.
    fn name(&self) -> &'static str;

    /// What the solver calls a solution for the target of that index, from `seed` \[rad\].
    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector>;

    /// Answers for all targets in one call, from `start` \[rad\]; `None` for a solver that takes them one by one.
    fn path(&mut self, _start: &JointVector) -> Option<Vec<Option<JointVector>>> {
        None
    }
}

/// Solvers in the order of their rows, our own first.
pub type Solvers<'a> = Vec<Box<dyn Solver + 'a>>;
