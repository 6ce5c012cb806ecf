//! The face of a plate as the bounds see it: round, flat and level.
//!
//! What holds for such faces alone is worked out here: whoever proves the washing of other faces starts in this file, with the
//! plate's normal at a point and the bounds of its curvature.

use nalgebra::{Vector2, Vector3};
use platewash_workcell::plate::Plate;
use platewash_workcell::surface::Surface;

/// Plates that overlap by less than this touch, and places that differ by less are one: the rounding of places \[m\].
pub(crate) const PLACE_M: f64 = 1e-9;

/// A flat and level face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Face {
    plate: Plate,
    /// World frame.
    normal: Vector3<f64>,
    /// Height of the face along the normal \[m\].
    level_m: f64,
}

/// Whether the face of a plate is one that the bounds hold for: a disc, that is round and flat, and level.
pub(crate) fn is_judged(plate: &Plate) -> bool {
    plate.is_level() && matches!(plate.surface, Surface::Disc { .. })
}

impl Face {
    /// That of a plate.
    pub fn of(plate: &Plate) -> Self {
        let normal = plate.axis();
        Self {
            plate: *plate,
            normal,
            level_m: plate.centre().dot(&normal),
        }
    }

    /// Height over the face \[m\].
    pub fn height_of(&self, point: &Vector3<f64>) -> f64 {
        self.plate.height_of(point)
    }

    /// Height over the face of the lowest point of a round rim about a point, across an axis \[m\].
    pub fn height_of_rim(&self, point: &Vector3<f64>, axis: &Vector3<f64>, radius_m: f64) -> f64 {
        point.dot(&self.normal) - radius_m * self.across(axis) - self.level_m
    }

    /// Where that lowest point is, from the point \[m\]; the point itself where all are equally low.
    pub fn lowest(&self, axis: &Vector3<f64>, radius_m: f64) -> Vector3<f64> {
        // −n less its part along the axis, written so that nothing cancels when the axis is nearly upright.
        let down = axis.cross(&axis.cross(&self.normal));
        down.try_normalize(0.0).map_or_else(Vector3::zeros, |d| d * radius_m)
    }

    /// Sine of the angle between an axis out of the tool and the way onto the face; 2 where it points away, beyond every limit.
    pub fn sine_of_tilt(&self, axis: &Vector3<f64>) -> f64 {
        if axis.dot(&self.normal) < 0.0 {
            self.across(axis)
        } else {
            2.0
        }
    }

    /// How long the part of an axis along the face is.
    fn across(&self, axis: &Vector3<f64>) -> f64 {
        (axis - self.normal * axis.dot(&self.normal)).norm()
    }

    /// A point of the world, seen along the axis of the plate, from the pole \[m\].
    pub fn seen(&self, point: &Vector3<f64>) -> Vector2<f64> {
        self.plate.local(point).xy()
    }

    /// The point of the face at a place seen so, world frame \[m\].
    pub fn point(&self, seen: &Vector2<f64>) -> Vector3<f64> {
        self.plate.world(&seen.push(0.0))
    }

    /// A direction along the face, world frame.
    pub fn direction(&self, seen: &Vector2<f64>) -> Vector3<f64> {
        self.plate.pose.rotation * seen.push(0.0)
    }
}

/// Height of the lowest point of a plate over the floor \[m\].
pub(crate) fn underside_m(plate: &Plate) -> f64 {
    plate.centre().z - plate.thickness_m
}

/// Distance between the rims of two plates, negative where they overlap \[m\].
pub(crate) fn gap(a: &Plate, b: &Plate) -> f64 {
    distance(a, b) - a.rim_m() - b.rim_m()
}

/// Distance between the poles of two plates, seen from above \[m\].
pub(crate) fn distance(a: &Plate, b: &Plate) -> f64 {
    let ([x, y], [u, v]) = (a.centre_xy(), b.centre_xy());
    norm(x - u, y - v)
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
            prop_assert!((face.sine_of_tilt(&axis) - lean.sin()).abs() < 1e-15);
            prop_assert_eq!(face.sine_of_tilt(&-axis), 2.0);
            prop_assert!((face.height_of_rim(&point, &axis, 0.025) - (z - 0.03 - 0.025 * lean.sin())).abs() < 1e-15);
            let low = face.lowest(&axis, 0.025);
            prop_assert!((low.norm() - 0.025).abs() < 1e-15 && low.dot(&axis).abs() < 1e-15);
            prop_assert!((low.z + 0.025 * lean.sin()).abs() < 1e-15);
            let back = face.point(&face.seen(&point));
            prop_assert!((back - Vector3::new(x, y, 0.03)).norm() < 1e-15);
        }
    }
}
