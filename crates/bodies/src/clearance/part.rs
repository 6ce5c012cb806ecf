//! Convex part of a body: a core shape with a radius around it.
//!
//! A sphere is a point with a radius and a capsule a segment with one, so that their distances have closed forms.

use crate::clearance::convex::{ConvexHull, HullFault};
use crate::clearance::lever::Levers;
use nalgebra::{Point3, Vector3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::shape::{Cuboid, Cylinder, Segment, SharedShape};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{BodyPoses, Frame};
use platewash_workcell::obstacle::is_ground_plane;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Quarter turn that rotates parry's cylinder (along y) to z.
const Y_TO_Z: f64 = FRAC_PI_2;

/// Core of a part, in its own frame.
#[derive(Clone)]
pub(crate) enum Core {
    /// Segment on z, with its half length \[m\]; 0 for a point.
    Segment(f64),
    /// Solid of the collision library.
    Solid(SharedShape, Extent),
    /// Half-space z ≤ 0 of the part's own frame.
    HalfSpace,
}

/// Data for the height of a solid over a half-space.
#[derive(Debug, Clone)]
pub(crate) enum Extent {
    /// Vertices \[m\], shared by parts of the same shape.
    Vertices(Arc<[Vector]>),
    /// Cylinder along y: radius and half length \[m\].
    Cylinder(f64, f64),
}

/// Part of a body, fixed to one of the arm's frames.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    core: Core,
    /// Radius around the core \[m\]: all points within it belong to the part.
    radius: f64,
    /// Radius of the sphere about the origin that holds the part \[m\].
    bounding: f64,
    frame: Frame,
    /// Poses of the part and its core, base frame, if no joint moves it.
    standing: Option<(RigidTransform, Pose)>,
}

/// Part at one configuration, base frame.
#[derive(Debug, Clone)]
pub(crate) struct PlacedPart<'a> {
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
            Self::HalfSpace => write!(f, "HalfSpace"),
        }
    }
}

impl Core {
    /// Returns the pose of the core of a part at `rigid`.
    fn placed(&self, rigid: &RigidTransform) -> Pose {
        let pose: Pose = platewash_kinematics::Pose::from(rigid).into();
        match self {
            Self::Solid(_, Extent::Cylinder(..)) => pose * Pose::rotation(Vector::new(Y_TO_Z, 0.0, 0.0)),
            _ => pose,
        }
    }
}

impl Part {
    /// True for the convex hull of a mesh.
    pub fn is_hull(&self) -> bool {
        matches!(&self.core, Core::Solid(solid, _) if solid.as_convex_polyhedron().is_some())
    }

    /// True for the half-space below height 0 of the base: the ground.
    pub fn is_ground(&self) -> bool {
        let RigidTransform { rotation, translation } = self.frame.on_body();
        let is_level = || is_ground_plane(&rotation.column(2).into_owned(), translation);
        matches!(self.core, Core::HalfSpace) && self.frame.body() == 0 && is_level()
    }

    /// Margin around the core \[m\].
    pub fn margin_m(&self) -> f64 {
        self.radius
    }

    /// True for a ball.
    pub fn is_ball(&self) -> bool {
        matches!(self.core, Core::Segment(half) if half == 0.0)
    }

    /// True for a ball, and for a capsule or a cylinder, which are round about z of their frame.
    pub fn is_round(&self) -> bool {
        matches!(self.core, Core::Segment(_) | Core::Solid(_, Extent::Cylinder(..)))
    }

    /// Builds the part of a link's shape. Fails for a mesh that has no volume or is too large.
    pub fn new(shape: &Shape, frame: Frame) -> Result<Self, HullFault> {
        Ok(match shape {
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
                let hull = ConvexHull::from_points(&vertices)?;
                Self::solid(
                    SharedShape::new(hull.solid),
                    Extent::Vertices(hull.corners.into()),
                    frame,
                )
            }
        })
    }

    /// Returns a cylinder along the frame's z axis; lengths in metres.
    pub fn cylinder(radius: f64, half_length: f64, frame: Frame) -> Self {
        // parry's cylinder lies along y; `place` turns it.
        let extent = Extent::Cylinder(radius, half_length);
        Self::solid(SharedShape::new(Cylinder::new(half_length, radius)), extent, frame)
    }

    /// Returns the half-space z ≤ 0 of a frame.
    pub fn half_space(frame: Frame) -> Self {
        Self::on(frame, Core::HalfSpace, 0.0, f64::INFINITY)
    }

    /// Returns the part grown by `margin_m` on all sides.
    pub fn grown(self, margin_m: f64) -> Self {
        Self {
            radius: self.radius + margin_m,
            bounding: self.bounding + margin_m,
            ..self
        }
    }

    /// Returns a sphere about the frame's origin \[m\].
    pub fn ball(radius: f64, frame: Frame) -> Self {
        Self::round(0.0, radius, frame)
    }

    /// Returns the part moved by a transform, for a body that is fixed to the base and stands elsewhere.
    pub fn moved_by(&self, transform: &RigidTransform) -> Self {
        let frame = Frame::base().offset(&transform.then(self.frame.on_body()));
        Self::on(frame, self.core.clone(), self.radius, self.bounding)
    }

    /// Returns the corners of a hull or box in the frame that carries the part \[m\]; empty for others.
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
        Self::on(frame, Core::Segment(half_length), radius, half_length + radius)
    }

    fn solid(shape: SharedShape, extent: Extent, frame: Frame) -> Self {
        let bounding = match &extent {
            Extent::Vertices(vertices) => vertices.iter().map(|v| v.length()).fold(0.0, f64::max),
            Extent::Cylinder(radius, half) => (radius * radius + half * half).sqrt(),
        };
        Self::on(frame, Core::Solid(shape, extent), 0.0, bounding)
    }

    fn on(frame: Frame, core: Core, radius: f64, bounding: f64) -> Self {
        let standing = (frame.body() == 0).then(|| {
            let stands = RigidTransform::identity().then(frame.on_body());
            (stands, core.placed(&stands))
        });
        Self {
            core,
            radius,
            bounding,
            frame,
            standing,
        }
    }

    /// Returns the frame that the part is fixed to, base frame.
    pub fn rigid(&self, poses: &BodyPoses) -> RigidTransform {
        let stands = self.standing.as_ref().map(|(stands, _)| *stands);
        stands.unwrap_or_else(|| poses.rigid(&self.frame))
    }

    /// Returns the origin of the frame that the part is fixed to, base frame.
    pub fn origin(&self, poses: &BodyPoses) -> Vector3<f64> {
        let stands = self.standing.as_ref().map(|(stands, _)| stands.translation);
        stands.unwrap_or_else(|| poses.rigid(&self.frame).translation)
    }

    /// Lower bound of the distance to another part from its bounding sphere \[m\]; `here` is this part's [`Part::rigid`], `there` the other
    /// one's [`Part::origin`].
    pub fn gap_to_sphere(&self, here: &RigidTransform, other: &Self, there: &Vector3<f64>) -> f64 {
        self.distance_to_point(here, there) - other.bounding
    }

    /// Distance of a point of the base frame from the part \[m\]: exact for capsules, cylinders and half-spaces, below 0 within the latter;
    /// otherwise a lower bound from the bounding sphere.
    fn distance_to_point(&self, here: &RigidTransform, point: &Vector3<f64>) -> f64 {
        let away = point - here.translation;
        match &self.core {
            Core::HalfSpace => here.rotation.column(2).dot(&away) - self.radius,
            Core::Segment(half) => {
                let axis = here.rotation.column(2);
                (away - axis * axis.dot(&away).clamp(-half, *half)).norm() - self.radius
            }
            Core::Solid(_, Extent::Cylinder(radius, half)) => {
                let along = here.rotation.column(2).dot(&away);
                let across = (away.norm_squared() - along * along).max(0.0).sqrt();
                let (over, beside) = ((along.abs() - half).max(0.0), (across - radius).max(0.0));
                (over * over + beside * beside).sqrt() - self.radius
            }
            Core::Solid(..) => away.norm() - self.bounding,
        }
    }

    /// Index of the arm's body that carries the part: 0 for fixed parts.
    pub fn body(&self) -> usize {
        self.frame.body()
    }

    /// Radius of the sphere about its frame's origin that holds the part \[m\].
    pub fn bounding(&self) -> f64 {
        self.bounding
    }

    /// Returns the frame that the part is fixed to.
    pub fn frame(&self) -> Frame {
        self.frame
    }

    /// Returns the levers of the part's origin, widened to the whole part; those of joints that do not move it stay 0.
    pub fn widened(&self, levers: &Levers) -> Levers {
        let body = self.body();
        Levers::from_fn(|i, _| if i < body { levers[i] + self.bounding } else { 0.0 })
    }

    /// Same as [`PlacedPart::sphere_gap`], from the parts' [`Part::rigid`].
    pub fn sphere_gap(&self, here: &RigidTransform, other: &Self, there: &RigidTransform) -> f64 {
        match (&self.core, &other.core) {
            (Core::HalfSpace, _) => self.gap_to_sphere(here, other, &there.translation),
            (_, Core::HalfSpace) => other.gap_to_sphere(there, self, &here.translation),
            _ => (here.translation - there.translation).norm() - self.bounding - other.bounding,
        }
    }

    /// Places the part at the poses of the arm's bodies.
    pub fn place(&self, poses: &BodyPoses) -> PlacedPart<'_> {
        self.place_at(&self.rigid(poses))
    }

    /// Places the part where its frame is at `rigid`, its [`Part::rigid`].
    pub fn place_at(&self, rigid: &RigidTransform) -> PlacedPart<'_> {
        let stands = self.standing.as_ref().map(|(_, pose)| *pose);
        PlacedPart {
            core: &self.core,
            radius: self.radius,
            pose: stands.unwrap_or_else(|| self.core.placed(rigid)),
            bounding: self.bounding,
        }
    }
}

impl PlacedPart<'_> {
    /// Radius of the sphere about its frame's origin that holds the part \[m\].
    pub fn bounding(&self) -> f64 {
        self.bounding
    }

    /// True if the distance to another part is exact up to rounding: over a half-space and between two spheres. Between segments the closed
    /// form takes nearly parallel ones for parallel; the error grows as they get shorter.
    pub fn is_exact_with(&self, other: &Self) -> bool {
        let is_sphere = |core: &Core| matches!(core, Core::Segment(half) if *half == 0.0);
        match (self.core, other.core) {
            (Core::HalfSpace, _) | (_, Core::HalfSpace) => true,
            (a, b) => is_sphere(a) && is_sphere(b),
        }
    }

    /// Outward unit vector of a half-space, base frame; `None` for other parts, which are bounded.
    pub fn outwards(&self) -> Option<Vector> {
        matches!(self.core, Core::HalfSpace).then(|| self.pose.rotation * Vector::Z)
    }

    /// Axis of a part that is round about one, base frame.
    pub fn axis(&self) -> Option<Vector> {
        match self.core {
            Core::Segment(half) if *half > 0.0 => Some(self.pose.rotation * Vector::Z),
            Core::Solid(_, Extent::Cylinder(..)) => Some(self.pose.rotation * Vector::Y),
            _ => None,
        }
    }

    /// Reach of the part along a unit direction from the base frame's origin \[m\]. A half-space has a finite reach only along
    /// [`PlacedPart::outwards`].
    pub fn support(&self, direction: Vector) -> f64 {
        let local = self.pose.rotation.inverse() * direction;
        let beyond = match self.core {
            Core::Segment(half) => half * local.z.abs(),
            Core::Solid(_, Extent::Vertices(vertices)) => {
                let farther = |most: f64, v: &Vector| if v.dot(local) > most { v.dot(local) } else { most };
                vertices.iter().fold(f64::NEG_INFINITY, farther)
            }
            // The cylinder lies along y in its own frame.
            Core::Solid(_, Extent::Cylinder(radius, half)) => {
                half * local.y.abs() + radius * (local.x * local.x + local.z * local.z).sqrt()
            }
            Core::HalfSpace => 0.0,
        };
        self.pose.translation.dot(direction) + (beyond + self.radius)
    }

    /// Returns the point of the core that is farthest along a direction, base frame; undefined for a half-space.
    pub fn extreme(&self, direction: Vector) -> Vector {
        let local = self.pose.rotation.inverse() * direction;
        let point = match self.core {
            Core::Segment(half) => Vector::new(0.0, 0.0, half.copysign(local.z)),
            Core::Solid(_, Extent::Vertices(vertices)) => {
                let reaches = vertices.iter().map(|v| (v.dot(local), v));
                let farthest = reaches.max_by(|(v, _), (w, _)| v.total_cmp(w));
                farthest.map_or(Vector::ZERO, |(_, v)| *v)
            }
            // The cylinder lies along y in its own frame.
            Core::Solid(_, Extent::Cylinder(radius, half)) => {
                let across = (local.x * local.x + local.z * local.z).sqrt();
                let out = if across > 0.0 { radius / across } else { 0.0 };
                Vector::new(local.x * out, half.copysign(local.y), local.z * out)
            }
            Core::HalfSpace => Vector::ZERO,
        };
        self.pose * point
    }

    /// Returns the core's segment, base frame.
    pub fn segment(&self, half: f64) -> Segment {
        let end = |z: f64| self.pose * Vector::new(0.0, 0.0, z);
        Segment::new(end(-half), end(half))
    }

    /// Distance of a point from the plane of a half-space \[m\]; below 0 within.
    pub fn height_of(&self, point: Vector) -> f64 {
        let normal = self.pose.rotation * Vector::Z;
        normal.dot(point - self.pose.translation) - self.radius
    }

    /// A lower bound of the distance to another part, from bounding spheres \[m\].
    pub fn sphere_gap(&self, other: &Self) -> f64 {
        match (self.core, other.core) {
            (Core::HalfSpace, _) => self.height_of(other.pose.translation) - other.bounding,
            (_, Core::HalfSpace) => other.height_of(self.pose.translation) - self.bounding,
            _ => (self.pose.translation - other.pose.translation).length() - self.bounding - other.bounding,
        }
    }
}
