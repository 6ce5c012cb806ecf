//! A table of positions and speeds at fixed steps, for any program that reads tables, and a text beside it that explains it.
//!
//! The table is strict: a header with a unit in each name, rows of numbers, nothing else. `plan_t_s` is the time in the plan of
//! each row, so that the table itself shows the share of the plan's speed at which it runs.

use crate::comment::wrapped;
use crate::dialect::language::{Dialect, Points};
use crate::program::{Place, Point, Program, ProgramFile};
use crate::reading::{ReadPoint, Reading, SegmentShape};
use platewash_kinematics::words::fixed;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::csv::{MAX_ROWS, STATE};
use platewash_motion_proof::ReadError;
use platewash_workcell::number_table::{NumberTable, TableError, TableShape};

/// End of a table's name.
const ENDING: &str = ".csv";

/// Time between two rows \[s\]: a control cycle of common controllers.
const STEP_S: f64 = 0.004;

/// Decimals of every number: a nanosecond, a nanoradian.
const DECIMALS: usize = 9;

/// Greatest magnitude of a number \[s, rad, rad/s\]; beyond it the file is in other units, or no motion.
const GREATEST: f64 = 1e6;

/// Largest deviation of `plan_t_s` from its share of `t_s` \[s\].
const TIME_S: f64 = 1e-6;

const TIMES: [&str; 2] = ["t_s", "plan_t_s"];
const POSITIONS: [&str; AXES] = STATE[0];
const SPEEDS: [&str; AXES] = STATE[1];

/// The dialect of tables.
#[derive(Debug, Clone, Copy)]
pub struct Csv;

impl Dialect for Csv {
    fn name(&self) -> &'static str {
        "csv"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        let head = file
            .text
            .trim_start_matches('\u{feff}')
            .lines()
            .next()
            .unwrap_or_default();
        let begins = head.starts_with("t_s,plan_t_s,q1_rad") || head.starts_with("t_s,q1_rad");
        // Tables of other kinds have these columns and more.
        let is_known = |name: &str| {
            TIMES
                .iter()
                .chain(&POSITIONS)
                .chain(&SPEEDS)
                .any(|known| *known == name)
        };
        let names = || head.split(',').map(str::trim);
        let is_in_any_order = names().all(is_known) && names().any(|other| other == POSITIONS[0]);
        file.ends_in(ENDING) && (begins || is_in_any_order)
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
        reading(ProgramFile::only(files, "table", ENDING)?)
    }
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

/// Text that explains the table.
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

/// Reads a table.
fn reading(file: &ProgramFile) -> Result<Reading, ReadError> {
    let refused = |error: TableError| ReadError::at(&file.name, error.line, error.without_line());
    read(file).map_err(refused)
}

/// Reads the header of a table, and finds its columns.
fn columns(text: &str) -> Result<NumberTable<'_>, TableError> {
    let required: Vec<&str> = TIMES.into_iter().take(1).chain(POSITIONS).collect();
    let shape = TableShape {
        required: &required,
        optional: &[&TIMES[1..], &SPEEDS],
        most: GREATEST,
        most_rows: MAX_ROWS,
        has_comments: false,
    };
    NumberTable::read(text, &shape)
}

fn read(file: &ProgramFile) -> Result<Reading, TableError> {
    let table = columns(&file.text)?;
    let (plan_time, speeds) = (table.places(&[TIMES[1]]), table.places(&SPEEDS));
    let mut points: Vec<ReadPoint> = Vec::new();
    let mut plan_times = Vec::new();
    let (time, positions) = (
        table.places(&[TIMES[0]]).unwrap_or_default(),
        table.places(&POSITIONS).unwrap_or_default(),
    );
    for row in table.rows() {
        let row = row?;
        let [t_s] = row.numbers(time)?;
        row.check_after(time[0], t_s, points.last().map(|point| point.t_s))?;
        if points.is_empty() && t_s != 0.0 {
            return row.refused(time[0], format!("expected 0 in the first row, found {t_s}"));
        }
        let qd_rad_s = speeds
            .map(|places| row.numbers(places))
            .transpose()?
            .map(JointVector::from);
        // It rests where all speeds are zero.
        let rests = qd_rad_s.map_or(points.is_empty(), |qd| qd.iter().all(|speed| *speed == 0.0));
        plan_times.extend(plan_time.map(|place| row.numbers(place)).transpose()?.map(|[t_s]| t_s));
        points.push(ReadPoint {
            place: Place::new(&file.name, row.line),
            t_s,
            q_rad: row.numbers(positions)?.into(),
            qd_rad_s,
            corner_m: if rests { None } else { Some(0.0) },
        });
    }
    if let Some(places) = speeds {
        check_rest(&table, places, &points)?;
    }
    let [_, .., last] = &mut points[..] else {
        let (line, column) = (points.last().map_or(1, |point| point.place.line), None);
        let reason = format!("expected two rows at least, found {}", points.len());
        return Err(TableError { line, column, reason });
    };
    let interpolation = match speeds {
        Some(_) => SegmentShape::Cubics,
        None => {
            last.corner_m = None;
            SegmentShape::Lines
        }
    };
    Ok(Reading {
        speed_share: plan_time
            .map(|[place]| share(&table, place, &points, &plan_times))
            .transpose()?,
        ..Reading::from_points(points, interpolation)
    })
}

/// Checks that the arm rests in the first row and in the last, as the text beside the table says.
fn check_rest(table: &NumberTable<'_>, places: [usize; AXES], points: &[ReadPoint]) -> Result<(), TableError> {
    let ends = [("first", points.first()), ("last", points.last())];
    for (which, point) in ends.into_iter().filter_map(|(which, point)| Some((which, point?))) {
        let speeds = point.qd_rad_s.iter().flatten();
        if let Some((place, speed)) = places.into_iter().zip(speeds).find(|(_, speed)| **speed != 0.0) {
            let reason =
                format!("expected a speed of 0 in the {which} row, in which the arm rests; found {speed} rad/s");
            return table.refused(point.place.line, place, reason);
        }
    }
    Ok(())
}

/// The share of the plan's speed: the same in every row.
fn share(table: &NumberTable<'_>, place: usize, points: &[ReadPoint], plan_times: &[f64]) -> Result<f64, TableError> {
    let ([.., last], [.., plan_last]) = (points, plan_times) else {
        return Ok(1.0);
    };
    let refused = |point: &ReadPoint, reason| table.refused(point.place.line, place, reason);
    let share = plan_last / last.t_s;
    if !(share > 0.0 && *plan_last <= last.t_s) {
        let reason = format!("expected above 0 and at most t_s, {} s, found {plan_last}", last.t_s);
        return refused(last, reason);
    }
    for (point, plan_t_s) in points.iter().zip(plan_times) {
        let expected = share * point.t_s;
        if (plan_t_s - expected).abs() > TIME_S {
            let expected = fixed(expected, DECIMALS);
            return refused(
                point,
                format!("expected {expected}, the last row's share of t_s, found {plan_t_s}"),
            );
        }
    }
    Ok(share)
}
