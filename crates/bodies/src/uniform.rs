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
    pub fn from_shape(shape: &Shape) -> Option<Self> {
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
