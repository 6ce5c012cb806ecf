//! Plate from measurements: its fitted face, its pose in the file, its deviation.

use crate::measured::bounds::MOST_DEVIATION_M;
use crate::measured::error::{MeasuredError, Place};
use crate::measured::face::Relief;
use crate::measured::unit::Unit;
use nalgebra::Vector3;
use platewash_kinematics::Pose;
use platewash_workcell::plate::Foot;
use platewash_workcell::surface::Surface;

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

/// Number of rings in which a face is compared with its mean height.
const ROUND_RINGS: usize = 72;

/// Greatest difference of points of a face, plate frame, from the mean at their radius \[m\].
pub(super) fn out_of_round_m(points: impl Iterator<Item = Vector3<f64>>, surface: &Surface) -> f64 {
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
pub(super) fn smooth_enough(plate: MeasuredPlate) -> Result<MeasuredPlate, MeasuredError> {
    let (deviation_m, place) = (plate.deviation_m, plate.worst);
    match deviation_m <= MOST_DEVIATION_M {
        true => Ok(plate),
        false => Err(MeasuredError::Rough { deviation_m, place }),
    }
}
