//! The border of a region, for display.
//!
//! The area in which plates are drawn, for display.

use crate::layout::region::Region;
use crate::trig::sin_cos;
use serde::Serialize;

/// Greatest angle between two points of an arc \[rad\].
const ARC_STEP_RAD: f64 = 0.05;

type Point = [f64; 2];

impl Region {
    /// The border as a closed polygon, base frame \[m\]; arcs are chords. A ring is one polygon that runs along its inner border, too, with
    /// a seam between both. Empty where no point satisfies every range.
    #[must_use]
    pub fn outline_m(&self) -> Vec<[f64; 2]> {
        let [x, y] = [self.x_m, self.y_m];
        let corners = vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
        if self.rho_m.is_none() && self.azimuth_deg.is_none() {
            return corners;
        }
        let farthest = corners.iter().map(|[x, y]| (x * x + y * y).sqrt()).fold(0.0, f64::max);
        // Chords of the outer arc must not cut off a corner of the rectangle.
        let beyond = 2.0 * farthest;
        let [least, most] = self.rho_m.unwrap_or([0.0, beyond]);
        let sector = sector([least, most.min(beyond)], self.azimuth_deg.unwrap_or([0.0, 360.0]));
        let sides = [(0, x[0], 1.0), (0, x[1], -1.0), (1, y[0], 1.0), (1, y[1], -1.0)];
        sides.into_iter().fold(sector, |polygon, (axis, at, sign)| {
            clip(&polygon, |p| sign * (p[axis] - at))
        })
    }
}

/// Returns the points between two distances from the origin and two azimuths: out along the outer arc, back along the inner one.
fn sector([least, most]: [f64; 2], azimuth_deg: [f64; 2]) -> Vec<Point> {
    let [from, to] = azimuth_deg.map(f64::to_radians);
    let steps = ((to - from) / ARC_STEP_RAD).ceil().max(1.0);
    let angles = (0..=steps as usize).map(|k| from + (to - from) * k as f64 / steps);
    let at = |rho: f64, angle: f64| {
        let (s, c) = sin_cos(angle);
        [rho * c, rho * s]
    };
    let inner = angles.clone().rev().map(|angle| at(least, angle));
    let back: Vec<_> = if least > 0.0 {
        inner.collect()
    } else if to - from < std::f64::consts::TAU {
        vec![[0.0; 2]]
    } else {
        Vec::new()
    };
    angles.map(|angle| at(most, angle)).chain(back).collect()
}

/// Returns the part of a polygon on one side of a line (Sutherland and Hodgman, Comm. ACM 17, 1974). `inside` is the signed distance from
/// the line, positive on that side.
fn clip(polygon: &[Point], inside: impl Fn(&Point) -> f64) -> Vec<Point> {
    let mut kept = Vec::new();
    for (k, here) in polygon.iter().enumerate() {
        let before = &polygon[(k + polygon.len() - 1) % polygon.len()];
        let [d0, d1] = [inside(before), inside(here)];
        if (d0 < 0.0) != (d1 < 0.0) {
            let share = d0 / (d0 - d1);
            kept.push([0, 1].map(|axis| before[axis] + share * (here[axis] - before[axis])));
        }
        if d1 >= 0.0 {
            kept.push(*here);
        }
    }
    kept
}

/// Area in which the centres of plates are drawn. It is not part of a plan, which has the plates themselves.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct TaskRegion {
    /// Radius about the base axis that the centres keep away from \[m\].
    pub base_circle_m: Option<f64>,
    /// Closed polygon, seen from above \[m\].
    pub polygon_m: Option<Vec<[f64; 2]>>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// True if a point is in a polygon: a ray from it crosses the border an odd number of times.
    fn contains(polygon: &[Point], [x, y]: Point) -> bool {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        let crossed =
            edges.filter(|([ax, ay], [bx, by])| (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax));
        crossed.count() % 2 == 1
    }

    fn area(polygon: &[Point]) -> f64 {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        0.5 * edges.map(|([ax, ay], [bx, by])| ax * by - bx * ay).sum::<f64>()
    }

    #[test]
    fn rectangles_and_sectors_agree_with_hand_calculation() {
        let appendix = Region::PAPER_APPENDIX.outline_m();
        assert_eq!(appendix, [[0.0, -0.38], [0.30, -0.38], [0.30, 0.38], [0.0, 0.38]]);
        let square = |rho_m, azimuth_deg| Region {
            x_m: [-1.0, 1.0],
            y_m: [-1.0, 1.0],
            rho_m,
            azimuth_deg,
        };
        let close = |region: Region, expected: f64| {
            let found = area(&region.outline_m());
            assert!((found - expected).abs() < 1e-3 * expected, "{found} {expected}");
        };
        let pi = std::f64::consts::PI;
        close(square(Some([0.0, 0.5]), None), 0.25 * pi);
        close(square(Some([0.3, 0.5]), None), 0.16 * pi);
        close(square(Some([0.0, 0.5]), Some([-90.0, 180.0])), 0.75 * 0.25 * pi);
        close(square(None, Some([0.0, 90.0])), 1.0);
        close(square(None, Some([-45.0, 45.0])), 1.0);
    }

    #[test]
    fn a_region_without_points_has_no_border() {
        let region = Region {
            rho_m: Some([0.1, 0.2]),
            x_m: [1.0, 2.0],
            ..Region::PAPER_TEXT
        };
        assert!(region.outline_m().is_empty());
    }

    proptest! {
        /// A point is in the polygon if it belongs to the region, except in a strip along arcs as narrow as a chord's height.
        #[test]
        fn the_border_is_that_of_the_region(
            x in [-0.6..0.0f64, 0.1..0.6f64], y in [-0.6..0.0f64, 0.1..0.6f64], rho in [0.0..0.3f64, 0.31..0.9f64],
            azimuth in (-300.0..300.0f64, 10.0..360.0f64), parts in 0..4u8, point in prop::array::uniform2(-0.7..0.7f64),
        ) {
            let region = Region {
                x_m: x,
                y_m: y,
                rho_m: (parts & 1 > 0).then_some(rho),
                azimuth_deg: (parts & 2 > 0).then_some([azimuth.0, azimuth.0 + azimuth.1]),
            };
            let off = 1e-3;
            let around = [[off, 0.0], [-off, 0.0], [0.0, off], [0.0, -off]].map(|[dx, dy]| [point[0] + dx, point[1] + dy]);
            let belongs = region.contains(point);
            prop_assume!(around.iter().all(|near| region.contains(*near) == belongs));
            prop_assert_eq!(contains(&region.outline_m(), point), belongs);
        }
    }
}
