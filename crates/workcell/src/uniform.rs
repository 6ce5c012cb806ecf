//! Bodies of uniform density: volume, centre and inertia of convex shapes in closed form.

use crate::clearance::hull_triangles;
use nalgebra::{Matrix3, Point3, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use std::f64::consts::PI;

/// Body of density 1 in some frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformBody {
    /// Volume \[m³\], above 0.
    pub volume_m3: f64,
    /// Centre of mass \[m\].
    pub centre_m: Vector3<f64>,
    /// Inertia about the centre, axes of the frame \[m⁵\]; multiplied by a density it is in kg·m².
    pub inertia_m5: Matrix3<f64>,
}

impl UniformBody {
    /// Returns the body of a shape in the shape's own frame; `None` if its volume is 0 or not finite.
    ///
    /// A hull is divided into the tetrahedra between its facets and one of its corners, whose integrals are exact.
    #[must_use]
    pub fn of(shape: &Shape) -> Option<Self> {
        let body = match shape {
            Shape::Box { half_m: [a, b, c] } => {
                let volume = 8.0 * a * b * c;
                // V/12 of the squares of both edges across, V/3 of their halves.
                let about = |u: &f64, v: &f64| volume / 3.0 * (u * u + v * v);
                centred(volume, [about(b, c), about(a, c), about(a, b)])
            }
            Shape::Cylinder {
                radius_m: r,
                half_length_m: h,
            } => {
                let volume = 2.0 * PI * r * r * h;
                let across = volume * (r * r / 4.0 + h * h / 3.0);
                centred(volume, [across, across, volume * r * r / 2.0])
            }
            Shape::Sphere { radius_m: r } => {
                let volume = 4.0 / 3.0 * PI * (r * r * r);
                centred(volume, [0.4 * volume * r * r; 3])
            }
            Shape::Capsule {
                radius_m: r,
                half_length_m: h,
            } => {
                let (rod, ball) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * (r * r * r));
                // Each half of the ball is 3r/8 beyond its end of the rod: 2r²/5 + h² + 3hr/4.
                let ends = ball * (0.4 * r * r + h * h + 0.75 * h * r);
                let across = rod * (r * r / 4.0 + h * h / 3.0) + ends;
                let along = rod * r * r / 2.0 + 0.4 * ball * r * r;
                centred(rod + ball, [across, across, along])
            }
            Shape::Hull { points } => polyhedron(points)?,
        };
        let finite = body.centre_m.iter().chain(&body.inertia_m5).all(|v| v.is_finite());
        (body.volume_m3 > 0.0 && body.volume_m3.is_finite() && finite).then_some(body)
    }

    /// Returns the body in another frame, placed at `T_new_old`.
    #[must_use]
    pub fn placed(&self, pose: &Pose) -> Self {
        let turn = pose.rotation.to_rotation_matrix();
        Self {
            volume_m3: self.volume_m3,
            centre_m: (pose * Point3::from(self.centre_m)).coords,
            inertia_m5: turn.matrix() * self.inertia_m5 * turn.matrix().transpose(),
        }
    }
}

fn centred(volume_m3: f64, inertia: [f64; 3]) -> UniformBody {
    UniformBody {
        volume_m3,
        centre_m: Vector3::zeros(),
        inertia_m5: Matrix3::from_diagonal(&Vector3::from(inertia)),
    }
}

/// Contribution of a volume at `d` to the inertia about the origin: V (d² 1 − d dᵀ).
pub(crate) fn steiner(volume: f64, d: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * volume
}

/// Returns the body of a polyhedron. A tetrahedron (0, a, b, c) with s = a + b + c has the volume `det/6`, the first moment `V s/4` and the
/// second moment `V/20 (Σ v vᵀ + s sᵀ)`.
fn polyhedron(points: &[Point3<f64>]) -> Option<UniformBody> {
    let hull = hull_triangles(points)?;
    let apex = hull.corners.first()?.coords;
    let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
    for triangle in &hull.triangles {
        let [a, b, c] = triangle.map(|k| hull.corners[k].coords - apex);
        let (v, s) = (a.dot(&b.cross(&c)) / 6.0, a + b + c);
        volume += v;
        first += s * (v / 4.0);
        let corners = a * a.transpose() + b * b.transpose() + c * c.transpose();
        second += (corners + s * s.transpose()) * (v / 20.0);
    }
    let mean = first / volume;
    let about = second - mean * mean.transpose() * volume;
    Some(UniformBody {
        volume_m3: volume,
        centre_m: apex + mean,
        inertia_m5: Matrix3::identity() * about.trace() - about,
    })
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Test that a point at ρ and z lies in a shape of some radius and half length.
    type InsideTest = fn(f64, f64, f64, f64) -> bool;

    /// Returns the hull of a prism along z over a regular polygon.
    fn prism(sides: usize, radius: f64, half: f64) -> Shape {
        let corner = |k: usize| {
            let (s, c) = crate::trig::sin_cos(2.0 * PI * (k % sides) as f64 / sides as f64);
            Point3::new(radius * c, radius * s, if k < sides { -half } else { half })
        };
        let points = (0..2 * sides).map(corner).collect();
        Shape::Hull { points }
    }

    fn are_close(a: &UniformBody, b: &UniformBody, part: f64) -> bool {
        let size = b.inertia_m5.norm();
        (a.volume_m3 - b.volume_m3).abs() <= part * b.volume_m3
            && (a.centre_m - b.centre_m).norm() <= part * b.volume_m3.cbrt()
            && (a.inertia_m5 - b.inertia_m5).norm() <= part * size
    }

    proptest! {
        /// The hull of a box's corners equals the box, at any position and rotation.
        #[test]
        fn a_hull_of_corners_is_its_box(half in prop::array::uniform3(0.01..0.3f64), at in prop::array::uniform3(-1.0..1.0f64), turn in prop::array::uniform3(-3.0..3.0f64)) {
            let pose = Pose::new(Vector3::from(at), Vector3::from(turn));
            let sign = |k: usize, bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let corner = |k: usize| pose * Point3::new(sign(k, 0) * half[0], sign(k, 1) * half[1], sign(k, 2) * half[2]);
            let points = (0..8).map(corner).collect();
            let hull = UniformBody::of(&Shape::Hull { points }).unwrap();
            let expected = UniformBody::of(&Shape::Box { half_m: half }).unwrap().placed(&pose);
            prop_assert!(are_close(&hull, &expected, 1e-9), "{hull:?} {expected:?}");
        }

        /// Sums over a fine grid of points.
        #[test]
        fn shapes_are_the_sums_over_their_points(r in 0.02..0.1f64, h in 0.01..0.2f64, which in 0..3usize) {
            let (shape, inside): (_, InsideTest) = match which {
                0 => (Shape::Cylinder { radius_m: r, half_length_m: h }, |rho, z, r, h| rho < r && z.abs() < h),
                1 => (Shape::Capsule { radius_m: r, half_length_m: h }, |rho, z, r, h| rho.hypot((z.abs() - h).max(0.0)) < r),
                _ => (Shape::Sphere { radius_m: r }, |rho, z, r, _| rho.hypot(z) < r),
            };
            // Rings about z: midpoints of ρ and z.
            let (n, top) = (400, if which == 0 { h } else { h + r });
            let (mut volume, mut along, mut across) = (0.0, 0.0, 0.0);
            for i in 0..n {
                let rho = r * (i as f64 + 0.5) / n as f64;
                for k in 0..n {
                    let z = top * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0);
                    if inside(rho, z, r, h) {
                        let ring = 2.0 * PI * rho * (r / n as f64) * (2.0 * top / n as f64);
                        volume += ring;
                        along += ring * rho * rho;
                        across += ring * (0.5 * rho * rho + z * z);
                    }
                }
            }
            let expected = centred(volume, [across, across, along]);
            let found = UniformBody::of(&shape).unwrap();
            prop_assert!(are_close(&found, &expected, 0.01), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn a_prism_of_many_sides_is_a_cylinder() {
        let cylinder = Shape::Cylinder {
            radius_m: 0.02,
            half_length_m: 0.07,
        };
        let [hull, round] = [prism(400, 0.02, 0.07), cylinder].map(|shape| UniformBody::of(&shape).unwrap());
        assert!(are_close(&hull, &round, 1e-3), "{hull:?} {round:?}");
    }

    #[test]
    fn rejects_bodies_without_volume() {
        let flat = (0..9)
            .map(|k| Point3::new(f64::from(k % 3), f64::from(k / 3), 0.0))
            .collect();
        let shapes = [
            Shape::Hull { points: flat },
            Shape::Hull { points: Vec::new() },
            Shape::Box {
                half_m: [1.0, 0.0, 1.0],
            },
            Shape::Sphere { radius_m: f64::NAN },
            Shape::Sphere {
                radius_m: f64::INFINITY,
            },
        ];
        for shape in shapes {
            assert_eq!(UniformBody::of(&shape), None, "{shape:?}");
        }
    }
}
