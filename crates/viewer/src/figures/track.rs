//! The way of the tip, moment by moment.

use crate::view::tips::Tip;
use nalgebra::Vector3;

/// Where the tip is at a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackPoint {
    /// When \[s\].
    pub t_s: f64,
    /// Index of the plan's segment.
    pub segment: usize,
    /// Where, world frame \[m\].
    pub at: Vector3<f64>,
    /// The way out of the tool, world frame.
    pub axis: Vector3<f64>,
}

impl From<&TrackPoint> for Tip {
    fn from(point: &TrackPoint) -> Self {
        Self {
            t_s: point.t_s,
            at: point.at,
            axis: point.axis,
        }
    }
}

/// The way of the tip in time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track(Vec<TrackPoint>);

impl Track {
    /// Of moments that follow one another.
    #[must_use]
    pub fn new(points: Vec<TrackPoint>) -> Self {
        Self(points)
    }

    /// All moments.
    #[must_use]
    pub fn points(&self) -> &[TrackPoint] {
        &self.0
    }

    /// The moments of a segment.
    #[must_use]
    pub fn within(&self, segment: usize) -> &[TrackPoint] {
        let from = self.0.partition_point(|point| point.segment < segment);
        let to = self.0.partition_point(|point| point.segment <= segment);
        &self.0[from..to]
    }

    /// The places of a segment from the last moment of the one before, so that ways have no gaps \[m\].
    #[must_use]
    pub fn way(&self, segment: usize) -> Vec<Vector3<f64>> {
        let from = self
            .0
            .partition_point(|point| point.segment < segment)
            .saturating_sub(1);
        let to = self.0.partition_point(|point| point.segment <= segment);
        self.0[from.min(to)..to].iter().map(|point| point.at).collect()
    }
}
