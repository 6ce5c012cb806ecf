//! A body's facets.

use nalgebra::Point3;
use platewash_kinematics::geometry::{Shape, Triangle};
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::clearance::hull_triangles;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Facets round a shape of revolution.
const ROUND: usize = 56;

/// Facets from the rim of a half sphere to its pole.
const TO_POLE: usize = 10;

/// The facets of a body, in its own frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facets {
    /// Corners \[m\].
    pub points: Vec<Point3<f64>>,
    /// Facets by their corners, counter-clockwise as seen from outside.
    pub faces: Vec<Vec<usize>>,
}

/// The facets of a shape; a hull that has no volume has none.
#[must_use]
pub fn facets(shape: &Shape) -> Facets {
    match shape {
        Shape::Box { half_m } => cuboid(*half_m),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => turned(&[[*radius_m, -half_length_m], [*radius_m, *half_length_m]]),
        Shape::Sphere { radius_m } => turned(&capsule(*radius_m, 0.0)),
        Shape::Capsule {
            radius_m,
            half_length_m,
        } => turned(&capsule(*radius_m, *half_length_m)),
        Shape::Hull { points } => hull(points),
    }
}

/// The facets of the hull of points; of one that has no volume none.
#[must_use]
pub fn hull(points: &[Point3<f64>]) -> Facets {
    let hull = hull_triangles(points).unwrap_or_default();
    let (points, faces) = (hull.corners, hull.triangles);
    let faces = faces.into_iter().map(|triangle| triangle.to_vec()).collect();
    Facets { points, faces }
}

/// The facets of a mesh's triangles; corners at the same place are one.
#[must_use]
pub fn mesh(triangles: &[Triangle]) -> Facets {
    let mut known: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    let mut all = Facets::default();
    for triangle in triangles {
        let corner = |at: &Point3<f32>| {
            // Of two zeros one is negative.
            let bits = [at.x, at.y, at.z].map(|c| (c + 0.0).to_bits());
            *known.entry(bits).or_insert_with(|| {
                all.points.push(at.cast());
                all.points.len() - 1
            })
        };
        let face: Vec<usize> = triangle.iter().map(corner).collect();
        all.faces.push(face);
    }
    all
}

fn cuboid([x, y, z]: [f64; 3]) -> Facets {
    let corner = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Point3::new(sign(0) * x, sign(1) * y, sign(2) * z)
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Facets {
        points: (0..8).map(corner).collect(),
        faces: faces.map(|face| face.to_vec()).to_vec(),
    }
}

/// The meridian of a capsule, without its poles.
fn capsule(radius: f64, half_length: f64) -> Vec<[f64; 2]> {
    let ring = |k: usize| {
        let (s, c) = sin_cos(FRAC_PI_2 * k as f64 / TO_POLE as f64);
        [radius * c, half_length + radius * s]
    };
    // The last ring is a small one about the pole.
    let rings: Vec<_> = (0..TO_POLE).map(ring).collect();
    let below = rings.iter().rev().map(|&[r, z]| [r, -z]);
    let mut all: Vec<_> = below.chain(rings.iter().copied()).collect();
    all.dedup();
    all
}

/// A meridian turned about z, \[distance from the axis, height\] from below to above, closed by flat ends.
#[must_use]
pub fn turned(meridian: &[[f64; 2]]) -> Facets {
    let mut points = Vec::new();
    for [r, z] in meridian {
        points.extend((0..ROUND).map(|k| {
            let (s, c) = sin_cos(TAU * k as f64 / ROUND as f64);
            Point3::new(r * c, r * s, *z)
        }));
    }
    let rings = meridian.len();
    let mut faces = Vec::new();
    for ring in 0..rings.saturating_sub(1) {
        faces.extend((0..ROUND).map(|k| {
            let (a, b) = (ring * ROUND + k, ring * ROUND + (k + 1) % ROUND);
            vec![a, b, b + ROUND, a + ROUND]
        }));
    }
    if rings > 0 {
        faces.push((0..ROUND).rev().collect());
        faces.push(((rings - 1) * ROUND..rings * ROUND).collect());
    }
    Facets { points, faces }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume: the sum of the facets' tetrahedra, positive only where facets turn outwards.
    fn volume(facets: &Facets) -> f64 {
        let mut sum = 0.0;
        for face in &facets.faces {
            let at = |k: usize| facets.points[face[k]].coords;
            sum += (1..face.len() - 1)
                .map(|k| at(0).dot(&at(k).cross(&at(k + 1))))
                .sum::<f64>();
        }
        sum / 6.0
    }

    #[test]
    fn facets_enclose_the_shape_and_turn_outwards() {
        let tau = TAU;
        let (r, l) = (0.3, 0.5);
        let cylinder = 0.5 * tau * r * r * 2.0 * l;
        let sphere = 2.0 / 3.0 * tau * r * r * r;
        let cube: Vec<_> = facets(&Shape::Box { half_m: [1.0; 3] }).points;
        let cases = [
            (
                Shape::Box {
                    half_m: [1.0, 2.0, 3.0],
                },
                48.0,
            ),
            (
                Shape::Cylinder {
                    radius_m: r,
                    half_length_m: l,
                },
                cylinder,
            ),
            (Shape::Sphere { radius_m: r }, sphere),
            (
                Shape::Capsule {
                    radius_m: r,
                    half_length_m: l,
                },
                cylinder + sphere,
            ),
            (Shape::Hull { points: cube }, 8.0),
        ];
        for (shape, expected) in cases {
            let found = volume(&facets(&shape));
            assert!(
                found <= expected * (1.0 + 1e-12) && found > 0.97 * expected,
                "{shape:?}: {found}"
            );
        }
    }

    #[test]
    fn a_hull_without_volume_has_no_facets() {
        let flat = vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0)];
        assert!(facets(&Shape::Hull { points: flat }).faces.is_empty());
    }
}
