//! How near a wash comes to the least time that its area allows, and what holds it back.
//!
//! A sponge of width 2 s that never went over a place twice and never slowed down below the speed v of washing would take area/(2 s v).

use crate::scene::Scene;
use crate::timing::{MotionLimits, Timed};
use platewash_kinematics::{AXES, Axes};
use platewash_workcell::plate::Plate;
use serde::Serialize;
use std::fmt;

/// A rate this near to its limit binds, as a part of it.
const BINDING: f64 = 0.98;

/// How long a wash takes beside what it could, and what binds it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pace {
    /// area/(2 s v) \[s\]: no wash is faster.
    pub least_s: f64,
    /// Length of the wash path \[m\].
    pub length_m: f64,
    /// Share of the time at the speed limit of the tip.
    pub tip_speed: f64,
    /// Share of the rest of it at the acceleration limit of the tip.
    pub tip_acceleration: f64,
    /// Share of the rest of it at the speed limit of a joint.
    pub joint_speed: f64,
    /// Share of the rest of it at the acceleration limit of a joint.
    pub joint_acceleration: f64,
}

impl Pace {
    /// That of a wash on a plate with a sponge of that radius \[m\], looked at in the middle of its pieces.
    pub(crate) fn of(scene: &Scene<'_>, (plate, sponge_m): (&Plate, f64), wash: &Timed, limits: &MotionLimits) -> Self {
        let tip = limits
            .tip
            .map_or([f64::INFINITY; 2], |tip| [tip.speed_m_s, tip.acceleration_m_s2]);
        let mut pace = Self {
            least_s: plate.surface.area_m2() / (2.0 * sponge_m * tip[0]),
            length_m: 0.0,
            tip_speed: 0.0,
            tip_acceleration: 0.0,
            joint_speed: 0.0,
            joint_acceleration: 0.0,
        };
        let times = wash.motion.times();
        let place = |t: f64| wash.motion.at(t).map(|state| (scene.robot.fk(&state.q), state));
        for ends in times.windows(2) {
            let (middle, long_s) = (0.5 * (ends[0] + ends[1]), ends[1] - ends[0]);
            let (Some((poses, state)), Some((next, later))) = (place(middle), place(middle + 1e-3 * long_s)) else {
                continue;
            };
            let velocity = |poses: &platewash_kinematics::BodyPoses, qd| {
                let jacobian = poses.jacobian(&scene.tip, Axes::Base);
                jacobian.fixed_rows::<3>(0) * qd
            };
            let here = velocity(&poses, state.qd);
            let acceleration = (velocity(&next, later.qd) - here) / (1e-3 * long_s);
            pace.length_m += here.norm() * long_s;
            let joints = |of: &dyn Fn(usize) -> f64| (0..AXES).map(of).fold(0.0, f64::max);
            let share = long_s / wash.motion.duration_s();
            if here.norm() >= BINDING * tip[0] {
                pace.tip_speed += share;
            } else if acceleration.norm() >= BINDING * tip[1] {
                pace.tip_acceleration += share;
            } else if joints(&|j| state.qd[j].abs() / limits.velocity[j]) >= BINDING {
                pace.joint_speed += share;
            } else if joints(&|j| state.qdd[j].abs() / limits.acceleration[j]) >= BINDING {
                pace.joint_acceleration += share;
            }
        }
        pace
    }
}

impl fmt::Display for Pace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.2} m, least time of the area {:.2} s; bound by ",
            self.length_m, self.least_s
        )?;
        let shares = [
            ("tip speed", self.tip_speed),
            ("tip acceleration", self.tip_acceleration),
            ("joint speed", self.joint_speed),
            ("joint acceleration", self.joint_acceleration),
        ];
        let mut told: Vec<_> = shares.into_iter().filter(|(_, share)| *share >= 0.005).collect();
        told.sort_by(|a, b| b.1.total_cmp(&a.1));
        let told: Vec<_> = told
            .iter()
            .map(|(what, share)| format!("{what} {:.0} %", 100.0 * share))
            .collect();
        f.write_str(&told.join(", "))
    }
}
