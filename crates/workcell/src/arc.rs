//! Route from one plate to the next: an arc round the base, high above the plates.

use crate::trig::{atan2, sin_cos};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// The arc round the base.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arc {
    /// Waypoints on the arc, both ends included; at least 2.
    pub points: usize,
    /// Radius about the base axis \[m\].
    pub radius_m: f64,
    /// Height \[m\].
    pub height_m: f64,
}

/// Returns the waypoints from `from` to `to` (base frame, m): `from`, the arc from the azimuth of one to that of the other the shorter way
/// round, then down to `to`.
///
/// As the paper's code: azimuths normalised to [0, 2π); a difference of exactly π goes counter-clockwise.
#[must_use]
pub fn waypoints(from: Vector3<f64>, to: Vector3<f64>, arc: &Arc) -> Vec<Vector3<f64>> {
    let start = azimuth(&from);
    let turn = shorter_turn(start, azimuth(&to));
    let last = arc.points.saturating_sub(1).max(1) as f64;
    let on_arc = (0..arc.points).map(|k| {
        let (s, c) = sin_cos(start + turn * (k as f64 / last));
        Vector3::new(arc.radius_m * c, arc.radius_m * s, arc.height_m)
    });
    std::iter::once(from).chain(on_arc).chain(std::iter::once(to)).collect()
}

/// Azimuth in [0, 2π) \[rad\].
fn azimuth(p: &Vector3<f64>) -> f64 {
    let angle = atan2(p.y, p.x);
    if angle < 0.0 { angle + TAU } else { angle }
}

/// Returns the signed turn in (−π, π] from one azimuth to another \[rad\].
fn shorter_turn(from: f64, to: f64) -> f64 {
    let turn = to - from;
    if turn > PI {
        turn - TAU
    } else if turn <= -PI {
        turn + TAU
    } else {
        turn
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ARC: Arc = Arc {
        points: 5,
        radius_m: 0.35,
        height_m: 0.25,
    };

    proptest! {
        #[test]
        fn the_arc_goes_the_shorter_way_at_its_radius_and_height(a in 0.0..TAU, b in 0.0..TAU, r in 0.1..0.6f64) {
            let place = |angle: f64| Vector3::new(r * angle.cos(), r * angle.sin(), 0.08);
            let path = waypoints(place(a), place(b), &ARC);
            prop_assert_eq!(path.len(), 7);
            prop_assert_eq!((path[0], path[6]), (place(a), place(b)));
            for p in &path[1..6] {
                prop_assert!((p.xy().norm() - 0.35).abs() < 1e-14 && p.z == 0.25);
            }
            let total: f64 = path[1..6].windows(2).map(|w| w[0].xy().angle(&w[1].xy())).sum();
            prop_assert!((total - place(a).xy().angle(&place(b).xy())).abs() < 1e-6, "turned {total}");
            // The ends of the arc stand over the ends of the path.
            prop_assert!(path[1].xy().angle(&path[0].xy()) < 1e-7);
            prop_assert!(path[5].xy().angle(&path[6].xy()) < 1e-7);
        }
    }

    #[test]
    fn arcs_take_no_detour_at_the_seam_of_atan2() {
        let path = waypoints(Vector3::new(-0.3, 0.01, 0.08), Vector3::new(-0.3, -0.01, 0.08), &ARC);
        assert!(path[1..6].iter().all(|p| p.x < -0.34), "{path:?}");
    }
}
