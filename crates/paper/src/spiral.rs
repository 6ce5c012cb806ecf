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

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;

    const PAPER: PaperSpiral = PaperSpiral {
        points: 55,
        turns: 3.0,
        radius_m: 0.145,
        closing_ring: false,
    };

    #[test]
    fn the_papers_spiral_turns_20_degrees_a_waypoint_and_ends_on_the_x_axis() {
        let points = PAPER.waypoints([0.25, -0.25]);
        assert_eq!(points.len(), 55);
        assert_eq!(points[0], [0.25, -0.25]);
        let end = points[54];
        assert!((end[0] - 0.395).abs() < 1e-15 && (end[1] + 0.25).abs() < 1e-15);
        for (k, p) in points.iter().enumerate().skip(1) {
            let (dx, dy) = (p[0] - 0.25, p[1] + 0.25);
            assert!(((dx * dx + dy * dy).sqrt() - 0.145 * k as f64 / 54.0).abs() < 1e-15);
            let angle = dy.atan2(dx).rem_euclid(TAU);
            let expected = (20.0_f64 * k as f64).to_radians().rem_euclid(TAU);
            let off = (angle - expected).abs();
            assert!(off.min(TAU - off) < 1e-12, "waypoint {k}");
        }
    }

    #[test]
    fn the_ring_is_a_full_circle_that_starts_where_the_spiral_ends() {
        let ringed = PaperSpiral {
            closing_ring: true,
            turns: 2.5,
            ..PAPER
        };
        let points = ringed.waypoints([0.0, 0.0]);
        let ring = &points[54..];
        assert_eq!(ring.len() - 1, 22, "54 steps over 2.5 turns are 21.6 a turn");
        let endless = PaperSpiral { turns: 1e-9, ..ringed };
        assert_eq!(endless.waypoints([0.0, 0.0]).len(), 55 + 3600);
        for spiral in [PAPER, ringed, endless] {
            assert_eq!(spiral.waypoint_count(), spiral.waypoints([0.0, 0.0]).len());
        }
        let (first, last) = (ring[0], ring[ring.len() - 1]);
        assert!((first[0] - last[0]).abs() < 1e-14 && (first[1] - last[1]).abs() < 1e-14);
        assert!(
            ring.iter()
                .all(|p| ((p[0] * p[0] + p[1] * p[1]).sqrt() - 0.145).abs() < 1e-15)
        );
    }
}
