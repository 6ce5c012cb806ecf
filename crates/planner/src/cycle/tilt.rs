//! Whether the tool keeps its largest tilt between the points that were solved too.

use super::CycleError;
use super::assemble::Assembled;
use crate::tool_path::SegmentKind;
use crate::trig::{asin, sin};
use platewash_kinematics::{Frame, RobotModel};

/// Looks into every piece of the motion.
const LOOKS: u32 = 4;

/// What a tilt of zero may be by rounding \[rad\].
const ROUNDING_RAD: f64 = 1e-8;

/// Refuses a motion on which the tool, at a plate, tilts by more than `most_rad`.
///
/// # Errors
/// [`CycleError::Tilt`], with the worst place.
pub(super) fn check(whole: &Assembled, robot: &RobotModel, tip: &Frame, most_rad: f64) -> Result<(), CycleError> {
    let most = sin(most_rad + ROUNDING_RAD);
    let times = whole.motion.times();
    let mut worst: Option<(f64, SegmentKind, usize)> = None;
    for segment in &whole.segments {
        use SegmentKind::{Approach, Retreat, Wash};
        if !matches!(segment.kind, Approach | Wash | Retreat) {
            continue;
        }
        let from = times.partition_point(|t| *t < segment.t_start_s);
        let to = times.partition_point(|t| *t < segment.t_end_s);
        for ends in times[from..=to.min(times.len() - 1)].windows(2) {
            for k in 0..=LOOKS {
                let at = ends[0] + (ends[1] - ends[0]) * (f64::from(k) / f64::from(LOOKS));
                let Some(state) = whole.motion.at(at) else { continue };
                let axis = robot.fk(&state.q).rigid(tip).rotation;
                let sine = (axis.m13 * axis.m13 + axis.m23 * axis.m23).sqrt();
                if sine > worst.map_or(most, |(sine, ..)| sine) {
                    worst = Some((sine, segment.kind, segment.plate));
                }
            }
        }
    }
    match worst {
        None => Ok(()),
        Some((sine, kind, plate)) => Err(CycleError::Tilt {
            plate,
            kind,
            tilt_rad: asin(sine.min(1.0)),
            most_rad,
        }),
    }
}
