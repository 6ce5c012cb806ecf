//! Convex parts that enclose the body of a profile plate together.
//!
//! The body is all that lies at most the thickness below the face, along the axis or along the normal, whichever reaches farther, and
//! within the radius of the rim; below the foot's circle it goes on down to where the foot stands. Its parts, each of which a convex
//! routine can judge:
//!
//! - a cylinder about the axis, where the face is nearly level;
//! - beyond it the turn about the axis is cut into sectors, all alike, of half an angle α to each side; a sector is cut into pieces along the
//!   meridian.
//!
//! In the half-plane of the meridian a piece of it is an arc or a line between two points. Where it is hollow it lies below its chord,
//! where it is domed below its two tangents: a triangle of both ends and the corner where the tangents meet holds it. Lowered by h
//! these points close a polygon. With t the thickness and β_max the steepest slope within t of the piece, h = t/cos β_max holds what
//! lies along the normal, too: from the point at ρ it lies above ρ′ = ρ + s sin β, s ≤ t, where the face has risen by at most
//! (ρ′ − ρ) tan β_max, so that it is at most s (sin β tan β_max + cos β) = s cos(β − β_max)/cos β_max below the face.
//!
//! Turned by ±α a corner at ρ runs along a circular arc, which lies within the triangle of its two ends and ρ/cos α on the middle. Each
//! point of the sector is a mean of corners turned alike, so that the hull of all these triangles holds it.
//!
//! What parts hold above the face, all as a share of the rim's radius: where the meridian bends [`BEND`]; where the face is hollow across
//! the meridian ρ (1 − cos α) sin β ≤ [`TURN`]; over the middle [`WELL`]. Beyond the rim they reach [`BEYOND`] at most.

use crate::plate::placed_plate::Plate;
use crate::surface::{Knot, MeridianPoint, Surface};
use nalgebra::{Point3, Quaternion, UnitQuaternion};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::trig::{cos, sin, sin_cos};
use std::f64::consts::PI;

/// Greatest height of a chord of the meridian above its arc, as a share of the rim's radius.
const BEND: f64 = 1e-3;

/// Greatest height of a chord across the meridian above the face, along its normal, as a share of the rim's radius.
const TURN: f64 = 2e-3;

/// Greatest range of heights of the middle of the face that one cylinder holds, as a share of the rim's radius.
const WELL: f64 = 2e-3;

/// Greatest distance of the corners of a sector beyond the rim, as a share of the rim's radius.
const BEYOND: f64 = 5e-3;

impl Plate {
    /// Returns the cylinder that encloses the whole body, and its pose, world frame.
    #[must_use]
    pub fn enclosure(&self) -> (Shape, Pose) {
        let (shape, pose) = self.enclosure_here();
        (shape, self.pose * pose)
    }

    /// Same as [`Plate::enclosure`], plate frame.
    fn enclosure_here(&self) -> (Shape, Pose) {
        upright_cylinder(self.outer_m(), self.extent_m())
    }

    /// Returns convex shapes with their poses, world frame, that together enclose the body ([`PlateParts`]).
    #[must_use]
    pub fn bodies(&self) -> Vec<(Shape, Pose)> {
        let placed = |(shape, pose)| (shape, self.pose * pose);
        PlateParts::new(self).all().map(placed).collect()
    }
}

/// Convex parts of a plate, plate frame.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateParts {
    /// Cylinder that holds all parts.
    pub whole: (Shape, Pose),
    /// Parts that occur once.
    pub single: Vec<(Shape, Pose)>,
    /// Parts of one sector.
    pub sector: Vec<(Shape, Pose)>,
    /// Rotations of that sector about the axis, one for each copy.
    pub turns: Vec<UnitQuaternion<f64>>,
}

impl PlateParts {
    /// Returns the parts of a plate; a flat one is one cylinder.
    #[must_use]
    pub fn new(plate: &Plate) -> Self {
        match plate.surface {
            Surface::Disc { .. } => Self {
                whole: plate.enclosure_here(),
                single: vec![plate.enclosure_here()],
                sector: Vec::new(),
                turns: Vec::new(),
            },
            Surface::Profile(_) => Self::of_profile(plate),
        }
    }

    /// Returns all parts, plate frame.
    pub fn all(&self) -> impl Iterator<Item = (Shape, Pose)> {
        let sectors = self.turns.iter().flat_map(|turn| {
            let turned = move |(shape, pose): &(Shape, Pose)| (shape.clone(), turn * pose);
            self.sector.iter().map(turned)
        });
        self.single.iter().cloned().chain(sectors)
    }

    fn of_profile(plate: &Plate) -> Self {
        let (rim_m, grown_m) = (plate.rim_m(), plate.deviation_m());
        let mut pieces = pieces(plate);
        let (mut well_m, mut heights) = (0.0, [f64::INFINITY, f64::NEG_INFINITY]);
        let mut bottom_m = f64::INFINITY;
        let mut held = 0;
        for piece in &pieces {
            let [low, high] = piece.top_bounds();
            let both = [heights[0].min(low), heights[1].max(high)];
            if both[1] - both[0] > WELL * rim_m {
                break;
            }
            heights = both;
            well_m = piece.to_m;
            bottom_m = bottom_m.min(piece.bottom_m());
            held += 1;
        }
        pieces.drain(..held);
        let well_m = if pieces.is_empty() { well_m + grown_m } else { well_m };
        let single = (held > 0).then(|| upright_cylinder(well_m, [bottom_m - grown_m, heights[1] + grown_m]));
        pieces.iter_mut().for_each(|piece| piece.grow(grown_m));
        let half = half_angle(&plate.surface);
        let count = (PI / half).ceil();
        let half = PI / count;
        let all = pieces.iter().flat_map(|piece| piece.corners.iter());
        let [low, high] = all.fold([bottom_m - grown_m, heights[1] + grown_m], |[low, high], &[_, z]| {
            [low.min(z), high.max(z)]
        });
        let reach_m = if pieces.is_empty() {
            well_m
        } else {
            plate.outer_m() / cos(half)
        };
        let turns = if pieces.is_empty() { 0 } else { count as usize };
        Self {
            whole: upright_cylinder(reach_m, [low, high]),
            single: single.into_iter().collect(),
            sector: pieces.iter().map(|piece| piece.hull(half)).collect(),
            turns: (0..turns).map(|k| about_axis(2.0 * half * k as f64)).collect(),
        }
    }
}

/// Piece of the body, in the half-plane of the meridian.
struct Piece {
    /// Radius ρ of the far end \[m\].
    to_m: f64,
    /// Corners as ρ and z, those of the face first \[m\].
    corners: Vec<[f64; 2]>,
    /// Number of corners that bound the face.
    tops: usize,
}

impl Piece {
    /// Returns the piece between two points of an arc or a line, lowered by `deep_m` and at least down to `down_to_m`.
    fn between([from, to]: [&MeridianPoint; 2], deep_m: f64, down_to_m: f64) -> Self {
        let ends = [from, to].map(|p| [p.radius_m, p.height_m]);
        let mut tops = vec![ends[0]];
        let mut below = vec![ends[0]];
        if let Some(corner) = corner(from, to) {
            let bound = if from.curvature < 0.0 { &mut tops } else { &mut below };
            bound.push(corner);
        }
        tops.push(ends[1]);
        below.push(ends[1]);
        let count = tops.len();
        let lowered = below.into_iter().map(|[rho, z]| [rho, (z - deep_m).min(down_to_m)]);
        let mut corners = tops;
        corners.extend(lowered);
        Self {
            to_m: to.radius_m,
            corners,
            tops: count,
        }
    }

    /// Grows the piece on all sides, as the real plate deviates from its shape \[m\].
    fn grow(&mut self, by_m: f64) {
        if by_m > 0.0 {
            let around = |&[rho, z]: &[f64; 2]| {
                [-by_m, by_m].map(|out_m| [-by_m, by_m].map(|up_m| [(rho + out_m).max(0.0), z + up_m]))
            };
            self.corners = self.corners.iter().flat_map(around).flatten().collect();
        }
    }

    /// Least and greatest height of the corners of the face \[m\].
    fn top_bounds(&self) -> [f64; 2] {
        let tops = self.corners[..self.tops].iter();
        tops.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &[_, z]| {
            [low.min(z), high.max(z)]
        })
    }

    /// Lowest height \[m\].
    fn bottom_m(&self) -> f64 {
        self.corners.iter().map(|&[_, z]| z).fold(f64::INFINITY, f64::min)
    }

    /// Returns the hull of the piece turned about the axis by `half` to each side of x \[rad\], relative to its own middle.
    fn hull(&self, half: f64) -> (Shape, Pose) {
        let (s, c) = sin_cos(half);
        let turned = |&[rho, z]: &[f64; 2]| {
            let ends = [[rho * c, rho * s, z], [rho * c, -rho * s, z], [rho / c, 0.0, z]];
            ends.into_iter().take(if rho > 0.0 { 3 } else { 1 })
        };
        let points: Vec<[f64; 3]> = self.corners.iter().flat_map(turned).collect();
        let bounds = |axis: usize| {
            let along = points.iter().map(|p| p[axis]);
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            })
        };
        let [x, z] = [0, 2].map(|axis| {
            let [low, high] = bounds(axis);
            0.5 * (low + high)
        });
        let points = points.iter().map(|p| Point3::new(p[0] - x, p[1], p[2] - z)).collect();
        (Shape::Hull { points }, Pose::translation(x, 0.0, z))
    }
}

/// Intersection of the tangents at both ends of an arc \[m\]; `None` for a line.
fn corner(from: &MeridianPoint, to: &MeridianPoint) -> Option<[f64; 2]> {
    if from.curvature == 0.0 {
        return None;
    }
    let chord = [to.radius_m - from.radius_m, to.height_m - from.height_m];
    // The chord leads half-way between both slopes, and each leg is half of it over the cosine of half the turn θ.
    let turn_cosine = from.cosine * to.cosine + from.sine * to.sine;
    let half_cosine = (0.5 * (1.0 + turn_cosine)).sqrt();
    let leg = 0.5 * (chord[0] * chord[0] + chord[1] * chord[1]).sqrt() / half_cosine;
    Some([from.radius_m + leg * from.cosine, from.height_m + leg * from.sine])
}

/// Returns the pieces of the body from the pole to the rim.
fn pieces(plate: &Plate) -> Vec<Piece> {
    let (surface, rim_m, thickness_m) = (&plate.surface, plate.rim_m(), plate.thickness_m);
    let Surface::Profile(meridian) = surface else {
        return Vec::new();
    };
    let foot = plate.foot.filter(|foot| foot.height_m > 0.0);
    let mut radii: Vec<f64> = meridian.knots().iter().map(|knot| knot.radius_m).collect();
    if let Some(foot) = foot.filter(|foot| foot.radius_m < rim_m) {
        radii.push(foot.radius_m);
        radii.sort_unstable_by(f64::total_cmp);
        radii.dedup();
    }
    let mut all = Vec::new();
    let mut from_m = 0.0;
    for to_m in radii {
        let from = surface.at_radius(from_m);
        let curvature = from.curvature.abs();
        let turn = curvature * (surface.arc_at(to_m) - surface.arc_at(from_m));
        // A chord over an angle θ is θ²/(8κ) off its arc.
        let parts = (turn / (8.0 * BEND * rim_m * curvature).sqrt()).ceil();
        let parts = if curvature > 0.0 { parts.clamp(1.0, 64.0) } else { 1.0 };
        let at = |k: f64| {
            // The end itself, whatever is rounded.
            let radius_m = if k < parts {
                from_m + (to_m - from_m) * (k / parts)
            } else {
                to_m
            };
            let sine = from.sine + from.curvature * (radius_m - from_m);
            MeridianPoint {
                radius_m,
                height_m: surface.height_m(radius_m),
                sine,
                cosine: (1.0 - sine * sine).max(0.0).sqrt(),
                curvature: from.curvature,
            }
        };
        for k in 0..parts as usize {
            let ends = [at(k as f64), at((k + 1) as f64)];
            let around = [
                (ends[0].radius_m - thickness_m).max(0.0),
                (ends[1].radius_m + thickness_m).min(rim_m),
            ];
            let deep_m = thickness_m / surface.patch(around).least_cosine();
            let stands = foot.filter(|foot| ends[1].radius_m <= foot.radius_m);
            let down_to_m = stands.map_or(f64::INFINITY, |foot| -thickness_m - foot.height_m);
            all.push(Piece::between([&ends[0], &ends[1]], deep_m, down_to_m));
        }
        from_m = to_m;
    }
    all
}

/// Half the angle of a sector \[rad\]: 1 − cos α ≤ α²/2 and 1/cos α − 1 ≤ α²/2 · 1.01 for α ≤ 0.1.
fn half_angle(surface: &Surface) -> f64 {
    let rim_m = surface.rim_m();
    let Surface::Profile(meridian) = surface else {
        return PI;
    };
    // ρ |sin β|, from above.
    let pole = Knot {
        radius_m: 0.0,
        slope_rad: 0.0,
    };
    let starts = [&pole].into_iter().chain(meridian.knots());
    let steepest = starts.zip(meridian.knots()).map(|(from, to)| {
        let slope_rad = from.slope_rad.abs().max(to.slope_rad.abs());
        to.radius_m * sin(slope_rad)
    });
    let steepest = steepest.fold(0.0, f64::max) / rim_m;
    let across = (2.0 * TURN / steepest.max(f64::MIN_POSITIVE)).sqrt();
    across.min((2.0 * BEYOND / 1.01).sqrt())
}

/// Rotation about the axis by an angle \[rad\].
fn about_axis(angle: f64) -> UnitQuaternion<f64> {
    let (s, c) = sin_cos(0.5 * angle);
    UnitQuaternion::new_unchecked(Quaternion::new(c, 0.0, 0.0, s))
}

/// Cylinder about the axis between two heights \[m\].
fn upright_cylinder(radius_m: f64, [low, high]: [f64; 2]) -> (Shape, Pose) {
    let shape = Shape::Cylinder {
        radius_m,
        half_length_m: (high - low) / 2.0,
    };
    (shape, Pose::translation(0.0, 0.0, (high + low) / 2.0))
}
