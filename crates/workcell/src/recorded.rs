//! A motion read back from CSV, as this program writes it: [`csv::HEADER`], and torques where it was executed.
//!
//! It is read strictly. What segment and plate a row belongs to, and where its tip is, is the plan's business: these columns are there and
//! not read.

use crate::csv::{self, MAX_ROWS};
use crate::number_table::{NumberTable, Row, TableError, TableShape};
use platewash_kinematics::JointVector;

/// What a number may be at most \[rad, rad/s, rad/s², N·m, s\]; beyond it the file is in other units, or no motion.
const GREATEST: f64 = 1e6;

/// Columns of the time; of torques; of the force.
const TIME: [&str; 1] = ["t_s"];
const TORQUE: [&str; 6] = ["tau1_n_m", "tau2_n_m", "tau3_n_m", "tau4_n_m", "tau5_n_m", "tau6_n_m"];
const FORCE: [&str; 1] = ["force_n"];

/// A recorded motion.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedMotion {
    /// Its samples, in time order; at least one.
    pub samples: Vec<RecordedSample>,
}

/// A sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecordedSample {
    /// When \[s\], from 0.
    pub t_s: f64,
    /// Positions \[rad\].
    pub q: JointVector,
    /// Speeds \[rad/s\].
    pub qd: JointVector,
    /// Accelerations \[rad/s²\].
    pub qdd: JointVector,
    /// Torques \[N·m\], where the file has them.
    pub torque: Option<JointVector>,
    /// Force on the sponge along the tool's axis \[N\], where it was simulated.
    pub force_n: Option<f64>,
}

impl RecordedMotion {
    /// Reads a table with the columns of [`csv::HEADER`], and those of [`csv::TORQUES`] where the motion was executed.
    ///
    /// # Errors
    /// [`TableError`] with the first line that does not fit, without the file's name.
    pub fn from_csv(text: &str) -> Result<Self, TableError> {
        let required: Vec<&str> = csv::HEADER.split(',').collect();
        let table = NumberTable::read(
            text,
            &TableShape {
                required: &required,
                optional: &[&TORQUE, &FORCE],
                most: GREATEST,
                most_rows: MAX_ROWS,
                has_comments: false,
            },
        )?;
        let (time, force) = (table.places(&TIME), table.places(&FORCE));
        // Required columns are there.
        let time = time.unwrap_or_default();
        let [q, qd, qdd] = csv::STATE.map(|names| table.places(&names).unwrap_or_default());
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
        let torques = if torque { csv::TORQUES } else { "" };
        format!("{}{torques}\n{}\n", csv::HEADER, rows.join("\n"))
    }

    fn said(text: &str) -> String {
        RecordedMotion::from_csv(text).unwrap_err().to_string()
    }

    #[test]
    fn columns_come_back_where_they_belong() {
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
    fn what_is_wrong_is_said_with_its_line_and_column() {
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
            (
                csv::HEADER.to_owned() + csv::TORQUES + ",more\n",
                "column \"more\" is unknown",
            ),
        ];
        for (text, words) in cases {
            assert!(said(&text).contains(words), "{words}: {}", said(&text));
        }
    }

    #[test]
    fn a_long_or_hostile_cell_is_repeated_in_part_and_printable() {
        let text = table(
            &[row("0", true).replace(",12,", &format!(",\u{1b}[2J{},", "x".repeat(10_000)))],
            true,
        );
        let said = said(&text);
        assert!(said.len() < 200 && !said.contains('\u{1b}'), "{said}");
    }

    proptest! {
        /// Whatever is done to a table, it is read or refused.
        #[test]
        fn a_damaged_table_is_no_trouble(at in 0..600usize, with in "\\PC{0,3}|[,\n]", cut in 0..40usize) {
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
