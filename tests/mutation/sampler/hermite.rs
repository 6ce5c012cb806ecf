//! Cubic Hermite pieces in the basis of Hermite, for the sampler alone.

use platewash::JointVector;
use platewash::workcell::plan::Knots;

/// Motion between two neighbouring knots.
#[derive(Clone, Copy, PartialEq)]
pub struct Piece {
    /// Time of the first knot \[s\].
    pub start_s: f64,
    /// \[s\]
    pub length_s: f64,
    /// Positions at both ends \[rad\].
    pub q: [JointVector; 2],
    /// Speeds at both ends \[rad/s\].
    pub qd: [JointVector; 2],
}

/// The pieces between the knots, in time order.
pub fn pieces(knots: &Knots) -> Vec<Piece> {
    let piece = |k: usize| Piece {
        start_s: knots.t_s[k],
        length_s: knots.t_s[k + 1] - knots.t_s[k],
        q: [knots.q_rad[k], knots.q_rad[k + 1]],
        qd: [knots.qd_rad_s[k], knots.qd_rad_s[k + 1]],
    };
    (0..knots.t_s.len() - 1).map(piece).collect()
}

impl Piece {
    /// Positions at u in \[0, length\] \[s\].
    pub fn position(&self, u: f64) -> JointVector {
        let (s, h) = (u / self.length_s, self.length_s);
        let ([q0, q1], [v0, v1]) = (&self.q, &self.qd);
        let way = s * s * (3.0 - 2.0 * s);
        q0 + (q1 - q0) * way + v0 * (h * s * (1.0 - s) * (1.0 - s)) - v1 * (h * s * s * (1.0 - s))
    }

    /// Speeds \[rad/s\].
    pub fn speed(&self, u: f64) -> JointVector {
        let s = u / self.length_s;
        let ([q0, q1], [v0, v1]) = (&self.q, &self.qd);
        (q1 - q0) * (6.0 * s * (1.0 - s) / self.length_s)
            + v0 * ((1.0 - s) * (1.0 - 3.0 * s))
            + v1 * (s * (3.0 * s - 2.0))
    }

    /// Accelerations \[rad/s²\].
    pub fn acceleration(&self, u: f64) -> JointVector {
        let (s, h) = (u / self.length_s, self.length_s);
        let ([q0, q1], [v0, v1]) = (&self.q, &self.qd);
        ((q1 - q0) * ((6.0 - 12.0 * s) / h) + v0 * (6.0 * s - 4.0) + v1 * (6.0 * s - 2.0)) / h
    }

    /// Whether another piece is the same motion, whenever it happens.
    pub fn moves_like(&self, other: &Self) -> bool {
        (self.length_s - other.length_s).abs() < 1e-12 && self.q == other.q && self.qd == other.qd
    }
}
