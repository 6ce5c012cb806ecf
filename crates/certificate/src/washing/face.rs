//! The face of a plate as the bounds need it: heights over it, and its normal.
//!
//! Formulas (19.1) and (20.1) on a profile, in `docs/certificate.md`.
//!
//! Heights are along the plate's axis. The normal of a face that is no disc is taken under a place, seen along that axis; `Pass` bounds its
//! rate of turning.
//!
//! The change under the tip on a curved face over a stretch: second derivative of the height over the face, and turning of the normal.
//!
//! With ρ the place's distance from the plate's axis, v and a bounds of the tip's speed and acceleration, β the slope, K the greatest
//! curvature within the places passed, a length of the meridian κ and across it sin β / ρ:
//!
//! - ρ̈ ≤ a + v²/ρ, so that ρ leaves the values at its ends by at most h²/8 of that;
//! - the height z − f(ρ) has a second derivative of at most a / cos β + K v² / cos³ β, as the Hessian of f is no greater than K / cos³ β;
//! - on a piece of the meridian sin β = A + κ ρ, so that the normal n = (−A ρ̂ − κ (x, y), cos β) has, with |ρ̂˙| ≤ v/ρ and
//!   |ρ̂¨| ≤ a/ρ + 2 v²/ρ², |ṅ_xy| ≤ |A| v/ρ + |κ| v and |n̈_xy| ≤ |A| (a/ρ + 2 v²/ρ²) + |κ| a; with S = sin β, |Ṡ| ≤ |κ| v and
//!   |S S̈| ≤ |S κ| a + |S/ρ| |κ| v², |ṅ_z| ≤ |S Ṡ|/cos β and |n̈_z| ≤ (Ṡ² + |S S̈|)/cos β + S² Ṡ²/cos³ β;
//! - where pieces of the meridian meet within the places passed, sin β leaves the line through its values at both ends by no more than
//!   the difference of the greatest and the least κ times the width of the places, and the normal by that over cos β.
//!
//! For a sum n × a of normal and axis, the second derivative is then at most ‖n̈‖ + 2 ‖ṅ‖ ‖ȧ‖ + ‖ä‖.

use crate::motion::tip::{Derivatives, Stretch};
use nalgebra::{Vector2, Vector3};
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::WashCurve;

/// Plates that overlap by less than this touch, and places that differ by less are one: the rounding of places \[m\].
pub(crate) const PLACE_M: f64 = 1e-9;

/// The face of a plate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Face<'a> {
    plate: &'a Plate,
    /// The plate's axis, world frame.
    upright: Vector3<f64>,
    /// Height of the pole along the axis \[m\].
    level_m: f64,
}

impl<'a> Face<'a> {
    /// Returns the face of a plate.
    pub fn new(plate: &'a Plate) -> Self {
        let upright = plate.axis();
        Self {
            plate,
            upright,
            level_m: plate.centre().dot(&upright),
        }
    }

    /// The surface, in the plate's frame.
    pub fn surface(&self) -> &'a Surface {
        &self.plate.surface
    }

    /// The plate's axis, world frame.
    pub fn plate_axis(&self) -> &Vector3<f64> {
        &self.upright
    }

    /// Height over the face \[m\].
    pub fn height_of(&self, point: &Vector3<f64>) -> f64 {
        self.plate.height_of(point)
    }

    /// The normal of the face under a place, world frame.
    pub fn normal_under(&self, point: &Vector3<f64>) -> Vector3<f64> {
        if self.surface().is_flat() {
            return self.upright;
        }
        let seen = self.project(point);
        let rho_m = norm(seen.x, seen.y);
        let at = self.surface().at_radius(rho_m);
        let out = if rho_m > 0.0 { seen / rho_m } else { Vector2::x() };
        self.plate.pose.rotation * Vector3::new(-at.sine * out.x, -at.sine * out.y, at.cosine)
    }

    /// Height over a flat face of the lowest point of a round rim \[m\], H + δ of formula (21.1). `point` is p + b a, the middle of the
    /// rim; `axis` is a, `radius_m` is s.
    pub fn height_of_rim(&self, point: &Vector3<f64>, axis: &Vector3<f64>, radius_m: f64) -> f64 {
        point.dot(&self.upright) - radius_m * across(axis, &self.upright) - self.level_m
    }

    /// Returns the position of that lowest point relative to `point` \[m\]; zero where all points are equally low.
    pub fn lowest(&self, axis: &Vector3<f64>, radius_m: f64) -> Vector3<f64> {
        // −n less its part along the axis, written so that nothing cancels when the axis is nearly upright.
        let down = axis.cross(&axis.cross(&self.upright));
        down.try_normalize(0.0).map_or_else(Vector3::zeros, |d| d * radius_m)
    }

    /// Returns a point of the world seen along the axis of the plate, relative to the pole \[m\].
    pub fn project(&self, point: &Vector3<f64>) -> Vector2<f64> {
        self.plate.local(point).xy()
    }

    /// A point of a wash curve and its derivative by θ, world frame \[m, m/rad\].
    pub fn on(&self, curve: &WashCurve, theta: f64) -> [Vector3<f64>; 2] {
        let there = curve.on(self.surface(), theta);
        [
            self.plate.world(&there.position),
            self.plate.pose.rotation * there.first,
        ]
    }
}

/// Sine of the tilt τ, formula (19.1): ‖a − (a·n) n‖; 2 where the axis points away, beyond every limit. `axis` is a, `normal` is n.
pub(crate) fn sine_of_tilt(axis: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    if axis.dot(normal) < 0.0 {
        across(axis, normal)
    } else {
        2.0
    }
}

/// Returns the length of the part of an axis across a normal.
fn across(axis: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    (axis - normal * axis.dot(normal)).norm()
}

/// √(x² + y²), the same bits on every machine.
pub(crate) fn norm(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Bounds for the place under the tip on a curved face over a stretch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pass {
    /// Least and greatest distance from the plate's axis \[m\].
    rho_m: [f64; 2],
    /// Bound v on the tip's speed \[m/s\].
    speed: f64,
    /// Bound a on the tip's acceleration \[m/s²\].
    acceleration: f64,
    /// Greatest |sin β|, and below the least cos β.
    sine: f64,
    cosine: f64,
    /// Greatest curvature K \[1/m\].
    greatest: f64,
    /// Least and greatest curvature κ of the meridian \[1/m\].
    kappa: [f64; 2],
    /// Greatest |A|.
    intercept: f64,
}

impl Pass {
    /// Bounds the pass of a stretch over a face, as the head of this file derives. `bounds` has sup ‖p̈‖ and sup ‖p⃛‖, formula (0.3).
    pub fn new(face: &Face<'_>, stretch: &Stretch<'_>, bounds: &Derivatives) -> Self {
        let surface = face.surface();
        let acceleration = bounds.second();
        let ends = stretch.ends;
        let [from, to] = ends.map(|m| m.speed.norm());
        let speed = from.max(to) + stretch.sag(bounds.third()).min(0.5 * stretch.length_s() * acceleration);
        let rho = ends.map(|m| {
            let seen = face.project(&m.position);
            norm(seen.x, seen.y)
        });
        let (near, far) = (rho[0].min(rho[1]), rho[0].max(rho[1]));
        let way_m = 0.5 * stretch.length_s() * speed;
        let least = near - way_m;
        let bulge_m = if least > 0.0 {
            way_m.min(stretch.sag(acceleration + speed * speed / least))
        } else {
            way_m
        };
        let rho_m = [(near - bulge_m).max(0.0), far + bulge_m];
        let (kappa, begins_flat) = curvatures(surface, rho_m);
        let patch = surface.patch(rho_m);
        let bent = (kappa[1] - kappa[0]) * (rho_m[1] - rho_m[0]);
        let sine = (patch.sine[0].abs().max(patch.sine[1].abs()) + bent).min(1.0);
        let steepest = kappa[0].abs().max(kappa[1].abs());
        let at = surface.at_radius(rho_m[0]);
        let intercept = match kappa[1] - kappa[0] {
            _ if begins_flat => 0.0,
            0.0 => (at.sine - at.curvature * rho_m[0]).abs(),
            _ => sine + steepest * rho_m[1],
        };
        Self {
            rho_m,
            speed,
            acceleration,
            sine,
            cosine: (1.0 - sine * sine).max(0.0).sqrt(),
            greatest: patch.greatest_curvature(),
            kappa,
            intercept,
        }
    }

    /// Returns an upper bound on the second derivative of the height over the face, z − f \[m/s²\]: a / cos β + K v² / cos³ β, formula (20.1).
    pub fn bend_of_height(&self) -> f64 {
        let (c, v) = (self.cosine, self.speed);
        self.acceleration / c + self.greatest / (c * c * c) * v * v
    }

    /// Returns an upper bound on the rise of sin τ above its values at the ends of a stretch, formula (19.1), with what the jumps of curvature
    /// between arcs add. `first` and `second` are sup ‖ȧ‖ \[1/s\] and sup ‖ä‖ \[1/s²\].
    pub fn sag_of_sine(&self, stretch: &Stretch<'_>, [first, second]: [f64; 2]) -> f64 {
        let [turn, bend] = self.of_normal();
        let kinks = (self.kappa[1] - self.kappa[0]) * (self.rho_m[1] - self.rho_m[0]) / self.cosine;
        stretch.sag(bend + 2.0 * turn * first + second) + kinks
    }

    /// Returns upper bounds on ‖ṅ‖ \[1/s\] and ‖n̈‖ \[1/s²\] of formula (19.1), within one piece of the meridian.
    fn of_normal(&self) -> [f64; 2] {
        let Self {
            speed: v,
            acceleration: a,
            sine: s,
            cosine: c,
            ..
        } = *self;
        let k = self.kappa[0].abs().max(self.kappa[1].abs());
        // Without an intercept the pole is no place of its own.
        let [first, second] = match self.intercept {
            0.0 => [0.0; 2],
            intercept => {
                let rho = self.rho_m[0];
                [intercept * v / rho, intercept * (a / rho + 2.0 * v * v / (rho * rho))]
            }
        };
        // |S/ρ| ≤ |A|/ρ + |κ|.
        let over_rho = match self.intercept {
            0.0 => k,
            intercept => intercept / self.rho_m[0] + k,
        };
        let slide = k * v;
        let bend_of_z = (slide * slide + s * k * a + over_rho * k * v * v) / c + s * s * slide * slide / (c * c * c);
        [first + k * v + s * slide / c, second + k * a + bend_of_z]
    }
}

/// Returns the least and greatest curvature along the meridian between two ρ \[1/m\], and true if all of it belongs to the piece next to
/// the pole.
fn curvatures(surface: &Surface, [least, most]: [f64; 2]) -> ([f64; 2], bool) {
    let Surface::Profile(meridian) = surface else {
        return ([0.0; 2], true);
    };
    let first = surface.at_radius(least).curvature;
    let mut bounds = [first; 2];
    for knot in meridian.knots() {
        if knot.radius_m > least && knot.radius_m <= most {
            let next = surface.at_radius(knot.radius_m).curvature;
            bounds = [bounds[0].min(next), bounds[1].max(next)];
        }
    }
    let ends_m = meridian.knots().first().map_or(0.0, |knot| knot.radius_m);
    (bounds, most < ends_m)
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    proptest! {
        /// On a plate of the kitchen, turned about its axis: the closed forms of a level face.
        #[test]
        fn heights_and_tilts_are_those_of_a_level_face(
            x in -0.5..0.5f64, y in -0.5..0.5f64, z in -0.1..0.3f64, lean in 0.01..1.4f64, way in -3.0..3.0f64, yaw in -3.0..3.0f64,
        ) {
            let mut plate = platewash_fixtures::kitchen_plate([0.2, -0.1]);
            plate.pose.rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
            let (face, point) = (Face::new(&plate), Vector3::new(x, y, z));
            let axis = Vector3::new(lean.sin() * way.cos(), lean.sin() * way.sin(), -lean.cos());
            prop_assert!((face.height_of(&point) - (z - 0.03)).abs() < 1e-15);
            prop_assert!((sine_of_tilt(&axis, face.plate_axis()) - lean.sin()).abs() < 1e-15);
            prop_assert_eq!(sine_of_tilt(&-axis, face.plate_axis()), 2.0);
            prop_assert_eq!(face.normal_under(&point), Vector3::z());
            prop_assert!((face.height_of_rim(&point, &axis, 0.025) - (z - 0.03 - 0.025 * lean.sin())).abs() < 1e-15);
            let low = face.lowest(&axis, 0.025);
            prop_assert!((low.norm() - 0.025).abs() < 1e-15 && low.dot(&axis).abs() < 1e-15);
            prop_assert!((low.z + 0.025 * lean.sin()).abs() < 1e-15);
            let back = plate.world(&face.project(&point).push(0.0));
            prop_assert!((back - Vector3::new(x, y, 0.03)).norm() < 1e-15);
        }
    }
}
