//! What a certified job needs of keys whose ranges are wider for the paper's program, or for messages that name the key.

use crate::error::Problem;
use crate::job::Program;
use crate::scenario::Scenario;
use platewash_workcell::wash_path::{LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_TURNS, WashCurve};
use std::f64::consts::PI;

/// Plates thinner or smaller than this are none to the certificate \[m\].
const LEAST_PLATE_M: f64 = 1e-6;

/// The slowest tip whose time can be computed \[m/s, m/s²\].
const LEAST_OF_TIP: f64 = 1e-6;

/// The least joint acceleration \[rad/s²\]: a transit then takes a minute or two.
const LEAST_JOINT_ACCELERATION: f64 = 1e-3;

impl Scenario {
    /// The wash curve on a plate, as far as the scenario alone decides it.
    #[must_use]
    pub(crate) fn wash_curve(&self) -> WashCurve {
        WashCurve {
            radius_m: self.wash.path_radius_m,
            turns: self.wash.turns,
            start_angle_rad: 0.0,
            closing_ring: self.wash.closing_ring,
        }
    }

    /// Refuses what no certified job can be planned or proved with, by its key.
    pub(super) fn check_certified(&self) -> Result<(), Problem> {
        if self.job.program != Program::Certified {
            return Ok(());
        }
        let (wash, layout, limits) = (&self.wash, &self.layout, &self.limits);
        let above = |key, found, least| refuse(key, found, found > least, format!("above {least:e}"));
        let from = |key, found, least| refuse(key, found, found >= least, format!("at least {least}"));
        above("layout.plate_radius_m", layout.plate_radius_m, LEAST_PLATE_M)?;
        above("layout.plate_thickness_m", layout.plate_thickness_m, LEAST_PLATE_M)?;
        let turns = (LEAST_TURNS..=MOST_TURNS).contains(&wash.turns);
        refuse(
            "wash.turns",
            wash.turns,
            turns,
            format!("from {LEAST_TURNS} to {MOST_TURNS}"),
        )?;
        from("wash.path_radius_m", wash.path_radius_m, LEAST_RADIUS_M)?;
        from("wash.speed_m_s", wash.speed_m_s, LEAST_OF_TIP)?;
        from("wash.acceleration_m_s2", wash.acceleration_m_s2, LEAST_OF_TIP)?;
        from("limits.tip_speed_m_s", limits.tip_speed_m_s, LEAST_OF_TIP)?;
        from(
            "limits.tip_acceleration_m_s2",
            limits.tip_acceleration_m_s2,
            LEAST_OF_TIP,
        )?;
        for found in limits.joint_acceleration_rad_s2 {
            from("limits.joint_acceleration_rad_s2", found, LEAST_JOINT_ACCELERATION)?;
        }
        // As the planner bounds it: a spiral of mean radius R/2, and a ring.
        let length = PI * wash.path_radius_m * (wash.turns + 2.0);
        let expected =
            format!("such that the wash curve π · wash.path_radius_m · (wash.turns + 2) is at most {LONGEST_M} m");
        refuse("wash.path_radius_m", wash.path_radius_m, length <= LONGEST_M, expected)
    }
}

fn refuse(key: &str, found: f64, fits: bool, expected: String) -> Result<(), Problem> {
    if fits {
        return Ok(());
    }
    Err(Problem::Value {
        key: key.to_owned(),
        expected: format!("{expected} in a certified job"),
        // As the file may state it: no row of zeros for a tiny number.
        found: format!("{found:?}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    type Change = fn(&mut Scenario);

    #[test]
    fn what_no_certified_job_can_have_is_refused_by_its_key() {
        let cases: [(&str, Change); 11] = [
            ("layout.plate_thickness_m", |s| s.layout.plate_thickness_m = 1e-6),
            ("layout.plate_radius_m", |s| s.layout.plate_radius_m = 1e-6),
            ("wash.turns", |s| s.wash.turns = 0.249),
            ("wash.turns", |s| s.wash.turns = 200.1),
            ("wash.path_radius_m", |s| s.wash.path_radius_m = 0.99e-4),
            ("wash.path_radius_m", |s| {
                (s.wash.path_radius_m, s.wash.turns) = (10.0, 3.0)
            }),
            ("wash.speed_m_s", |s| s.wash.speed_m_s = 1e-300),
            ("wash.acceleration_m_s2", |s| s.wash.acceleration_m_s2 = 1e-9),
            ("limits.tip_speed_m_s", |s| s.limits.tip_speed_m_s = 1e-9),
            ("limits.tip_acceleration_m_s2", |s| {
                s.limits.tip_acceleration_m_s2 = 1e-9
            }),
            ("limits.joint_acceleration_rad_s2", |s| {
                s.limits.joint_acceleration_rad_s2[3] = 1e-9
            }),
        ];
        for (key, change) in cases {
            let mut scenario = Scenario::load("kitchen").unwrap();
            assert!(scenario.validate().is_ok());
            change(&mut scenario);
            let problem = scenario.validate().unwrap_err().problem;
            assert!(
                matches!(&problem, Problem::Value { key: named, .. } if named == key),
                "{problem}"
            );
            // The paper's program takes them.
            let mut paper = Scenario::load("paper-text").unwrap();
            change(&mut paper);
            assert!(paper.validate().is_ok(), "{key}");
        }
    }
}
