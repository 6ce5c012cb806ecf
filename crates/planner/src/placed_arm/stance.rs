//! Stance: the rules for a tool on faces that are not flat, and for the wrist; and the point at which the tip stands.

use nalgebra::Vector3;
use platewash_kinematics::trig::{asin, sin_cos};
use platewash_workcell::surface::Surface;
use std::f64::consts::PI;

/// The share of a face's slope that the tool's axis takes where none is stated: on the plates that come along the wrist then keeps away
/// from where it would flip, and the sponge from lifting.
pub const AXIS_SHARE: f64 = 0.5;

/// Half the length of the meridian over which the axis takes the mean slope \[m\], so that it turns evenly over a bend.
const HALF_WINDOW_M: f64 = 6e-3;

/// Reserve of the wrist beyond its least angle \[rad\], 0.25°: between the points solved joint 5 may come nearer to 0.
pub const WRIST_RESERVE_RAD: f64 = PI / 720.0;

/// Reserve between the largest tilt planned and the largest allowed \[rad\], 0.057°. Between the points solved, the joints follow
/// curves through them and then cubics, which turn the tool a little further.
pub const TILT_RESERVE_RAD: f64 = 1e-3;

/// Rules for the tool on faces, and for the wrist.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stance {
    /// Slope of the tool's axis as a share of the mean slope of the face around.
    pub axis_share: f64,
    /// Least angle of joint 5 from 0, always on one side \[rad\]; `None` where no angle is required.
    pub wrist_rad: Option<f64>,
    /// Reserve between the largest tilt planned and the largest allowed \[rad\].
    pub tilt_reserve_rad: f64,
    /// Lean of the tool across the arm's plane, besides any tilt in it \[rad\]: positive towards n × ρ̂.
    pub aside_rad: f64,
}

impl Default for Stance {
    fn default() -> Self {
        Self {
            axis_share: AXIS_SHARE,
            wrist_rad: None,
            tilt_reserve_rad: TILT_RESERVE_RAD,
            aside_rad: 0.0,
        }
    }
}

impl Stance {
    /// Total lean of the tool at a tilt in the arm's plane \[rad\].
    #[must_use]
    pub fn lean_rad(&self, tilt_rad: f64) -> f64 {
        if self.aside_rad == 0.0 {
            return tilt_rad.abs();
        }
        (tilt_rad * tilt_rad + self.aside_rad * self.aside_rad).sqrt()
    }

    /// The largest tilt in the arm's plane with which the tool leans by `most_rad` in all \[rad\].
    #[must_use]
    pub fn tilt_rad(&self, most_rad: f64) -> f64 {
        if self.aside_rad == 0.0 {
            return most_rad;
        }
        (most_rad * most_rad - self.aside_rad * self.aside_rad).max(0.0).sqrt()
    }
}

/// The slope of the axis along a meridian: a share of the face's own, averaged over 12 mm of it.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisRule {
    share: f64,
    /// ℓ, β and ∫ β dℓ at the pole and at the knots; none of a flat face.
    knots: Vec<[f64; 3]>,
}

impl AxisRule {
    /// The rule on a surface.
    #[must_use]
    pub fn new(surface: &Surface, share: f64) -> Self {
        let mut knots = Vec::new();
        if let Surface::Profile(meridian) = surface {
            let mut last = [0.0; 3];
            knots.push(last);
            for knot in meridian.knots() {
                let arc_m = meridian.arc_at(knot.radius_m);
                let area = last[2] + 0.5 * (arc_m - last[0]) * (last[1] + knot.slope_rad);
                last = [arc_m, knot.slope_rad, area];
                knots.push(last);
            }
        }
        Self { share, knots }
    }

    /// cos and sin of the axis's slope at ℓ \[m\].
    #[must_use]
    pub fn direction(&self, arc_m: f64) -> [f64; 2] {
        if self.knots.is_empty() {
            return [1.0, 0.0];
        }
        let [before, after] = [arc_m - HALF_WINDOW_M, arc_m + HALF_WINDOW_M].map(|at| self.integral(at));
        let (s, c) = sin_cos(self.share * (after - before) / (2.0 * HALF_WINDOW_M));
        [c, s]
    }

    /// ∫ β dℓ from the pole; β is linear in ℓ between knots, constant beyond the rim, and −β on the other side of the pole.
    fn integral(&self, arc_m: f64) -> f64 {
        let arc_m = arc_m.abs();
        let after = self.knots.partition_point(|knot| knot[0] <= arc_m).max(1);
        let [from_m, slope, area] = self.knots[after - 1];
        let rate = match self.knots.get(after) {
            Some([to_m, next, _]) => (next - slope) / (to_m - from_m),
            None => 0.0,
        };
        let along_m = arc_m - from_m;
        area + along_m * (slope + 0.5 * rate * along_m)
    }
}

/// The angle between two unit vectors that are not far apart \[rad\].
pub(crate) fn angle_between(a: &nalgebra::Vector3<f64>, b: &nalgebra::Vector3<f64>) -> f64 {
    let half = (0.5 * (a - b).norm()).min(1.0);
    2.0 * asin(half)
}

/// Point at which the tip stands, with the face there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The point \[m\], base frame.
    pub point: Vector3<f64>,
    /// The normal of the face there, out of it, base frame.
    pub normal: Vector3<f64>,
    /// Axis from which the tilt of the tool counts, base frame: along it the tool is upright. On a flat face it is the normal.
    pub axis: Vector3<f64>,
}

impl Contact {
    /// A point whose tool stands on the normal.
    #[must_use]
    pub fn on_normal(point: Vector3<f64>, normal: Vector3<f64>) -> Self {
        let axis = normal;
        Self { point, normal, axis }
    }

    /// A point over level ground \[m\].
    #[must_use]
    pub fn level(point: Vector3<f64>) -> Self {
        Self::on_normal(point, Vector3::z())
    }

    /// The point so far along the normal \[m\].
    #[must_use]
    pub fn raised(&self, height_m: f64) -> Self {
        let point = self.point + self.normal * height_m;
        Self { point, ..*self }
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use platewash_workcell::surface::SHIPPED_PROFILES;
    use proptest::prelude::*;

    proptest! {
        /// By sums over the window.
        #[test]
        fn the_axis_takes_its_share_of_the_mean_slope(name in prop::sample::select(SHIPPED_PROFILES.to_vec()), at in 0.0..1.05f64, share in 0.0..1.0f64) {
            let surface = Surface::shipped(name).unwrap();
            let arc_m = at * surface.arc_m();
            let slope = |arc_m: f64| {
                let slope = surface.at_arc(arc_m.abs()).sine.asin();
                if arc_m < 0.0 { -slope } else { slope }
            };
            let steps = 2000;
            let over = |k: i32| slope(arc_m + HALF_WINDOW_M * (2.0 * (f64::from(k) + 0.5) / f64::from(steps) - 1.0));
            let mean = (0..steps).map(over).sum::<f64>() / f64::from(steps);
            let [c, s] = AxisRule::new(&surface, share).direction(arc_m);
            prop_assert!((s.atan2(c) - share * mean).abs() < 1e-5);
        }
    }

    #[test]
    fn on_a_flat_face_the_axis_is_the_normal() {
        let rule = AxisRule::new(&Surface::Disc { radius_m: 0.1 }, 0.5);
        assert_eq!(rule.direction(0.05), [1.0, 0.0]);
    }
}
