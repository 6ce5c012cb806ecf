//! One piece of the promised motion: a cubic in time between two knots.

use platewash_kinematics::{AXES, JointVector};

/// A cubic Hermite piece between (q₀, q̇₀) at 0 and (q₁, q̇₁) at `h`, with its accelerations.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    /// Duration \[s\].
    pub h: f64,
    /// Position at the start \[rad\].
    pub start: JointVector,
    /// Speeds at both ends \[rad/s\].
    pub speed: [JointVector; 2],
    /// Accelerations at both ends \[rad/s²\]; between them a line.
    pub acceleration: [JointVector; 2],
}

impl Piece {
    /// The piece through two positions \[rad\] with their speeds \[rad/s\], of duration `h` \[s\].
    pub fn new(h: f64, [q0, q1]: [&JointVector; 2], speed: [JointVector; 2]) -> Self {
        let chord = (q1 - q0) / h;
        let [v0, v1] = speed;
        Self {
            h,
            start: *q0,
            speed,
            acceleration: [
                (chord * 6.0 - v0 * 4.0 - v1 * 2.0) / h,
                (v0 * 2.0 + v1 * 4.0 - chord * 6.0) / h,
            ],
        }
    }

    /// Position, speed and acceleration at `t` in [0, h].
    pub fn at(&self, t: f64) -> [JointVector; 3] {
        let [a, jerk] = [self.acceleration[0], self.jerk()];
        [
            self.start + (self.speed[0] + (a * 0.5 + jerk * (t / 6.0)) * t) * t,
            self.speed[0] + (a + jerk * (0.5 * t)) * t,
            a + jerk * t,
        ]
    }

    /// The constant third derivative \[rad/s³\].
    pub fn jerk(&self) -> JointVector {
        (self.acceleration[1] - self.acceleration[0]) / self.h
    }

    /// Largest acceleration of each joint \[rad/s²\].
    pub fn most_acceleration(&self) -> JointVector {
        self.acceleration[0].abs().sup(&self.acceleration[1].abs())
    }

    /// Largest speed of each joint \[rad/s\]: at an end, or where the acceleration passes through zero.
    pub fn most_speed(&self) -> JointVector {
        let mut most = self.speed[0].abs().sup(&self.speed[1].abs());
        for joint in 0..AXES {
            let [a0, a1] = [self.acceleration[0][joint], self.acceleration[1][joint]];
            if a0 * a1 < 0.0 {
                let turn = self.speed[0][joint] + 0.5 * a0 * self.h * (a0 / (a0 - a1));
                most[joint] = most[joint].max(turn.abs());
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_motion::trajectory::Trajectory;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from)
    }

    proptest! {
        #[test]
        fn cubic_equals_the_segment_of_the_trajectory(q in [vector(), vector()], v in [vector(), vector()], h in 0.01..2.0f64) {
            let piece = Piece::new(h, [&q[0], &q[1]], v);
            let motion = Trajectory::from_knots(vec![0.0, h], q.to_vec(), v.to_vec()).unwrap();
            let extremes = motion.extremes().next().unwrap();
            let scale = 1.0 + extremes.acceleration.amax();
            prop_assert!((piece.most_speed() - extremes.speed).amax() < 1e-12 * scale);
            prop_assert!((piece.most_acceleration() - extremes.acceleration).amax() < 1e-12 * scale);
            for share in [0.0, 0.3, 0.9] {
                let (state, [q, qd, qdd]) = (motion.at(share * h).unwrap(), piece.at(share * h));
                prop_assert!((state.q - q).amax().max((state.qd - qd).amax()).max((state.qdd - qdd).amax()) < 1e-11 * scale);
            }
        }
    }
}
