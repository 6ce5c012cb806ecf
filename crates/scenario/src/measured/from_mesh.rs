//! Plate of a mesh.

use crate::measured::axis::Frame;
use crate::measured::body::{Body, Extremes, Ruler};
use crate::measured::bounds::MOST_DEVIATION_M;
use crate::measured::error::MeasuredError;
use crate::measured::face::{Heights, check_slope, relief};
use crate::measured::file::File;
use crate::measured::knots::{Profile, RINGS, rings};
use crate::measured::mesh::{Fit, Mesh, SECTORS};
use crate::measured::plate::{MeasuredPlate, out_of_round_m, smooth_enough};
use crate::measured::profile_fit::{FIRST_KNOTS, sparing};
use crate::measured::side::{FLAT, FaceSide, Side};
use crate::measured::unit::Unit;
use nalgebra::{Point3, Vector3};

/// Width of the rim in which facets that fall steeply belong to the lip \[m\].
const LIP_M: f64 = 3e-3;

/// Difference of deviations, beyond twice the lesser one, from which on the smoother side of a flat plate fits better \[m\].
const CLEARLY_M: f64 = 2e-4;

/// Number of rings with vertices from which on, and deviation \[m\] up to which, the vertices tell the profile well.
const ENOUGH_RINGS: usize = RINGS / 4;
const WELL_M: f64 = 1e-4;

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
        unit: Unit::determine(unit, 2.0 * reaches[0])?,
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
    let side = |k: usize| FaceSide::along(&frames[k].axis());
    let (k, is_sure) = match Side::new(stated, &frames[0].axis(), rise_m - fall_m, rim_m) {
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
    let upper = Heights::from_triangles(face.facets.iter().map(|t| local(t, &frame)), rim_m, 1.0);
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
    let upper = Heights::from_triangles(face.facets.iter().map(|t| local(t, &frame)), rim_m, 1.0);
    let all = || mesh.triangles.iter().map(|t| local(t, &frame));
    let mut plate = file.plate(&frame, surface, &extremes, relief(&surface, Some(&upper), None));
    plate.out_of_round_m = out_of_round_m(face.facets.iter().flat_map(|t| local(t, &frame)), &surface);
    let mut plate = smooth_enough(plate)?;
    // Every triangle counts, whether it belongs to the face or not.
    let body = Body::from_facets(&ruler, all());
    if body.above.0 > MOST_DEVIATION_M {
        let (height_m, place) = (body.above.0, file.place(&frame, &body.above.1));
        return Err(MeasuredError::StandsUp { height_m, place });
    }
    if mesh.is_closed(&frame.axis()) {
        let (thickness_m, foot) = body.thickness_and_foot(&surface);
        let lower = Heights::from_triangles(all(), rim_m, -1.0);
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
