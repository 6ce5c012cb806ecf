//! The knots on the path: where they are, and how the joints and the tip move there with the path's parameter.
//!
//! Here the parameter is s, the path's u over its whole span, so that s runs over a length of 1 for any u.

use crate::joint_path::JointPath;
use crate::timing::error::TimingError;
use crate::timing::tip_model::TipModel;
use crate::timing::tip_model::TipRates;
use platewash_kinematics::JointVector;

/// A knot on the path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PathKnot {
    /// The path's parameter.
    pub u: f64,
    /// The piece of the path to the right of it (to the left of the last).
    pub piece: usize,
    /// Joint positions \[rad\].
    pub q: JointVector,
    /// dq/ds \[rad\].
    pub slope: JointVector,
    /// Rates of the tip, where it has limits.
    pub tip: Option<TipRates>,
}

/// Knots along a path, its samples among them.
#[derive(Debug)]
pub(crate) struct Grid<'a> {
    path: &'a JointPath,
    tip: Option<TipModel<'a>>,
    span: f64,
    knots: Vec<PathKnot>,
}

impl<'a> Grid<'a> {
    /// The samples of the path.
    pub fn new(path: &'a JointPath, tip: Option<TipModel<'a>>) -> Result<Self, TimingError> {
        let u = path.parameters();
        let mut grid = Self {
            path,
            tip,
            span: u[u.len() - 1] - u[0],
            knots: Vec::with_capacity(u.len()),
        };
        for k in 0..u.len() {
            let knot = grid.knot(k.min(u.len() - 2), u[k]);
            if !knot.slope.iter().all(|v| v.is_finite() && v.abs() < 1e100) {
                return Err(TimingError::Range { u: u[k] });
            }
            grid.knots.push(knot);
        }
        Ok(grid)
    }

    /// The knots.
    pub fn knots(&self) -> &[PathKnot] {
        &self.knots
    }

    /// The model of the tip, where it has limits.
    pub fn tip(&self) -> Option<&TipModel<'a>> {
        self.tip.as_ref()
    }

    /// The path's position \[rad\] within interval `k`, at a share of it.
    pub fn position_within(&self, k: usize, share: f64) -> JointVector {
        let [from, to] = [self.knots[k].u, self.knots[k + 1].u];
        self.path.on_piece(self.knots[k].piece, from + (to - from) * share).q
    }

    /// Range of u that s covers from 0 to 1.
    pub fn span(&self) -> f64 {
        self.span
    }

    /// Length in s of interval `k`.
    pub fn width(&self, k: usize) -> f64 {
        (self.knots[k + 1].u - self.knots[k].u) / self.span
    }

    /// The same grid with further knots in every interval, at the shares of it that `shares` lists (ascending, within
    /// 0 and 1), and of every new interval the old one that it is a part of. A share that meets no number between the
    /// knots is left out.
    pub fn refined(&mut self, mut shares: impl FnMut(usize, &mut Vec<f64>)) -> Vec<usize> {
        let old = std::mem::take(&mut self.knots);
        let (mut parents, mut here) = (Vec::with_capacity(old.len()), Vec::new());
        self.knots.reserve(old.len());
        for (k, ends) in old.windows(2).enumerate() {
            let [from, to] = [ends[0].u, ends[1].u];
            self.knots.push(ends[0]);
            parents.push(k);
            here.clear();
            shares(k, &mut here);
            let mut last = from;
            for share in &here {
                let u = from + (to - from) * share;
                if u > last && u < to {
                    let knot = self.knot(ends[0].piece, u);
                    self.knots.push(knot);
                    parents.push(k);
                    last = u;
                }
            }
        }
        self.knots.extend(old.last());
        parents
    }

    fn knot(&self, piece: usize, u: f64) -> PathKnot {
        let state = self.path.on_piece(piece, u);
        let slope = state.first * self.span;
        PathKnot {
            u,
            piece,
            q: state.q,
            slope,
            tip: self.tip.as_ref().map(|tip| tip.rates(&state.q, &slope)),
        }
    }
}
