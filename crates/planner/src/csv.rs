//! A motion as CSV, for spreadsheets and plots.

use crate::plan::PlanSegment;
use crate::trajectory::Trajectory;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use std::fmt::Write;

/// Most rows that are written.
pub const MAX_ROWS: usize = 1_000_000;

/// Why a motion was not written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CsvError {
    /// A time step that makes no sense.
    #[error("the CSV's time step must be positive and give at most {MAX_ROWS} rows; found {dt_s} s for {duration_s} s")]
    Step {
        /// The step \[s\].
        dt_s: f64,
        /// The motion's duration \[s\].
        duration_s: f64,
    },
}

/// The header line.
pub const HEADER: &str = "t_s,segment,plate,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,\
qd1_rad_s,qd2_rad_s,qd3_rad_s,qd4_rad_s,qd5_rad_s,qd6_rad_s,\
qdd1_rad_s2,qdd2_rad_s2,qdd3_rad_s2,qdd4_rad_s2,qdd5_rad_s2,qdd6_rad_s2,tip_x_m,tip_y_m,tip_z_m";

/// The motion at multiples of `dt_s` and at its end: time, segment, plate, joint positions, speeds, accelerations (to
/// the right of the time) and the origin of `tip`. Numbers are the shortest that read back exactly.
///
/// # Errors
/// [`CsvError::Step`].
pub fn table(
    motion: &Trajectory,
    segments: &[PlanSegment],
    robot: &RobotModel,
    tip: &Frame,
    dt_s: f64,
) -> Result<String, CsvError> {
    let duration_s = motion.duration_s();
    // A last step shorter than a millionth of dt is rounding, not a row.
    let whole = (duration_s / dt_s - 1e-6).ceil();
    if !(dt_s > 0.0 && whole < MAX_ROWS as f64) {
        return Err(CsvError::Step { dt_s, duration_s });
    }
    let times = (0..whole.max(0.0) as usize)
        .map(|k| k as f64 * dt_s)
        .chain([duration_s]);
    let mut text = String::from(HEADER);
    text.push('\n');
    for t in times {
        let Some(state) = motion.at(t) else { continue };
        // Times that are a knot's up to rounding belong to the segment that the knot ends.
        let part = segments
            .iter()
            .find(|s| t <= s.t_end_s + 1e-6 * dt_s)
            .or(segments.last());
        let (kind, plate) = part.map_or(("", String::new()), |s| (s.kind.name(), s.plate.to_string()));
        // Writing to a String cannot fail.
        let _ = write!(text, "{t},{kind},{plate}");
        for row in [&state.q, &state.qd, &state.qdd] {
            push(&mut text, row);
        }
        let at = robot.fk(&state.q).rigid(tip).translation;
        let _ = writeln!(text, ",{},{},{}", at.x, at.y, at.z);
    }
    Ok(text)
}

fn push(text: &mut String, row: &JointVector) {
    for value in row.iter() {
        let _ = write!(text, ",{value}");
    }
}
