//! Heights of a face on a polar grid: its holes, and its picture.

pub use platewash_workcell::job::Relief;

use crate::measured::axis::Frame;
use crate::measured::error::{MeasuredError, Place};
use crate::measured::knots::Ring;
use nalgebra::{Vector2, Vector3};
use platewash_kinematics::trig::{atan2, sin_cos};
use platewash_workcell::surface::{STEEPEST_RAD, Surface};
use std::f64::consts::{PI, TAU};

/// Numbers of rings and of azimuths of the grid; a relief has every third.
const GRID: [usize; 2] = [72, 144];
const EVERY: usize = 3;

/// Distance from the rim within which the face may be missing \[m\]: rims of coarse meshes are polygons.
const EDGE_M: f64 = 2e-3;

/// Length along the radius over which a slope is averaged, as a share of the rim's radius, and tolerance of its tangent.
const SLOPE_SPAN: f64 = 0.03;
const SLOPE_SLACK: f64 = 1.15;

/// Share of a triangle by which a place may be beyond its edge, and part of a cell by which it is looked for: far more than is rounded, far
/// less than matters.
const ON_EDGE: f64 = 1e-5;
const WIDER: f64 = 1e-3;

/// Unit of heights in a relief \[m\].
const STEP_M: f64 = 1e-5;

/// Heights on the grid \[m\]; NaN where nothing is.
pub(super) struct Heights(Vec<f64>);

fn radius_m(ring: usize, rim_m: f64) -> f64 {
    rim_m * (ring as f64 + 0.5) / GRID[0] as f64
}

fn place(ring: usize, azimuth: usize, rim_m: f64) -> [f64; 2] {
    let (s, c) = sin_cos(TAU * azimuth as f64 / GRID[1] as f64);
    let rho_m = radius_m(ring, rim_m);
    [rho_m * c, rho_m * s]
}

impl Heights {
    /// Returns the greatest heights of triangles, plate frame, or with side −1 the least.
    #[inline(never)]
    pub fn from_triangles(triangles: impl Iterator<Item = [Vector3<f64>; 3]>, rim_m: f64, side: f64) -> Self {
        let mut heights = vec![f64::NAN; GRID[0] * GRID[1]];
        for corners in triangles {
            let [from, to] = rings_of(&corners, rim_m);
            if from > to {
                continue;
            }
            let [first, count] = azimuths_of(&corners);
            for ring in from..=to {
                for azimuth in (first..first + count).map(|k| k % GRID[1]) {
                    let Some(height) = height_at(&corners, place(ring, azimuth, rim_m)) else {
                        continue;
                    };
                    let here = &mut heights[ring * GRID[1] + azimuth];
                    if here.is_nan() || side * height > side * *here {
                        *here = height;
                    }
                }
            }
        }
        Self(heights)
    }

    /// Refuses a face with a hole, and one that ends before the rim in a quarter of all directions: that is not round.
    pub fn check_whole(&self, rim_m: f64, placed: impl Fn(&Vector3<f64>) -> Place) -> Result<(), MeasuredError> {
        let is_missing = |ring: usize, azimuth: usize| self.0[ring * GRID[1] + azimuth].is_nan();
        let inside = (0..GRID[0])
            .take_while(|ring| radius_m(*ring, rim_m) <= rim_m - EDGE_M)
            .count();
        let reach = |azimuth: usize| (0..inside).rev().find(|ring| !is_missing(*ring, azimuth)).unwrap_or(0);
        let short: Vec<_> = (0..GRID[1]).filter(|azimuth| reach(*azimuth) + 2 < inside).collect();
        if let Some(least) = short.iter().copied().min_by_key(|azimuth| reach(*azimuth))
            && 4 * short.len() > GRID[1]
        {
            let ring = reach(least);
            let [x, y] = place(ring, least, rim_m);
            return Err(MeasuredError::NotRound {
                rim_m: [radius_m(ring, rim_m), rim_m],
                place: placed(&Vector3::new(x, y, 0.0)),
            });
        }
        for azimuth in 0..GRID[1] {
            // A ring alone is no hole: next to the pole, noise turns small facets over.
            let mut pairs = 1..inside;
            let Some(second) = pairs.find(|ring| is_missing(*ring, azimuth) && is_missing(ring - 1, azimuth)) else {
                continue;
            };
            let first = second - 1;
            let last = (first..inside).take_while(|ring| is_missing(*ring, azimuth)).last();
            let last = last.unwrap_or(first);
            let [x, y] = place(first.midpoint(last), azimuth, rim_m);
            let middle = placed(&Vector3::new(x, y, 0.0));
            let between_m = [first, last].map(|ring| radius_m(ring, rim_m));
            return Err(MeasuredError::Missing {
                between_m,
                place: middle,
            });
        }
        Ok(())
    }
}

/// Returns the first and the last ring that a triangle may meet.
fn rings_of(corners: &[Vector3<f64>; 3], rim_m: f64) -> [usize; 2] {
    let most = corners.iter().map(|p| p.xy().norm()).fold(0.0, f64::max);
    let pairs = [0, 1, 2].map(|k| (corners[k].xy(), corners[(k + 1) % 3].xy()));
    let near = pairs.iter().map(|(a, b)| {
        let along = b - a;
        let share = (-a.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (a + along * share).norm()
    });
    let least = match height_at(corners, [0.0; 2]) {
        Some(_) => 0.0,
        None => near.fold(f64::INFINITY, f64::min),
    };
    let ring = |rho: f64| rho / rim_m * GRID[0] as f64 - 0.5;
    // A little wider, whatever is rounded.
    let (from, to) = ((ring(least) - WIDER).ceil().max(0.0), (ring(most) + WIDER).floor());
    match to >= from {
        true => [from as usize, (to as usize).min(GRID[0] - 1)],
        false => [1, 0],
    }
}

/// Returns the first azimuth that a triangle may meet, and their number.
fn azimuths_of(corners: &[Vector3<f64>; 3]) -> [usize; 2] {
    let angles = corners.map(|p| atan2(p.y, p.x));
    let about = angles.map(|angle| {
        let turned = angle - angles[0];
        turned - TAU * (turned / TAU).round()
    });
    let [low, high] = about
        .iter()
        .fold([0.0_f64; 2], |[low, high], a| [low.min(*a), high.max(*a)]);
    if high - low >= PI - 1e-6 || corners.iter().any(|p| p.xy().norm_squared() == 0.0) {
        return [0, GRID[1]];
    }
    let step = TAU / GRID[1] as f64;
    let (from, to) = (
        ((angles[0] + low) / step - WIDER).ceil(),
        ((angles[0] + high) / step + WIDER).floor(),
    );
    match to >= from {
        true => [from.rem_euclid(GRID[1] as f64) as usize, (to - from) as usize + 1],
        false => [0, 0],
    }
}

/// Returns the relief of grids; where nothing was measured it is that of a surface, and `thickness_m` below it.
pub(super) fn relief(surface: &Surface, upper: Option<&Heights>, lower: Option<(&Heights, f64)>) -> Relief {
    let rim_m = surface.rim_m();
    let rings = || (0..GRID[0] / EVERY).map(|k| EVERY * k + EVERY / 2);
    let list = |heights: Option<&Heights>, below_m: f64| {
        let at = |ring: usize, azimuth: usize| {
            let found = heights.map_or(f64::NAN, |heights| heights.0[ring * GRID[1] + azimuth]);
            let height = if found.is_nan() {
                surface.height_m(radius_m(ring, rim_m)) - below_m
            } else {
                found
            };
            (height / STEP_M).round() as i32
        };
        let ring = |ring: usize| (0..GRID[1]).step_by(EVERY).map(move |azimuth| (ring, azimuth));
        rings()
            .flat_map(ring)
            .map(|(ring, azimuth)| at(ring, azimuth))
            .collect()
    };
    Relief {
        radii_m: rings().map(|ring| radius_m(ring, rim_m)).collect(),
        azimuths: GRID[1] / EVERY,
        upper: list(upper, 0.0),
        lower: lower.map_or_else(Vec::new, |(heights, thickness_m)| list(Some(heights), thickness_m)),
    }
}

/// Refuses a face that rises more steeply than a profile can.
pub(super) fn check_slope(rings: &[Ring], rim_m: f64) -> Result<(), MeasuredError> {
    let (s, c) = sin_cos(STEEPEST_RAD);
    for (k, from) in rings.iter().enumerate() {
        let far = |ring: &&Ring| ring.rho_m - from.rho_m >= SLOPE_SPAN * rim_m;
        let Some(to) = rings[k..].iter().find(far) else { break };
        let (along, up) = (to.rho_m - from.rho_m, to.height_m - from.height_m);
        if up * c > SLOPE_SLACK * along * s {
            return Err(MeasuredError::Steep {
                radius_m: from.rho_m.midpoint(to.rho_m),
                slope_deg: atan2(up, along).to_degrees(),
            });
        }
    }
    Ok(())
}

/// Height of a triangle over a place, seen along z; `None` beside it. A place on an edge of two triangles is over both of them, however their
/// corners are rounded.
pub(super) fn height_at([a, b, c]: &[Vector3<f64>; 3], [x, y]: [f64; 2]) -> Option<f64> {
    let twice = |p: &Vector3<f64>, q: &Vector3<f64>| (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
    let [u, v, w] = [twice(b, c), twice(c, a), twice(a, b)];
    let sum = u + v + w;
    let inside = sum != 0.0 && [u, v, w].iter().all(|part| part * sum >= -ON_EDGE * sum * sum);
    inside.then(|| (u * a.z + v * b.z + w * c.z) / sum)
}

/// Returns the points that are corners of the outline of all, seen along the frame's axis: those of the convex hull.
pub(super) fn corners(points: impl Iterator<Item = Vector3<f64>>, frame: &Frame) -> Vec<Vector3<f64>> {
    let mut all: Vec<_> = points.map(|point| (frame.local(&point).xy(), point)).collect();
    all.sort_unstable_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut hull = half_outline(all.iter());
    hull.extend(half_outline(all.iter().rev()));
    hull
}

/// Half of the outline of points that come in order along x or against it.
fn half_outline<'a>(points: impl Iterator<Item = &'a (Vector2<f64>, Vector3<f64>)>) -> Vec<Vector3<f64>> {
    let mut half: Vec<&(Vector2<f64>, Vector3<f64>)> = Vec::new();
    for point in points {
        while let [.., (a, _), (b, _)] = half[..]
            && (b - a).perp(&(point.0 - b)) <= 0.0
        {
            half.pop();
        }
        half.push(point);
    }
    // The other half begins with the last one.
    half.pop();
    half.into_iter().map(|(_, point)| *point).collect()
}

/// Returns the outermost point of each sector that has one.
pub(super) fn outermost(
    points: impl Iterator<Item = Vector3<f64>>,
    frame: &Frame,
    sectors: usize,
) -> Vec<Vector3<f64>> {
    let mut found: Vec<Option<(f64, Vector3<f64>)>> = vec![None; sectors];
    for point in points {
        let local = frame.local(&point);
        let share = (atan2(local.y, local.x) / TAU).rem_euclid(1.0);
        let sector = &mut found[((share * sectors as f64) as usize).min(sectors - 1)];
        let rho = local.xy().norm();
        if sector.is_none_or(|(before, _)| rho > before) {
            *sector = Some((rho, point));
        }
    }
    found.into_iter().flatten().map(|(_, point)| point).collect()
}
