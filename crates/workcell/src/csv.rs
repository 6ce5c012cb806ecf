//! A motion as CSV, for spreadsheets and plots.

use crate::segment::PlanSegment;
use crate::trajectory::Trajectory;
use nalgebra::Vector3;
use platewash_kinematics::words::rounded_up;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use std::fmt;

/// Most rows that are written.
pub const MAX_ROWS: usize = 1_000_000;

/// Why a motion was not written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CsvError {
    /// A time step that makes no sense.
    #[error("{}", step(*.dt_s, *.duration_s))]
    Step {
        /// The step \[s\].
        dt_s: f64,
        /// The motion's duration \[s\].
        duration_s: f64,
    },
}

fn step(dt_s: f64, duration_s: f64) -> String {
    if dt_s > 0.0 {
        let least = least_step_s(duration_s);
        format!(
            "a time step of {dt_s} s gives more than {MAX_ROWS} rows of CSV for {duration_s:.2} s of motion; give at least {least} s"
        )
    } else {
        format!("the CSV's time step must be positive; found {dt_s} s")
    }
}

/// Significant digits of a time step that is suggested.
const STEP_DIGITS: usize = 3;

/// A time step \[s\] with which a motion of `duration_s` or less gives no more than [`MAX_ROWS`] rows: the least one of
/// three digits, but for a row or two of rounding.
#[must_use]
pub fn least_step_s(duration_s: f64) -> f64 {
    rounded_up(duration_s / (MAX_ROWS - 2) as f64, STEP_DIGITS)
}

/// Refuses a time step that is not positive or gives more than [`MAX_ROWS`] rows for a motion of `duration_s`.
///
/// # Errors
/// [`CsvError::Step`] with a step that is accepted.
pub fn check_step(duration_s: f64, dt_s: f64) -> Result<(), CsvError> {
    if dt_s > 0.0 && (duration_s / dt_s).ceil() < MAX_ROWS as f64 {
        return Ok(());
    }
    Err(CsvError::Step { dt_s, duration_s })
}

/// Columns of joint positions, speeds and accelerations.
pub const STATE: [[&str; 6]; 3] = [
    ["q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"],
    [
        "qd1_rad_s",
        "qd2_rad_s",
        "qd3_rad_s",
        "qd4_rad_s",
        "qd5_rad_s",
        "qd6_rad_s",
    ],
    [
        "qdd1_rad_s2",
        "qdd2_rad_s2",
        "qdd3_rad_s2",
        "qdd4_rad_s2",
        "qdd5_rad_s2",
        "qdd6_rad_s2",
    ],
];

/// The header line.
pub const HEADER: &str = "t_s,segment,plate,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,\
qd1_rad_s,qd2_rad_s,qd3_rad_s,qd4_rad_s,qd5_rad_s,qd6_rad_s,\
qdd1_rad_s2,qdd2_rad_s2,qdd3_rad_s2,qdd4_rad_s2,qdd5_rad_s2,qdd6_rad_s2,tip_x_m,tip_y_m,tip_z_m";

/// What stands in the header behind [`HEADER`] where a motion was executed: torques.
pub const TORQUES: &str = ",tau1_n_m,tau2_n_m,tau3_n_m,tau4_n_m,tau5_n_m,tau6_n_m";

/// What stands behind [`TORQUES`] where the force on the sponge was simulated, along the tool's axis.
pub const FORCE: &str = ",force_n";

/// The motion at multiples of `dt_s` and at its end: time, segment, plate, joint positions, speeds, accelerations (to
/// the right of the time) and the origin of `tip`. Numbers are the shortest that read back exactly.
///
/// # Errors
/// [`CsvError::Step`].
pub fn table<'a>(
    motion: &'a Trajectory,
    segments: &'a [PlanSegment],
    robot: &'a RobotModel,
    tip: &Frame,
    dt_s: f64,
) -> Result<MotionTable<'a>, CsvError> {
    check_step(motion.duration_s(), dt_s)?;
    Ok(MotionTable {
        motion,
        segments,
        robot,
        tip: *tip,
        dt_s,
    })
}

/// A motion as CSV, made row by row while it is written: [`table`].
#[derive(Debug, Clone)]
pub struct MotionTable<'a> {
    motion: &'a Trajectory,
    segments: &'a [PlanSegment],
    robot: &'a RobotModel,
    tip: Frame,
    dt_s: f64,
}

impl fmt::Display for MotionTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let duration_s = self.motion.duration_s();
        // A last step shorter than a millionth of dt is rounding, not a row.
        let whole = (duration_s / self.dt_s - 1e-6).ceil();
        let times = (0..whole.max(0.0) as usize).map(|k| k as f64 * self.dt_s);
        writeln!(f, "{HEADER}")?;
        for t in times.chain([duration_s]) {
            let Some(state) = self.motion.at(t) else { continue };
            // Times that are a knot's up to rounding belong to the segment that the knot ends.
            let is_over = |s: &&PlanSegment| t <= s.t_end_s + 1e-6 * self.dt_s;
            let segment = self.segments.iter().find(is_over).or(self.segments.last());
            let at = self.robot.fk(&state.q).rigid(&self.tip).translation;
            write_row(f, t, segment, [&state.q, &state.qd, &state.qdd], &at)?;
            writeln!(f)?;
        }
        Ok(())
    }
}

/// Writes the columns of [`HEADER`]: time \[s\], segment, joint positions, speeds and accelerations \[rad, rad/s, rad/s²\], and the
/// tip \[m\].
///
/// # Errors
/// That of the writer.
pub fn write_row(
    f: &mut fmt::Formatter<'_>,
    t_s: f64,
    segment: Option<&PlanSegment>,
    motion: [&JointVector; 3],
    tip: &Vector3<f64>,
) -> fmt::Result {
    match segment {
        Some(segment) => write!(f, "{t_s},{},{}", segment.kind.name(), segment.plate)?,
        None => write!(f, "{t_s},,")?,
    }
    for joints in motion {
        write_joints(f, joints)?;
    }
    write!(f, ",{},{},{}", tip.x, tip.y, tip.z)
}

/// Writes a number a joint, each behind a comma.
///
/// # Errors
/// That of the writer.
pub fn write_joints(f: &mut fmt::Formatter<'_>, joints: &JointVector) -> fmt::Result {
    joints.iter().try_for_each(|value| write!(f, ",{value}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// What is suggested is accepted when it is typed in, and hardly anything less is.
        #[test]
        fn a_suggested_time_step_is_accepted(mantissa in 1.0..10.0_f64, exponent in -3..12_i32, share in 1e-9..0.9_f64) {
            let duration_s = mantissa * 10_f64.powi(exponent);
            let refused = check_step(duration_s, share * least_step_s(duration_s)).unwrap_err().to_string();
            let suggested = refused.rsplit("at least ").next().and_then(|s| s.strip_suffix(" s")).unwrap();
            prop_assert_eq!(check_step(duration_s, suggested.parse().unwrap()), Ok(()), "{}", refused);
        }
    }

    #[test]
    fn a_time_step_that_is_none_is_refused_as_such() {
        for dt_s in [0.0, -1.0, f64::NAN] {
            assert!(check_step(1.0, dt_s).unwrap_err().to_string().contains("positive"));
        }
    }
}
