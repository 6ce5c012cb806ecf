//! Route from one plate to the next: an arc round the base, high above the plates.

use nalgebra::Vector3;
use platewash_kinematics::trig::{atan2, sin_cos};
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
