//! What joint_trajectory_controller asks of a message, and what this program asks beyond that, rule by rule.
//!
//! The controller's own rules are those of its check of messages in ros2_controllers 2.54 (Humble) and 6.9, with the parameters that
//! it has by default; they are the same in both, but that 6.9 takes effort where it commands effort. Those of 4.42 (Jazzy), between them, were
//! not read.

use super::message::{Message, MessagePoint, Span, Tolerance, Tolerances};
use super::rule::{Breach, Rule};
use super::timing::{LEAD_IN_NS, LEAD_IN_S, NS_PER_S};
use platewash_kinematics::{AXES, RobotModel};
use platewash_workcell::words::quoted;

/// What the controller takes for a last speed of zero \[rad/s\].
const AT_REST_RAD_S: f64 = f32::EPSILON as f64;

/// Refuses a message that breaks a rule, for an arm whose controller has all its joints, in any order.
///
/// # Errors
/// [`Breach`], the first one.
pub fn check(message: &Message, arm: &RobotModel) -> Result<(), Breach> {
    let known: Vec<&str> = arm.joints().iter().map(|joint| joint.name.as_str()).collect();
    names(message, &known)?;
    let stamp = &message.stamp;
    if stamp.nanoseconds() != 0 {
        let found = "expected a header.stamp of 0, which is at once; found a time of the clock";
        return Err(Rule::Stamp.broken(stamp.sec.line, found.to_owned()));
    }
    let points = &message.points.value;
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return Err(Rule::Points.broken(message.points.line, "expected points; found none".to_owned()));
    };
    points.iter().try_for_each(|point| duration(&point.time_from_start))?;
    times(points, first)?;
    points.iter().try_for_each(lengths)?;
    at_rest(first, "first", 0.0, Rule::StartSpeed)?;
    at_rest(last, "last", AT_REST_RAD_S, Rule::EndSpeed)?;
    match &message.tolerances {
        Some(stated) => tolerances(stated, &known),
        None => Ok(()),
    }
}

fn names(message: &Message, known: &[&str]) -> Result<(), Breach> {
    let names = &message.joint_names.value;
    for (k, name) in names.iter().enumerate() {
        if names[..k].iter().any(|other| other.value == name.value) {
            let found = format!("expected each joint once; found {} again", quoted(&name.value));
            return Err(Rule::JointTwice.broken(name.line, found));
        }
        if !known.contains(&name.value.as_str()) {
            return Err(Rule::JointName.broken(name.line, unknown(&name.value, known)));
        }
    }
    if names.len() != AXES {
        let missing = known.iter().filter(|k| !names.iter().any(|name| name.value == **k));
        let missing = missing.copied().collect::<Vec<_>>().join(", ");
        let found = format!(
            "expected the {AXES} joints of the arm; found {}, without {missing}",
            names.len()
        );
        return Err(Rule::JointCount.broken(message.joint_names.line, found));
    }
    Ok(())
}

fn unknown(name: &str, known: &[&str]) -> String {
    format!(
        "expected one of the arm's joints {}; found {}",
        known.join(", "),
        quoted(name)
    )
}

fn duration(span: &Span) -> Result<(), Breach> {
    if !(0..=i64::from(i32::MAX)).contains(&span.sec.value) {
        let found = format!("expected sec from 0 to {}; found {}", i32::MAX, span.sec.value);
        return Err(Rule::Duration.broken(span.sec.line, found));
    }
    if !(0..NS_PER_S).contains(&span.nanosec.value) {
        let found = format!(
            "expected nanosec from 0 to {}; found {}",
            NS_PER_S - 1,
            span.nanosec.value
        );
        return Err(Rule::Duration.broken(span.nanosec.line, found));
    }
    Ok(())
}

fn times(points: &[MessagePoint], first: &MessagePoint) -> Result<(), Breach> {
    let told = |point: &MessagePoint| {
        let Span { sec, nanosec } = point.time_from_start;
        format!("{}.{:09} s", sec.value, nanosec.value)
    };
    let line = |point: &MessagePoint| point.time_from_start.sec.line;
    if first.time_from_start.nanoseconds() < i128::from(LEAD_IN_NS) {
        let found = format!(
            "expected the first point at {LEAD_IN_S} s or later; found {}",
            told(first)
        );
        return Err(Rule::LeadIn.broken(line(first), found));
    }
    for pair in points.windows(2) {
        let [before, point] = pair else { continue };
        if point.time_from_start.nanoseconds() <= before.time_from_start.nanoseconds() {
            let found = format!(
                "expected a time after {}, that of the point before; found {}",
                told(before),
                told(point)
            );
            return Err(Rule::TimeOrder.broken(line(point), found));
        }
    }
    Ok(())
}

fn lengths(point: &MessagePoint) -> Result<(), Breach> {
    let rows = [
        ("positions", &point.positions, AXES, Rule::Positions),
        ("velocities", &point.velocities, AXES, Rule::Velocities),
        ("accelerations", &point.accelerations, 0, Rule::Accelerations),
        ("effort", &point.effort, 0, Rule::Effort),
    ];
    for (name, row, expected, rule) in rows {
        let found = row.value.len();
        if found != expected {
            return Err(rule.broken(row.line, format!("expected {expected} {name}; found {found}")));
        }
    }
    Ok(())
}

fn at_rest(point: &MessagePoint, which: &str, most_rad_s: f64, rule: Rule) -> Result<(), Breach> {
    let moving = point
        .velocities
        .value
        .iter()
        .find(|v| v.is_nan() || v.abs() > most_rad_s);
    match moving {
        Some(speed) => {
            let found = format!("expected velocities of 0 at the {which} point; found {speed} rad/s");
            Err(rule.broken(point.velocities.line, found))
        }
        None => Ok(()),
    }
}

fn tolerances(stated: &Tolerances, known: &[&str]) -> Result<(), Breach> {
    for (list, which) in [(&stated.path, "path_tolerance"), (&stated.goal, "goal_tolerance")] {
        for (k, tolerance) in list.value.iter().enumerate() {
            let name = &tolerance.name;
            if !known.contains(&name.value.as_str()) {
                return Err(Rule::Tolerance.broken(name.line, unknown(&name.value, known)));
            }
            if list.value[..k].iter().any(|other| other.name.value == name.value) {
                let found = format!("expected each joint once; found {} again", quoted(&name.value));
                return Err(Rule::Tolerance.broken(name.line, found));
            }
            legal(tolerance)?;
        }
        if list.value.len() != AXES {
            let found = format!(
                "expected a {which} for each of the {AXES} joints; found {}",
                list.value.len()
            );
            return Err(Rule::Tolerance.broken(list.line, found));
        }
    }
    duration(&stated.goal_time)
}

fn legal(tolerance: &Tolerance) -> Result<(), Breach> {
    for number in [&tolerance.position, &tolerance.velocity, &tolerance.acceleration] {
        if !(number.value >= 0.0 || number.value == -1.0) {
            let found = format!(
                "expected a tolerance above 0, or 0 for the controller's own, or -1.0 for none; found {}",
                number.value
            );
            return Err(Rule::Tolerance.broken(number.line, found));
        }
    }
    Ok(())
}
