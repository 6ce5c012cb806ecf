//! Upper bound on the number of plates in any arrangement.

use crate::layout::outline::{Point, clip};
use crate::layout::region::{Area, Region};
use platewash_kinematics::trig::sin_cos;

/// Number of sides of the polygon that replaces the outer circle of `rho_m`. It is drawn around the circle.
const CIRCLE_SIDES: usize = 64;

/// Upper bound on the number of points of a region that are pairwise at least `min_distance_m` apart, in any arrangement; `None` for a
/// distance of zero, which sets no bound.
///
/// Oler's inequality: in a compact convex set of area A and perimeter P, points that are pairwise at least d apart number
/// at most 2 A/(√3 d²) + P/(2 d) + 1. It is applied to a convex polygon around the region: the x/y box, cut by tangents of
/// the circle `rho_m[1]` and, if `azimuth_deg` spans at most half a turn, by its two rays. The free space around the base
/// is not taken out, so that the bound holds but may be generous.
///
/// Source: N. Oler, "An inequality in the geometry of numbers", Acta Mathematica 105 (1961) 19–48.
#[must_use]
pub fn packing_bound(region: &Region, min_distance_m: f64) -> Option<usize> {
    if min_distance_m.is_nan() || min_distance_m <= 0.0 {
        return None;
    }
    let hull = convex_cover(region);
    if hull.len() < 3 {
        return Some(0);
    }
    let (area, perimeter) = area_and_perimeter(&hull);
    let bound =
        2.0 / 3.0_f64.sqrt() * area / (min_distance_m * min_distance_m) + perimeter / (2.0 * min_distance_m) + 1.0;
    // Outward rounding: far above the rounding error of the sum, far below one plate.
    Some((bound * (1.0 + 1e-12) + 1e-9) as usize)
}

/// Returns a convex polygon, counter-clockwise, that contains the region; empty if the region is.
fn convex_cover(region: &Region) -> Vec<Point> {
    let ([x0, x1], [y0, y1]) = (region.x_m, region.y_m);
    let mut polygon = vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    let within = |polygon: &[Point], normal: Point, offset: f64| {
        clip(polygon, |p| -(normal[0] * p[0] + normal[1] * p[1] - offset))
    };
    for normal in Area::new(region).wedge().outward_normals() {
        polygon = within(&polygon, normal, 0.0);
    }
    if let Some([_, rho_max]) = region.rho_m {
        for side in 0..CIRCLE_SIDES {
            let (sin, cos) = sin_cos(std::f64::consts::TAU * side as f64 / CIRCLE_SIDES as f64);
            polygon = within(&polygon, [cos, sin], rho_max);
        }
    }
    polygon
}

fn area_and_perimeter(polygon: &[Point]) -> (f64, f64) {
    let (mut twice_area, mut perimeter) = (0.0, 0.0);
    for (i, b) in polygon.iter().enumerate() {
        let a = polygon[(i + polygon.len() - 1) % polygon.len()];
        twice_area += a[0] * b[1] - a[1] * b[0];
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        perimeter += (dx * dx + dy * dy).sqrt();
    }
    (0.5 * twice_area.abs(), perimeter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wedge_reduces_the_bounding_box() {
        // Left of the ray at 60° the box loses a triangle of base n/2: 3/4 of its area is left.
        let cut = |n: f64| Region {
            x_m: [0.0, n],
            y_m: [0.0, n * 0.75_f64.sqrt()],
            rho_m: None,
            azimuth_deg: Some([0.0, 60.0]),
        };
        let (area, perimeter) = area_and_perimeter(&convex_cover(&cut(4.0)));
        assert!((area - 0.75 * 16.0 * 0.75_f64.sqrt()).abs() < 1e-12);
        assert!((perimeter - (4.0 + 4.0 + 2.0 + 4.0 * 0.75_f64.sqrt())).abs() < 1e-12);
        // The triangle inside it holds a lattice of (n + 1)(n + 2)/2 points.
        for n in 1..20 {
            assert!(packing_bound(&cut(n as f64), 1.0).unwrap() >= (n + 1) * (n + 2) / 2);
        }
    }

    #[test]
    fn rings_and_wedges_tighten_the_bound() {
        let wide = Region {
            x_m: [-1.0, 1.0],
            y_m: [-1.0, 1.0],
            rho_m: None,
            azimuth_deg: None,
        };
        let disc = Region {
            rho_m: Some([0.0, 0.5]),
            ..wide
        };
        let quarter = Region {
            azimuth_deg: Some([10.0, 100.0]),
            ..disc
        };
        let bound = |region: &Region| packing_bound(region, 0.05).unwrap();
        assert!(bound(&quarter) < bound(&disc) && bound(&disc) < bound(&wide));
        let (area, perimeter) = area_and_perimeter(&convex_cover(&disc));
        let pi = std::f64::consts::PI;
        assert!(area > 0.25 * pi && area < 0.251 * pi && perimeter > pi && perimeter < 1.001 * pi);
        let nowhere = Region {
            x_m: [2.0, 3.0],
            ..disc
        };
        assert_eq!(packing_bound(&nowhere, 0.05), Some(0));
    }
}
