//! A motion as CSV, for spreadsheets and plots.
//!
//! The CSV is also read back, in the format that this program writes: [`HEADER`], and torques if the motion was executed.
//!
//! Reading is strict. The columns for segment, plate and tip must be present but are not read, as they follow from the plan.

use crate::digits::push_shortest;
use crate::trajectory::{PlanSegment, Trajectory};
use nalgebra::Vector3;
use platewash_kinematics::words::rounded_up;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_workcell::number_table::{NumberTable, Row, TableError, TableShape};
use std::fmt;

/// Greatest number of rows.
pub const MAX_ROWS: usize = 1_000_000;

/// Reason that a motion was not written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CsvError {
    /// The time step is not positive, or gives too many rows.
    #[error("{}", step(*.dt_s, *.duration_s))]
    Step {
        /// Time step \[s\].
        dt_s: f64,
        /// Duration of the motion \[s\].
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

/// Significant digits of a suggested time step.
const STEP_DIGITS: usize = 3;

/// Returns a time step \[s\] with which a motion of `duration_s` \[s\] or less gives no more than [`MAX_ROWS`] rows: the least one with
/// three digits, up to a row or two for rounding.
#[must_use]
pub fn least_step_s(duration_s: f64) -> f64 {
    rounded_up(duration_s / (MAX_ROWS - 2) as f64, STEP_DIGITS)
}

/// Refuses a time step that is not positive, or that gives more than [`MAX_ROWS`] rows for a motion of `duration_s` \[s\].
///
/// # Errors
/// [`CsvError::Step`]. Its message has a step that is accepted.
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

/// Header columns after [`HEADER`] for an executed motion: torques.
pub const TORQUES: &str = ",tau1_n_m,tau2_n_m,tau3_n_m,tau4_n_m,tau5_n_m,tau6_n_m";

/// Header column after [`TORQUES`] if the force on the sponge along the tool's axis was simulated.
pub const FORCE: &str = ",force_n";

/// Formats the motion at multiples of `dt_s` and at its end: time, segment, plate, joint positions, speeds, accelerations (at a knot those
/// after it) and the origin of `tip`. Numbers are the shortest that read back exactly.
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

/// A motion as CSV, made row by row while it is written; see [`table`].
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
        let mut row = String::new();
        for t in times.chain([duration_s]) {
            let Some(state) = self.motion.at(t) else { continue };
            // Times that are a knot's up to rounding belong to the segment that the knot ends.
            let is_over = |s: &&PlanSegment| t <= s.t_end_s + 1e-6 * self.dt_s;
            let segment = self.segments.iter().find(is_over).or(self.segments.last());
            let at = self.robot.fk(&state.q).rigid(&self.tip).translation;
            row.clear();
            add_row(&mut row, t, segment, [&state.q, &state.qd, &state.qdd], &at);
            row.push('\n');
            f.write_str(&row)?;
        }
        Ok(())
    }
}

/// Adds the columns of [`HEADER`] to a row: time \[s\], segment, joint positions, speeds and accelerations \[rad, rad/s, rad/s²\], and the
/// tip \[m\].
pub fn add_row(
    row: &mut String,
    t_s: f64,
    segment: Option<&PlanSegment>,
    motion: [&JointVector; 3],
    tip: &Vector3<f64>,
) {
    add_number(row, t_s);
    match segment {
        Some(segment) => *row += &format!(",{},{}", segment.kind.name(), segment.plate),
        None => row.push_str(",,"),
    }
    add_numbers(row, motion.into_iter().flatten().chain(tip));
}

/// Adds numbers to a row, each after a comma.
pub fn add_numbers<'a>(row: &mut String, values: impl IntoIterator<Item = &'a f64>) {
    for value in values {
        row.push(',');
        add_number(row, *value);
    }
}

/// Adds a number as `{}` writes it, which takes longer: the shortest decimal that reads back exactly, without an exponent.
fn add_number(row: &mut String, value: f64) {
    if value != 0.0 && !(1e-300..1e15).contains(&value.abs()) {
        *row += &value.to_string();
        return;
    }
    let start = row.len();
    push_shortest(row, value);
    let Some((digits, exponent)) = row[start..].split_once('e') else {
        return;
    };
    // The exponent is negative.
    let zeros = exponent.parse().map_or(0, |exponent: i32| -1 - exponent).max(0) as usize;
    let (sign, digits) = digits.strip_prefix('-').map_or(("", digits), |digits| ("-", digits));
    let plain = format!("{sign}0.{:0<zeros$}{}", "", digits.replace('.', ""));
    row.replace_range(start.., &plain);
}

/// Greatest absolute value of a number \[rad, rad/s, rad/s², N·m, s\]. A larger one has another unit, or is no motion.
const GREATEST: f64 = 1e6;

/// Columns of the time, and below of torques and of the force.
const TIME: [&str; 1] = ["t_s"];
const TORQUE: [&str; 6] = ["tau1_n_m", "tau2_n_m", "tau3_n_m", "tau4_n_m", "tau5_n_m", "tau6_n_m"];
const FORCE_NAMES: [&str; 1] = ["force_n"];

/// A recorded motion.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedMotion {
    /// Samples in time order; at least one.
    pub samples: Vec<RecordedSample>,
}

/// Sample of a recorded motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordedSample {
    /// Time \[s\], from 0.
    pub t_s: f64,
    /// Positions \[rad\].
    pub q: JointVector,
    /// Speeds \[rad/s\].
    pub qd: JointVector,
    /// Accelerations \[rad/s²\].
    pub qdd: JointVector,
    /// Torques \[N·m\], if the file has them.
    pub torque: Option<JointVector>,
    /// Force on the sponge along the tool's axis \[N\], if it was simulated.
    pub force_n: Option<f64>,
}

impl RecordedMotion {
    /// Reads a table with the columns of [`HEADER`], and those of [`TORQUES`] if the motion was executed.
    ///
    /// # Errors
    /// [`TableError`] with the first line that does not fit, without the file's name.
    pub fn from_csv(text: &str) -> Result<Self, TableError> {
        let required: Vec<&str> = HEADER.split(',').collect();
        let table = NumberTable::read(
            text,
            &TableShape {
                required: &required,
                optional: &[&TORQUE, &FORCE_NAMES],
                most: GREATEST,
                most_rows: MAX_ROWS,
                has_comments: false,
            },
        )?;
        let (time, force) = (table.places(&TIME), table.places(&FORCE_NAMES));
        // Required columns are there.
        let time = time.unwrap_or_default();
        let [q, qd, qdd] = STATE.map(|names| table.places(&names).unwrap_or_default());
        let torque = table.places(&TORQUE);
        let mut samples: Vec<RecordedSample> = Vec::new();
        for row in table.rows() {
            let row = row?;
            let joints = |row: &Row<'_>, places| row.numbers(places).map(JointVector::from);
            let [t_s] = row.numbers(time)?;
            row.check_after(time[0], t_s, samples.last().map(|sample| sample.t_s))?;
            if t_s < 0.0 {
                return row.refused(time[0], format!("{t_s} s is before 0, when the plan begins"));
            }
            samples.push(RecordedSample {
                t_s,
                q: joints(&row, q)?,
                qd: joints(&row, qd)?,
                qdd: joints(&row, qdd)?,
                torque: torque.map(|places| joints(&row, places)).transpose()?,
                force_n: force
                    .map(|place| row.numbers(place))
                    .transpose()?
                    .map(|[force_n]| force_n),
            });
        }
        Ok(Self { samples })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// A number is written as the standard library writes it.
        #[test]
        fn numbers_are_plain_and_shortest(bits in any::<u64>(), near in -1000.0..1000.0_f64) {
            let written = |value: f64| {
                let mut row = String::new();
                add_number(&mut row, value);
                row
            };
            for value in [f64::from_bits(bits), near, near.round(), near * 1e-7, 0.0, -0.0, f64::NAN, f64::INFINITY] {
                prop_assert_eq!(written(value), value.to_string());
            }
        }
    }
}
