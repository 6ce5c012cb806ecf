//! Trajectories as tables: a header line, then a row a point.
//!
//! Positions are `q1_rad` to `q6_rad` in the arm's order, or columns with the names of its joints; `t_s`, speeds and accelerations may be left
//! out. Other columns of this program's own tables are not read.

use crate::dialect::{ProgramFile, ReadError};
use crate::trajectory::JointPoints;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_workcell::csv::{MAX_ROWS, STATE};
use platewash_workcell::number_table::{NumberTable, Row, TableError, TableShape};
use platewash_workcell::words::without_mark;

/// Greatest magnitude of a number \[s, rad, rad/s, rad/s²\].
const GREATEST: f64 = 1e6;

const TIME: [&str; 1] = ["t_s"];

/// Columns of this program's own tables that are not read.
const PLACE: [&str; 2] = ["segment", "plate"];
const TIP: [&str; 3] = ["tip_x_m", "tip_y_m", "tip_z_m"];
const PLAN_TIME: [&str; 1] = ["plan_t_s"];

/// Reads a table: the points, and the line of each.
pub(super) fn read(file: &ProgramFile, arm: &RobotModel) -> Result<(JointPoints, Vec<usize>), ReadError> {
    table(&file.text, arm).map_err(|error| ReadError::at(&file.name, error.line, error.without_line()))
}

fn table(text: &str, arm: &RobotModel) -> Result<(JointPoints, Vec<usize>), TableError> {
    let names = arm.joints().each_ref().map(|joint| joint.name.as_str());
    let [speed_names, acceleration_names] = ["rad_s", "rad_s2"].map(|unit| names.map(|name| format!("{name}_{unit}")));
    let header = without_mark(text)
        .lines()
        .find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let is_named = header.is_some_and(|header| header.split(',').any(|column| names.contains(&column.trim())));
    let [positions, speeds, accelerations] = match is_named {
        true => [
            names,
            speed_names.each_ref().map(String::as_str),
            acceleration_names.each_ref().map(String::as_str),
        ],
        false => STATE,
    };
    let table = NumberTable::read(
        text,
        &TableShape {
            required: &positions,
            optional: &[&TIME, &speeds, &accelerations, &PLACE, &TIP, &PLAN_TIME],
            most: GREATEST,
            most_rows: MAX_ROWS,
            has_comments: true,
        },
    )?;
    let (time, speed_places) = (table.places(&TIME), table.places(&speeds));
    // The motion of a plan is made of cubics, whose accelerations its table has, too.
    let is_plan = table.places(&PLACE).is_some();
    let acceleration_places = table.places(&accelerations).filter(|_| !is_plan);
    // Required columns are there.
    let position_places = table.places(&positions).unwrap_or_default();
    let mut points = JointPoints {
        t_s: time.map(|_| Vec::new()),
        qd_rad_s: speed_places.map(|_| Vec::new()),
        qdd_rad_s2: acceleration_places.map(|_| Vec::new()),
        ..JointPoints::default()
    };
    let mut lines = Vec::new();
    let joints = |row: &Row<'_>, places: [usize; AXES]| row.numbers(places).map(JointVector::from);
    for row in table.rows() {
        let row = row?;
        if let (Some(place), Some(times)) = (time, &mut points.t_s) {
            let [t_s] = row.numbers(place)?;
            row.check_after(place[0], t_s, times.last().copied())?;
            times.push(t_s);
        }
        if let (Some(places), Some(all)) = (speed_places, &mut points.qd_rad_s) {
            all.push(joints(&row, places)?);
        }
        if let (Some(places), Some(all)) = (acceleration_places, &mut points.qdd_rad_s2) {
            all.push(joints(&row, places)?);
        }
        points.q_rad.push(joints(&row, position_places)?);
        lines.push(row.line);
    }
    Ok((points, lines))
}
