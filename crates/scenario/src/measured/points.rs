//! Plate whose face was touched in points.

use crate::measured::algebra::{Moments, median};
use crate::measured::axis::{Cloud, Fitted, Frame};
use crate::measured::body::{Extremes, Ruler};
use crate::measured::bounds::{MOST_DEVIATION_M, is_coordinate};
use crate::measured::error::{MeasuredError, Place};
use crate::measured::face::{check_slope, outermost, relief};
use crate::measured::file::File;
use crate::measured::knots::{Profile, rings};
use crate::measured::plate::{MeasuredPlate, out_of_round_m, smooth_enough};
use crate::measured::profile_fit::{FIRST_KNOTS, sparing};
use crate::measured::side::{FaceSide, Side};
use crate::measured::unit::Unit;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::trig::{atan2, sin_cos};
use platewash_workcell::words::millimetres;
use std::f64::consts::{PI, TAU};

/// Least number of probed points.
pub const LEAST_POINTS: usize = 12;

/// Slope, root mean square, below which a face does not fix its centre.
const FLAT_SLOPE: f64 = 0.02;

/// Greatest standard deviation of the centre of probed points, and greatest difference of their rim's radius if it fixes the centre \[m\].
const UNSURE_M: f64 = 1e-3;

/// Number of sectors in which the outermost probed point is sought.
const POINT_SECTORS: usize = 12;

/// Number of sectors whose outermost points tell the radius of the rim, and greatest difference of the azimuths of points on it \[rad\].
const RIM_SECTORS: usize = 8;
const RIM_GAP: f64 = 0.875;

/// Greatest number of searches for knots and axis, and movement of the frame below which they are found \[m\].
const MOST_SEARCHES: usize = 6;
const STILL_M: f64 = 2e-6;

/// Greatest gap between the radii of probed points, as a share of the rim's, and between their azimuths \[rad\].
const RADIUS_GAP: f64 = 0.4;
const AZIMUTH_GAP: f64 = 1.75;

/// Number of times that the points of a face are found from the centres of a ball, each with the normals found before.
const BALL_ROUNDS: usize = 4;

/// Returns the plate whose face was touched with a ball of a radius \[m\], from the places of its centre: these lie on a surface that is as far
/// from the face all over. Its normals are those of the face.
///
/// # Errors
/// As [`from_points`].
pub fn from_ball_centres(
    centres: &[Point3<f64>],
    radius_m: f64,
    unit: Option<Unit>,
    face: Option<FaceSide>,
) -> Result<MeasuredPlate, MeasuredError> {
    let mut plate = from_points(centres, unit, face)?;
    let (unit, unit_is_guessed) = (plate.unit, plate.unit_is_guessed);
    let mut touched = centres.to_vec();
    for _ in 0..BALL_ROUNDS {
        for (point, centre) in touched.iter_mut().zip(centres) {
            let local = plate.pose.inverse_transform_point(&(*point * unit.length_m()));
            let rho_m = local.xy().coords.norm().min(plate.surface.rim_m());
            let normal = plate.surface.normal(rho_m, atan2(local.y, local.x)).into_inner();
            *point = centre - plate.pose.rotation * normal * (radius_m / unit.length_m());
        }
        plate = from_points(&touched, Some(unit), face)?;
    }
    Ok(MeasuredPlate {
        unit_is_guessed,
        ..plate
    })
}

/// Returns the plate whose face was touched in points. Its rim is at the outermost one: touch the rim all round.
///
/// # Errors
/// [`MeasuredError`]: too few points, points that fix no axis or no profile, whose outermost ones are on no circle, or that deviate by more than [`MOST_DEVIATION_M`].
pub fn from_points(
    points: &[Point3<f64>],
    unit: Option<Unit>,
    face: Option<FaceSide>,
) -> Result<MeasuredPlate, MeasuredError> {
    if points.len() < LEAST_POINTS {
        let (found, least) = (points.len(), LEAST_POINTS);
        return Err(MeasuredError::Few { found, least });
    }
    if let Some(index) = points.iter().position(|p| p.iter().any(|c| !is_coordinate(*c))) {
        let (what, found) = ("point", points[index].coords.into());
        return Err(MeasuredError::Coordinate { what, index, found });
    }
    let moments = Moments::from_points(|| points.iter().map(|point| (point.coords, 1.0)));
    let [_, (beside, _), (along, _)] = moments.spread;
    if beside <= 0.01 * along {
        let why = "they lie in one line; touch the whole face, and the rim all round".to_owned();
        return Err(MeasuredError::NoAxis { why });
    }
    let axis = moments.spread[0].1;
    let beside = |point: &Point3<f64>| (point.coords - moments.middle).cross(&axis).norm();
    let reach = points.iter().map(beside).fold(0.0, f64::max);
    let file = File {
        middle: moments.middle,
        unit: Unit::determine(unit, 2.0 * reach)?,
        unit_is_guessed: unit.is_none(),
    };
    let length_m = file.unit.length_m();
    let mut sorted: Vec<_> = points
        .iter()
        .map(|point| (point.coords - moments.middle) * length_m)
        .collect();
    sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    let first = side_of_points(&sorted, &axis, reach * length_m, face)?;
    let mut frame = first;
    // A ring of the profile weighs as much as any other.
    let weight = |point: &Vector3<f64>| frame.local(point).xy().norm().max(0.05 * reach * length_m);
    let cloud: Cloud = sorted.iter().map(|point| (*point, weight(point))).collect();
    let count = (points.len() / 5).clamp(2, FIRST_KNOTS);
    let mut profile = Profile::level(reach * length_m, count);
    let refit =
        |points: &[([f64; 2], f64)], profile: &Profile| profile.fitted(&rings(points, profile.rim_m()), false, 4);
    let mut fitted = Fitted {
        cloud: &cloud,
        rim: &[],
    };
    let mut unsure_m = fitted.refine(&mut frame, &mut profile, 100, refit);
    let is_unsure = |sigma_m: f64| sigma_m.is_nan() || sigma_m > UNSURE_M;
    let rim;
    if profile.steepness() < FLAT_SLOPE || is_unsure(unsure_m) {
        // The rim alone fixes the centre of a flat face.
        frame = first;
        rim = outermost(sorted.iter().copied(), &frame, POINT_SECTORS);
        fitted.rim = &rim;
        profile = Profile::level(reach * length_m, count);
        unsure_m = fitted.refine(&mut frame, &mut profile, 100, refit);
        let rim_m = fitted.rim_m(&frame);
        let off = |point: &Vector3<f64>| (frame.local(point).xy().norm() - rim_m).abs();
        if rim.iter().filter(|point| off(point) <= UNSURE_M).count() < POINT_SECTORS / 2 {
            unsure_m = f64::INFINITY;
        }
    }
    if is_unsure(unsure_m) {
        let why = "a flat face and a part of a sphere have the same shape about other axes, too; touch the rim all round, and points between \
                   it and the middle"
            .to_owned();
        return Err(MeasuredError::NoAxis { why });
    }
    let rim_of = |frame: &Frame| {
        sorted
            .iter()
            .map(|point| frame.local(point).xy().norm())
            .fold(0.0, f64::max)
    };
    // Knots and axis depend on each other.
    for _ in 0..MOST_SEARCHES {
        let (before, rim_m) = (frame, rim_of(&frame));
        profile = sparing(&fitted, &mut frame, &profile, rim_m);
        let tilt = (frame.axis() - before.axis()).norm();
        if tilt * rim_m + (frame.origin - before.origin).norm() < STILL_M {
            break;
        }
    }
    let rim_m = profile.rim_m();
    let local: Vec<_> = sorted.iter().map(|point| frame.local(point)).collect();
    check_gaps(&local, rim_m)?;
    check_rim(&local, |point| file.place(&frame, point))?;
    check_slope(&rings(&fitted.kept(&frame, &profile), rim_m), rim_m)?;
    let surface = profile.surface().ok_or(MeasuredError::Empty)?;
    let frame = frame.raised(profile.level_m());
    let ruler = Ruler::new(surface);
    let mut extremes = Extremes::new();
    let seen = |point: &Vector3<f64>| frame.local(point);
    sorted
        .iter()
        .map(seen)
        .for_each(|local| extremes.see(ruler.above_m(&local), 0.0, &local));
    let frame = frame.raised(extremes.middle_m());
    let mut plate = file.plate(&frame, surface, &extremes, relief(&surface, None, None));
    plate.out_of_round_m = out_of_round_m(sorted.iter().map(|point| frame.local(point)), &surface);
    smooth_enough(plate)
}

/// Returns the frame whose z is an axis or against it, towards the side that was touched: the one stated, or that to which points rise outwards;
/// level ones look along the file's z.
fn side_of_points(
    points: &[Vector3<f64>],
    axis: &Vector3<f64>,
    reach_m: f64,
    stated: Option<FaceSide>,
) -> Result<Frame, MeasuredError> {
    let frame = Frame::new(axis, Vector3::zeros());
    let all: Vec<_> = points
        .iter()
        .map(|point| frame.local(point))
        .map(|p| [p.xy().norm_squared(), p.z])
        .collect();
    let count = all.len() as f64;
    let middle = all.iter().map(|[square, _]| square).sum::<f64>() / count;
    let [product, spread] = all.iter().fold([0.0; 2], |[product, spread], [square, z]| {
        [
            product + (square - middle) * z,
            spread + (square - middle) * (square - middle),
        ]
    });
    let rise_m = product / spread.max(f64::MIN_POSITIVE) * reach_m * reach_m;
    let sides = [*axis, -axis].map(|axis| FaceSide::along(&axis));
    let side = match Side::new(stated, axis, 2.0 * rise_m, reach_m) {
        Side::Stated(k) | Side::Rising(k) | Side::Upper(k) => k,
        Side::Across(off_deg) => return Err(MeasuredError::across(stated, off_deg)),
        Side::Level => return Err(MeasuredError::level(sides)),
        Side::UpperIfAlone(k) => return Err(MeasuredError::rising([sides[k], sides[1 - k]])),
    };
    Ok(Frame::new(&if side == 1 { -axis } else { *axis }, Vector3::zeros()))
}

fn azimuth(point: &Vector3<f64>) -> f64 {
    atan2(point.y, point.x)
}

/// The first gap between the azimuths of points, all round, that is wider than `most` \[rad\].
fn wide_gap<'a>(points: impl Iterator<Item = &'a Vector3<f64>>, most: f64) -> Option<[f64; 2]> {
    let mut azimuths: Vec<f64> = points.map(azimuth).collect();
    azimuths.sort_unstable_by(f64::total_cmp);
    azimuths.extend(azimuths.first().map(|first| first + TAU));
    azimuths.array_windows().find(|[from, to]| to - from > most).copied()
}

/// Refuses points whose outermost ones are not on one circle, or not all round.
fn check_rim(local: &[Vector3<f64>], placed: impl Fn(&Vector3<f64>) -> Place) -> Result<(), MeasuredError> {
    let mut outermost = [0.0_f64; RIM_SECTORS];
    for point in local {
        let sector = ((azimuth(point) + PI) / TAU * RIM_SECTORS as f64) as usize % RIM_SECTORS;
        outermost[sector] = outermost[sector].max(point.xy().norm());
    }
    let rim_m = median(outermost.to_vec());
    let off = |point: &Vector3<f64>| point.xy().norm() - rim_m;
    if let Some(beyond) = local
        .iter()
        .max_by(|a, b| off(a).total_cmp(&off(b)))
        .filter(|point| off(point) > MOST_DEVIATION_M)
    {
        let place = placed(beyond);
        return Err(MeasuredError::BeyondRim { place, rim_m });
    }
    let on_rim = local.iter().filter(|point| off(point) >= -MOST_DEVIATION_M);
    match wide_gap(on_rim, RIM_GAP) {
        None => Ok(()),
        Some([from, to]) => {
            let (sine, cosine) = sin_cos(from.midpoint(to));
            Err(MeasuredError::RimGap {
                between_deg: [from.to_degrees(), to.to_degrees()],
                most_deg: RIM_GAP.to_degrees().round(),
                place: placed(&Vector3::new(rim_m * cosine, rim_m * sine, 0.0)),
                rim_m,
            })
        }
    }
}

/// Refuses points that leave too much of the face untouched.
fn check_gaps(local: &[Vector3<f64>], rim_m: f64) -> Result<(), MeasuredError> {
    let mut radii: Vec<f64> = local.iter().map(|p| p.xy().norm()).chain([0.0]).collect();
    radii.sort_unstable_by(f64::total_cmp);
    if let Some(gap) = radii.windows(2).find(|gap| gap[1] - gap[0] > RADIUS_GAP * rim_m) {
        let [from, to] = [0, 1].map(|k| millimetres(gap[k]));
        let why = format!("none lies between radius {from} and {to}; touch the face there, too");
        return Err(MeasuredError::NoAxis { why });
    }
    let outer = local.iter().filter(|p| p.xy().norm() > 0.5 * rim_m);
    if let Some(gap) = wide_gap(outer, AZIMUTH_GAP) {
        let [from, to] = gap.map(f64::to_degrees);
        let why =
            format!("none lies between azimuth {from:.0}° and {to:.0}° in the outer half; touch the face there, too");
        return Err(MeasuredError::NoAxis { why });
    }
    Ok(())
}
