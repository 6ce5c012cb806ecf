//! The face of a plate, as the bounds see it: heights over it, and its normal.
//!
//! Heights are along the plate's axis. The normal of a face that is no disc is the one under a place, seen along that axis; `pass.rs` has
//! how fast it turns.

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
    /// That of a plate.
    pub fn of(plate: &'a Plate) -> Self {
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
    pub fn upright(&self) -> &Vector3<f64> {
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
        let seen = self.seen(point);
        let rho_m = norm(seen.x, seen.y);
        let at = self.surface().at_radius(rho_m);
        let out = if rho_m > 0.0 { seen / rho_m } else { Vector2::x() };
        self.plate.pose.rotation * Vector3::new(-at.sine * out.x, -at.sine * out.y, at.cosine)
    }

    /// Height over a flat face of the lowest point of a round rim about a point, across an axis \[m\].
    pub fn height_of_rim(&self, point: &Vector3<f64>, axis: &Vector3<f64>, radius_m: f64) -> f64 {
        point.dot(&self.upright) - radius_m * across(axis, &self.upright) - self.level_m
    }

    /// Where that lowest point is, from the point \[m\]; the point itself where all are equally low.
    pub fn lowest(&self, axis: &Vector3<f64>, radius_m: f64) -> Vector3<f64> {
        // −n less its part along the axis, written so that nothing cancels when the axis is nearly upright.
        let down = axis.cross(&axis.cross(&self.upright));
        down.try_normalize(0.0).map_or_else(Vector3::zeros, |d| d * radius_m)
    }

    /// A point of the world, seen along the axis of the plate, from the pole \[m\].
    pub fn seen(&self, point: &Vector3<f64>) -> Vector2<f64> {
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

/// Sine of the angle between an axis out of the tool and the way against a normal; 2 where it points away, beyond every limit.
pub(crate) fn sine_of_tilt(axis: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    if axis.dot(normal) < 0.0 {
        across(axis, normal)
    } else {
        2.0
    }
}

/// How long the part of an axis across a normal is.
fn across(axis: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    (axis - normal * axis.dot(normal)).norm()
}

/// √(x² + y²), the same bits on every machine.
pub(crate) fn norm(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

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
            let mut plate = platewash_workcell::fixtures::kitchen_plate([0.2, -0.1]);
            plate.pose.rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
            let (face, point) = (Face::of(&plate), Vector3::new(x, y, z));
            let axis = Vector3::new(lean.sin() * way.cos(), lean.sin() * way.sin(), -lean.cos());
            prop_assert!((face.height_of(&point) - (z - 0.03)).abs() < 1e-15);
            prop_assert!((sine_of_tilt(&axis, face.upright()) - lean.sin()).abs() < 1e-15);
            prop_assert_eq!(sine_of_tilt(&-axis, face.upright()), 2.0);
            prop_assert_eq!(face.normal_under(&point), Vector3::z());
            prop_assert!((face.height_of_rim(&point, &axis, 0.025) - (z - 0.03 - 0.025 * lean.sin())).abs() < 1e-15);
            let low = face.lowest(&axis, 0.025);
            prop_assert!((low.norm() - 0.025).abs() < 1e-15 && low.dot(&axis).abs() < 1e-15);
            prop_assert!((low.z + 0.025 * lean.sin()).abs() < 1e-15);
            let back = plate.world(&face.seen(&point).push(0.0));
            prop_assert!((back - Vector3::new(x, y, 0.03)).norm() < 1e-15);
        }
    }
}
