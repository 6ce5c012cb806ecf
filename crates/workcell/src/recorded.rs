//! A motion read back from CSV, as this program writes it: [`csv::HEADER`], and torques where it was executed.
//!
//! It is read strictly. What segment and plate a row belongs to, and where its tip is, is the plan's business: these columns are there and
//! not read.

use crate::csv::{self, MAX_ROWS};
use crate::words::printable;
use platewash_kinematics::{AXES, JointVector};

/// Longest text of a cell that a message repeats, in characters.
const LONGEST: usize = 40;

/// What a number may be at most \[rad, rad/s, rad/s², N·m, s\]; beyond it the file is in other units, or no motion.
const GREATEST: f64 = 1e6;

/// Columns before the joints' positions: time, segment, plate.
const BEFORE_JOINTS: usize = 3;

/// Columns of the tip.
const TIP: usize = 3;

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

/// Why a text is no recorded motion. Lines and columns count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordedError {
    /// No line at all.
    #[error("it is empty; expected the header \"t_s,segment,plate,q1_rad,…\"")]
    Empty,
    /// A header and nothing else.
    #[error("it has a header and no rows")]
    NoRows,
    /// A column of the header that is another one.
    #[error("line 1, column {column}: expected {expected}, found {found}")]
    Header {
        /// The column.
        column: usize,
        /// Its name.
        expected: String,
        /// What stands there.
        found: String,
    },
    /// A row of another length than the header.
    #[error("line {line}: {found} columns; the header has {expected}")]
    Columns {
        /// The line.
        line: usize,
        /// As many as the header has.
        expected: usize,
        /// As many as it has.
        found: usize,
    },
    /// A cell that is no number of a motion.
    #[error("line {line}, column {column} ({name}): expected a number from -1e6 to 1e6, found {found}")]
    Number {
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// Its name.
        name: String,
        /// What stands there.
        found: String,
    },
    /// A time that is not after the one before it.
    #[error("line {line}, column 1 (t_s): {t_s} s must come after {after_s} s, the time of the row before")]
    Order {
        /// The line.
        line: usize,
        /// Its time \[s\].
        t_s: f64,
        /// The time of the row before \[s\].
        after_s: f64,
    },
    /// A first time before 0.
    #[error("line {line}, column 1 (t_s): {t_s} s is before 0, when the plan begins")]
    Early {
        /// The line.
        line: usize,
        /// Its time \[s\].
        t_s: f64,
    },
    /// More rows than are read.
    #[error("it has more than {MAX_ROWS} rows, the most that are read; write it with a longer time step")]
    TooLong,
}

impl RecordedMotion {
    /// Reads a table with the columns of [`csv::HEADER`], and those of [`csv::TORQUES`] where the motion was executed.
    ///
    /// # Errors
    /// [`RecordedError`] with the first line that does not fit, without the file's name.
    pub fn from_csv(text: &str) -> Result<Self, RecordedError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text.lines().enumerate();
        let header = lines.next().map_or("", |(_, line)| line);
        if header.trim().is_empty() {
            return Err(RecordedError::Empty);
        }
        let names = names(header)?;
        let mut samples: Vec<RecordedSample> = Vec::new();
        for (index, line) in lines {
            if samples.len() == MAX_ROWS {
                return Err(RecordedError::TooLong);
            }
            let row = Row {
                line: index + 1,
                names: &names,
            };
            let sample = row.sample(line)?;
            row.check_time(sample.t_s, samples.last())?;
            samples.push(sample);
        }
        match samples.is_empty() {
            true => Err(RecordedError::NoRows),
            false => Ok(Self { samples }),
        }
    }
}

/// The columns that a header names.
fn names(header: &str) -> Result<Vec<&'static str>, RecordedError> {
    let found: Vec<&str> = header.split(',').collect();
    let mut expected: Vec<_> = csv::HEADER.split(',').collect();
    if found.len() > expected.len() {
        expected.extend(csv::TORQUES.split(',').skip(1));
    }
    if found.len() > expected.len() {
        expected.extend(csv::FORCE.split(',').skip(1));
    }
    let at = |names: &[&str], k: usize| names.get(k).copied().map(shortened);
    let columns = expected.len().max(found.len());
    match (0..columns).find(|&k| expected.get(k) != found.get(k)) {
        Some(k) => Err(RecordedError::Header {
            column: k + 1,
            expected: at(&expected, k).unwrap_or_else(|| "the end of the line".to_owned()),
            found: at(&found, k).unwrap_or_else(|| "the end of the line".to_owned()),
        }),
        None => Ok(expected),
    }
}

/// A row of the table.
struct Row<'a> {
    line: usize,
    names: &'a [&'static str],
}

impl Row<'_> {
    fn sample(&self, text: &str) -> Result<RecordedSample, RecordedError> {
        let found = text.split(',').count();
        let expected = self.names.len();
        if found != expected {
            let line = self.line;
            return Err(RecordedError::Columns { line, expected, found });
        }
        let mut cells = text.split(',').enumerate();
        let t_s = match cells.next() {
            Some(cell) => self.number(cell)?,
            None => return Err(RecordedError::NoRows),
        };
        let mut cells = cells.skip(BEFORE_JOINTS - 1);
        let [q, qd, qdd] = [
            self.joints(&mut cells)?,
            self.joints(&mut cells)?,
            self.joints(&mut cells)?,
        ];
        let mut cells = cells.skip(TIP).peekable();
        let torque = match cells.peek() {
            Some(_) => Some(self.joints(&mut cells)?),
            None => None,
        };
        let force_n = cells.next().map(|cell| self.number(cell)).transpose()?;
        Ok(RecordedSample {
            t_s,
            q,
            qd,
            qdd,
            torque,
            force_n,
        })
    }

    /// The next six numbers.
    fn joints<'c>(&self, cells: &mut impl Iterator<Item = (usize, &'c str)>) -> Result<JointVector, RecordedError> {
        let mut joints = JointVector::zeros();
        for (joint, cell) in cells.take(AXES).enumerate() {
            joints[joint] = self.number(cell)?;
        }
        Ok(joints)
    }

    fn number(&self, (index, cell): (usize, &str)) -> Result<f64, RecordedError> {
        let number = cell.trim().parse::<f64>().ok();
        number
            .filter(|number| number.abs() <= GREATEST)
            .ok_or_else(|| RecordedError::Number {
                line: self.line,
                column: index + 1,
                name: self.names.get(index).copied().unwrap_or_default().to_owned(),
                found: shortened(cell),
            })
    }

    fn check_time(&self, t_s: f64, before: Option<&RecordedSample>) -> Result<(), RecordedError> {
        let line = self.line;
        match before {
            Some(before) if t_s <= before.t_s => {
                let after_s = before.t_s;
                Err(RecordedError::Order { line, t_s, after_s })
            }
            None if t_s < 0.0 => Err(RecordedError::Early { line, t_s }),
            _ => Ok(()),
        }
    }
}

/// A cell as a message repeats it: in quotes, printable, and no longer than need be.
fn shortened(cell: &str) -> String {
    match cell.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("\"{}…\"", printable(&cell[..end])),
        None => format!("\"{}\"", printable(cell)),
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
            (table(&[good()], false), "line 2: 30 columns; the header has 24"),
            (table(&[row("0", false)], true), "line 2: 24 columns; the header has 30"),
            (table(&[good(), String::new()], true), "line 3: 1 columns"),
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
                "line 2, column 1 (t_s): expected a number from -1e6 to 1e6, found \"NaN\"",
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
                "line 2, column 4 (q1_rad): expected a number from -1e6 to 1e6, found \"\"",
            ),
            (
                table(&[good()], true).replace("qd3_rad_s,", "qd3_deg_s,"),
                "line 1, column 12: expected \"qd3_rad_s\", found \"qd3_deg_s\"",
            ),
            // An arm of seven joints.
            (
                table(&[good()], true).replace("q6_rad,", "q6_rad,q7_rad,"),
                "line 1, column 10: expected \"qd1_rad_s\", found \"q7_rad\"",
            ),
            (
                "t_s,segment\n".to_owned(),
                "line 1, column 3: expected \"plate\", found the end of the line",
            ),
            (
                csv::HEADER.to_owned() + csv::TORQUES + ",more\n",
                "column 31: expected \"force_n\", found \"more\"",
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
