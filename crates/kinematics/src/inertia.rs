//! Inertias of a description that no body of the link's mass and size has: they are probably in another unit.

use crate::geometry::{Inertial, Primitive, Shape, VisualShape};
use crate::model::{Link, RobotModel};
use nalgebra::{Matrix3, Point3, Vector3};
use serde::Serialize;

/// Factor beyond which an inertia is implausible.
const FACTOR: f64 = 100.0;

/// Share of mass × radius² that the greatest principal moment of an even body has at least: a rod about its end has a third, one about its
/// middle, whose farthest point counts from a centre of mass at the end, a twelfth.
const LEAST_SHARE: f64 = 1.0 / 12.0;

/// Inertia that no body of the link's mass and size has.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImplausibleInertia {
    /// Name of the link.
    pub link: String,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Distance of the farthest point of the link's shapes from the centre of mass \[m\].
    pub radius_m: f64,
    /// Greatest principal moment of inertia that the description states \[kg·m²\].
    pub found_kg_m2: f64,
    /// Moments that bodies of that mass and size have \[kg·m²\].
    pub possible_kg_m2: [f64; 2],
}

impl RobotModel {
    /// Inertias that are greater or smaller than those of any body of the link's mass and size by a factor of 100. The size is that of the
    /// link's collision shapes, or of its visuals where it has none.
    pub fn implausible_inertias(&self) -> impl Iterator<Item = ImplausibleInertia> {
        self.links().iter().filter_map(implausible)
    }
}

fn implausible(link: &Link) -> Option<ImplausibleInertia> {
    let Inertial {
        pose,
        mass_kg,
        inertia_kg_m2: [xx, xy, xz, yy, yz, zz],
    } = link.inertial.as_ref()?;
    let radius_m = radius_m(link, &pose.translation.vector.into())?;
    let matrix = Matrix3::new(*xx, *xy, *xz, *xy, *yy, *yz, *xz, *yz, *zz);
    let found_kg_m2 = matrix.symmetric_eigenvalues().max();
    // No point is farther from an axis through the centre of mass.
    let most = mass_kg * radius_m * radius_m;
    let possible_kg_m2 = [most * LEAST_SHARE, most];
    let is_possible = found_kg_m2 <= FACTOR * most && found_kg_m2 * FACTOR >= possible_kg_m2[0];
    (!is_possible).then(|| ImplausibleInertia {
        link: link.name.clone(),
        mass_kg: *mass_kg,
        radius_m,
        found_kg_m2,
        possible_kg_m2,
    })
}

/// Distance of the farthest point of a link's shapes from a point, or a little more \[m\]; `None` for a link without shapes.
fn radius_m(link: &Link, from: &Point3<f64>) -> Option<f64> {
    let of_shape = |pose: &crate::Pose, shape: &Shape| match shape {
        Shape::Hull { points } => farthest(points.iter().map(|point| pose * point), from),
        other => {
            let reach = Vector3::from_fn(|axis, _| other.support(&Vector3::ith(axis, 1.0)));
            (pose * Point3::origin() - from).norm() + reach.norm()
        }
    };
    let of_visual = |pose: &crate::Pose, shape: &VisualShape| match shape {
        VisualShape::Solid(shape) => of_shape(pose, shape),
        VisualShape::Mesh(triangles) => {
            let corners = triangles.iter().flatten();
            farthest(corners.map(|corner| pose * corner.cast::<f64>()), from)
        }
    };
    let collision = link
        .collision
        .iter()
        .map(|Primitive { pose, shape }| of_shape(pose, shape));
    let visual = link.visuals.iter().map(|visual| of_visual(&visual.pose, &visual.shape));
    collision.reduce(f64::max).or_else(|| visual.reduce(f64::max))
}

fn farthest(points: impl Iterator<Item = Point3<f64>>, from: &Point3<f64>) -> f64 {
    points.map(|point| (point - from).norm()).fold(0.0, f64::max)
}
