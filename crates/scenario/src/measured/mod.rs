//! Plate from measurements: a mesh of its surface, such as a scan or a drawing, or points touched on its face with a probe.
//!
//! The face is the side that is stated, otherwise the one that rises towards its rim; of a flat plate the one that looks along the file's z. It ends at the lip, where it
//! falls outwards by more than 45°, or at the greatest radius. Its profile is fitted to the vertices, or where these have few radii to the whole surface. The deviation is measured between the
//! vertices, too, and is an upper bound; of points it is that at the points, and nothing is known between them. The pole is put so that the
//! face is as far above its profile as below it: a dent of 1 mm is a deviation of 0.5 mm.
//!
//! A mesh is a body if it is closed, but for holes of 1 % of its area. Facets must be wound alike, all to the outside or all to the
//! inside; a mirror image does no harm, nor does any placement in the file. Holes in the face narrower than about 3 % of its radius, and those
//! within 2 mm of its rim, are not seen.
//!
//! | concept | file |
//! | --- | --- |
//! | unit of the file, points as text | `unit` |
//! | equal corners joined; sides of a mesh, its face | `mesh` |
//! | side that is the face | `side` |
//! | axis | `axis`, `algebra` |
//! | knots of the profile | `knots` |
//! | heights on a grid: holes, picture | `face` |
//! | probed points | `points` |
//! | deviation, thickness, foot | `body` |
//! | errors | `error` |

mod algebra;
mod axis;
mod body;
mod error;
mod face;
mod knots;
mod mesh;
mod points;
mod side;
mod unit;

pub use crate::measured::error::{MeasuredError, Place};
pub use crate::measured::face::Relief;
pub use crate::measured::points::{LEAST_POINTS, from_ball_centres, from_points};
pub use crate::measured::side::FaceSide;
pub use crate::measured::unit::{Unit, probe_points};

use crate::measured::axis::{Fitted, Frame};
use crate::measured::body::{Body, Extremes, Ruler};
use crate::measured::face::{Heights, check_slope, relief};
use crate::measured::knots::{Profile, RINGS, rings};
use crate::measured::mesh::{Fit, Mesh, SECTORS};
use crate::measured::side::{FLAT, Side};
use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::trig::atan2;
use platewash_workcell::plate::Foot;
use platewash_workcell::surface::Surface;

/// Greatest deviation of a plate from its profile \[m\]. Chipped and bent plates are refused.
pub const MOST_DEVIATION_M: f64 = 2e-3;

/// Least diameter of a plate \[m\].
pub const LEAST_PLATE_M: f64 = 0.02;

/// Greatest diameter of a plate \[m\].
pub const MOST_PLATE_M: f64 = 1.0;

/// Length below which differences of heights do not matter \[m\].
const NOISE_M: f64 = 1e-5;

/// Width of the rim in which facets that fall steeply belong to the lip \[m\].
const LIP_M: f64 = 3e-3;

/// Difference of deviations, beyond twice the lesser one, from which on the smoother side of a flat plate fits better \[m\].
const CLEARLY_M: f64 = 2e-4;

/// Number of rings with vertices from which on, and deviation \[m\] up to which, the vertices tell the profile well.
const ENOUGH_RINGS: usize = RINGS / 4;
const WELL_M: f64 = 1e-4;

/// Number of rings in which a face is compared with its mean height.
const ROUND_RINGS: usize = 72;

/// Number of knots, at equal distances, of the profile while the axis is sought.
const FIRST_KNOTS: usize = 16;

/// Plate from measurements.
#[derive(Debug, Clone)]
pub struct MeasuredPlate {
    /// Fitted face.
    pub surface: Surface,
    /// Thickness along the axis \[m\]; `None` if only the face was measured.
    pub thickness_m: Option<f64>,
    /// Depth below the face to which the mesh of a face reaches, at a lip or elsewhere \[m\]; 0 if the body was measured. A plate is no thinner.
    pub least_thickness_m: f64,
    /// Foot, if the body was measured and has one.
    pub foot: Option<Foot>,
    /// Pose in the file in metres, `T_file_plate`: origin at the pole, z along the axis out of the face, x as near the file's as can be.
    pub pose: Pose,
    /// Unit of the file.
    pub unit: Unit,
    /// True if the unit was not stated.
    pub unit_is_guessed: bool,
    /// Greatest distance, along the axis, of the measured face from `surface`, or if greater that of the mesh from the body \[m\].
    pub deviation_m: f64,
    /// Place of the greatest deviation.
    pub worst: Place,
    /// Greatest difference of the face from the mean height at its radius \[m\].
    pub out_of_round_m: f64,
    /// Heights for pictures. Of probed points they are those of `surface`.
    pub relief: Relief,
}

/// True for a number that a coordinate can be; false for NaN.
fn is_coordinate(c: f64) -> bool {
    c.abs() <= 1e9
}

/// Measurement in metres about its middle, with what converts back.
struct File {
    middle: Vector3<f64>,
    unit: Unit,
    unit_is_guessed: bool,
}

impl File {
    fn place(&self, frame: &Frame, local: &Vector3<f64>) -> Place {
        let in_file = self.middle + frame.outside(local) / self.unit.length_m();
        Place {
            radius_m: local.xy().norm(),
            azimuth_deg: atan2(local.y, local.x).to_degrees(),
            in_file: in_file.into(),
        }
    }

    fn pose(&self, frame: &Frame) -> Pose {
        let rotation = Rotation3::from_matrix_unchecked(frame.turn.transpose());
        let origin = self.middle * self.unit.length_m() + frame.origin;
        Pose::from_parts(origin.into(), UnitQuaternion::from_rotation_matrix(&rotation))
    }

    /// Returns the plate without a body. `extremes` are about the profile before it is raised to their middle.
    fn plate(&self, frame: &Frame, surface: Surface, extremes: &Extremes, relief: Relief) -> MeasuredPlate {
        let [high_m, low_m] = [extremes.high.0, extremes.low.0];
        // Both are as far off; the place is that which was farther from the mean.
        let farthest = if high_m > -low_m {
            extremes.high.1
        } else {
            extremes.low.1
        };
        MeasuredPlate {
            surface,
            thickness_m: None,
            least_thickness_m: 0.0,
            foot: None,
            pose: self.pose(frame),
            unit: self.unit,
            unit_is_guessed: self.unit_is_guessed,
            deviation_m: 0.5 * (high_m - low_m),
            worst: self.place(frame, &(farthest - Vector3::z() * extremes.middle_m())),
            out_of_round_m: 0.0,
            relief,
        }
    }
}

/// Returns the plate of a mesh. The order of the triangles does not matter. Without a unit it is the one in which the diameter is from 145 mm
/// to 365 mm. Without a side the face is the one that rises to its rim, and of a flat plate the one towards the file's +z.
///
/// # Errors
/// [`MeasuredError`]: a mesh that is no round plate, has holes in its face, deviates by more than [`MOST_DEVIATION_M`], or does not tell which
/// side is the face.
pub fn from_mesh(
    triangles: &[[Point3<f64>; 3]],
    unit: Option<Unit>,
    face: Option<FaceSide>,
) -> Result<MeasuredPlate, MeasuredError> {
    let mut mesh = Mesh::new(triangles)?;
    let moments = mesh.moments();
    let axes = moments.spread.map(|(_, axis)| axis);
    let reach = |axis: &Vector3<f64>, middle: &Vector3<f64>| {
        let beside = |point: &Vector3<f64>| (point - middle).cross(axis).norm();
        mesh.points.iter().map(beside).fold(0.0, f64::max)
    };
    let reaches = [0, 2].map(|k| reach(&axes[k], &moments.middle));
    let file = File {
        middle: mesh.middle,
        unit: Unit::of(unit, 2.0 * reaches[0])?,
        unit_is_guessed: unit.is_none(),
    };
    let length_m = file.unit.length_m();
    mesh.scale(length_m);
    let mut refused = None;
    // Of a tall cup, the axis is the direction in which it is longest.
    for (axis, reach) in [0, 2].map(|k| axes[k]).into_iter().zip(reaches) {
        let frames = [1.0, -1.0].map(|side| Frame::new(&(axis * side), moments.middle * length_m));
        match of_side(&mesh, &file, frames, reach * length_m, face) {
            Ok(plate) => return Ok(plate),
            Err(why) => {
                let is_round = !matches!(why, MeasuredError::NotRound { .. });
                if refused.is_none() || matches!(why, MeasuredError::Steep { .. }) {
                    refused = Some(why);
                }
                if is_round {
                    break;
                }
            }
        }
    }
    Err(refused.unwrap_or(MeasuredError::Empty))
}

/// Returns the plate of the side that is the face, of the two whose axes are z of the frames, roughly.
fn of_side(
    mesh: &Mesh,
    file: &File,
    frames: [Frame; 2],
    rim_m: f64,
    stated: Option<FaceSide>,
) -> Result<MeasuredPlate, MeasuredError> {
    let [rise_m, fall_m] = [0, 1].map(|k| mesh.rise_m(&frames[k], rim_m));
    let found = |k: usize| of_face(mesh, file, frames[k], rim_m);
    let side = |k: usize| FaceSide::of(&frames[k].axis());
    let (k, is_sure) = match Side::of(stated, &frames[0].axis(), rise_m - fall_m, rim_m) {
        Side::Stated(k) => return found(k),
        Side::Rising(k) => {
            // A high ring near the rim, on which a flat plate stands, seems to be a rim.
            let is_upper = frames[1 - k].axis().z > 0.0;
            let is_flat = |plate: &MeasuredPlate| plate.surface.height_m(plate.surface.rim_m()) > -FLAT * rim_m;
            let other = || found(1 - k).ok().filter(is_flat);
            return found(k).or_else(|why| is_upper.then(other).flatten().ok_or(why));
        }
        Side::Across(off_deg) => return Err(MeasuredError::across(stated, off_deg)),
        // That it is no plate is told first.
        Side::Level => {
            found(0).or_else(|_| found(1))?;
            return Err(MeasuredError::level([side(0), side(1)]));
        }
        Side::Upper(k) => (k, true),
        Side::UpperIfAlone(k) => (k, false),
    };
    let sides = [side(k), side(1 - k)];
    // A side with a foot ring rises, too, but its profile does not fit well.
    let is_rougher = |a: &MeasuredPlate, b: &MeasuredPlate| a.deviation_m > 2.0 * b.deviation_m + CLEARLY_M;
    match (found(k), found(1 - k)) {
        (Ok(plate), Ok(other)) if !is_sure && !is_rougher(&other, &plate) => Err(MeasuredError::rising(sides)),
        (Ok(plate), Ok(other)) if is_rougher(&plate, &other) => {
            Err(MeasuredError::smoother(sides, [plate.deviation_m, other.deviation_m]))
        }
        (Err(why), Ok(_)) => Err(MeasuredError::OtherSide {
            why: Box::new(why),
            tried: sides[0],
            other: sides[1],
        }),
        (answer, _) => answer,
    }
}

/// Returns the plate whose face looks along z of a frame, roughly. Its profile is fitted to the vertices, which lie on the plate. Where these
/// have few radii, or tell no plate, the whole surface may tell it better.
fn of_face(mesh: &Mesh, file: &File, frame: Frame, rim_m: f64) -> Result<MeasuredPlate, MeasuredError> {
    let by_vertices = by_fit(mesh, file, frame, rim_m, Fit::Vertices);
    let is_sure = |(plate, rings): &(MeasuredPlate, usize)| *rings >= ENOUGH_RINGS || plate.deviation_m <= WELL_M;
    if by_vertices.as_ref().is_ok_and(is_sure) {
        return by_vertices.map(|(plate, _)| plate);
    }
    match (by_vertices, by_fit(mesh, file, frame, rim_m, Fit::Surface)) {
        (Ok((plate, _)), Ok((other, _))) if other.deviation_m < plate.deviation_m => Ok(other),
        (Err(_), Ok((other, _))) => Ok(other),
        (answer, _) => answer.map(|(plate, _)| plate),
    }
}

/// Returns the plate with its profile fitted to the vertices or to the surface, and the number of rings that hold what is fitted.
fn by_fit(
    mesh: &Mesh,
    file: &File,
    mut frame: Frame,
    rim_m: f64,
    fit: Fit,
) -> Result<(MeasuredPlate, usize), MeasuredError> {
    let mut profile = Profile::level(rim_m, FIRST_KNOTS);
    let mut face = mesh.face(&frame, fit);
    for _ in 0..2 {
        let fitted = face.fitted()?;
        profile = Profile::level(fitted.rim_m(&frame), FIRST_KNOTS);
        fitted.refine(&mut frame, &mut profile, 20, |points, profile| {
            profile.fitted(&rings(points, profile.rim_m()), false, 4)
        });
        face = mesh.face(&frame, fit);
    }
    let fitted = face.fitted()?;
    let rim_m = fitted.rim_m(&frame);
    let radii = face.rim.iter().map(|point| frame.local(point).xy().norm());
    let off_round = radii
        .clone()
        .filter(|rho| (rho - rim_m).abs() > MOST_DEVIATION_M)
        .count();
    // A bite out of the rim is a part that is missing.
    if 4 * off_round > SECTORS.min(face.rim.len()) {
        let by_radius = |a: &Vector3<f64>, b: &Vector3<f64>| a.xy().norm().total_cmp(&b.xy().norm());
        let all = || face.rim.iter().map(|point| frame.local(point));
        let [least, most] = [all().min_by(by_radius), all().max_by(by_radius)].map(Option::unwrap_or_default);
        let rim_m = [least.xy().norm(), most.xy().norm()];
        let place = file.place(&frame, &least);
        return Err(MeasuredError::NotRound { rim_m, place });
    }
    let local = |t: &[u32; 3], frame: &Frame| t.map(|k| frame.local(&mesh.points[k as usize]));
    let upper = Heights::of(face.facets.iter().map(|t| local(t, &frame)), rim_m, 1.0);
    // That it is not round is told first; a steep wall leaves gaps.
    let means = rings(&fitted.placed(&frame), rim_m);
    match upper.check_whole(rim_m, |point| file.place(&frame, point)) {
        Err(why @ MeasuredError::NotRound { .. }) => return Err(why),
        whole => check_slope(&means, rim_m).and(whole)?,
    }
    let profile = sparing(&fitted, &mut frame, &profile, rim_m);
    let surface = profile.surface().ok_or(MeasuredError::Empty)?;
    let frame = frame.raised(profile.level_m());
    let ruler = Ruler::new(surface);
    let mut extremes = Extremes::new();
    let inner_m = rim_m - LIP_M;
    let is_edge = |t: &[u32; 3]| local(t, &frame).iter().any(|corner| corner.xy().norm() > inner_m);
    face.facets.retain(|t| !(mesh.is_lip(t, &frame) && is_edge(t)));
    face.facets
        .iter()
        .for_each(|t| extremes.see_facet(&ruler, local(t, &frame)));
    let frame = frame.raised(extremes.middle_m());
    let upper = Heights::of(face.facets.iter().map(|t| local(t, &frame)), rim_m, 1.0);
    let all = || mesh.triangles.iter().map(|t| local(t, &frame));
    let mut plate = file.plate(&frame, surface, &extremes, relief(&surface, Some(&upper), None));
    plate.out_of_round_m = out_of_round_m(face.facets.iter().flat_map(|t| local(t, &frame)), &surface);
    let mut plate = smooth_enough(plate)?;
    // Every triangle counts, whether it belongs to the face or not.
    let body = Body::of(&ruler, all());
    if body.above.0 > MOST_DEVIATION_M {
        let (height_m, place) = (body.above.0, file.place(&frame, &body.above.1));
        return Err(MeasuredError::StandsUp { height_m, place });
    }
    if mesh.is_closed(&frame.axis()) {
        let (thickness_m, foot) = body.thickness_and_foot(&surface);
        let lower = Heights::of(all(), rim_m, -1.0);
        plate.relief = relief(&surface, Some(&upper), Some((&lower, thickness_m)));
        (plate.thickness_m, plate.foot) = (Some(thickness_m), foot);
    } else {
        plate.least_thickness_m = body.depth_m();
    }
    for (off_m, at) in [body.beyond, body.above] {
        if off_m > plate.deviation_m {
            (plate.deviation_m, plate.worst) = (off_m, file.place(&frame, &at));
        }
    }
    Ok((smooth_enough(plate)?, means.len()))
}

/// Returns the profile with as few knots as the points ask for, and moves the frame to its axis.
fn sparing(fitted: &Fitted<'_>, frame: &mut Frame, profile: &Profile, rim_m: f64) -> Profile {
    let found = |frame: &Frame, profile: &Profile| Profile::sparing(&rings(&fitted.kept(frame, profile), rim_m), rim_m);
    let mut profile = found(frame, profile);
    fitted.refine(frame, &mut profile, 20, |points, profile| {
        profile.fitted(&rings(points, rim_m), false, 4)
    });
    found(frame, &profile)
}

/// Greatest difference of points of a face, plate frame, from the mean at their radius \[m\].
fn out_of_round_m(points: impl Iterator<Item = Vector3<f64>>, surface: &Surface) -> f64 {
    let mut sums = vec![[0.0; 2]; ROUND_RINGS];
    let ring = |rho: f64| ((rho / surface.rim_m() * ROUND_RINGS as f64) as usize).min(ROUND_RINGS - 1);
    let off = |point: Vector3<f64>| {
        let rho = point.xy().norm();
        (ring(rho), point.z - surface.height_m(rho))
    };
    let all: Vec<_> = points.map(off).collect();
    for (ring, off) in &all {
        sums[*ring] = [sums[*ring][0] + 1.0, sums[*ring][1] + off];
    }
    let apart = all
        .iter()
        .map(|(ring, off)| (off - sums[*ring][1] / sums[*ring][0]).abs());
    apart.fold(0.0, f64::max)
}

/// Refuses a rough plate.
fn smooth_enough(plate: MeasuredPlate) -> Result<MeasuredPlate, MeasuredError> {
    let (deviation_m, place) = (plate.deviation_m, plate.worst);
    match deviation_m <= MOST_DEVIATION_M {
        true => Ok(plate),
        false => Err(MeasuredError::Rough { deviation_m, place }),
    }
}
