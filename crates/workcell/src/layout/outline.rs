//! The border of a region, for display.
//!
//! The area in which plates are drawn, for display.

use crate::layout::region::Region;
use platewash_kinematics::trig::sin_cos;
use serde::Serialize;
use ts_rs::TS;

/// Greatest angle between two points of an arc \[rad\].
const ARC_STEP_RAD: f64 = 0.05;

pub(crate) type Point = [f64; 2];

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
pub(crate) fn clip(polygon: &[Point], inside: impl Fn(&Point) -> f64) -> Vec<Point> {
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
#[derive(Debug, Clone, PartialEq, Default, Serialize, TS)]
pub struct TaskRegion {
    /// Radius about the base axis that the centres keep away from \[m\].
    pub base_circle_m: Option<f64>,
    /// Closed polygon, seen from above \[m\].
    pub polygon_m: Option<Vec<[f64; 2]>>,
}
