//! Whether the tool keeps its largest tilt between the points that were solved too.

use super::assemble::Assembled;
use super::shared::Pipeline;
use crate::error::PlanError;
use crate::scene::{Scene, TILT_RESERVE_RAD};
use crate::trig::{asin, sin};
use nalgebra::Vector3;
use platewash_workcell::trajectory::{PlanSegment, SegmentKind};
use platewash_workcell::wash_path::WashPath;

/// Looks into every piece of the motion.
const LOOKS: u32 = 16;

/// What a tilt of zero may be by rounding \[rad\].
const ROUNDING_RAD: f64 = 1e-8;

/// The part of the usual reserve that is left for the certificate: it bounds the tilt between what is looked at here.
const LEFT: f64 = 0.1;

impl Pipeline<'_> {
    /// Refuses a motion on which the tool, at a plate, tilts by more than the terms allow.
    ///
    /// # Errors
    /// [`PlanError::Tilt`], with the worst place.
    pub fn check_tilt(&self, scene: &Scene<'_>, whole: &Assembled, paths: &[WashPath]) -> Result<(), PlanError> {
        let most_rad = self.terms.tilt_max_rad();
        let left_rad = LEFT * TILT_RESERVE_RAD.min(0.5 * most_rad);
        let most = sin(most_rad + ROUNDING_RAD - left_rad);
        let times = whole.motion.times();
        let mut worst: Option<(f64, SegmentKind, usize)> = None;
        for segment in &whole.segments {
            scene.check_cancelled()?;
            let Some(face) = self.face(segment, paths) else {
                continue;
            };
            let from = times.partition_point(|t| *t < segment.t_start_s);
            let to = times.partition_point(|t| *t < segment.t_end_s);
            for ends in times[from..=to.min(times.len() - 1)].windows(2) {
                for k in 0..=LOOKS {
                    let at = ends[0] + (ends[1] - ends[0]) * (f64::from(k) / f64::from(LOOKS));
                    let Some(state) = whole.motion.at(at) else { continue };
                    let tip = scene.robot.fk(&state.q).rigid(&scene.tip);
                    let sine = tip.rotation.column(2).cross(&face(&tip.translation)).norm();
                    if sine > worst.map_or(most, |(sine, ..)| sine) {
                        worst = Some((sine, segment.kind, segment.plate));
                    }
                }
            }
        }
        match worst {
            None => Ok(()),
            Some((sine, kind, plate)) => Err(PlanError::Tilt {
                plate,
                kind,
                tilt_rad: asin(sine.min(1.0)),
                most_rad,
            }),
        }
    }

    /// The normal from which the tilt counts at a place of the tip \[m\] in a segment at a plate: that of the line, or of the face.
    fn face(&self, segment: &PlanSegment, paths: &[WashPath]) -> Option<impl Fn(&Vector3<f64>) -> Vector3<f64> + '_> {
        let plate = self.plates.get(segment.plate)?;
        let [start, end] = paths.iter().find(|path| path.plate == segment.plate)?.feet(plate);
        let foot = match segment.kind {
            SegmentKind::Approach => Some(start),
            SegmentKind::Wash => None,
            SegmentKind::Retreat => Some(end),
            _ => return None,
        };
        Some(move |tip: &Vector3<f64>| plate.normal_at(&foot.unwrap_or(*tip)))
    }
}
