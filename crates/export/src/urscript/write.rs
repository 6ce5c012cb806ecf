//! A program's text.
//!
//! The first line is the program's `def`, and the header stands inside: a controller takes text from a socket from the first
//! `def` to its `end`. A stretch of the plan is a function of its own.

use crate::comment::wrapped;
use crate::dialect::start_within::start_within_deg;
use crate::program::Program;
use platewash_kinematics::rotation::{RigidTransform, rotation_vector};
use platewash_kinematics::words::fixed;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::words::{plate_name, plate_number};

/// Decimals of a position \[rad, m\]: half a nanoradian.
const DECIMALS: usize = 9;

/// Nanoseconds of a second: times are rounded as sums, so that rounding does not add up.
const PER_S: f64 = 1e9;

/// Acceleration \[rad/s²\] and speed \[rad/s\] with which the program moves to its start, and once more to its end.
const SLOWLY: &str = "a=0.1, v=0.05";

/// Statement that stops the program behind the last point, where the plan rests \[rad/s²\].
const STOP: &str = "stopj(2.0)";

/// Settings of the servo with their trade-offs: the shortest look-ahead, and the gain of the maker's own driver.
const SERVO: &str =
    "  # How closely the arm follows: look-ahead 0.03 to 0.2 s, gain 100 to 2000. A longer look-ahead and a lower gain
  # are smoother and later, and cut corners.
  global lookahead = 0.03
  global gain = 2000
";

/// The program's text.
pub(crate) fn text(program: &Program<'_>) -> String {
    let mut text = format!("def pw_{}():\n", program.name);
    text.push_str(&head(program));
    text.push_str(SERVO);
    let stretches = stretches(program);
    stretches.iter().for_each(|(_, function)| text.push_str(function));
    let Some((first, last)) = program.points.first().zip(program.points.last()) else {
        return text + "end\n";
    };
    text.push_str(&start(&first.q_rad, start_within_deg(&program.plan.job)));
    text.push_str(&tool(program));
    text.push_str(&format!("  movej(start, {SLOWLY})\n"));
    for (name, _) in &stretches {
        text.push_str(&format!("  {name}()\n"));
    }
    let end = list(last.q_rad.iter().copied());
    text + &format!(
        "  # The plan rests here. What the arm is late by is made up slowly.\n  {STOP}\n  movej({end}, {SLOWLY})\nend\n"
    )
}

/// Header and units.
fn head(program: &Program<'_>) -> String {
    let share = format!("{:?}", program.speed_share);
    let own = [
        "Units: rad, m, s, kg. Joints in the order base, shoulder, elbow, wrist 1, wrist 2, wrist 3.".to_owned(),
        format!(
            "Duration {} s at {share} of the plan's speed.",
            fixed(program.duration_s(), 3)
        ),
    ];
    let mut text = wrapped("  #", program.header.iter().chain(&own).map(String::as_str));
    text.push_str("  # The points are made for this share of the plan's speed: to change it, export again.\n");
    text + &format!("  global speed_share = {share}\n")
}

/// Lines for the tool: its tip and its weight.
fn tool(program: &Program<'_>) -> String {
    let tool = program.tool();
    let tip = RigidTransform::from(&tool.tip);
    let turn = rotation_vector(&tip.rotation);
    let pose = list(tip.translation.iter().chain(turn.iter()).copied());
    let mut text = format!(
        "  # The tool, at the flange: its tip as position and rotation vector, mass, centre of mass.\n  set_tcp(p{pose})\n"
    );
    if let Some(mass) = &tool.mass {
        let com = list(mass.com_m);
        text.push_str(&format!("  set_payload({}, {com})\n", fixed(mass.mass_kg, DECIMALS)));
    }
    text
}

/// Refuses to start from elsewhere, before anything is set or moved.
fn start(q_rad: &JointVector, within_deg: f64) -> String {
    let mut text = format!(
        "  # The arm must stand within {within_deg} deg of the start.\n  start = {}\n  found = get_actual_joint_positions()\n",
        list(q_rad.iter().copied())
    );
    for joint in 0..AXES {
        let (number, deg) = (joint + 1, fixed(q_rad[joint].to_degrees(), 2));
        let said = format!(
            "Joint {number} is more than {within_deg} deg from the start: move it to {deg} deg, then start again."
        );
        let most = fixed(within_deg.to_radians(), DECIMALS);
        text.push_str(&format!(
            "  if norm(found[{joint}] - start[{joint}]) > {most}:\n    \
             popup(\"{said}\", title=\"platewash\", error=True, blocking=True)\n    halt\n  end\n"
        ));
    }
    text
}

/// The stretches of the plan, each as a function: its name and its text.
fn stretches(program: &Program<'_>) -> Vec<(String, String)> {
    let mut stretches = Vec::new();
    let mut before = program.points.first();
    let points = program.points.get(1..).unwrap_or_default();
    for points in points.chunk_by(|a, b| a.segment == b.segment) {
        let count = stretches.len();
        let (name, said) = match program.plan.segments.get(points[0].segment) {
            Some(segment) => {
                let (kind, plate) = (segment.kind.name(), segment.plate);
                let time = format!("{} to {} s", fixed(segment.t_start_s, 3), fixed(segment.t_end_s, 3));
                (
                    format!("part_{count}_{kind}_{}", plate_number(plate)),
                    format!("{kind}, {}: {time} of the plan", plate_name(plate)),
                )
            }
            None => (format!("part_{count}"), "a part of the plan".to_owned()),
        };
        let mut text = format!("  # {said}\n  def {name}():\n");
        for point in points {
            let ends = [before.unwrap_or(point), point];
            let [from, to] = ends.map(|point| (point.t_s / program.speed_share * PER_S).round() as i64);
            before = Some(point);
            // Nothing takes no time: points as close as that are one.
            if to > from {
                let (q, t) = (list(point.q_rad.iter().copied()), seconds(to - from));
                text += &format!("    servoj({q}, t={t}, lookahead_time=lookahead, gain=gain)\n");
            }
        }
        stretches.push((name, text + "  end\n"));
    }
    stretches
}

/// Nanoseconds, in seconds without zeros that say nothing.
fn seconds(ns: i64) -> String {
    let (whole, rest) = (ns / 1_000_000_000, ns % 1_000_000_000);
    let decimals = format!("{rest:09}");
    let decimals = decimals.trim_end_matches('0');
    format!("{whole}.{}", if decimals.is_empty() { "0" } else { decimals })
}

fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|number| fixed(number, DECIMALS)).collect();
    format!("[{}]", numbers.join(", "))
}
