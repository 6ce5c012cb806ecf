//! Exhaustive check of a contact point: every branch, every tilt, in every direction.
//!
//! It judges the planner: where it finds nothing, a failure is the arm's. It takes no short cut that the planner
//! takes: tilts out of the arm's plane are tried too, and neighbouring points are not used. Yaw about the tool's axis is left out
//! where it changes nothing but joint 6: with the tool along axis 6.

use crate::placed_arm::{Contact, Width};
use crate::redundancy::task::Task;
use platewash_kinematics::JointVector;
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::cancel::Cancelled;

/// Difference of neighbouring tilts, at most \[rad\]: 1°.
const TILT_STEP_RAD: f64 = std::f64::consts::PI / 180.0;

/// Directions of the tilt: 5° apart.
const DIRECTIONS: u32 = 72;

/// A configuration found by looking everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundConfiguration {
    /// Tilt of the tool from the plate's normal \[rad\], at least 0.
    pub tilt_rad: f64,
    /// Direction to which the flange leans, counter-clockwise from "away from axis 1" \[rad\].
    pub azimuth_rad: f64,
    /// The configuration \[rad\].
    pub q: JointVector,
}

/// The configuration of least tilt at which the point at `theta` \[rad\] of the wash path can be washed, if there is one.
///
/// On arms without named branches only those are tried that a search finds.
///
/// # Errors
/// [`Cancelled`].
pub fn anywhere(task: &Task<'_>, theta: f64) -> Result<Option<FoundConfiguration>, Cancelled> {
    let placed = task.placed;
    let contact = task.samples.at(theta.clamp(0.0, task.path.curve.end()));
    let contact = Contact::on_normal(contact.point, contact.normal);
    let out = placed.outward_direction(&contact);
    let steps = (task.tilt_max_rad() / TILT_STEP_RAD).ceil();
    for k in 0..=steps as u32 {
        let tilt_rad = if k == 0 {
            0.0
        } else {
            task.tilt_max_rad() * f64::from(k) / steps
        };
        let directions = if k == 0 { 1 } else { DIRECTIONS };
        for d in 0..directions {
            placed.check_cancelled()?;
            let azimuth_rad = std::f64::consts::TAU * f64::from(d) / f64::from(DIRECTIONS);
            let (s, c) = sin_cos(azimuth_rad);
            let lean = (out * c + contact.normal.cross(&out) * s) * tilt_rad;
            let target = placed.tip_leaning(&contact, &lean);
            let starts = placed.inverse.starts(&target, &task.near, Width::Near);
            if let Some(start) = starts
                .unwrap_or_default()
                .iter()
                .find(|start| task.is_allowed(&start.q))
            {
                return Ok(Some(FoundConfiguration {
                    tilt_rad,
                    azimuth_rad,
                    q: start.q,
                }));
            }
        }
    }
    Ok(None)
}
