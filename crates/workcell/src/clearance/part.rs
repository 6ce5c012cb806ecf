//! A convex part of a body: a core shape with a radius around it.
//!
//! A sphere is a point with a radius and a capsule a segment with one, so that their distances have closed forms.

use super::lever::Levers;
use nalgebra::{Point3, Vector3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::shape::{ConvexPolyhedron, Cuboid, Cylinder, Segment, SharedShape};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{BodyPoses, Frame};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// A quarter turn that lays parry's cylinder (along y) along z.
const Y_TO_Z: f64 = FRAC_PI_2;

/// The core of a part, in its own frame.
#[derive(Clone)]
pub(super) enum Core {
    /// A segment on z, half length \[m\]; 0 for a point.
    Segment(f64),
    /// A solid of the collision library.
    Solid(SharedShape, Extent),
    /// The half-space z ≤ 0 of the base frame.
    Floor,
}

/// What the height of a solid over the floor needs.
#[derive(Debug, Clone)]
pub(super) enum Extent {
    /// Vertices \[m\], shared by parts that are alike.
    Vertices(Arc<[Vector]>),
    /// A cylinder along y: radius and half length \[m\].
    Cylinder(f64, f64),
}

/// A part of a body, fixed to one of the arm's frames.
#[derive(Debug, Clone)]
pub(super) struct Part {
    core: Core,
    radius: f64,
    /// Radius of the sphere about the origin that holds the part \[m\].
    bounding: f64,
    frame: Frame,
}

/// A part at one configuration, base frame.
pub(super) struct Placed<'a> {
    pub core: &'a Core,
    pub radius: f64,
    pub pose: Pose,
    bounding: f64,
}

impl std::fmt::Debug for Core {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Segment(half) => write!(f, "Segment({half})"),
            Self::Solid(_, extent) => write!(f, "Solid({extent:?})"),
            Self::Floor => write!(f, "Floor"),
        }
    }
}

impl Part {
    /// The part for a link's shape; `None` for a mesh without volume.
    pub fn new(shape: &Shape, frame: Frame) -> Option<Self> {
        Some(match shape {
            Shape::Sphere { radius_m } => Self::round(0.0, *radius_m, frame),
            Shape::Capsule {
                radius_m,
                half_length_m,
            } => Self::round(*half_length_m, *radius_m, frame),
            Shape::Cylinder {
                radius_m,
                half_length_m,
            } => Self::cylinder(*radius_m, *half_length_m, frame),
            Shape::Box { half_m: [x, y, z] } => {
                let corner = Vector::new(*x, *y, *z);
                let signs = [-1.0, 1.0];
                let corners = signs.iter().flat_map(|i| signs.iter().map(move |j| (i, j)));
                let corners = corners.flat_map(|(i, j)| signs.iter().map(move |k| Vector::new(*i, *j, *k) * corner));
                Self::solid(
                    SharedShape::new(Cuboid::new(corner)),
                    Extent::Vertices(corners.collect()),
                    frame,
                )
            }
            Shape::Hull { points } => {
                let vertices: Vec<_> = points
                    .iter()
                    .map(|p: &Point3<f64>| Vector::new(p.x, p.y, p.z))
                    .collect();
                let hull = ConvexPolyhedron::from_convex_hull(&vertices).filter(|_| has_volume(&vertices))?;
                let extent = Extent::Vertices(enclosing(&hull, &vertices).into());
                Self::solid(SharedShape::new(hull), extent, frame)
            }
        })
    }

    /// A cylinder along the frame's z axis; lengths in metres.
    pub fn cylinder(radius: f64, half_length: f64, frame: Frame) -> Self {
        // parry's cylinder lies along y; `place` turns it.
        let extent = Extent::Cylinder(radius, half_length);
        Self::solid(SharedShape::new(Cylinder::new(half_length, radius)), extent, frame)
    }

    /// The floor; it needs no frame of its own.
    pub fn floor() -> Self {
        Self {
            core: Core::Floor,
            radius: 0.0,
            bounding: f64::INFINITY,
            frame: Frame::base(),
        }
    }

    /// A sphere about the frame's origin \[m\].
    pub fn ball(radius: f64, frame: Frame) -> Self {
        Self::round(0.0, radius, frame)
    }

    /// The part where a body fixed to the base carries it that stands elsewhere.
    pub fn carried(&self, by: &Rigid) -> Self {
        Self {
            frame: Frame::base().offset(&by.then(self.frame.on_body())),
            ..self.clone()
        }
    }

    /// The corners of a hull or box in the frame that carries the part; of others none \[m\].
    pub fn corners(&self) -> impl Iterator<Item = Vector3<f64>> {
        let vertices: &[Vector] = match &self.core {
            Core::Solid(_, Extent::Vertices(vertices)) => vertices,
            _ => &[],
        };
        let at = self.frame.on_body();
        vertices
            .iter()
            .map(move |v| at.rotation * Vector3::new(v.x, v.y, v.z) + at.translation)
    }

    fn round(half_length: f64, radius: f64, frame: Frame) -> Self {
        Self {
            core: Core::Segment(half_length),
            radius,
            bounding: half_length + radius,
            frame,
        }
    }

    fn solid(shape: SharedShape, extent: Extent, frame: Frame) -> Self {
        let bounding = match &extent {
            Extent::Vertices(vertices) => vertices.iter().map(|v| v.length()).fold(0.0, f64::max),
            Extent::Cylinder(radius, half) => (radius * radius + half * half).sqrt(),
        };
        Self {
            core: Core::Solid(shape, extent),
            radius: 0.0,
            bounding,
            frame,
        }
    }

    /// The frame that the part is fixed to, base frame.
    pub fn rigid(&self, poses: &BodyPoses) -> Rigid {
        poses.rigid(&self.frame)
    }

    /// A lower bound of the distance to another part from its bounding sphere; `here` and `there` are the parts'
    /// [`Part::rigid`] \[m\].
    pub fn gap_to_sphere(&self, here: &Rigid, other: &Self, there: &Rigid) -> f64 {
        self.distance_to_point(here, &there.translation) - other.bounding
    }

    /// Distance of a point of the base frame from the part \[m\]: exact for capsules, cylinders and the floor, otherwise a
    /// lower bound from the bounding sphere.
    fn distance_to_point(&self, here: &Rigid, point: &Vector3<f64>) -> f64 {
        let away = point - here.translation;
        match &self.core {
            Core::Floor => point.z,
            Core::Segment(half) => {
                let axis = here.rotation.column(2);
                (away - axis * axis.dot(&away).clamp(-half, *half)).norm() - self.radius
            }
            Core::Solid(_, Extent::Cylinder(radius, half)) => {
                let along = here.rotation.column(2).dot(&away);
                let across = (away.norm_squared() - along * along).max(0.0).sqrt();
                let (over, beside) = ((along.abs() - half).max(0.0), (across - radius).max(0.0));
                (over * over + beside * beside).sqrt()
            }
            Core::Solid(..) => away.norm() - self.bounding,
        }
    }

    /// The arm's body that carries the part: 0 for what never moves.
    pub fn body(&self) -> usize {
        self.frame.body()
    }

    /// Radius of the sphere about its frame's origin that holds the part \[m\].
    pub fn bounding(&self) -> f64 {
        self.bounding
    }

    /// The frame that the part is fixed to.
    pub fn frame(&self) -> Frame {
        self.frame
    }

    /// Levers of the part's origin, widened to the whole part; those of joints that do not move it stay 0.
    pub fn widened(&self, levers: &Levers) -> Levers {
        let body = self.body();
        Levers::from_fn(|i, _| if i < body { levers[i] + self.bounding } else { 0.0 })
    }

    /// [`Placed::sphere_gap`] without placing the parts.
    pub fn sphere_gap(&self, other: &Self, poses: &BodyPoses) -> f64 {
        let centre = |part: &Self| poses.rigid(&part.frame).translation;
        match (&self.core, &other.core) {
            (Core::Floor, _) => centre(other).z - other.bounding,
            (_, Core::Floor) => centre(self).z - self.bounding,
            _ => (centre(self) - centre(other)).norm() - self.bounding - other.bounding,
        }
    }

    /// The part where the arm's bodies stand.
    pub fn place(&self, poses: &BodyPoses) -> Placed<'_> {
        let pose: Pose = poses.pose(&self.frame).into();
        let pose = match &self.core {
            Core::Solid(_, Extent::Cylinder(..)) => pose * Pose::rotation(Vector::new(Y_TO_Z, 0.0, 0.0)),
            _ => pose,
        };
        Placed {
            core: &self.core,
            radius: self.radius,
            pose,
            bounding: self.bounding,
        }
    }
}

/// What a point may be outside of a face by rounding, and how thin a hull may be, as a part of its size.
const HULL_ROUNDING: f64 = 1e-12;
const THINNEST_HULL: f64 = 1e-9;

/// The vertices of a hull, and those of the points it was made of that it left outside: a hull that the collision library makes may be
/// too small, down to a flat one for a body that is much wider than high. What reaches farthest along a direction is among these,
/// whatever became of the hull, so that a gap along a direction is never overstated.
fn enclosing(hull: &ConvexPolyhedron, points: &[Vector]) -> Vec<Vector> {
    let size = points.iter().map(|p| p.length()).fold(0.0, f64::max);
    let corner = |first: u32| hull.points()[hull.vertices_adj_to_face()[first as usize] as usize];
    let faces: Vec<_> = hull
        .faces()
        .iter()
        .map(|f| (f.normal, corner(f.first_vertex_or_edge)))
        .collect();
    let is_outside = |point: &&Vector| {
        let beyond = |(normal, corner): &(Vector, Vector)| normal.dot(**point - *corner);
        // NaN is outside.
        !faces.iter().map(beyond).all(|beyond| beyond <= HULL_ROUNDING * size)
    };
    let outside = points.iter().filter(is_outside);
    hull.points().iter().chain(outside).copied().collect()
}

/// Whether points span a volume: some of them is off the plane through three that are far apart.
pub(super) fn has_volume(points: &[Vector]) -> bool {
    let Some(first) = points.first().copied() else {
        return false;
    };
    let farthest = |distance: &dyn Fn(Vector) -> f64| {
        let far = points
            .iter()
            .copied()
            .max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        far.map_or((first, 0.0), |point| (point, distance(point)))
    };
    let (second, size) = farthest(&|p| (p - first).length());
    let along = (second - first) / size;
    let (third, width) = farthest(&|p| (p - first).cross(along).length());
    let normal = along.cross(third - first).normalize_or_zero();
    let (_, height) = farthest(&|p| (p - first).dot(normal).abs());
    width > THINNEST_HULL * size && height > THINNEST_HULL * size
}

impl Placed<'_> {
    /// Whether the distance to another part is right to rounding: over the floor and between two spheres. Between segments
    /// the closed form takes nearly parallel ones for parallel, which costs more the shorter they are.
    pub fn is_exact_with(&self, other: &Self) -> bool {
        let is_sphere = |core: &Core| matches!(core, Core::Segment(half) if *half == 0.0);
        match (self.core, other.core) {
            (Core::Floor, _) | (_, Core::Floor) => true,
            (a, b) => is_sphere(a) && is_sphere(b),
        }
    }

    /// How far the part reaches along a unit direction from the base frame's origin \[m\].
    pub fn support(&self, direction: Vector) -> f64 {
        let local = self.pose.rotation.inverse() * direction;
        let beyond = match self.core {
            Core::Segment(half) => half * local.z.abs() + self.radius,
            Core::Solid(_, Extent::Vertices(vertices)) => {
                vertices.iter().map(|v| v.dot(local)).fold(f64::NEG_INFINITY, f64::max)
            }
            // The cylinder lies along y in its own frame.
            Core::Solid(_, Extent::Cylinder(radius, half)) => {
                half * local.y.abs() + radius * (local.x * local.x + local.z * local.z).sqrt()
            }
            // The half-space z ≤ 0 is bounded upwards alone.
            Core::Floor if direction.x == 0.0 && direction.y == 0.0 && direction.z > 0.0 => 0.0,
            Core::Floor => f64::INFINITY,
        };
        self.pose.translation.dot(direction) + beyond
    }

    /// The point of the core that is farthest along a direction, base frame; that of the floor is not defined.
    pub fn extreme(&self, direction: Vector) -> Vector {
        let local = self.pose.rotation.inverse() * direction;
        let point = match self.core {
            Core::Segment(half) => Vector::new(0.0, 0.0, half.copysign(local.z)),
            Core::Solid(_, Extent::Vertices(vertices)) => {
                let farthest = vertices.iter().max_by(|v, w| v.dot(local).total_cmp(&w.dot(local)));
                farthest.copied().unwrap_or(Vector::ZERO)
            }
            // The cylinder lies along y in its own frame.
            Core::Solid(_, Extent::Cylinder(radius, half)) => {
                let across = (local.x * local.x + local.z * local.z).sqrt();
                let out = if across > 0.0 { radius / across } else { 0.0 };
                Vector::new(local.x * out, half.copysign(local.y), local.z * out)
            }
            Core::Floor => Vector::ZERO,
        };
        self.pose * point
    }

    /// The core segment's ends, base frame.
    pub fn segment(&self, half: f64) -> Segment {
        let end = |z: f64| self.pose * Vector::new(0.0, 0.0, z);
        Segment::new(end(-half), end(half))
    }

    /// A lower bound of the distance to another part, from bounding spheres \[m\].
    pub fn sphere_gap(&self, other: &Self) -> f64 {
        match (self.core, other.core) {
            (Core::Floor, _) => other.pose.translation.z - other.bounding,
            (_, Core::Floor) => self.pose.translation.z - self.bounding,
            _ => (self.pose.translation - other.pose.translation).length() - self.bounding - other.bounding,
        }
    }
}
