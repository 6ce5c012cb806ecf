//! The path of the sponge on a plate: a curve on its face, and how the tool stands on it.
//!
//! In its plate's frame the curve is stated by the length ℓ along the meridian from the pole as a function of the angle θ about the axis
//! ([`WashCurve`]): a spiral that runs into a closing ring, or rings joined by blends. On a flat disc ℓ is the distance from the centre.

mod curve;
mod rings;
pub use curve::{BLEND_RAD, CurvePoint, LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_TURNS, SurfacePoint, WashCurve};
pub use rings::{MOST_RINGS, Rings};

use crate::plate::Plate;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

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
        plate.world(&self.curve.on(&plate.surface, theta).position)
    }

    /// The foot of the line along which the tip approaches, and of the one along which it retreats, world frame \[m\].
    #[must_use]
    pub fn feet(&self, plate: &Plate) -> [Vector3<f64>; 2] {
        [0.0, self.curve.end()].map(|theta| self.contact(plate, theta))
    }
}
