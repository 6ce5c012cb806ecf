//! Joint motion of cubic and quintic pieces that meet in position, but not necessarily in speed: the motion that a controller is assumed to
//! make of a program.

use crate::trajectory::KnotError;
use platewash_kinematics::JointVector;

/// Hermite piece of joint motion: cubic, or quintic where accelerations are stated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPiece {
    /// Start and end \[s\].
    pub t_s: [f64; 2],
    /// Positions there \[rad\].
    pub q_rad: [JointVector; 2],
    /// Speeds there, on the piece's own side \[rad/s\].
    pub qd_rad_s: [JointVector; 2],
    /// Accelerations there, on the piece's own side \[rad/s²\]; `None` for a cubic, which has no more to choose.
    pub qdd_rad_s2: Option<[JointVector; 2]>,
}

/// Pieces one after the other, from 0 s and without a gap in time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PiecewiseMotion {
    pieces: Vec<MotionPiece>,
}

impl MotionPiece {
    /// Returns the motion at constant speed from one position to another \[rad\].
    #[must_use]
    pub fn line(t_s: [f64; 2], q_rad: [JointVector; 2]) -> Self {
        let speed = (q_rad[1] - q_rad[0]) / (t_s[1] - t_s[0]);
        Self::cubic(t_s, q_rad, [speed; 2])
    }

    /// Returns the cubic with positions \[rad\] and speeds \[rad/s\] at both ends.
    #[must_use]
    pub fn cubic(t_s: [f64; 2], q_rad: [JointVector; 2], qd_rad_s: [JointVector; 2]) -> Self {
        Self {
            t_s,
            q_rad,
            qd_rad_s,
            qdd_rad_s2: None,
        }
    }

    /// Duration \[s\].
    #[must_use]
    pub fn length_s(&self) -> f64 {
        self.t_s[1] - self.t_s[0]
    }

    /// Returns the coefficients cₖ of q = Σ cₖ uᵏ, u from the start of the piece \[s\].
    fn coefficients(&self) -> [JointVector; 6] {
        let h = self.length_s();
        let ([q0, q1], [v0, v1]) = (self.q_rad, self.qd_rad_s);
        let mean = (q1 - q0) / h;
        let Some([a0, a1]) = self.qdd_rad_s2 else {
            let (c2, c3) = ((mean * 3.0 - v0 * 2.0 - v1) / h, (v0 + v1 - mean * 2.0) / (h * h));
            return [q0, v0, c2, c3, JointVector::zeros(), JointVector::zeros()];
        };
        let (b0, b1) = (a0 * (0.5 * h), a1 * (0.5 * h));
        [
            q0,
            v0,
            a0 * 0.5,
            (mean * 10.0 - v0 * 6.0 - v1 * 4.0 - b0 * 3.0 + b1) / (h * h),
            (v0 * 8.0 + v1 * 7.0 - mean * 15.0 + b0 * 3.0 - b1 * 2.0) / (h * h * h),
            (mean * 6.0 - (v0 + v1) * 3.0 - b0 + b1) / ((h * h) * (h * h)),
        ]
    }

    /// Returns position \[rad\], speed \[rad/s\] and acceleration \[rad/s²\] at a time within the piece \[s\].
    fn state(&self, t_s: f64) -> [JointVector; 3] {
        let [c0, c1, c2, c3, c4, c5] = self.coefficients();
        let u = t_s - self.t_s[0];
        [
            c0 + (c1 + (c2 + (c3 + (c4 + c5 * u) * u) * u) * u) * u,
            c1 + (c2 * 2.0 + c3 * (3.0 * u) + (c4 * 4.0 + c5 * (5.0 * u)) * (u * u)) * u,
            c2 * 2.0 + c3 * (6.0 * u) + (c4 * 12.0 + c5 * (20.0 * u)) * (u * u),
        ]
    }

    /// Returns position \[rad\] and speed \[rad/s\] at a time within the piece \[s\].
    #[must_use]
    pub fn at(&self, t_s: f64) -> [JointVector; 2] {
        let [q, qd, _] = self.state(t_s);
        [q, qd]
    }

    /// Accelerations at the start and at the end \[rad/s²\]. Those of a cubic are all between them.
    #[must_use]
    pub fn accelerations(&self) -> [JointVector; 2] {
        self.t_s.map(|t_s| self.state(t_s)[2])
    }

    /// Returns the two parts of the piece before and after a time within it \[s\].
    fn split(&self, t_s: f64) -> [Self; 2] {
        let [q, qd, qdd] = self.state(t_s);
        let [from, to] = self.t_s;
        let part = |t_s, q_rad, qd_rad_s, qdd_rad_s2| Self {
            t_s,
            q_rad,
            qd_rad_s,
            qdd_rad_s2,
        };
        let (before, after) = (
            self.qdd_rad_s2.map(|a| [a[0], qdd]),
            self.qdd_rad_s2.map(|a| [qdd, a[1]]),
        );
        [
            part([from, t_s], [self.q_rad[0], q], [self.qd_rad_s[0], qd], before),
            part([t_s, to], [q, self.q_rad[1]], [qd, self.qd_rad_s[1]], after),
        ]
    }
}

impl PiecewiseMotion {
    /// A motion from its pieces.
    ///
    /// # Errors
    /// [`KnotError`] with the index of the piece: a number that is not finite, a time that does not continue the one before, or a
    /// position that is not the one in which that ends.
    pub fn new(pieces: Vec<MotionPiece>) -> Result<Self, KnotError> {
        let (mut end_s, mut there) = (0.0, pieces.first().map(|piece| piece.q_rad[0]));
        for (knot, piece) in pieces.iter().enumerate() {
            let [from, to] = piece.t_s;
            let accelerations = piece.qdd_rad_s2.as_ref().into_iter().flatten();
            let numbers = piece.q_rad.iter().chain(&piece.qd_rad_s).chain(accelerations).flatten();
            if ![from, to].into_iter().chain(numbers.copied()).all(f64::is_finite) {
                return Err(KnotError::NotFinite { knot });
            }
            if from != end_s || to <= from {
                return Err(KnotError::Time { knot, t_s: to });
            }
            if there.is_some_and(|there| there != piece.q_rad[0]) {
                return Err(KnotError::Apart { knot });
            }
            (end_s, there) = (to, Some(piece.q_rad[1]));
        }
        Ok(Self { pieces })
    }

    /// The pieces, in time order.
    #[must_use]
    pub fn pieces(&self) -> &[MotionPiece] {
        &self.pieces
    }

    /// Time of the end \[s\]; 0 for an empty motion.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.pieces.last().map_or(0.0, |piece| piece.t_s[1])
    }

    /// Returns position \[rad\] and speed \[rad/s\] at a time \[s\]. At a time at which pieces meet the later one counts. `None` outside
    /// the motion.
    #[must_use]
    pub fn at(&self, t_s: f64) -> Option<[JointVector; 2]> {
        let index = self.pieces.partition_point(|piece| piece.t_s[0] <= t_s);
        let piece = self.pieces.get(index.checked_sub(1)?)?;
        (t_s <= piece.t_s[1]).then(|| piece.at(t_s))
    }

    /// Returns the motion stretched in time by `factor`, so that it is slower by that factor.
    #[must_use]
    pub fn stretched(&self, factor: f64) -> Self {
        let stretched = |piece: &MotionPiece| MotionPiece {
            t_s: piece.t_s.map(|t| t * factor),
            q_rad: piece.q_rad,
            qd_rad_s: piece.qd_rad_s.map(|v| v / factor),
            qdd_rad_s2: piece.qdd_rad_s2.map(|both| both.map(|a| a / (factor * factor))),
        };
        Self {
            pieces: self.pieces.iter().map(stretched).collect(),
        }
    }

    /// Returns the motion with a rest at its end, until a later time \[s\].
    #[must_use]
    pub fn resting_until(mut self, end_s: f64) -> Self {
        let from = self.duration_s();
        if let Some(last) = self.pieces.last().filter(|_| end_s > from) {
            let there = last.q_rad[1];
            self.pieces.push(MotionPiece::line([from, end_s], [there; 2]));
        }
        self
    }

    /// Returns the motion with pieces that end at each of some times \[s\], in ascending order. Times outside the motion are ignored, and
    /// so are those within `near_s` \[s\] of the end of a piece.
    #[must_use]
    pub fn cut_at(&self, times_s: impl IntoIterator<Item = f64>, near_s: f64) -> Self {
        let mut pieces = Vec::with_capacity(self.pieces.len());
        let mut rest = self.pieces.iter().copied();
        let mut current = rest.next();
        for t_s in times_s {
            while let Some(piece) = current.filter(|piece| piece.t_s[1] <= t_s + near_s) {
                pieces.push(piece);
                current = rest.next();
            }
            if let Some(piece) = current.filter(|piece| piece.t_s[0] + near_s < t_s) {
                let [before, after] = piece.split(t_s);
                pieces.push(before);
                current = Some(after);
            }
        }
        pieces.extend(current.into_iter().chain(rest));
        Self { pieces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-2.0..2.0_f64).prop_map(JointVector::from)
    }

    fn motions() -> impl Strategy<Value = PiecewiseMotion> {
        let piece = (
            0.01..0.5_f64,
            vector(),
            [vector(), vector()],
            prop::option::of([vector(), vector()]),
        );
        (vector(), prop::collection::vec(piece, 1..8)).prop_map(|(start, parts)| {
            let (mut t, mut q) = (0.0, start);
            let pieces = parts.into_iter().map(|(h, to, qd_rad_s, qdd_rad_s2)| {
                let piece = MotionPiece {
                    t_s: [t, t + h],
                    q_rad: [q, to],
                    qd_rad_s,
                    qdd_rad_s2,
                };
                (t, q) = (t + h, to);
                piece
            });
            PiecewiseMotion::new(pieces.collect()).unwrap()
        })
    }

    proptest! {
        #[test]
        fn cutting_changes_no_motion(motion in motions(), shares in prop::collection::vec(-0.1..1.1_f64, 0..6), seen in 0.0..1.0_f64) {
            let duration_s = motion.duration_s();
            let mut times: Vec<_> = shares.iter().map(|share| share * duration_s).collect();
            times.sort_unstable_by(f64::total_cmp);
            let cut = motion.cut_at(times.iter().copied(), 0.0);
            prop_assert!(PiecewiseMotion::new(cut.pieces().to_vec()).is_ok());
            prop_assert_eq!(cut.duration_s(), duration_s);
            for time in times.into_iter().filter(|t| *t > 0.0 && *t <= duration_s) {
                prop_assert!(cut.pieces().iter().any(|piece| piece.t_s[1] == time));
            }
            let t = seen * duration_s;
            let ([q, v], [q_cut, v_cut]) = (motion.at(t).unwrap(), cut.at(t).unwrap());
            prop_assert!((q - q_cut).amax() < 1e-9 && (v - v_cut).amax() < 1e-6, "{} {}", (q - q_cut).amax(), (v - v_cut).amax());
        }

        #[test]
        fn a_stretched_motion_is_slower_and_goes_the_same_way(motion in motions(), factor in 0.2..5.0_f64, share in 0.0..1.0_f64) {
            let stretched = motion.stretched(factor);
            let t = share * motion.duration_s();
            let ([q, v], [q_slow, v_slow]) = (motion.at(t).unwrap(), stretched.at((t * factor).min(stretched.duration_s())).unwrap());
            prop_assert!((q - q_slow).amax() < 1e-9, "{}", (q - q_slow).amax());
            prop_assert!((v - v_slow * factor).amax() < 1e-6);
        }

        #[test]
        fn speeds_are_derivatives_and_accelerations_theirs(motion in motions(), share in 0.1..0.9_f64) {
            let piece = motion.pieces()[0];
            let (u, h) = (share * piece.length_s(), 1e-6);
            let [before, after] = [u - h, u + h].map(|u| piece.at(u));
            prop_assert!(((after[0] - before[0]) / (2.0 * h) - piece.at(u)[1]).amax() < 1e-3);
            let acceleration = (after[1] - before[1]) / (2.0 * h);
            let [first, last] = piece.accelerations();
            let room = 1.0 + first.amax() + last.amax() + acceleration.amax();
            prop_assert!((piece.state(u)[2] - acceleration).amax() < 1e-3 * room);
            if piece.qdd_rad_s2.is_none() {
                prop_assert!((first + (last - first) * share - acceleration).amax() < 1e-3 * room);
            }
        }

        #[test]
        fn pieces_have_the_ends_that_they_state(motion in motions()) {
            for piece in motion.pieces() {
                for end in 0..2 {
                    let [q, qd, qdd] = piece.state(piece.t_s[end]);
                    prop_assert!((q - piece.q_rad[end]).amax() < 1e-9 && (qd - piece.qd_rad_s[end]).amax() < 1e-7);
                    prop_assert!(piece.qdd_rad_s2.is_none_or(|stated| (stated[end] - qdd).amax() < 1e-5));
                }
            }
        }
    }

    #[test]
    fn rejects_gaps_and_nan() {
        let rest = |t_s| MotionPiece::line(t_s, [JointVector::zeros(); 2]);
        let refused = |pieces| PiecewiseMotion::new(pieces).unwrap_err();
        assert_eq!(
            refused(vec![rest([0.0, 1.0]), rest([1.5, 2.0])]),
            KnotError::Time { knot: 1, t_s: 2.0 }
        );
        assert_eq!(refused(vec![rest([0.5, 1.0])]), KnotError::Time { knot: 0, t_s: 1.0 });
        let mut nan = rest([0.0, 1.0]);
        nan.qd_rad_s[1][3] = f64::NAN;
        assert_eq!(refused(vec![nan]), KnotError::NotFinite { knot: 0 });
        assert_eq!(PiecewiseMotion::new(Vec::new()).unwrap().at(0.0), None);
    }
}
