//! The path of the sponge on a plate, as a curve: a spiral from the centre that runs tangentially into a closing ring.
//!
//! In polar coordinates about the plate's centre the angle θ is the parameter, from 0 to `Θ`, the spiral's turns, and on
//! to `Θ + 2π` with a ring. The radius grows at the constant rate `a = R / (Θ − β/2)` until the last `β` =
//! [`BLEND_RAD`] of the spiral, over which the rate falls to zero as `a (1 − S(x))`, `S(x) = x³ (10 − 15 x + 6 x²)`. So
//! `r(θ)` is C³ and meets the ring at `r = R` without a bend.

use crate::plate::Plate;
use crate::trig::sin_cos;
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// The last part of the spiral, over which it turns into the ring \[rad\].
pub const BLEND_RAD: f64 = 1.0;

/// The least outer radius of a wash curve \[m\].
pub const LEAST_RADIUS_M: f64 = 1e-4;

/// The fewest turns of a wash curve.
pub const LEAST_TURNS: f64 = 0.25;

/// The most turns of a wash curve.
pub const MOST_TURNS: f64 = 200.0;

/// The longest wash curve \[m\]; it bounds time and memory.
pub const LONGEST_M: f64 = 100.0;

/// A spiral and its ring in the plane of a plate, as parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WashCurve {
    /// Outer radius R \[m\], above 0.
    pub radius_m: f64,
    /// Turns of the spiral; at least a quarter.
    pub turns: f64,
    /// Direction in which the spiral leaves the centre, counter-clockwise from +x \[rad\].
    pub start_angle_rad: f64,
    /// Whether a full circle at the outer radius follows.
    pub closing_ring: bool,
}

/// A point of a wash curve, relative to the plate's centre, with derivatives by θ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Position \[m\].
    pub position: Vector2<f64>,
    /// First derivative \[m/rad\].
    pub first: Vector2<f64>,
    /// Second derivative \[m/rad²\].
    pub second: Vector2<f64>,
}

/// How the tip washes a plate: the curve of the tip on the face, and how the tool stands on it. From parameters alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WashPath {
    /// Index of the plate.
    pub plate: usize,
    /// The curve, seen along the plate's axis; its x is the plate's.
    pub curve: WashCurve,
    /// How far the tip approaches and retreats along the normal over the ends of the curve \[m\].
    pub lift_m: f64,
    /// Half the angle of the cone about the local normal within which the tool stays \[rad\].
    pub cone_rad: f64,
}

impl WashPath {
    /// The contact point at θ \[rad\], world frame \[m\].
    #[must_use]
    pub fn contact(&self, plate: &Plate, theta: f64) -> Vector3<f64> {
        let at = self.curve.at(theta).position;
        plate.world(&Vector3::new(at.x, at.y, plate.surface.height_m(at.norm())))
    }

    /// The foot of the line along which the tip approaches, and of the one along which it retreats, world frame \[m\].
    #[must_use]
    pub fn feet(&self, plate: &Plate) -> [Vector3<f64>; 2] {
        [0.0, self.curve.end()].map(|theta| self.contact(plate, theta))
    }
}

impl WashCurve {
    /// The last θ \[rad\].
    #[must_use]
    pub fn end(&self) -> f64 {
        self.spiral_end() + if self.closing_ring { TAU } else { 0.0 }
    }

    /// θ at which the spiral ends and the ring begins \[rad\].
    #[must_use]
    pub fn spiral_end(&self) -> f64 {
        TAU * self.turns
    }

    /// Distance between neighbouring windings \[m\].
    #[must_use]
    pub fn pitch_m(&self) -> f64 {
        TAU * self.rate()
    }

    /// The point at θ in [0, [`WashCurve::end`]] \[rad\].
    #[must_use]
    pub fn at(&self, theta: f64) -> CurvePoint {
        let [r, r1, r2] = self.radius(theta);
        let (s, c) = sin_cos(self.start_angle_rad + theta);
        let (along, across) = (Vector2::new(c, s), Vector2::new(-s, c));
        CurvePoint {
            position: along * r,
            first: along * r1 + across * r,
            second: along * (r2 - r) + across * (2.0 * r1),
        }
    }

    /// Values of θ from 0 to the end, so close that the chord between neighbours leaves the curve by at most
    /// `chord_error_m`; the spiral's end is one of them.
    #[must_use]
    pub fn parameters(&self, chord_error_m: f64) -> Vec<f64> {
        let mut all = vec![0.0];
        for (from, to) in [(0.0, self.spiral_end()), (self.spiral_end(), self.end())] {
            let mut steps = Vec::new();
            let mut theta = from;
            while theta < to {
                let step = self.step(theta, chord_error_m);
                steps.push(step);
                theta += step;
            }
            // Shrunk evenly so that the last one ends where it should.
            let shrink = (to - from) / (theta - from).max(f64::MIN_POSITIVE);
            let mut theta = from;
            for (k, step) in steps.iter().enumerate() {
                theta = if k + 1 == steps.len() {
                    to
                } else {
                    theta + step * shrink
                };
                all.push(theta);
            }
        }
        all
    }

    /// A step in θ over which the chord leaves the curve by `error`: |p″| Δθ² / 8, of the second derivative's part
    /// across the curve.
    fn step(&self, theta: f64, error: f64) -> f64 {
        let CurvePoint { first, second, .. } = self.at(theta);
        let across = (first.x * second.y - first.y * second.x).abs() / first.norm();
        (8.0 * error / across).sqrt().min(0.25)
    }

    fn rate(&self) -> f64 {
        self.radius_m / (self.spiral_end() - 0.5 * BLEND_RAD)
    }

    /// r, r′, r″ at θ.
    fn radius(&self, theta: f64) -> [f64; 3] {
        let (a, blend) = (self.rate(), self.spiral_end() - BLEND_RAD);
        if theta <= blend {
            return [a * theta, a, 0.0];
        }
        if theta >= self.spiral_end() {
            return [self.radius_m, 0.0, 0.0];
        }
        let x = (theta - blend) / BLEND_RAD;
        let (x2, x3) = (x * x, x * x * x);
        // ∫S = x⁴ (5/2 − 3 x + x²), S and S′.
        let area = x2 * x2 * (2.5 - 3.0 * x + x2);
        let rise = x3 * (10.0 - 15.0 * x + 6.0 * x2);
        let slope = 30.0 * x2 * (1.0 - x) * (1.0 - x);
        [
            a * (blend + BLEND_RAD * (x - area)),
            a * (1.0 - rise),
            -a * slope / BLEND_RAD,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn curves() -> impl Strategy<Value = WashCurve> {
        (0.02..0.3f64, 0.5..8.0f64, -4.0..4.0f64, prop::bool::ANY).prop_map(
            |(radius_m, turns, start_angle_rad, closing_ring)| WashCurve {
                radius_m,
                turns,
                start_angle_rad,
                closing_ring,
            },
        )
    }

    proptest! {
        #[test]
        fn derivatives_are_those_of_the_position(curve in curves(), share in 0.001..0.999f64) {
            let (theta, h) = (share * curve.end(), 1e-5);
            let [before, here, after] = [theta - h, theta, theta + h].map(|t| curve.at(t));
            prop_assert!(((after.position - before.position) / (2.0 * h) - here.first).norm() < 1e-8);
            prop_assert!(((after.first - before.first) / (2.0 * h) - here.second).norm() < 1e-7);
        }

        #[test]
        fn the_radius_grows_from_the_centre_to_the_ring(curve in curves()) {
            prop_assert_eq!(curve.at(0.0).position.norm(), 0.0);
            let mut last = 0.0;
            for k in 0..=2000 {
                let r = curve.at(curve.end() * f64::from(k) / 2000.0).position.norm();
                prop_assert!(r >= last - 1e-15 && r <= curve.radius_m * (1.0 + 1e-14));
                last = r;
            }
            prop_assert!((curve.at(curve.spiral_end()).position.norm() - curve.radius_m).abs() < 1e-15);
            prop_assert!(curve.at(curve.spiral_end()).first.normalize().dot(&curve.at(curve.spiral_end()).position) < 1e-15);
        }

        #[test]
        fn chords_keep_their_error(curve in curves(), error in 1e-6..1e-4f64) {
            let all = curve.parameters(error);
            prop_assert_eq!(all[0], 0.0);
            prop_assert_eq!(all[all.len() - 1], curve.end());
            prop_assert!(all.contains(&curve.spiral_end()));
            for ends in all.windows(2) {
                prop_assert!(ends[0] < ends[1]);
                let [a, b] = [ends[0], ends[1]].map(|t| curve.at(t).position);
                let along = (b - a).normalize();
                for k in 1..8 {
                    let off = curve.at(ends[0] + (ends[1] - ends[0]) * f64::from(k) / 8.0).position - a;
                    prop_assert!((off - along * along.dot(&off)).norm() <= 1.1 * error + 1e-12);
                }
            }
        }
    }

    /// By hand: without the blend, R = a Θ; with it a is larger by half a blend's share.
    #[test]
    fn the_pitch_of_the_kitchen() {
        let curve = WashCurve {
            radius_m: 0.124,
            turns: 3.5,
            start_angle_rad: 0.0,
            closing_ring: true,
        };
        let expected = TAU * 0.124 / (7.0 * std::f64::consts::PI - 0.5);
        assert!((curve.pitch_m() - expected).abs() < 1e-15);
        let outwards = curve.at(TAU).position.norm() - curve.at(0.0).position.norm();
        assert!((outwards - curve.pitch_m()).abs() < 1e-15);
    }
}
