//! Time of a wash against the least time for its face, and the limits that hold it back.
//!
//! A disc of radius s whose centre moves by L covers at most 2 s L + π s². A wash at the speed v or below that covers the area A
//! therefore takes at least (A − π s²)/(2 s v).

use crate::pattern::length_m;
use crate::placed_arm::PlacedArm;
use crate::timing::MotionLimits;
use platewash_kinematics::words::decimals_down;
use platewash_kinematics::{AXES, Axes};
use platewash_motion::trajectory::{JointState, Trajectory};
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashCurve;
use serde::Serialize;
use std::f64::consts::PI;
use std::fmt;

/// A rate this near to its limit binds, as a part of it.
const BINDING: f64 = 0.98;

/// Number of moments of a motion at which its limits are looked at.
const MOMENTS: u32 = 100;

/// Least time of a wash, and the shares of its time at each limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pace {
    /// Lower bound on the time of any wash of the plate with this sponge and wash speed \[s\].
    pub least_s: f64,
    /// Lower bound on the time along its path at the wash speed \[s\].
    pub path_s: f64,
    /// Length of the wash path \[m\].
    pub length_m: f64,
    /// Shares of the time at each limit.
    #[serde(flatten)]
    pub limits: LimitShares,
}

impl Pace {
    /// The pace of a wash of `plate` along `curve`.
    pub(crate) fn measure(
        placed: &PlacedArm<'_>,
        plate: &Plate,
        terms: &JobTerms,
        (curve, motion): (&WashCurve, &Trajectory),
        limits: &MotionLimits,
    ) -> Self {
        let (length_m, speed_m_s) = (length_m(curve, &plate.surface), terms.wash_speed_of(plate));
        Self {
            least_s: least_area_m2(plate, terms) / (2.0 * terms.workcell.tool.sponge.radius_m * speed_m_s),
            path_s: length_m / speed_m_s,
            length_m,
            limits: LimitShares::measure(placed, motion, limits),
        }
    }
}

/// Shares of the time of a motion at each limit.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct LimitShares {
    /// Share of the time at the speed limit of the tip.
    pub tip_speed: f64,
    /// Share of the rest of it at the acceleration limit of the tip.
    pub tip_acceleration: f64,
    /// Share of the rest of it at the speed limit of a joint.
    pub joint_speed: f64,
    /// Share of the rest of it at the acceleration limit of a joint.
    pub joint_acceleration: f64,
}

impl LimitShares {
    /// The shares of a motion, by moments that are evenly apart.
    pub(crate) fn measure(placed: &PlacedArm<'_>, motion: &Trajectory, limits: &MotionLimits) -> Self {
        let tip = limits
            .tip
            .map_or([f64::INFINITY; 2], |tip| [tip.speed_m_s, tip.acceleration_m_s2]);
        let (mut shares, step_s) = (Self::default(), motion.duration_s() / f64::from(MOMENTS));
        let velocity = |state: &JointState| {
            let jacobian = placed.robot.fk(&state.q).jacobian(&placed.tip, Axes::Base);
            jacobian.fixed_rows::<3>(0) * state.qd
        };
        for k in 0..MOMENTS {
            let t_s = (f64::from(k) + 0.5) * step_s;
            let (Some(state), Some(later)) = (motion.at(t_s), motion.at(t_s + 1e-3 * step_s)) else {
                continue;
            };
            let here = velocity(&state);
            let acceleration = || (velocity(&later) - here) / (1e-3 * step_s);
            let joints = |of: &dyn Fn(usize) -> f64| (0..AXES).map(of).fold(0.0, f64::max) >= BINDING;
            let share = if here.norm() >= BINDING * tip[0] {
                &mut shares.tip_speed
            } else if acceleration().norm() >= BINDING * tip[1] {
                &mut shares.tip_acceleration
            } else if joints(&|j| state.qd[j].abs() / limits.velocity[j]) {
                &mut shares.joint_speed
            } else if joints(&|j| state.qdd[j].abs() / limits.acceleration[j]) {
                &mut shares.joint_acceleration
            } else {
                continue;
            };
            *share += 1.0 / f64::from(MOMENTS);
        }
        shares
    }
}

/// Area of the face that the moving sponge must cover, seen along the plate's axis, less the sponge's own \[m²\]. A part of the face
/// is at most as large seen along the axis as along its normal.
fn least_area_m2(plate: &Plate, terms: &JobTerms) -> f64 {
    let disc_m2 = |radius_m: f64| PI * radius_m * radius_m;
    let left_out_m2 = (1.0 - terms.requirements.coverage) * plate.surface.area_m2();
    let sponge_m2 = disc_m2(terms.workcell.tool.sponge.radius_m);
    (disc_m2(plate.surface.rim_m()) - left_out_m2 - sponge_m2).max(0.0)
}

impl fmt::Display for Pace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "path of {:.2} m, at least {} s",
            self.length_m,
            decimals_down(self.path_s, 2)
        )?;
        if self.least_s > 0.0 {
            write!(f, "; no path is faster than {} s", decimals_down(self.least_s, 2))?;
        }
        write!(f, "{}", self.limits)
    }
}

impl fmt::Display for LimitShares {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shares = [
            ("tip speed", self.tip_speed),
            ("tip acceleration", self.tip_acceleration),
            ("joint speed", self.joint_speed),
            ("joint acceleration", self.joint_acceleration),
        ];
        let mut shown: Vec<_> = shares.into_iter().filter(|(_, share)| *share >= 0.005).collect();
        shown.sort_by(|a, b| b.1.total_cmp(&a.1));
        for (k, (limit, share)) in shown.iter().enumerate() {
            let [before, after] = if k == 0 { ["; ", " of the time"] } else { [", ", ""] };
            write!(f, "{before}{limit} is the limit for {:.0} %{after}", 100.0 * share)?;
        }
        Ok(())
    }
}
