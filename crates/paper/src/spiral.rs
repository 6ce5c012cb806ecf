//! The spiral over a plate, and the ring that closes it.

use platewash_kinematics::trig::sin_cos;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Most points of a closing ring: a tenth of a degree apart.
const MOST_RING_POINTS: f64 = 3600.0;

/// An Archimedean spiral from the centre outwards, as the paper samples it: `points` waypoints with
/// θ = linspace(0, 2π·turns) and r = linspace(0, radius), equally spaced in angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperSpiral {
    /// Waypoints, at least 2.
    pub points: usize,
    /// Turns.
    pub turns: f64,
    /// Outer radius \[m\].
    pub radius_m: f64,
    /// True where a full circle at the outer radius follows, at the spiral's angular spacing or finer.
    pub closing_ring: bool,
}

impl PaperSpiral {
    /// Waypoints about `centre` (x, y \[m\]), counter-clockwise from +x.
    #[must_use]
    pub fn waypoints(&self, centre: [f64; 2]) -> Vec<[f64; 2]> {
        let last = self.points.saturating_sub(1).max(1) as f64;
        let place = |radius: f64, angle: f64| {
            let (s, c) = sin_cos(angle);
            [centre[0] + radius * c, centre[1] + radius * s]
        };
        let full = TAU * self.turns;
        let spiral = (0..self.points).map(|k| {
            let share = k as f64 / last;
            place(self.radius_m * share, full * share)
        });
        let ring_points = self.ring_points();
        let ring = (1..=ring_points).map(|k| place(self.radius_m, full + TAU * k as f64 / ring_points as f64));
        spiral.chain(ring).collect()
    }

    /// Number of waypoints.
    #[must_use]
    pub fn waypoint_count(&self) -> usize {
        self.points.saturating_add(self.ring_points())
    }

    /// Points of one full circle at the spiral's angular spacing or finer, from 3 to [`MOST_RING_POINTS`]; none without a closing ring.
    fn ring_points(&self) -> usize {
        if !self.closing_ring {
            return 0;
        }
        let last = self.points.saturating_sub(1).max(1) as f64;
        (last / self.turns).ceil().clamp(3.0, MOST_RING_POINTS) as usize
    }
}
