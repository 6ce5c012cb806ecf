//! The speed along the path: reachability analysis backwards and forwards over the knots.
//!
//! Time-optimal path parametrisation by Pham & Pham, *A new approach to time-optimal path parameterization based on
//! reachability analysis*, IEEE T-RO 2018. With x = ṡ² and constant s̈ between knots, a first pass from the end finds
//! the largest x at each knot from which the end can be reached within limits; as standing still always can, every
//! smaller x can too. A second pass from the start takes the largest x that stays below.

use super::interval::Interval;
use super::linear_program::LinearProgram;

/// Share by which the backward pass stays inside its limits, so that rounding never closes the forward pass's way.
const INSIDE: f64 = 1e-10;

/// Room for the passes, kept from one round to the next.
#[derive(Debug)]
pub(super) struct Passes {
    program: LinearProgram,
    /// Largest x from which the end is reached.
    controllable: Vec<f64>,
    /// Share of x₁ in x₀ that is allowed for the largest x₀, by interval.
    witness: Vec<f64>,
    /// ẋ² … the answer: x at every knot.
    x: Vec<f64>,
}

impl Passes {
    /// Empty.
    pub fn new() -> Self {
        Self {
            program: LinearProgram::new(),
            controllable: Vec::new(),
            witness: Vec::new(),
            x: Vec::new(),
        }
    }

    /// x at every knot. `most` bounds x at the knots, one more than there are intervals; it is positive and finite but
    /// at a knot where the motion rests, where it is 0.
    pub fn run(&mut self, intervals: &[Interval], most: &[f64]) -> &[f64] {
        let n = intervals.len();
        self.controllable.clear();
        self.controllable.extend_from_slice(most);
        self.witness.clear();
        self.witness.resize(n, 0.0);
        for (k, interval) in intervals.iter().enumerate().rev() {
            if most[k] > 0.0 {
                let [x0, x1] = self
                    .program
                    .furthest_back(interval, [most[k], self.controllable[k + 1]]);
                self.controllable[k] = x0 * (1.0 - INSIDE);
                self.witness[k] = x1 / x0;
            }
        }
        self.x.clear();
        self.x.push(self.controllable[0]);
        for (k, interval) in intervals.iter().enumerate() {
            let x0 = self.x[k];
            let furthest = interval.furthest(x0).max(self.witness[k] * x0);
            self.x.push(furthest.clamp(0.0, self.controllable[k + 1]));
        }
        &self.x
    }
}
