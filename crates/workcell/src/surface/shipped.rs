//! The profiles that come along.

use super::{Knot, Surface};

/// A profile by its name: knots as radius \[mm\] and slope \[°\].
struct Shipped {
    name: &'static str,
    knots: &'static [[f64; 2]],
}

/// `coupe275` is fitted to a scan of a real plate, within 0.54 mm; the shapes of the others are assumptions, with the diameters of dinner,
/// soup and dessert plates (EN 50242).
const SHIPPED: [Shipped; 4] = [
    Shipped {
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
    Shipped {
        name: "rim270",
        knots: &[[82.0, 0.0], [93.0, 38.0], [103.0, 11.0], [131.0, 11.0], [135.0, 0.0]],
    },
    Shipped {
        name: "deep230",
        knots: &[[42.0, 0.0], [84.0, 50.0], [95.0, 12.0], [112.0, 12.0], [115.0, 0.0]],
    },
    Shipped {
        name: "dessert190",
        knots: &[[58.0, 2.0], [70.0, 10.0], [84.0, 22.0], [92.0, 22.0], [95.0, 5.0]],
    },
];

/// Names of the profiles that come along, a flat disc apart.
pub const SHIPPED_PROFILES: [&str; 4] = ["coupe275", "rim270", "deep230", "dessert190"];

impl Surface {
    /// The profile of that name; `None` where none has it.
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

    /// The name of the profile that comes along with this very shape; `None` of any other.
    #[must_use]
    pub fn shipped_name(&self) -> Option<&'static str> {
        SHIPPED_PROFILES
            .into_iter()
            .find(|name| Self::shipped(name).is_some_and(|shipped| shipped == *self))
    }
}
