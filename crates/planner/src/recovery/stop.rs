//! Moment of a plan at which the arm was stopped, and the plates that were washed by then.

use crate::recovery::error::RecoveryError;
use platewash_kinematics::JointVector;
use platewash_motion::plan::Plan;
use platewash_motion::trajectory::{PlanSegment, SegmentKind, Trajectory};
use platewash_workcell::words::plate_name;
use serde::Serialize;
use std::fmt;

/// Distance beyond that of the nearest moment up to which a moment fits \[rad\]: the joints may be off by as much.
const AS_NEAR_RAD: f64 = 0.035;

/// Largest distance of a joint from the plan at which the arm counts as stopped on it \[rad\].
const ON_PLAN_RAD: f64 = 0.06;

/// Rounding of a printed time \[s\].
const PRINTED_S: f64 = 0.005;

/// Moments of each piece of the motion that are looked at.
const LOOKS: u32 = 4;

/// Stop of a plan.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Stop {
    /// Time in the plan \[s\]: as stated, or else the nearest moment at which as few plates were washed as at the first that fits. `None`
    /// where the arm is far from the plan.
    pub time_s: Option<f64>,
    /// True where the time was stated.
    pub is_stated: bool,
    /// True where the joints fit the plan then. A stated time that they do not fit counts where they fit no moment: it was not checked.
    pub joints_fit: bool,
    /// The earliest moment that the joints fit, too, where fewer plates were washed than at the stated time \[s\].
    pub earlier_s: Option<f64>,
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
    /// [`RecoveryError::Time`] for a time outside of the plan, [`RecoveryError::OtherTime`] for one that the joints do not fit where they
    /// fit another one.
    pub fn new(plan: &Plan, motion: &Trajectory, at: &JointVector, time_s: Option<f64>) -> Result<Self, RecoveryError> {
        let duration_s = motion.duration_s();
        let off_rad = |t_s: f64| motion.at(t_s).map_or(f64::INFINITY, |state| (state.q - at).amax());
        let (by_joints, nearest_rad) = Self::by_joints(plan, motion, off_rad);
        let Some(found_s) = time_s else {
            return Ok(by_joints);
        };
        // The end as it is printed may be a little later; −0 is 0.
        if !(0.0..=duration_s + PRINTED_S).contains(&found_s) {
            return Err(RecoveryError::Time { found_s, duration_s });
        }
        let found_s = found_s.min(duration_s) + 0.0;
        let stated_off_rad = off_rad(found_s);
        match by_joints.time_s {
            Some(fits_s) if stated_off_rad > ON_PLAN_RAD.max(nearest_rad + AS_NEAR_RAD) => {
                Err(RecoveryError::OtherTime {
                    found_s,
                    found_off_rad: stated_off_rad,
                    fits_s,
                    fits_off_rad: by_joints.off_rad,
                })
            }
            earlier_s => {
                let stated = Self::at_time(plan, found_s, stated_off_rad, true);
                Ok(Self {
                    joints_fit: earlier_s.is_some(),
                    earlier_s: earlier_s.filter(|_| by_joints.washed.len() < stated.washed.len()),
                    ..stated
                })
            }
        }
    }

    /// The stop at the moment that fits the joints, which are `off_rad` from the plan at a time \[s\], and the least such distance \[rad\].
    fn by_joints(plan: &Plan, motion: &Trajectory, off_rad: impl Fn(f64) -> f64) -> (Self, f64) {
        let moments = || {
            let pieces = motion.times().windows(2);
            let within = |ends: &[f64], k: u32| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / f64::from(LOOKS));
            pieces
                .flat_map(move |ends| (0..LOOKS).map(move |k| within(ends, k)))
                .chain([motion.duration_s()])
        };
        let nearest_rad = moments().map(&off_rad).fold(f64::INFINITY, f64::min);
        let unknown = Self {
            off_rad: nearest_rad,
            ..Self::default()
        };
        if nearest_rad > ON_PLAN_RAD {
            return (unknown, nearest_rad);
        }
        let first = moments().find(|t_s| off_rad(*t_s) <= nearest_rad + AS_NEAR_RAD);
        let next_ends = first.and_then(|first| washes(plan).map(|wash| wash.t_end_s).find(|end| *end > first));
        let until = next_ends.unwrap_or(f64::INFINITY);
        let since = moments().filter(|t_s| first.is_some_and(|first| *t_s >= first) && *t_s < until);
        let nearest = since.map(|t_s| (off_rad(t_s), t_s)).min_by(|a, b| a.0.total_cmp(&b.0));
        let stop = nearest.map_or(unknown, |(off_rad, t_s)| Self::at_time(plan, t_s, off_rad, false));
        (stop, nearest_rad)
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
            joints_fit: true,
            earlier_s: None,
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

impl Stop {
    /// Returns what the first line says of a stated time that the joints do not confirm; empty where they do.
    #[must_use]
    pub fn caveat(&self) -> String {
        let Some(time_s) = self.time_s.filter(|_| self.is_stated) else {
            return String::new();
        };
        match (self.joints_fit, self.earlier_s) {
            (false, _) => format!(
                "; not checked: that it stopped at {time_s} s, as stated; the joints fit no moment of the plan (off by {:.1}°)",
                self.off_rad.to_degrees()
            ),
            (true, Some(earlier_s)) => format!(
                "; not checked: that it stopped at {time_s} s, as stated, and not at {earlier_s:.2} s, which the joints fit, too"
            ),
            (true, None) => String::new(),
        }
    }
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
        let how = match (self.is_stated, self.joints_fit, self.earlier_s) {
            (false, ..) => "by the joints; the earliest where several moments fit".to_owned(),
            (true, false, _) => "as stated and not checked, as the joints fit no moment of the plan".to_owned(),
            (true, true, None) => "as stated".to_owned(),
            (true, true, Some(earlier_s)) => {
                format!("as stated; the joints fit {earlier_s:.2} s, too, when fewer plates were washed")
            }
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
