//! Cubic curves through waypoints at equally spaced times in [0, 1].

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A curve through waypoints at equally spaced times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// One cubic per segment, at rest at every waypoint (the paper).
    ZeroVelocity,
    /// One spline with continuous acceleration, at rest at both ends only.
    C2Spline,
}

/// Samples a curve through `waypoints` (at times 0, h, 2h … 1) at `samples` equally spaced times, both ends
/// included.
///
/// - [`Interpolation::ZeroVelocity`]: one cubic per segment with zero velocity at **every** waypoint, which
///   is what MATLAB's `cubicpolytraj` does by default: the curve stops at each of them, and its acceleration
///   jumps there.
/// - [`Interpolation::C2Spline`]: the clamped cubic spline, zero velocity at both ends and continuous
///   acceleration everywhere (de Boor, *A Practical Guide to Splines*, ch. IV).
///
/// With fewer than two waypoints the answer is those waypoints.
#[must_use]
pub fn sample(waypoints: &[Vector3<f64>], interpolation: Interpolation, samples: usize) -> Vec<Vector3<f64>> {
    let segments = waypoints.len().saturating_sub(1);
    if segments == 0 {
        return waypoints.to_vec();
    }
    let slopes = match interpolation {
        Interpolation::ZeroVelocity => vec![Vector3::zeros(); waypoints.len()],
        Interpolation::C2Spline => clamped_slopes(waypoints),
    };
    let last = samples.saturating_sub(1).max(1);
    let at = |k: usize| {
        // Time in units of one segment; whole numbers are hit exactly.
        let time = (k * segments) as f64 / last as f64;
        let segment = (time as usize).min(segments - 1);
        let ends = [segment, segment + 1];
        hermite(
            ends.map(|i| waypoints[i]),
            ends.map(|i| slopes[i]),
            time - segment as f64,
        )
    };
    (0..samples).map(at).collect()
}

/// Cubic with the given end values and end slopes, at u in [0, 1].
fn hermite([p0, p1]: [Vector3<f64>; 2], [v0, v1]: [Vector3<f64>; 2], u: f64) -> Vector3<f64> {
    let rise = p1 - p0;
    let (a2, a3) = (rise * 3.0 - v0 * 2.0 - v1, v0 + v1 - rise * 2.0);
    p0 + (v0 + (a2 + a3 * u) * u) * u
}

/// Slopes (per segment) of the clamped spline: `s_{i−1} + 4 s_i + s_{i+1} = 3 (p_{i+1} − p_{i−1})` with zero end
/// slopes, solved by elimination (diagonally dominant, so without pivoting).
fn clamped_slopes(p: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let n = p.len();
    let mut slopes = vec![Vector3::zeros(); n];
    let mut upper = vec![0.0; n];
    for i in 1..n - 1 {
        let pivot = 4.0 - upper[i - 1];
        upper[i] = 1.0 / pivot;
        slopes[i] = ((p[i + 1] - p[i - 1]) * 3.0 - slopes[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        slopes[i] = slopes[i] - slopes[i + 1] * upper[i];
    }
    slopes
}
