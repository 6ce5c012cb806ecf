//! What stands at the head of a module, as comments.

use super::line::Lines;
use super::names::SHARE;
use crate::program::Program;

/// What every module says of itself.
const OWN: [&str; 2] = [
    "Units: mm, degrees, kg, kg*m^2; times after \\T in seconds at the plan's own speed, divided by the share of the run.",
    "Joints are the robot's own, 1 to 6; no external axes; no work object: MoveAbsJ needs none.",
];

/// At the head of the module with `main`.
pub fn write(lines: &mut Lines, program: &Program<'_>, files: &[String]) {
    for entry in &program.header {
        lines.comment(1, entry);
    }
    lines.comment(1, "");
    OWN.into_iter().for_each(|sentence| lines.comment(1, sentence));
    lines.comment(
        1,
        &format!(
            "To run it slower, lower {SHARE} below: 0.1 is a tenth of the plan's speed. It takes {} at most.",
            program.speed_share
        ),
    );
    if files.len() > 1 {
        lines.comment(
            1,
            &format!(
                "The program is {} modules; load them all into one task: {}.",
                files.len(),
                files.join(", ")
            ),
        );
    }
}

/// At the head of a further module.
pub fn write_part(lines: &mut Lines, files: &[String], part: usize) {
    let first = files.first().map_or("", String::as_str);
    let (number, count) = (part + 1, files.len());
    lines.comment(
        1,
        &format!("Module {number} of {count}. It needs the others; {first} has main and says what this is."),
    );
}
