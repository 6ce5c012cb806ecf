//! Trajectories as tables: a header line, then a row a point.
//!
//! Positions are `q1_rad` to `q6_rad` in the arm's order, or columns with the names of its joints; `t_s`, speeds and accelerations may be left
//! out. Other columns of this program's own tables are not read.

use crate::file::fixed_joints::{check_fixed, check_fixed_names};
use crate::place::ReadError;
use crate::points::JointPoints;
use crate::time::ExactTime;
use platewash_kinematics::urdf::FixedJoints;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::csv::{MAX_ROWS, STATE};
use platewash_workcell::number_table::{self, NumberTable, Row, TableError, TableShape};
use platewash_workcell::words::{quoted, shortened};
use std::borrow::Cow;

/// Greatest magnitude of a number \[rad, rad/s, rad/s²\].
const GREATEST: f64 = 1e6;

const TIME: [&str; 1] = ["t_s"];

/// Columns of this program's own tables that are not read.
const PLACE: [&str; 2] = ["segment", "plate"];
const TIP: [&str; 3] = ["tip_x_m", "tip_y_m", "tip_z_m"];
const PLAN_TIME: [&str; 1] = ["plan_t_s"];

/// Reads a table: the points, and the line of each.
pub(super) fn read(
    name: &str,
    text: &str,
    arm: &RobotModel,
    fixed: &FixedJoints,
) -> Result<(JointPoints, Vec<usize>), ReadError> {
    let text = with_bare_header(text);
    let columns = Columns::from_header(&text, arm, fixed);
    let read = columns.table(&text).and_then(|table| {
        let is_there = |name: &str| table.places(&[name]).is_some();
        let known = check_fixed_names(arm, fixed, is_there);
        known.map_err(|reason| TableError {
            line: 1,
            column: None,
            reason,
        })?;
        columns.points(&table)
    });
    read.map_err(|error| ReadError::at(name, error.line, error.without_line()))
}

/// The text of a table with its header as a line of its own: NumPy writes the header behind a `#`, right before the first row of numbers.
fn with_bare_header(text: &str) -> Cow<'_, str> {
    let is_number = |cell: &str| cell.trim().parse::<f64>().is_ok();
    let is_row = |line: &&str| line.split(',').all(is_number);
    let mut before = None;
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        if line.trim_start_matches('\u{feff}').starts_with('#') {
            before = Some(line);
            continue;
        }
        let Some(header) = before.filter(|_| is_row(&line)) else {
            break;
        };
        let names = header.trim_start_matches(['\u{feff}', '#']);
        if names.split(',').count() != line.split(',').count() {
            break;
        }
        let at = header.as_ptr() as usize - text.as_ptr() as usize;
        return Cow::Owned([&text[..at], names, &text[at + header.len()..]].concat());
    }
    Cow::Borrowed(text)
}

/// Longest name of a column that a message repeats, in characters.
const LONGEST: usize = 40;

/// Names of the columns of positions, speeds and accelerations.
struct Columns {
    /// Names of the arm's joints.
    names: [String; AXES],
    /// Columns of the six axes, and the position of each that is fixed.
    axes: [[String; AXES]; 3],
    at: [Option<f64>; AXES],
    /// Columns of other joints that are fixed, and their positions.
    others: Vec<([String; 3], f64)>,
}

impl Columns {
    /// Names in the table of an arm: those of its joints where the header has one of them.
    fn from_header(text: &str, arm: &RobotModel, fixed: &FixedJoints) -> Self {
        let named = |name: &str| [name.to_owned(), format!("{name}_rad_s"), format!("{name}_rad_s2")];
        let names = arm.joints().each_ref().map(|joint| joint.name.as_str());
        let header = number_table::header(text, true);
        let is_named = header.is_some_and(|(_, header)| header.iter().any(|column| names.contains(column)));
        let axis = |rate: usize, joint: usize| match is_named {
            true => named(names[joint])[rate].clone(),
            false => STATE[rate][joint].to_owned(),
        };
        let others = fixed.iter().filter(|(name, _)| !names.contains(&name.as_str()));
        Self {
            names: names.map(str::to_owned),
            axes: std::array::from_fn(|rate| std::array::from_fn(|joint| axis(rate, joint))),
            at: names.map(|name| fixed.get(name).copied()),
            others: others.map(|(name, at)| (named(name), *at)).collect(),
        }
    }

    fn table<'t>(&self, text: &'t str) -> Result<NumberTable<'t>, TableError> {
        let moving = |rate: usize| -> Vec<&str> {
            let axes = self.axes[rate].iter().zip(&self.at);
            axes.filter(|(_, at)| at.is_none())
                .map(|(name, _)| name.as_str())
                .collect()
        };
        let [positions, speeds, accelerations] = [0, 1, 2].map(moving);
        let still: Vec<[&str; 1]> = self.fixed().map(|(name, _)| [name]).collect();
        let mut optional: Vec<&[&str]> = vec![&TIME, &speeds, &accelerations, &PLACE, &TIP, &PLAN_TIME];
        optional.extend(still.iter().map(|name| &name[..]));
        let known = |column: &str| positions.contains(&column) || optional.iter().any(|group| group.contains(&column));
        self.check_header(text, known)?;
        NumberTable::read(
            text,
            &TableShape {
                required: &positions,
                optional: &optional,
                most: GREATEST,
                most_rows: MAX_ROWS,
                has_comments: true,
            },
        )
    }

    /// Refuses a header with a column that is not known, and says what to do about it.
    fn check_header(&self, text: &str, is_known: impl Fn(&str) -> bool) -> Result<(), TableError> {
        let Some((line, names)) = number_table::header(text, true) else {
            return Ok(());
        };
        let refused = |reason| {
            Err(TableError {
                line,
                column: None,
                reason,
            })
        };
        let expected = self.expected();
        if let [all] = names[..]
            && let Some(found) = all.chars().find(|c| [';', '\t', ' '].contains(c))
        {
            return refused(format!(
                "columns are separated by {found:?}; expected commas between them, and a point for decimals: {expected}"
            ));
        }
        if names.iter().all(|name| name.parse::<f64>().is_ok()) {
            return refused(format!(
                "found numbers in the first line; expected a header there: {expected}"
            ));
        }
        let Some(unknown) = names.iter().find(|name| !is_known(name)) else {
            return Ok(());
        };
        let advice = self.advice(unknown);
        let unknown = quoted(&shortened(unknown, LONGEST));
        refused(format!("column {unknown} is unknown; {advice}; expected {expected}"))
    }

    /// Columns that are read, in words.
    fn expected(&self) -> String {
        let names = self.names.join(", ");
        format!(
            "t_s [s], which may be left out; q1_rad to q6_rad or the names of the joints ({names}) [rad]; and, where they are known, speeds \
             qd1_rad_s or NAME_rad_s and accelerations qdd1_rad_s2 or NAME_rad_s2"
        )
    }

    /// Advice on a column that is not known.
    fn advice(&self, column: &str) -> String {
        let small = column.to_ascii_lowercase();
        let has = |words: &[&str]| words.iter().any(|word| small.contains(word));
        if has(&["time", "stamp", "clock", "sec"]) || ["t", "ts", "t_ms", "t_ns"].contains(&small.as_str()) {
            return "if it has times in seconds, rename it t_s (those of a clock may stay as they are; milliseconds and nanoseconds must be \
                    converted)"
                .to_owned();
        }
        if has(&["deg"]) {
            return "angles must be radians".to_owned();
        }
        if let Some(joint) = self
            .names
            .iter()
            .find(|name| small.contains(&name.to_ascii_lowercase()))
        {
            return format!("if it has positions of {joint} in radians, rename it {joint}; speeds are {joint}_rad_s");
        }
        match small.as_str() {
            "" => "it has no name".to_owned(),
            _ => format!(
                "a joint that does not move can be fixed (--fix {}=VALUE), what another one moves is not judged, and anything else can be \
                 removed",
                shortened(column, LONGEST)
            ),
        }
    }

    /// Columns of joints that are fixed, with the number that each must have.
    fn fixed(&self) -> impl Iterator<Item = (&str, f64)> {
        let axes = (0..AXES).filter_map(|joint| {
            let names = self.axes.each_ref().map(|names| names[joint].as_str());
            self.at[joint].map(|at| (names, at))
        });
        let others = self
            .others
            .iter()
            .map(|(names, at)| (names.each_ref().map(String::as_str), *at));
        axes.chain(others)
            .flat_map(|([position, speed, acceleration], at)| [(position, at), (speed, 0.0), (acceleration, 0.0)])
    }

    fn points(&self, table: &NumberTable<'_>) -> Result<(JointPoints, Vec<usize>), TableError> {
        // The motion of a plan is made of cubics; its table has their accelerations, too, at rows that are none of their ends.
        let is_plan = table.places(&PLACE).is_some() && table.places(&TIP).is_some();
        let place = |name: &str| table.places(&[name]).map(|[place]| place);
        let places = [0, 1, 2].map(|rate: usize| self.axes[rate].each_ref().map(|name| place(name)));
        let time = table.places(&TIME);
        let still: Vec<_> = self
            .fixed()
            .filter_map(|(name, at)| Some((name, place(name)?, at)))
            .collect();
        let (mut all, mut times, mut lines) = ([const { Vec::new() }; 3], Vec::new(), Vec::new());
        for row in table.rows() {
            let row = row?;
            if let Some(place) = time {
                let t = read_time(&row, place[0])?;
                if let Some(before) = times.last().filter(|before| t <= **before) {
                    return row.refused(
                        place[0],
                        format!("{t} s must come after {before} s, the time of the row before"),
                    );
                }
                times.push(t);
            }
            for (name, place, at) in &still {
                let [found] = row.numbers([*place])?;
                check_fixed(name, *at, found).or_else(|reason| row.refused(*place, reason))?;
            }
            for (rate, all) in all.iter_mut().enumerate() {
                let axis = |joint: usize| match (places[rate][joint], self.at[joint]) {
                    (Some(place), _) => Ok(row.numbers([place])?[0]),
                    (None, at) => Ok(at.filter(|_| rate == 0).unwrap_or(0.0)),
                };
                let numbers: Vec<f64> = (0..AXES).map(axis).collect::<Result<_, TableError>>()?;
                all.push(JointVector::from_iterator(numbers));
            }
            lines.push(row.line);
        }
        let has = |rate: usize| (0..AXES).any(|joint| self.at[joint].is_none() && places[rate][joint].is_some());
        let [q_rad, speeds, accelerations] = all;
        let notes = match is_plan && has(2) {
            true => vec![
                "its accelerations are not used, as a table with the columns segment, plate and tip_x_m to tip_z_m is of a plan, which is made \
                 of cubics"
                    .to_owned(),
            ],
            false => Vec::new(),
        };
        let start = times.first().copied().unwrap_or_default();
        let points = JointPoints {
            q_rad,
            t_s: time.map(|_| times.iter().map(|t| t.since(start)).collect()),
            start,
            notes,
            qd_rad_s: has(1).then_some(speeds),
            qdd_rad_s2: (has(2) && !is_plan).then_some(accelerations),
            ..JointPoints::default()
        };
        Ok((points, lines))
    }
}

/// Returns the time in a cell, with all of its digits.
fn read_time(row: &Row<'_>, place: usize) -> Result<ExactTime, TableError> {
    ExactTime::parse(row.text(place)).map_or_else(
        || {
            let found = row.quoted(place);
            row.refused(
                place,
                format!("expected a time in seconds, with a point for decimals; found {found}"),
            )
        },
        Ok,
    )
}
