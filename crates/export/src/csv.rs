//! A table of positions and speeds at fixed steps, for whatever reads tables, and a text beside it that explains it.
//!
//! The table is strict: a header with a unit in each name, rows of numbers, nothing else. `plan_t_s` is the moment of the plan that a row
//! is, so that the table itself says at which share of the plan's speed it runs.

use crate::comment::wrapped;
use crate::dialect::{Dialect, Points, ReadError};
use crate::file::{Place, ProgramFile};
use crate::program::{Point, Program};
use crate::reading::{Between, ReadPoint, Reading};
use crate::refusal::Refusal;
use platewash_kinematics::words::fixed;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_workcell::csv::MAX_ROWS;
use platewash_workcell::job::JobTerms;
use platewash_workcell::words::{quoted, without_mark};

/// Time between two rows \[s\]: a control cycle of common controllers.
const STEP_S: f64 = 0.004;

/// Decimals of every number: a nanosecond, a nanoradian.
const DECIMALS: usize = 9;

/// What a number may be at most \[s, rad, rad/s\]; beyond it the file is in other units, or no motion.
const GREATEST: f64 = 1e6;

/// How far `plan_t_s` may be from its share of `t_s` \[s\].
const TIME_S: f64 = 1e-6;

/// Longest text of a cell that a message repeats, in characters.
const LONGEST: usize = 40;

const TIMES: [&str; 2] = ["t_s", "plan_t_s"];
const POSITIONS: [&str; AXES] = ["q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"];
const SPEEDS: [&str; AXES] = [
    "qd1_rad_s",
    "qd2_rad_s",
    "qd3_rad_s",
    "qd4_rad_s",
    "qd5_rad_s",
    "qd6_rad_s",
];

/// The dialect of tables.
#[derive(Debug, Clone, Copy)]
pub struct Csv;

impl Dialect for Csv {
    fn name(&self) -> &'static str {
        "csv"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        let head = file.text.trim_start_matches('\u{feff}');
        is_table(file) && (head.starts_with("t_s,plan_t_s,q1_rad") || head.starts_with("t_s,q1_rad"))
    }

    fn points(&self) -> Points {
        Points::Steps { step_s: STEP_S }
    }

    fn assumptions(&self) -> &'static [&'static str] {
        &[
            "Whatever follows this table is assumed to move each joint on the cubic that has the positions and speeds of two neighbouring \
             rows, and to be at each row at its time. Straight lines between rows differ from it by less than (step^2 / 8) x acceleration.",
            "Nobody has tried this table on a controller.",
            "The joints are assumed to have the zeros, signs and order of the arm's description.",
        ]
    }

    fn accepts(&self, _job: &JobTerms, _arm: &RobotModel) -> Result<(), Refusal> {
        // A table speaks of joints alone: any arm has six, and what it holds is not said.
        Ok(())
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        let table = ProgramFile {
            name: format!("{}.csv", program.name),
            text: table(program),
        };
        let about = ProgramFile {
            name: format!("{}.txt", program.name),
            text: about(program, &table.name),
        };
        vec![table, about]
    }

    fn read(&self, files: &[ProgramFile], _arm: &RobotModel) -> Result<Reading, ReadError> {
        let mut tables = files.iter().filter(|file| is_table(file));
        match (tables.next(), tables.next()) {
            (Some(file), None) => reading(file),
            (Some(_), Some(second)) => Err(ReadError::at(&second.name, 1, "a second table; expected one .csv file")),
            (None, _) => Err(ReadError::at(
                files.first().map_or("", |file| &file.name),
                1,
                "expected a file whose name ends in .csv",
            )),
        }
    }
}

fn is_table(file: &ProgramFile) -> bool {
    file.name.to_ascii_lowercase().ends_with(".csv")
}

/// The table's text.
fn table(program: &Program<'_>) -> String {
    let names: Vec<&str> = TIMES.into_iter().chain(POSITIONS).chain(SPEEDS).collect();
    let mut text = names.join(",") + "\n";
    let mut before = None;
    for point in &program.points {
        let cells = row(point, program.speed_share);
        // Rows whose times read the same are one.
        if before == cells.first().cloned() {
            continue;
        }
        before = cells.first().cloned();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

fn row(point: &Point, share: f64) -> Vec<String> {
    let times = [point.t_s / share, point.t_s];
    let speeds = point.qd_rad_s * share;
    let numbers = times.iter().chain(point.q_rad.iter()).chain(speeds.iter());
    numbers.map(|number| fixed(*number, DECIMALS)).collect()
}

/// What explains the table.
fn about(program: &Program<'_>, name: &str) -> String {
    let joints: Vec<String> = program
        .arm
        .joints()
        .iter()
        .enumerate()
        .map(|(k, joint)| format!("q{} is {}", k + 1, joint.name))
        .collect();
    let own = [
        format!(
            "{name} is a table: a header line, then a row a moment; commas between columns, a point before decimals, line feeds at the ends \
             of lines. There are no comments in it."
        ),
        "t_s [s]: when, from 0. plan_t_s [s]: which moment of the plan it is; plan_t_s / t_s is the share of the plan's speed.".to_owned(),
        "q1_rad to q6_rad [rad]: joint positions. qd1_rad_s to qd6_rad_s [rad/s]: joint speeds in the table's own time.".to_owned(),
        format!(
            "Joints are those of the arm's description ({}), from the base to the flange: {}. Zero is the description's; positive is \
             right-handed about the joint's axis as described.",
            program.arm.name(),
            joints.join(", ")
        ),
        format!("Rows stand every {STEP_S} s of t_s; the last one is the first at which the plan has ended."),
        "Between two rows each joint moves on the cubic that has both rows' positions and speeds.".to_owned(),
        format!("The arm must stand at the first row before it starts. It rests at the last one, after {} s.", fixed(program.duration_s(), 3)),
    ];
    wrapped("-", program.header.iter().chain(&own).map(String::as_str))
}

/// Which columns a table has.
struct Columns {
    names: Vec<&'static str>,
    has_plan_time: bool,
    has_speeds: bool,
}

/// What a table says.
fn reading(file: &ProgramFile) -> Result<Reading, ReadError> {
    let text = without_mark(&file.text);
    let mut lines = text.lines().zip(1..);
    let (header, _) = lines.next().unwrap_or_default();
    let columns = columns(header).map_err(|reason| ReadError::at(&file.name, 1, reason.0))?;
    let mut points: Vec<ReadPoint> = Vec::new();
    let mut plan_times = Vec::new();
    for (line, number) in lines {
        let refuse = |reason: String| ReadError::at(&file.name, number, reason);
        if points.len() == MAX_ROWS {
            return Err(refuse(format!("more than {MAX_ROWS} rows, the most that are read")));
        }
        let cells = cells(line, &columns).map_err(|reason| refuse(reason.0))?;
        let after_s = points.last().map(|point| point.t_s);
        match (cells.t_s, after_s) {
            (t_s, None) if t_s != 0.0 => return Err(refuse(format!("t_s of the first row: expected 0, found {t_s}"))),
            (t_s, Some(after_s)) if t_s <= after_s => {
                return Err(refuse(format!(
                    "t_s: {t_s} s must come after {after_s} s, the time of the row before"
                )));
            }
            _ => {}
        }
        plan_times.push(cells.plan_t_s);
        points.push(cells.point(Place {
            file: file.name.clone(),
            line: number,
        }));
    }
    if points.len() < 2 {
        let reason = format!("expected two rows at least, found {}", points.len());
        return Err(ReadError::at(&file.name, points.len() + 1, reason));
    }
    let between = if columns.has_speeds {
        Between::Cubics
    } else {
        Between::Lines
    };
    if let (Between::Lines, Some(last)) = (between, points.last_mut()) {
        last.corner_m = None;
    }
    let speed_share = if columns.has_plan_time {
        Some(share(&points, &plan_times)?)
    } else {
        None
    };
    Ok(Reading {
        speed_share,
        points,
        between,
        tool: None,
        checks_start: false,
    })
}

/// What is wrong with a line.
struct Fault(String);

/// The columns that a header names.
fn columns(header: &str) -> Result<Columns, Fault> {
    let found: Vec<&str> = header.split(',').collect();
    let has_plan_time = found.get(1) == Some(&TIMES[1]);
    let times = if has_plan_time { 2 } else { 1 };
    let has_speeds = found.len() > times + AXES;
    let speeds = if has_speeds { AXES } else { 0 };
    let names: Vec<&str> = TIMES
        .into_iter()
        .take(times)
        .chain(POSITIONS)
        .chain(SPEEDS.into_iter().take(speeds))
        .collect();
    let end = "the end of the line";
    match (0..names.len().max(found.len())).find(|&k| names.get(k) != found.get(k)) {
        None => Ok(Columns {
            names,
            has_plan_time,
            has_speeds,
        }),
        Some(k) => Err(Fault(format!(
            "column {}: expected {}, found {}",
            k + 1,
            names.get(k).unwrap_or(&end),
            found.get(k).map_or(end.to_owned(), |name| told(name))
        ))),
    }
}

/// The numbers of a row.
struct Cells {
    t_s: f64,
    plan_t_s: f64,
    q_rad: JointVector,
    qd_rad_s: Option<JointVector>,
    is_first: bool,
}

impl Cells {
    /// The row as a point; it rests where all speeds are zero.
    fn point(&self, place: Place) -> ReadPoint {
        let rests = self
            .qd_rad_s
            .map_or(self.is_first, |qd| qd.iter().all(|speed| *speed == 0.0));
        ReadPoint {
            place,
            t_s: self.t_s,
            q_rad: self.q_rad,
            qd_rad_s: self.qd_rad_s,
            corner_m: if rests { None } else { Some(0.0) },
        }
    }
}

fn cells(line: &str, columns: &Columns) -> Result<Cells, Fault> {
    let (found, expected) = (line.split(',').count(), columns.names.len());
    if found != expected {
        return Err(Fault(format!("{found} columns; the header has {expected}")));
    }
    let mut numbers = Vec::with_capacity(expected);
    for (k, (cell, name)) in line.split(',').zip(&columns.names).enumerate() {
        // Rust reads "inf" and "nan", too.
        match cell.parse::<f64>() {
            Ok(number) if number.abs() <= GREATEST => numbers.push(number),
            _ => {
                let (column, found) = (k + 1, told(cell));
                return Err(Fault(format!(
                    "column {column} ({name}): expected a number from -1e6 to 1e6, found {found}"
                )));
            }
        }
    }
    let times = if columns.has_plan_time { 2 } else { 1 };
    let joints = |from: usize| numbers.get(from..from + AXES).map(JointVector::from_column_slice);
    let t_s = numbers.first().copied().unwrap_or_default();
    Ok(Cells {
        t_s,
        plan_t_s: if columns.has_plan_time {
            numbers.get(1).copied().unwrap_or_default()
        } else {
            t_s
        },
        q_rad: joints(times).unwrap_or_default(),
        qd_rad_s: if columns.has_speeds { joints(times + AXES) } else { None },
        is_first: t_s == 0.0,
    })
}

/// The share of the plan's speed: the same in every row.
fn share(points: &[ReadPoint], plan_times: &[f64]) -> Result<f64, ReadError> {
    let (Some(last), Some(plan_last)) = (points.last(), plan_times.last()) else {
        return Ok(1.0);
    };
    let refuse = |point: &ReadPoint, reason: String| ReadError {
        place: point.place.clone(),
        reason,
    };
    let share = plan_last / last.t_s;
    if !(share > 0.0 && *plan_last <= last.t_s) {
        let reason = format!(
            "column 2 (plan_t_s): expected above 0 and at most t_s, {} s, found {plan_last}",
            last.t_s
        );
        return Err(refuse(last, reason));
    }
    for (point, plan_t_s) in points.iter().zip(plan_times) {
        let expected = share * point.t_s;
        if (plan_t_s - expected).abs() > TIME_S {
            let expected = fixed(expected, DECIMALS);
            let reason =
                format!("column 2 (plan_t_s): expected {expected}, the last row's share of t_s, found {plan_t_s}");
            return Err(refuse(point, reason));
        }
    }
    Ok(share)
}

/// A cell, as a message repeats it.
fn told(cell: &str) -> String {
    match cell.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", quoted(cell.get(..end).unwrap_or_default())),
        None => quoted(cell),
    }
}
