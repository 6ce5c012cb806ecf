//! Face of a plate to be washed: a surface of revolution, given by its meridian.
//!
//! In its plate's frame the axis is z and the pole, where the axis meets the face, is the origin. A point is stated by its
//! distance ρ from the axis \[m\] and its azimuth φ from x \[rad\], or by its length ℓ along the meridian from the pole \[m\] and φ.
//!
//! Some profiles are built in.
//!
//! Profiles can be described in words.

mod meridian;

pub use crate::surface::meridian::{
    Knot, MOST_KNOTS, Meridian, MeridianError, MeridianPoint, Patch, SHARPEST_M, STEEPEST_RAD, share_of_slope,
};

use nalgebra::{Point3, Unit, Vector3};
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::words::rounded;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use ts_rs::TS;

/// Surface of revolution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "meridian", rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "copied seldom, and never in a loop")]
pub enum Surface {
    /// Flat disc.
    Disc {
        /// Radius of the rim \[m\].
        radius_m: f64,
    },
    /// Arcs and lines by their knots; never a flat one, which is a disc (see [`Surface::profile`]).
    Profile(Meridian),
}

impl Surface {
    /// Builds the surface of a profile from its knots, without the pole. It is a disc if all of it is level.
    ///
    /// # Errors
    /// As [`Meridian::new`].
    pub fn profile(knots: &[Knot]) -> Result<Self, MeridianError> {
        let meridian = Meridian::new(knots)?;
        Ok(if meridian.is_flat() {
            Self::Disc {
                radius_m: meridian.rim_m(),
            }
        } else {
            Self::Profile(meridian)
        })
    }

    /// True if the face is flat.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        matches!(self, Self::Disc { .. })
    }

    /// Radius of the rim, the greatest ρ \[m\].
    #[must_use]
    pub fn rim_m(&self) -> f64 {
        match self {
            Self::Disc { radius_m } => *radius_m,
            Self::Profile(meridian) => meridian.rim_m(),
        }
    }

    /// Length of the meridian from the pole to the rim \[m\].
    #[must_use]
    pub fn arc_m(&self) -> f64 {
        match self {
            Self::Disc { radius_m } => *radius_m,
            Self::Profile(meridian) => meridian.arc_m(),
        }
    }

    /// Returns the point of the meridian at ρ \[m\]. Beyond the rim it continues straight.
    #[must_use]
    #[inline]
    pub fn at_radius(&self, rho_m: f64) -> MeridianPoint {
        match self {
            Self::Disc { .. } => level(rho_m),
            Self::Profile(meridian) => meridian.at_radius(rho_m),
        }
    }

    /// Returns the point of the meridian at ℓ \[m\]. Beyond the rim it continues straight.
    #[must_use]
    #[inline]
    pub fn at_arc(&self, arc_m: f64) -> MeridianPoint {
        match self {
            Self::Disc { .. } => level(arc_m),
            Self::Profile(meridian) => meridian.at_arc(arc_m),
        }
    }

    /// Length ℓ along the meridian at ρ \[m\].
    #[must_use]
    pub fn arc_at(&self, rho_m: f64) -> f64 {
        match self {
            Self::Disc { .. } => rho_m,
            Self::Profile(meridian) => meridian.arc_at(rho_m),
        }
    }

    /// Height of the face over its pole at ρ \[m\].
    #[must_use]
    #[inline]
    pub fn height_m(&self, rho_m: f64) -> f64 {
        self.at_radius(rho_m).height_m
    }

    /// Returns points of the meridian from the pole to the rim, ρ and height \[m\], for display. Every knot is included, and between two of
    /// them the face turns by at most `turn_rad` \[rad\], which must be above 0.
    #[must_use]
    pub fn outline_m(&self, turn_rad: f64) -> Vec<[f64; 2]> {
        let mut points = vec![[0.0, 0.0]];
        let Self::Profile(meridian) = self else {
            points.push([self.rim_m(), 0.0]);
            return points;
        };
        let mut from_m = 0.0;
        for knot in meridian.knots() {
            let to_m = self.arc_at(knot.radius_m);
            let turn = self.at_arc(from_m).curvature.abs() * (to_m - from_m);
            let parts = (turn / turn_rad).ceil().clamp(1.0, 256.0);
            let between = (1..parts as usize).map(|k| self.at_arc(from_m + (to_m - from_m) * k as f64 / parts));
            points.extend(between.map(|at| [at.radius_m, at.height_m]));
            points.push([knot.radius_m, self.height_m(knot.radius_m)]);
            from_m = to_m;
        }
        points
    }

    /// Least and greatest height of the face over its pole \[m\].
    #[must_use]
    pub fn height_bounds_m(&self) -> [f64; 2] {
        match self {
            Self::Disc { .. } => [0.0; 2],
            Self::Profile(meridian) => meridian.height_bounds_m(),
        }
    }

    /// The point at ρ \[m\] and φ \[rad\], plate frame.
    #[must_use]
    pub fn point(&self, rho_m: f64, phi_rad: f64) -> Point3<f64> {
        let (s, c) = sin_cos(phi_rad);
        Point3::new(rho_m * c, rho_m * s, self.height_m(rho_m))
    }

    /// The normal at ρ \[m\] and φ \[rad\], away from the plate's body, plate frame.
    #[must_use]
    pub fn normal(&self, rho_m: f64, phi_rad: f64) -> Unit<Vector3<f64>> {
        match self {
            Self::Disc { .. } => Vector3::z_axis(),
            Self::Profile(meridian) => {
                let at = meridian.at_radius(rho_m);
                let (s, c) = sin_cos(phi_rad);
                Unit::new_normalize(Vector3::new(-at.sine * c, -at.sine * s, at.cosine))
            }
        }
    }

    /// Least and greatest principal curvature \[1/m\], above 0 if the face is hollow.
    #[must_use]
    pub fn curvature_bounds(&self) -> [f64; 2] {
        self.patch([0.0, self.rim_m()]).curvature
    }

    /// Returns the ranges of slope and curvature between two ρ \[m\].
    #[must_use]
    pub fn patch(&self, between_m: [f64; 2]) -> Patch {
        match self {
            Self::Disc { .. } => Patch::FLAT,
            Self::Profile(meridian) => meridian.patch(between_m),
        }
    }

    /// Area of the face \[m²\].
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        self.area_within_m2(self.rim_m())
    }

    /// Area of the face from the pole to ρ \[m²\].
    #[must_use]
    pub fn area_within_m2(&self, rho_m: f64) -> f64 {
        match self {
            Self::Disc { .. } => PI * rho_m * rho_m,
            Self::Profile(meridian) => meridian.area_within_m2(rho_m),
        }
    }
}

impl Surface {
    /// Returns points spread evenly over the face, about `apart_m` \[m\] from each other: each in the plate frame \[m\], with the area that
    /// it represents \[m²\]. The areas add up to that of the face.
    pub fn points(&self, apart_m: f64) -> impl Iterator<Item = (Vector3<f64>, f64)> + '_ {
        let rings = (self.arc_m() / apart_m).ceil().max(1.0) as usize;
        let radius_m = move |half_ring: usize| {
            self.at_arc(self.arc_m() * half_ring as f64 / (2 * rings) as f64)
                .radius_m
        };
        (0..rings).flat_map(move |ring| {
            let [inner_m, rho_m, outer_m] = [2 * ring, 2 * ring + 1, 2 * ring + 2].map(radius_m);
            let count = (TAU * rho_m / apart_m).ceil().max(1.0) as usize;
            let area_m2 = (self.area_within_m2(outer_m) - self.area_within_m2(inner_m)) / count as f64;
            // Every other ring starts half a step further on.
            let first = 0.5 * (ring % 2) as f64;
            (0..count).map(move |k| {
                let phi_rad = TAU * (k as f64 + first) / count as f64;
                (self.point(rho_m, phi_rad).coords, area_m2)
            })
        })
    }
}

/// Returns a point of a flat face.
#[inline]
fn level(radius_m: f64) -> MeridianPoint {
    MeridianPoint {
        radius_m,
        height_m: 0.0,
        sine: 0.0,
        cosine: 1.0,
        curvature: 0.0,
    }
}

/// Named profile: knots as radius \[mm\] and slope \[°\].
struct ShippedProfile {
    name: &'static str,
    knots: &'static [[f64; 2]],
}

/// Built-in profiles. `coupe275` is fitted to a scan of a real plate, within 0.54 mm; the shapes of the others are assumptions, with the
/// diameters of dinner, soup and dessert plates (EN 50242).
const SHIPPED: [ShippedProfile; 4] = [
    ShippedProfile {
        name: "coupe275",
        knots: &[
            [24.0, 1.1],
            [74.0, 1.9],
            [92.0, 10.0],
            [106.0, 17.5],
            [119.0, 28.5],
            [129.0, 30.0],
            [137.0, 5.0],
        ],
    },
    ShippedProfile {
        name: "rim270",
        knots: &[[82.0, 0.0], [93.0, 38.0], [103.0, 11.0], [131.0, 11.0], [135.0, 0.0]],
    },
    ShippedProfile {
        name: "deep230",
        knots: &[[42.0, 0.0], [84.0, 50.0], [95.0, 12.0], [112.0, 12.0], [115.0, 0.0]],
    },
    ShippedProfile {
        name: "dessert190",
        knots: &[[58.0, 2.0], [70.0, 10.0], [84.0, 22.0], [92.0, 22.0], [95.0, 5.0]],
    },
];

/// Names of the built-in profiles, without the flat disc.
pub const SHIPPED_PROFILES: [&str; 4] = ["coupe275", "rim270", "deep230", "dessert190"];

impl Surface {
    /// Returns the built-in profile of a name; `None` for an unknown name.
    #[must_use]
    pub fn shipped(name: &str) -> Option<Self> {
        let found = SHIPPED.iter().find(|profile| profile.name == name)?;
        let knot = |[radius, slope]: &[f64; 2]| Knot {
            radius_m: 1e-3 * radius,
            slope_rad: slope.to_radians(),
        };
        let knots: Vec<_> = found.knots.iter().map(knot).collect();
        Self::profile(&knots).ok()
    }

    /// Returns the name of the built-in profile with exactly this shape; `None` for any other.
    #[must_use]
    pub fn shipped_name(&self) -> Option<&'static str> {
        SHIPPED_PROFILES
            .into_iter()
            .find(|name| Self::shipped(name).is_some_and(|shipped| shipped == *self))
    }
}

/// Significant digits of a knot, which is stated, and of a height, which is computed.
const DIGITS: [usize; 2] = [9, 5];

impl Surface {
    /// Describes the profile by its name or its knots, and the height of its rim over its pole; `None` for a disc.
    #[must_use]
    pub fn profile_words(&self) -> Option<String> {
        let Self::Profile(meridian) = self else { return None };
        let [stated, derived] = DIGITS;
        let knot = |knot: &Knot| {
            let (radius_mm, slope_deg) = (1e3 * knot.radius_m, knot.slope_rad.to_degrees());
            format!(
                "{} mm {}°",
                rounded(radius_mm, stated),
                rounded(slope_deg, stated) + 0.0
            )
        };
        let by_knots = || {
            let knots: Vec<_> = meridian.knots().iter().map(knot).collect();
            format!("of a profile by knots ({})", knots.join(", "))
        };
        let profile = self
            .shipped_name()
            .map_or_else(by_knots, |name| format!("of profile {name}"));
        let rim_mm = rounded(1e3 * self.height_m(self.rim_m()), derived);
        let side = if rim_mm < 0.0 { "below" } else { "over" };
        Some(format!("{profile}, rim {} mm {side} the pole", rim_mm.abs()))
    }
}
