//! Whether a contact point can be washed at all: every branch, every tilt, in every direction.
//!
//! It judges the planner: where it finds nothing, a failure is the arm's. It takes no short cut that the planner
//! takes: tilts out of the arm's plane are tried too, and neighbouring points are not looked at. Yaw about the tool's
//! axis is left out where it changes nothing but joint 6: with the tool along axis 6.

use super::inverse::Width;
use super::task::Task;
use super::{Cell, PostureError, PostureSettings};
use crate::trig::sin_cos;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::stroke::Stroke;

/// Difference of neighbouring tilts, at most \[rad\]: 1°.
pub const TILT_STEP_RAD: f64 = std::f64::consts::PI / 180.0;

/// Directions of the tilt: 5° apart.
pub const DIRECTIONS: u32 = 72;

/// A posture found by looking everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Tilt of the tool from the plate's normal \[rad\], at least 0.
    pub tilt_rad: f64,
    /// Direction to which the flange leans, counter-clockwise from "away from axis 1" \[rad\].
    pub azimuth_rad: f64,
    /// The configuration \[rad\].
    pub q: JointVector,
}

/// The posture of least tilt at which the point at `theta` \[rad\] of the stroke can be washed, if there is one. Arguments as
/// for [`super::washing`].
///
/// On arms without named branches only those are tried that a search finds.
///
/// # Errors
/// [`PostureError`] for numbers out of range.
pub fn posture_anywhere(
    cell: &Cell<'_>,
    (stroke, theta): (&Stroke, f64),
    centre: Vector3<f64>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<Option<Found>, PostureError> {
    let task = Task::new(cell, stroke, centre, plate, settings, near)?;
    Ok(anywhere(&task, theta.clamp(0.0, stroke.end()), settings, near))
}

/// [`posture_anywhere`] of a task.
pub(super) fn anywhere(task: &Task<'_>, theta: f64, settings: &PostureSettings, near: &JointVector) -> Option<Found> {
    let cell = task.cell;
    let contact = task.samples.at(theta);
    let out = cell.seen(&contact).out;
    let steps = (settings.tilt_max_rad / TILT_STEP_RAD).ceil();
    for k in 0..=steps as u32 {
        let tilt_rad = if k == 0 {
            0.0
        } else {
            settings.tilt_max_rad * f64::from(k) / steps
        };
        let directions = if k == 0 { 1 } else { DIRECTIONS };
        for d in 0..directions {
            let azimuth_rad = std::f64::consts::TAU * f64::from(d) / f64::from(DIRECTIONS);
            let (s, c) = sin_cos(azimuth_rad);
            let lean = (out * c + Vector3::z().cross(&out) * s) * tilt_rad;
            let target = cell.tip_leaning(&contact, &lean);
            let starts = cell.inverse.starts(&target, near, Width::Near).unwrap_or_default();
            if let Some(start) = starts.iter().find(|start| task.check_clear(&start.q).is_ok()) {
                return Some(Found {
                    tilt_rad,
                    azimuth_rad,
                    q: start.q,
                });
            }
        }
    }
    None
}
