//! A motion as CSV, for spreadsheets and plots.
//!
//! The CSV is also read back, in the format that this program writes: [`HEADER`], and torques if the motion was executed.
//!
//! Reading is strict. The columns for segment, plate and tip must be present but are not read, as they follow from the plan.

use crate::number_table::{NumberTable, Row, TableError, TableShape};
use crate::trajectory::{PlanSegment, Trajectory};
use crate::words::push_shortest;
use nalgebra::Vector3;
use platewash_kinematics::words::rounded_up;
use platewash_kinematics::{Frame, JointVector, RobotModel};
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

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// A suggested time step is accepted when it is entered, and hardly any smaller one is.
        #[test]
        fn a_suggested_time_step_is_accepted(mantissa in 1.0..10.0_f64, exponent in -3..12_i32, share in 1e-9..0.9_f64) {
            let duration_s = mantissa * 10_f64.powi(exponent);
            let refused = check_step(duration_s, share * least_step_s(duration_s)).unwrap_err().to_string();
            let suggested = refused.rsplit("at least ").next().and_then(|s| s.strip_suffix(" s")).unwrap();
            prop_assert_eq!(check_step(duration_s, suggested.parse().unwrap()), Ok(()), "{}", refused);
        }
    }

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

    #[test]
    fn rejects_an_invalid_time_step() {
        for dt_s in [0.0, -1.0, f64::NAN] {
            assert!(check_step(1.0, dt_s).unwrap_err().to_string().contains("positive"));
        }
    }

    fn row(t_s: &str, torque: bool) -> String {
        let joints = |first: usize| (first..first + 6).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
        let tail = if torque {
            format!(",{}", joints(30))
        } else {
            String::new()
        };
        format!(
            "{t_s},wash,0,{},{},{},0.1,0.2,0.3{tail}",
            joints(1),
            joints(10),
            joints(20)
        )
    }

    fn table(rows: &[String], torque: bool) -> String {
        let torques = if torque { TORQUES } else { "" };
        format!("{}{torques}\n{}\n", HEADER, rows.join("\n"))
    }

    fn error_text(text: &str) -> String {
        RecordedMotion::from_csv(text).unwrap_err().to_string()
    }

    #[test]
    fn reads_columns_back_in_their_places() {
        for torque in [false, true] {
            let text = table(&[row("0", torque), row("0.5", torque)], torque);
            let joints = |first: usize| JointVector::from_fn(|joint, _| (first + joint) as f64);
            let motion = RecordedMotion::from_csv(&text).unwrap();
            let expected = RecordedSample {
                t_s: 0.5,
                q: joints(1),
                qd: joints(10),
                qdd: joints(20),
                torque: torque.then(|| joints(30)),
                force_n: None,
            };
            assert_eq!((motion.samples.len(), motion.samples[1]), (2, expected));
            // As a spreadsheet on another system writes it.
            let other = format!("\u{feff}{}", text.replace('\n', "\r\n"));
            assert_eq!(RecordedMotion::from_csv(&other), Ok(motion));
        }
    }

    #[test]
    fn errors_name_line_and_column() {
        let good = || row("0", true);
        let cases = [
            (String::new(), "empty"),
            ("\n\n".to_owned(), "empty"),
            (table(&[], true).trim_end().to_owned() + "\n", "no rows"),
            (table(&[good()], false), "line 2: found 30 columns; expected 24"),
            (table(&[row("0", false)], true), "line 2: found 24 columns; expected 30"),
            (
                table(&[good(), String::new()], true),
                "line 3: found 1 column; expected 30",
            ),
            (
                table(&[good(), good()], true),
                "line 3, column 1 (t_s): 0 s must come after 0 s",
            ),
            (
                table(&[row("0.2", true), row("0.1", true)], true),
                "line 3, column 1 (t_s): 0.1 s must come after 0.2 s",
            ),
            (
                table(&[row("-0.1", true)], true),
                "line 2, column 1 (t_s): -0.1 s is before 0",
            ),
            (
                table(&[row("NaN", true)], true),
                "line 2, column 1 (t_s): expected a number from -1e6 to 1e6, with a point for decimals; found \"NaN\"",
            ),
            (
                table(&[good().replace(",12,", ",inf,")], true),
                "line 2, column 12 (qd3_rad_s)",
            ),
            (
                table(&[good().replace(",35", ",1e7")], true),
                "line 2, column 30 (tau6_n_m)",
            ),
            (
                table(&[good().replace(",1,", ",,")], true),
                "line 2, column 4 (q1_rad): expected a number from -1e6 to 1e6, with a point for decimals; found \"\"",
            ),
            (
                table(&[good()], true).replace("qd3_rad_s,", "qd3_deg_s,"),
                "line 1: column \"qd3_deg_s\" is unknown",
            ),
            // An arm of seven joints.
            (
                table(&[good()], true).replace("q6_rad,", "q6_rad,q7_rad,"),
                "line 1: column \"q7_rad\" is unknown",
            ),
            ("t_s,segment\n".to_owned(), "line 1: column \"plate\" is missing"),
            (HEADER.to_owned() + TORQUES + ",more\n", "column \"more\" is unknown"),
        ];
        for (text, words) in cases {
            assert!(error_text(&text).contains(words), "{words}: {}", error_text(&text));
        }
    }

    #[test]
    fn a_long_or_hostile_cell_is_repeated_in_part_and_printable() {
        let text = table(
            &[row("0", true).replace(",12,", &format!(",\u{1b}[2J{},", "x".repeat(10_000)))],
            true,
        );
        let said = error_text(&text);
        assert!(said.len() < 200 && !said.contains('\u{1b}'), "{said}");
    }

    proptest! {
        /// Any damaged table is read or refused, without a panic.
        #[test]
        fn damaged_tables_never_panic(at in 0..600usize, with in "\\PC{0,3}|[,\n]", cut in 0..40usize) {
            let text = table(&[row("0", true), row("0.25", true)], true);
            let start = at.min(text.len());
            let end = (start + cut).min(text.len());
            let damaged = format!("{}{with}{}", &text[..start], &text[end..]);
            if let Ok(motion) = RecordedMotion::from_csv(&damaged) {
                prop_assert!(motion.samples.windows(2).all(|pair| pair[0].t_s < pair[1].t_s));
                prop_assert!(motion.samples.iter().all(|sample| sample.q.iter().all(|q| q.is_finite())));
            }
        }
    }
}
