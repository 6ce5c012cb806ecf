//! A curve through joint configurations without a time: the cubic spline q(u), twice continuously differentiable.
//!
//! The slopes at the samples solve one tridiagonal system (de Boor, *A Practical Guide to Splines*, ch. IV): with
//! `h_k = u_{k+1} − u_k` and `δ_k = (q_{k+1} − q_k) / h_k`,
//!
//! `h_k m_{k−1} + 2 (h_{k−1} + h_k) m_k + h_{k−1} m_{k+1} = 3 (h_k δ_{k−1} + h_{k−1} δ_k)`,
//!
//! closed at both ends by given slopes, or by *not-a-knot*: the first two pieces are one cubic, and so are the last two.

use platewash_kinematics::JointVector;

/// End conditions of the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ends {
    /// Given derivatives dq/du at the first and the last sample \[rad per unit of u\].
    Clamped([JointVector; 2]),
    /// Ends that follow from the samples next to them: the first two pieces are one cubic, and so are the last two. Three samples
    /// give a parabola, two a straight line.
    NotAKnot,
}

/// A C² cubic spline through samples (u, q).
#[derive(Debug, Clone, PartialEq)]
pub struct JointPath {
    u: Vec<f64>,
    q: Vec<JointVector>,
    /// dq/du at the samples.
    slopes: Vec<JointVector>,
}

/// A point of a path with its derivatives by the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathState {
    /// Joint positions \[rad\].
    pub q: JointVector,
    /// dq/du \[rad per unit of u\].
    pub first: JointVector,
    /// d²q/du² \[rad per unit of u, squared\].
    pub second: JointVector,
}

impl PathState {
    /// The same place passed the other way: the parameter runs backwards.
    pub(crate) fn reversed(self) -> Self {
        Self {
            first: -self.first,
            ..self
        }
    }
}

/// Samples through which no path goes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JointPathError {
    /// The lists differ in length.
    #[error("{parameters} parameters for {positions} configurations; there must be as many of each")]
    Count {
        /// Parameters.
        parameters: usize,
        /// Configurations.
        positions: usize,
    },
    /// Fewer than two samples.
    #[error("a path needs at least two samples; found {samples}")]
    TooFew {
        /// Samples.
        samples: usize,
    },
    /// A number of a sample is not finite.
    #[error("sample {sample}: not finite")]
    NotFinite {
        /// Index of the sample.
        sample: usize,
    },
    /// An end derivative is not finite.
    #[error("the derivatives at the ends are not finite")]
    EndNotFinite,
    /// Parameters don't ascend strictly.
    #[error("sample {sample}: parameter {u} after {before}; parameters must ascend strictly")]
    Order {
        /// Index of the sample.
        sample: usize,
        /// Parameter of the sample.
        u: f64,
        /// The parameter before.
        before: f64,
    },
    /// The parameters are so far apart, their spacing so uneven or the steps so steep that numbers overflow.
    #[error("sample {sample}: the curve's parameter or slope there is beyond what a number holds")]
    Overflow {
        /// Index of the sample.
        sample: usize,
    },
}

impl JointPath {
    /// The spline through `q` \[rad\] at the parameters `u` (any unit, strictly ascending, any spacing). O(n).
    ///
    /// # Errors
    /// [`JointPathError`] with the first sample that does not fit.
    pub fn through(u: Vec<f64>, q: Vec<JointVector>, ends: Ends) -> Result<Self, JointPathError> {
        check(&u, &q, &ends)?;
        let slopes = slopes(&u, &q, &ends);
        if let Some(sample) = slopes.iter().position(|m| !m.iter().all(|v| v.is_finite())) {
            return Err(JointPathError::Overflow { sample });
        }
        Ok(Self { u, q, slopes })
    }

    /// Parameters of the samples, strictly ascending; at least two.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.u
    }

    /// Configurations of the samples \[rad\].
    #[must_use]
    pub fn positions(&self) -> &[JointVector] {
        &self.q
    }

    /// Derivatives dq/du at the samples \[rad per unit of u\].
    #[must_use]
    pub fn slopes(&self) -> &[JointVector] {
        &self.slopes
    }

    /// The point at `u`, clamped to the path; NaN in, NaN out.
    #[must_use]
    pub fn at(&self, u: f64) -> PathState {
        let after = self.u.partition_point(|&sample| sample <= u);
        let piece = after.saturating_sub(1).min(self.u.len() - 2);
        self.on_piece(piece, u.clamp(self.u[0], self.u[self.u.len() - 1]))
    }

    /// The cubic between the samples `piece` and `piece + 1`, at `u`.
    pub(crate) fn on_piece(&self, piece: usize, u: f64) -> PathState {
        let h = self.u[piece + 1] - self.u[piece];
        // From the nearer sample, so that both are met exactly.
        let (near, far, x) = if u - self.u[piece] <= self.u[piece + 1] - u {
            (piece, piece + 1, (u - self.u[piece]) / h)
        } else {
            (piece + 1, piece, (u - self.u[piece + 1]) / h)
        };
        let side = if near == piece { 1.0 } else { -1.0 };
        let (rise, m0, m1) = (
            (self.q[far] - self.q[near]) * side,
            self.slopes[near] * h,
            self.slopes[far] * h,
        );
        // With y = ± x in [0, 1/2]: q = q₀ + m₀ x + c₂ x² + c₃ x³, c₃ the same from either end.
        let c3 = m0 + m1 - rise * 2.0;
        let c2 = (rise * 3.0 - m0 * 2.0 - m1) * side;
        PathState {
            q: self.q[near] + (m0 + (c2 + c3 * x) * x) * x,
            first: self.slopes[near] + (c2 * 2.0 + c3 * (3.0 * x)) * (x / h),
            second: (c2 * 2.0 + c3 * (6.0 * x)) / h / h,
        }
    }
}

fn check(u: &[f64], q: &[JointVector], ends: &Ends) -> Result<(), JointPathError> {
    if u.len() != q.len() {
        return Err(JointPathError::Count {
            parameters: u.len(),
            positions: q.len(),
        });
    }
    if u.len() < 2 {
        return Err(JointPathError::TooFew { samples: u.len() });
    }
    for (sample, &here) in u.iter().enumerate() {
        if !here.is_finite() || !q[sample].iter().all(|v| v.is_finite()) {
            return Err(JointPathError::NotFinite { sample });
        }
        if sample > 0 && here <= u[sample - 1] {
            let before = u[sample - 1];
            return Err(JointPathError::Order {
                sample,
                u: here,
                before,
            });
        }
        if !(here - u[0]).is_finite() {
            return Err(JointPathError::Overflow { sample });
        }
    }
    match ends {
        Ends::Clamped(slopes) if !slopes.iter().flatten().all(|v| v.is_finite()) => Err(JointPathError::EndNotFinite),
        _ => Ok(()),
    }
}

/// One row of the system, `lower m_{k−1} + diagonal m_k + upper m_{k+1} = right`: these three, and the right-hand side.
type Row = ([f64; 3], JointVector);

/// Slopes at the samples, by elimination. No pivoting: with every row the pivots stay positive, and the ratio of the
/// entry above to its pivot stays below 1.
fn slopes(u: &[f64], q: &[JointVector], ends: &Ends) -> Vec<JointVector> {
    let last = u.len() - 1;
    let step = |k: usize| u[k + 1] - u[k];
    let chord = |k: usize| (q[k + 1] - q[k]) / step(k);
    if let (Ends::NotAKnot, 1 | 2) = (ends, last) {
        return slopes_of_few_samples(last, step, chord);
    }
    let row = |k: usize| match (ends, k) {
        (Ends::Clamped([first, _]), 0) => ([0.0, 1.0, 0.0], *first),
        (Ends::Clamped([_, end]), k) if k == last => ([0.0, 1.0, 0.0], *end),
        (Ends::NotAKnot, 0) => {
            let (diagonal, upper, right) = not_a_knot([step(0), step(1)], [chord(0), chord(1)]);
            ([0.0, diagonal, upper], right)
        }
        (Ends::NotAKnot, k) if k == last => {
            let [near, next] = [last - 1, last - 2];
            let (diagonal, lower, right) = not_a_knot([step(near), step(next)], [chord(near), chord(next)]);
            ([lower, diagonal, 0.0], right)
        }
        (_, k) => inner([step(k - 1), step(k)], [chord(k - 1), chord(k)]),
    };
    let mut slopes: Vec<JointVector> = Vec::with_capacity(u.len());
    let mut ratio = vec![0.0; u.len()];
    for k in 0..=last {
        let ([lower, diagonal, upper], right) = row(k);
        let (above, before) = match k {
            0 => (0.0, JointVector::zeros()),
            _ => (ratio[k - 1], slopes[k - 1]),
        };
        let pivot = diagonal - lower * above;
        ratio[k] = upper / pivot;
        slopes.push((right - before * lower) / pivot);
    }
    for k in (0..last).rev() {
        slopes[k] = slopes[k] - slopes[k + 1] * ratio[k];
    }
    slopes
}

/// The row of a sample between two pieces, scaled by the sum of their lengths.
fn inner([left, right]: [f64; 2], [before, after]: [JointVector; 2]) -> Row {
    let sum = left + right;
    let (l, r) = (left / sum, right / sum);
    ([r, 2.0, l], (before * r + after * l) * 3.0)
}

/// The row of an end (diagonal, neighbour, right-hand side) from the two pieces next to it, the nearer first: the
/// condition of equal third derivatives with the row beside it worked in, scaled by the sum of the lengths.
fn not_a_knot([near, next]: [f64; 2], [chord, beyond]: [JointVector; 2]) -> (f64, f64, JointVector) {
    let sum = near + next;
    let (a, b) = (near / sum, next / sum);
    (b, 1.0, chord * ((a + 2.0) * b) + beyond * (a * a))
}

/// A straight line through two samples, a parabola through three.
fn slopes_of_few_samples(
    last: usize,
    step: impl Fn(usize) -> f64,
    chord: impl Fn(usize) -> JointVector,
) -> Vec<JointVector> {
    if last == 1 {
        return vec![chord(0); 2];
    }
    let (left, right) = (step(0), step(1));
    let (before, after) = (chord(0), chord(1));
    let middle = (before * right + after * left) / (left + right);
    vec![before * 2.0 - middle, middle, after * 2.0 - middle]
}
