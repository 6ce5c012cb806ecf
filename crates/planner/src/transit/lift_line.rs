//! Where a transit begins or ends.

use crate::joint_path::{Ends, JointPath, JointPathError, PathState};
use crate::timing::Slow;
use platewash_kinematics::JointVector;

/// Home, or a plate with the line along its normal: configurations from where the arm rests to where it is free.
#[derive(Debug, Clone, PartialEq)]
pub struct LiftLine {
    /// Heights above the place of rest \[m\], ascending from 0; one alone for home.
    height_m: Vec<f64>,
    /// Configurations there \[rad\].
    q: Vec<JointVector>,
    /// By the height, at the lower and the upper end \[rad/m\]; the second one twice at the upper end.
    slopes: Option<[JointVector; 3]>,
    plate: Option<usize>,
    /// Up to a height \[m\] the tip is no faster than that \[m/s\].
    slow: Option<[f64; 2]>,
}

/// A line that is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the line over plate {plate}: {error}")]
pub struct LiftLineError {
    /// The plate.
    pub plate: usize,
    /// What is wrong with its samples.
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

    /// The same, with the tip no faster than `speed_m_s` up to `height_m` above the place of rest.
    #[must_use]
    pub fn no_faster(mut self, height_m: f64, speed_m_s: f64) -> Self {
        self.slow = Some([height_m, speed_m_s]);
        self
    }

    /// Where a path that leaves from here is slow: its parameter is the height.
    pub(super) fn slow_from(&self, u: f64) -> Option<Slow> {
        self.slow.map(|[height_m, most]| Slow {
            u: [u, u + height_m],
            most,
        })
    }

    /// The same for a path that ends here.
    pub(super) fn slow_until(&self, u: f64) -> Option<Slow> {
        self.slow.map(|[height_m, most]| Slow {
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

    /// Where the arm rests \[rad\].
    #[must_use]
    pub fn rest(&self) -> &JointVector {
        &self.q[0]
    }

    /// Where the arm is free to go anywhere \[rad\].
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
    pub(super) fn leaving(&self, slope: JointVector) -> PathState {
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
    pub(super) fn slope_at_rest(&self, slope: JointVector) -> JointVector {
        self.slopes.map_or(slope, |[low, ..]| low)
    }
}
