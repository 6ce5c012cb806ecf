//! Moment of a plan at which the arm was stopped, and the plates that were washed by then.

use crate::recovery::RecoveryError;
use platewash_kinematics::JointVector;
use platewash_workcell::plan::Plan;
use platewash_workcell::trajectory::{PlanSegment, SegmentKind, Trajectory};
use platewash_workcell::words::plate_name;
use serde::Serialize;
use std::fmt;

/// Distance beyond that of the nearest moment up to which a moment fits \[rad\]: the joints may be off by as much.
const AS_NEAR_RAD: f64 = 0.035;

/// Largest distance of a joint from the plan at which the arm counts as stopped on it \[rad\].
const ON_PLAN_RAD: f64 = 0.06;

/// Moments of each piece of the motion that are looked at.
const LOOKS: u32 = 4;

/// Stop of a plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stop {
    /// Time in the plan \[s\]: as stated, or else the nearest moment at which as few plates were washed as at the first that fits. `None`
    /// where the arm is far from the plan.
    pub time_s: Option<f64>,
    /// True where the time was stated.
    pub is_stated: bool,
    /// Largest distance of a joint from the plan then \[rad\]; where there is no time, from the nearest moment.
    pub off_rad: f64,
    /// Plates whose wash had ended, by index, in the order of washing.
    pub washed: Vec<usize>,
    /// Plate whose wash, approach or retreat was under way.
    pub at_plate: Option<usize>,
}

impl Stop {
    /// The stop of a plan with the arm at `at` \[rad\], at a stated time \[s\] or else at the moment that fits. Where several do, the
    /// earliest counts: a plate may be washed twice, and none is left out.
    ///
    /// # Errors
    /// [`RecoveryError::Time`] for a time outside of the plan.
    pub fn new(plan: &Plan, motion: &Trajectory, at: &JointVector, time_s: Option<f64>) -> Result<Self, RecoveryError> {
        let duration_s = motion.duration_s();
        let off_rad = |t_s: f64| motion.at(t_s).map_or(f64::INFINITY, |state| (state.q - at).amax());
        if let Some(found_s) = time_s {
            if !(0.0..=duration_s).contains(&found_s) {
                return Err(RecoveryError::Time { found_s, duration_s });
            }
            return Ok(Self::at_time(plan, found_s, off_rad(found_s), true));
        }
        let moments = || {
            let pieces = motion.times().windows(2);
            let within = |ends: &[f64], k: u32| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / f64::from(LOOKS));
            pieces.flat_map(move |ends| (0..LOOKS).map(move |k| within(ends, k)))
        };
        let nearest_rad = moments().map(off_rad).fold(off_rad(duration_s), f64::min);
        let unknown = Self {
            time_s: None,
            is_stated: false,
            off_rad: nearest_rad,
            washed: Vec::new(),
            at_plate: None,
        };
        if nearest_rad > ON_PLAN_RAD {
            return Ok(unknown);
        }
        let first = moments().find(|t_s| off_rad(*t_s) <= nearest_rad + AS_NEAR_RAD);
        let next_ends = first.and_then(|first| washes(plan).map(|wash| wash.t_end_s).find(|end| *end > first));
        let until = next_ends.unwrap_or(f64::INFINITY);
        let since = moments().filter(|t_s| first.is_some_and(|first| *t_s >= first) && *t_s < until);
        let nearest = since.map(|t_s| (off_rad(t_s), t_s)).min_by(|a, b| a.0.total_cmp(&b.0));
        Ok(nearest.map_or(unknown, |(off_rad, t_s)| Self::at_time(plan, t_s, off_rad, false)))
    }

    fn at_time(plan: &Plan, time_s: f64, off_rad: f64, is_stated: bool) -> Self {
        let ended = washes(plan).filter(|wash| wash.t_end_s <= time_s);
        let here = plan
            .segments
            .iter()
            .find(|s| s.t_start_s <= time_s && time_s < s.t_end_s);
        Self {
            time_s: Some(time_s),
            is_stated,
            off_rad,
            washed: ended.map(|wash| wash.plate).collect(),
            at_plate: here
                .filter(|segment| segment.kind.is_at_plate())
                .map(|segment| segment.plate),
        }
    }
}

fn washes(plan: &Plan) -> impl Iterator<Item = &PlanSegment> {
    plan.segments.iter().filter(|segment| segment.kind == SegmentKind::Wash)
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let off_deg = self.off_rad.to_degrees();
        let Some(time_s) = self.time_s else {
            return write!(
                f,
                "the arm is nowhere near the plan (a joint is off by {off_deg:.1}°), so no plate counts as washed; state the time of the stop \
                 to change that"
            );
        };
        let how = match self.is_stated {
            true => "as stated",
            false => "by the joints; the earliest where several moments fit",
        };
        let at = self
            .at_plate
            .map_or_else(String::new, |plate| format!(", at {}", plate_name(plate)));
        let names: Vec<_> = self.washed.iter().map(|plate| plate_name(*plate)).collect();
        let washed = if names.is_empty() {
            "none".to_owned()
        } else {
            names.join(", ")
        };
        write!(
            f,
            "at {time_s:.2} s of the plan ({how}; joints off by up to {off_deg:.2}°){at}; washed by then: {washed}"
        )
    }
}
