//! Smallest distances between the arm, its tool, the floor and the plates.
//!
//! The collision library (parry) appears in this folder only; its types do not leave it.
//!
//! # Accuracy
//!
//! Distances between spheres and over the floor are closed forms, right to rounding (1e-12 m). The others are proposed by a routine of
//! their own (for capsules a closed form too, for solids GJK) and held between two bounds, the gap along a direction and the distance of two
//! points, no more than [`ITERATIVE_ERROR_M`] apart; what is proved uses the lower one. Tests hold them against closed forms,
//! another method and an independent library. Yes-or-no questions of the planner ([`ClearanceModel::keeps`]) take the proposal,
//! which may be too great by some hundredths of a millimetre. Bodies that overlap have a distance ≤ 0; how far they overlap is only
//! a lower bound of the penetration depth.

mod bracket;
mod distance;
pub mod lever;
pub mod motion;
mod pairs;
mod part;
mod washing;

use crate::layout::Plate;
use crate::tool::Tool;
use distance::{Separation, bracketed, separation};
use nalgebra::{Point3, Vector3};
use part::{Part, Placed};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{Frame, JointVector, Pose, RobotModel};
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

/// How far apart the bounds of a distance between solids are that is stated \[m\].
pub const ITERATIVE_ERROR_M: f64 = bracket::ERROR_M;

/// Something that must not be touched or must not touch.
#[derive(Debug, Clone)]
struct Body {
    name: String,
    kind: BodyKind,
    parts: Vec<Part>,
}

/// What a body is; decides which pairs are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BodyKind {
    /// A link, with the index of the arm's body that carries it.
    Link(usize),
    /// The tool's handle.
    Handle,
    /// The sponge.
    Sponge,
    /// The plane z = 0.
    Floor,
    /// A plate.
    Plate(usize),
}

/// Distance between two bodies at one configuration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PairClearance {
    /// One body.
    pub a: String,
    /// The other.
    pub b: String,
    /// Distance \[m\]; ≤ 0 when they touch or overlap.
    pub distance_m: f64,
    /// Half-way between the two nearest points \[m\], base frame.
    pub place_m: [f64; 3],
}

/// Why no clearance model could be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClearanceError {
    /// A mesh whose points span no volume.
    #[error("link '{link}': its collision mesh is flat; a convex hull needs a volume")]
    FlatHull {
        /// The link.
        link: String,
    },
}

/// The bodies and pairs of one job, ready for many configurations.
#[derive(Debug, Clone)]
pub struct ClearanceModel {
    robot: RobotModel,
    bodies: Vec<Body>,
    pairs: Vec<(usize, usize)>,
}

impl ClearanceModel {
    /// The arm with its tool (none when `length_m` is 0), over the floor z = 0 and the plates.
    ///
    /// Pairs: links that can meet (all but those that the arm's list disables; without a list, all but neighbours and
    /// pairs that touch in every configuration sampled); handle and sponge with every link up to the forearm;
    /// everything that moves with the floor and the plates.
    ///
    /// # Errors
    /// [`ClearanceError::FlatHull`] for a mesh without volume.
    pub fn new(robot: &RobotModel, tool: &Tool, plates: &[Plate]) -> Result<Self, ClearanceError> {
        let mut bodies = Vec::new();
        for link in robot.links().iter().filter(|link| !link.collision.is_empty()) {
            let parts = link
                .collision
                .iter()
                .map(|p| Part::new(&p.shape, link.frame.offset(&Rigid::from(&p.pose))));
            let flat = || ClearanceError::FlatHull {
                link: link.name.clone(),
            };
            bodies.push(Body {
                name: link.name.clone(),
                kind: BodyKind::Link(link.frame.body()),
                parts: parts.collect::<Option<_>>().ok_or_else(flat)?,
            });
        }
        bodies.extend(tool_bodies(robot, tool));
        bodies.push(body("floor", BodyKind::Floor, Part::floor()));
        bodies.extend(plates.iter().enumerate().map(|(i, plate)| plate_body(i, plate)));
        let mut model = Self {
            robot: robot.clone(),
            bodies,
            pairs: Vec::new(),
        };
        model.pairs = pairs::choose(&model);
        Ok(model)
    }

    /// The same arm and tool among plates that lie elsewhere, as many as before: which pairs are checked does not depend on where
    /// plates lie, and the arm's bodies need not be made again.
    #[must_use]
    pub fn among(&self, plates: &[Plate]) -> Self {
        let mut model = self.clone();
        model.lay(plates);
        model
    }

    /// [`ClearanceModel::among`] in place.
    pub fn lay(&mut self, plates: &[Plate]) {
        for body in &mut self.bodies {
            if let BodyKind::Plate(index) = body.kind
                && let Some(plate) = plates.get(index)
            {
                *body = plate_body(index, plate);
            }
        }
    }

    /// Names of the pairs that are checked.
    #[must_use]
    pub fn pair_names(&self) -> Vec<(&str, &str)> {
        let name = |i: usize| self.bodies[i].name.as_str();
        self.pairs.iter().map(|&(a, b)| (name(a), name(b))).collect()
    }

    /// Distances of all pairs at `q` \[rad\], in the order of [`ClearanceModel::pair_names`].
    #[must_use]
    pub fn all(&self, q: &JointVector) -> Vec<PairClearance> {
        let placed = self.place(q);
        let all = self.pairs.iter().map(|&(a, b)| {
            let least = self
                .part_pairs(a, b)
                .map(|(p, r)| bracketed(&placed[a][p], &placed[b][r]).0);
            self.describe(a, b, nearest(least))
        });
        all.collect()
    }

    /// The smallest distance at `q` \[rad\] and where it is. The sponge may touch the plates in `working`.
    ///
    /// `None` when there is nothing to check: a description without collision geometry.
    #[must_use]
    pub fn smallest(&self, q: &JointVector, working: &[usize]) -> Option<PairClearance> {
        let placed = self.place(q);
        let mut best: Option<(usize, usize, Separation)> = None;
        let mut candidates: Vec<_> = self
            .pairs
            .iter()
            .filter(|&&(a, b)| !self.exempt(a, b, working))
            .flat_map(|&(a, b)| self.part_pairs(a, b).map(move |(p, r)| (a, b, p, r)))
            .map(|(a, b, p, r)| (placed[a][p].sphere_gap(&placed[b][r]), a, b, p, r))
            .collect();
        candidates.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
        for (at_least, a, b, p, r) in candidates {
            if best.as_ref().is_some_and(|(.., s)| at_least >= s.distance) {
                break;
            }
            let found = bracketed(&placed[a][p], &placed[b][r]).0;
            if best.as_ref().is_none_or(|(.., s)| found.distance < s.distance) {
                best = Some((a, b, found));
            }
        }
        best.map(|(a, b, found)| self.describe(a, b, found))
    }

    /// All pairs that are in contact or nearer than `required_m` at `q` \[rad\], nearest first. The sponge may touch the
    /// plates in `working`.
    #[must_use]
    pub fn too_near(&self, q: &JointVector, working: &[usize], required_m: f64) -> Vec<PairClearance> {
        let placed = self.place(q);
        let pairs = self.pairs.iter().filter(|&&(a, b)| !self.exempt(a, b, working));
        let near = pairs.map(|&(a, b)| {
            let candidates = self.part_pairs(a, b).map(|(p, r)| (&placed[a][p], &placed[b][r]));
            let candidates = candidates.filter(|(p, r)| p.sphere_gap(r) <= required_m);
            self.describe(a, b, nearest(candidates.map(|(p, r)| bracketed(p, r).0)))
        });
        let mut near: Vec<_> = near.filter(|pair| !is_clear(pair.distance_m, required_m)).collect();
        near.sort_by(|x, y| x.distance_m.total_cmp(&y.distance_m));
        near
    }

    fn exempt(&self, a: usize, b: usize, working: &[usize]) -> bool {
        match (self.bodies[a].kind, self.bodies[b].kind) {
            (BodyKind::Sponge, BodyKind::Plate(i)) | (BodyKind::Plate(i), BodyKind::Sponge) => working.contains(&i),
            _ => false,
        }
    }

    fn part_pairs(&self, a: usize, b: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (in_a, in_b) = (self.bodies[a].parts.len(), self.bodies[b].parts.len());
        (0..in_a).flat_map(move |p| (0..in_b).map(move |r| (p, r)))
    }

    fn place(&self, q: &JointVector) -> Vec<Vec<Placed<'_>>> {
        let poses = self.robot.fk(q);
        self.bodies
            .iter()
            .map(|body| body.parts.iter().map(|part| part.place(&poses)).collect())
            .collect()
    }

    fn describe(&self, a: usize, b: usize, found: Separation) -> PairClearance {
        PairClearance {
            a: self.bodies[a].name.clone(),
            b: self.bodies[b].name.clone(),
            distance_m: found.distance,
            place_m: found.place,
        }
    }
}

/// Whether a distance \[m\] keeps the clearance asked for \[m\]; at 0 only contact breaks it. NaN keeps nothing.
#[must_use]
pub fn is_clear(distance_m: f64, required_m: f64) -> bool {
    distance_m > 0.0 && distance_m >= required_m
}

fn nearest(separations: impl Iterator<Item = Separation>) -> Separation {
    separations
        .min_by(|x, y| x.distance.total_cmp(&y.distance))
        .unwrap_or(Separation {
            distance: f64::INFINITY,
            place: [0.0; 3],
            normal: [0.0; 3],
        })
}

fn body(name: &str, kind: BodyKind, part: Part) -> Body {
    Body {
        name: name.to_owned(),
        kind,
        parts: vec![part],
    }
}

/// Handle and sponge, cylinders along the z axis of the mounting frame.
fn tool_bodies(robot: &RobotModel, tool: &Tool) -> Vec<Body> {
    let handle_length = tool.length_m - tool.sponge_height_m;
    if tool.length_m <= 0.0 || handle_length <= 0.0 {
        return Vec::new();
    }
    let mount = robot.mounting_frame();
    let along = |middle: f64| {
        mount.offset(&Rigid {
            translation: Vector3::new(0.0, 0.0, middle),
            ..Rigid::identity()
        })
    };
    let handle = Part::cylinder(tool.radius_m, handle_length / 2.0, along(handle_length / 2.0));
    let sponge_half = tool.sponge_height_m / 2.0;
    let sponge = Part::cylinder(tool.sponge_radius_m, sponge_half, along(handle_length + sponge_half));
    vec![
        body("handle", BodyKind::Handle, handle),
        body("sponge", BodyKind::Sponge, sponge),
    ]
}

fn plate_body(index: usize, plate: &Plate) -> Body {
    let half = plate.thickness_m / 2.0;
    let centre = Point3::new(plate.x_m, plate.y_m, plate.z_m - half);
    let frame = Frame::base().offset(&Rigid::from(&Pose::translation(centre.x, centre.y, centre.z)));
    let part = Part::cylinder(plate.radius_m, half, frame);
    body(&format!("plate {index}"), BodyKind::Plate(index), part)
}

/// A quarter turn that lays parry's cylinder (along y) along z.
const Y_TO_Z: f64 = FRAC_PI_2;

#[cfg(test)]
mod tests;
