//! Ends of a transit, the lines over plates, and the arc round the base between them, as paths of the joints.
//!
//! A quintic from one state of the joints to another: C² where it joins the pieces before and after.

use crate::joint_path::{Ends, JointPath, JointPathError, PathState};
use crate::placed_arm::{Contact, PlacedArm};
use crate::timing::SlowStretch;
use crate::transit::rules::{BaseArc, FreePath};
use platewash_kinematics::{JointVector, Pose};
use platewash_workcell::arc;
use platewash_workcell::words::plate_name;

/// Home, or a plate with the line along its normal: configurations from where the arm rests to where it is free.
#[derive(Debug, Clone, PartialEq)]
pub struct LiftLine {
    /// Heights above the place of rest \[m\], ascending from 0; one alone for home.
    height_m: Vec<f64>,
    /// Configurations there \[rad\].
    q: Vec<JointVector>,
    /// Slopes by the height, at the lower and the upper end \[rad/m\]; the second one twice at the upper end.
    slopes: Option<[JointVector; 3]>,
    plate: Option<usize>,
    /// Up to a height \[m\] the tip is no faster than that \[m/s\].
    slow: Option<[f64; 2]>,
}

/// A line that is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the line over {}: {error}", plate_name(*.plate))]
pub struct LiftLineError {
    /// The plate.
    pub plate: usize,
    /// Error in its samples.
    pub error: JointPathError,
}

impl LiftLine {
    /// Rest at a configuration \[rad\].
    #[must_use]
    pub fn home(q: JointVector) -> Self {
        Self {
            height_m: vec![0.0],
            q: vec![q],
            slopes: None,
            plate: None,
            slow: None,
        }
    }

    /// The line over a plate: heights \[m\], ascending from 0, and the configurations there \[rad\].
    ///
    /// # Errors
    /// [`LiftLineError`] for fewer than four samples, or heights that don't ascend.
    pub fn line(plate: usize, height_m: Vec<f64>, q: Vec<JointVector>) -> Result<Self, LiftLineError> {
        let path = JointPath::through(height_m.clone(), q.clone(), Ends::NotAKnot)
            .map_err(|error| LiftLineError { plate, error })?;
        let [low, top] = [0.0, height_m.last().copied().unwrap_or(0.0)].map(|h| path.at(h));
        Ok(Self {
            height_m,
            q,
            slopes: Some([low.first, top.first, top.second]),
            plate: Some(plate),
            slow: None,
        })
    }

    /// The same line, with the tip no faster than `speed_m_s` up to `height_m` above the place of rest.
    #[must_use]
    pub fn no_faster(mut self, height_m: f64, speed_m_s: f64) -> Self {
        self.slow = Some([height_m, speed_m_s]);
        self
    }

    /// Slow range of a path that leaves from here: its parameter is the height.
    pub(crate) fn slow_from(&self, u: f64) -> Option<SlowStretch> {
        self.slow.map(|[height_m, most]| SlowStretch {
            u: [u, u + height_m],
            most,
        })
    }

    /// The same range for a path that ends here.
    pub(crate) fn slow_until(&self, u: f64) -> Option<SlowStretch> {
        self.slow.map(|[height_m, most]| SlowStretch {
            u: [u - height_m, u],
            most,
        })
    }

    /// The plate under it.
    #[must_use]
    pub fn plate(&self) -> Option<usize> {
        self.plate
    }

    /// Heights \[m\] and configurations \[rad\] from rest to the top.
    #[must_use]
    pub fn samples(&self) -> (&[f64], &[JointVector]) {
        (&self.height_m, &self.q)
    }

    /// Configuration in which the arm rests \[rad\].
    #[must_use]
    pub fn rest(&self) -> &JointVector {
        &self.q[0]
    }

    /// Configuration from which the arm is free to go anywhere \[rad\].
    #[must_use]
    pub fn top(&self) -> &JointVector {
        &self.q[self.q.len() - 1]
    }

    /// Length of the line \[m\].
    #[must_use]
    pub fn height_m(&self) -> f64 {
        self.height_m[self.height_m.len() - 1]
    }

    /// State at the top on the way out; home leaves at the slope given \[rad/m\].
    pub(crate) fn leaving(&self, slope: JointVector) -> PathState {
        let (first, second) = match self.slopes {
            Some([_, first, second]) => (first, second),
            None => (slope, JointVector::zeros()),
        };
        PathState {
            q: *self.top(),
            first,
            second,
        }
    }

    /// Slope at rest on the way out \[rad/m\].
    pub(crate) fn slope_at_rest(&self, slope: JointVector) -> JointVector {
        self.slopes.map_or(slope, |[low, ..]| low)
    }
}

/// The path over the arc; `None` where a point of it is out of reach, or reached by a jump only.
pub(crate) fn path(placed: &PlacedArm<'_>, over: &BaseArc, from: &LiftLine, to: &LiftLine) -> Option<FreePath> {
    let tip = |q| placed.robot.fk(q).rigid(&placed.tip).translation;
    let (start, end) = (tip(from.top()), tip(to.top()));
    let points = arc::waypoints(start, end, &over.arc);
    let inner = &points[1..points.len() - 1];
    let pose = |point: &_| placed.pose(&Contact::level(*point), &over.policy);
    let poses: Vec<Pose> = inner.iter().map(pose).collect();
    let q = placed.solver.solve_path(&poses, from.top()).ok()?.q;
    let mut length = 0.0;
    let u = points[..points.len() - 1].windows(2).map(|ends| {
        length += (ends[1] - ends[0]).norm().max(1e-4);
        length
    });
    let u: Vec<f64> = u.collect();
    let last = (end - points[points.len() - 2]).norm().max(1e-4);
    Some(FreePath {
        length: u.last()? + last,
        u,
        q,
    })
}

/// Quintic with given states at both ends of [0, length]; at `share` of it, in [0, 1].
///
/// In `s = u / length`, with `v = length · first` and `w = length² · second` (Hermite form; Farin, *Curves and Surfaces for
/// CAGD*, ch. 7): the value is `Σ H_k(s) · (q₀, v₀, w₀, w₁, v₁, q₁)`.
pub(crate) fn quintic(from: &PathState, to: &PathState, length: f64, share: f64) -> JointVector {
    let s = share;
    let (s2, t) = (s * s, 1.0 - s);
    let (s3, t2) = (s2 * s, t * t);
    let t3 = t2 * t;
    let (v, w) = (length, length * length);
    from.q * (t3 * (1.0 + 3.0 * s + 6.0 * s2))
        + from.first * (v * t3 * s * (1.0 + 3.0 * s))
        + from.second * (w * t3 * s2 * 0.5)
        + to.second * (w * s3 * t2 * 0.5)
        - to.first * (v * s3 * t * (1.0 + 3.0 * t))
        + to.q * (s3 * (1.0 + 3.0 * t + 6.0 * t2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn joints() -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from)
    }

    fn states() -> impl Strategy<Value = PathState> {
        (joints(), joints(), joints()).prop_map(|(q, first, second)| PathState { q, first, second })
    }

    proptest! {
        #[test]
        fn meets_both_ends_with_their_derivatives(a in states(), b in states(), length in 0.1..3.0f64) {
            let at = |u: f64| quintic(&a, &b, length, u / length);
            let h = 1e-4 * length;
            for (end, state, h) in [(0.0, a, h), (length, b, -h)] {
                let q: Vec<_> = (0..4).map(|k| at(end + h * f64::from(k))).collect();
                prop_assert!((q[0] - state.q).amax() < 1e-12);
                let first = (q[0] * -11.0 + q[1] * 18.0 - q[2] * 9.0 + q[3] * 2.0) / (6.0 * h);
                prop_assert!((first - state.first).amax() < 1e-6 * (1.0 + 1.0 / length));
                let second = (q[0] * 2.0 - q[1] * 5.0 + q[2] * 4.0 - q[3]) / (h * h);
                prop_assert!((second - state.second).amax() < 1e-2 * (1.0 + 1.0 / (length * length)), "{second}");
            }
        }
    }
}
