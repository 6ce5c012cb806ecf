//! A range of azimuths about the base axis, as half planes.

use crate::trig::sin_cos;

type Point = [f64; 2];

/// The points whose azimuth lies in a closed range. No angle is computed per query: membership is the sign of cross
/// products with the two bounding rays.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wedge {
    /// Every azimuth.
    Full,
    /// At most half a turn, counter-clockwise from the ray `from` to the ray `to`: an intersection of half planes.
    Convex { from: Point, to: Point, middle: Point },
    /// More than half a turn: what is left outside the open convex wedge from the ray `to` on to the ray `from`.
    Reflex { from: Point, to: Point },
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The unit vector at an azimuth, exact at multiples of 90° (so that a plate on an axis belongs to `[-90, 90]`).
fn ray(azimuth_deg: f64) -> Point {
    let azimuth_deg = azimuth_deg.rem_euclid(360.0);
    let quarter = (azimuth_deg / 90.0).floor();
    let (sin, cos) = sin_cos((azimuth_deg - 90.0 * quarter).to_radians());
    match quarter as u8 % 4 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

impl Wedge {
    /// The wedge of azimuths from `low_deg` to `high_deg`, counter-clockwise from base x, 0 < `high_deg` − `low_deg` ≤ 360.
    pub(super) fn new([low_deg, high_deg]: [f64; 2]) -> Self {
        let (from, to) = (ray(low_deg), ray(high_deg));
        let width_deg = high_deg - low_deg;
        if width_deg >= 360.0 {
            Self::Full
        } else if width_deg > 180.0 {
            Self::Reflex { from, to }
        } else {
            Self::Convex {
                from,
                to,
                middle: ray(low_deg + 0.5 * width_deg),
            }
        }
    }

    pub(super) fn contains(&self, p: Point) -> bool {
        match *self {
            Self::Full => true,
            Self::Convex { from, to, .. } => cross(from, p) >= 0.0 && cross(p, to) >= 0.0,
            Self::Reflex { from, to } => cross(to, p) <= 0.0 || cross(p, from) <= 0.0,
        }
    }

    /// Whether the convex hull of `corners` is surely outside. May miss a polygon that is outside, never the reverse.
    pub(super) fn excludes(&self, corners: &[Point; 4]) -> bool {
        let all = |outside: &dyn Fn(Point) -> bool| corners.iter().all(|&p| outside(p));
        match *self {
            Self::Full => false,
            Self::Convex { from, to, middle } => {
                all(&|p| cross(from, p) < 0.0) || all(&|p| cross(p, to) < 0.0) || all(&|p| dot(middle, p) < 0.0)
            }
            Self::Reflex { .. } => all(&|p| !self.contains(p)),
        }
    }

    /// Outward normals of the half planes through the origin that contain the wedge; none when it is not convex.
    pub(super) fn outward_normals(&self) -> Vec<Point> {
        match *self {
            Self::Convex { from, to, .. } => vec![[from[1], -from[0]], [-to[1], to[0]]],
            Self::Full | Self::Reflex { .. } => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn axes_belong_to_the_wedges_they_bound() {
        for (range, p) in [
            ([-90.0, 90.0], [0.0, 0.3]),
            ([-90.0, 90.0], [0.0, -0.3]),
            ([0.0, 180.0], [-0.3, 0.0]),
        ] {
            assert!(Wedge::new(range).contains(p), "{range:?} {p:?}");
        }
        assert!(Wedge::new([-180.0, 180.0]).contains([-0.3, 0.0]));
        assert!(Wedge::new([90.0, 360.0]).contains([0.0, 0.3]) && Wedge::new([90.0, 360.0]).contains([0.3, 0.0]));
        assert!(!Wedge::new([90.0, 360.0]).contains([0.3, 0.1]));
        assert!(Wedge::new([250.0, 470.0]).contains([1.0, 0.0]) && !Wedge::new([250.0, 470.0]).contains([-1.0, 0.0]));
    }

    proptest! {
        #[test]
        fn membership_agrees_with_the_angle(low in -360.0..360.0_f64, width in 0.01..360.0_f64, azimuth in -180.0..180.0_f64, rho in 1e-3..2.0_f64) {
            let offset = (azimuth - low).rem_euclid(360.0);
            prop_assume!(offset > 1e-9 && (offset - width).abs() > 1e-9 && offset < 360.0 - 1e-9);
            let (sin, cos) = sin_cos(azimuth.to_radians());
            prop_assert_eq!(Wedge::new([low, low + width]).contains([rho * cos, rho * sin]), offset < width);
        }

        #[test]
        fn no_point_of_an_excluded_square_is_inside(low in -360.0..360.0_f64, width in 0.01..360.0_f64, x in -1.0..1.0_f64, y in -1.0..1.0_f64, h in 0.0..0.5_f64, u in -1.0..1.0_f64, v in -1.0..1.0_f64) {
            let wedge = Wedge::new([low, low + width]);
            let corners = [[x - h, y - h], [x + h, y - h], [x + h, y + h], [x - h, y + h]];
            prop_assert!(!(wedge.excludes(&corners) && wedge.contains([x + u * h, y + v * h])));
        }
    }
}
