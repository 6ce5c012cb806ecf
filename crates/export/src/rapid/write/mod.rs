//! A program in the words of RAPID.
//!
//! Also here: head of a module, as comments.
//!
//! Lines of a module: ASCII, line feeds, no blanks at the end.
//!
//! Names in a module: unique, no keywords, 32 characters at most.

mod motion;
mod start;

use crate::dialect::{Program, ProgramFile, start_within_deg};
use crate::header::wrapped;
use crate::maker_joints::Joint3;
use crate::rapid::is_taken;
use crate::rapid::write::motion::{Routine, routines};
use platewash_kinematics::words::fixed;
use platewash_workcell::trajectory::SegmentKind;
use std::collections::HashSet;

/// Most targets of a module; more go to modules of their own.
const MOST_TARGETS: usize = 4000;

/// The modules of a program, the one with `main` first.
pub fn modules(program: &Program<'_>) -> Vec<ProgramFile> {
    let name = module(&program.name);
    let routines = routines(program, MOST_TARGETS);
    let targets: usize = routines.iter().map(Routine::targets).sum();
    let shares = if targets <= MOST_TARGETS {
        Vec::new()
    } else {
        split_into_modules(&routines)
    };
    let files: Vec<String> = (0..=shares.len()).map(|index| file(&name, index)).collect();

    let mut first = Lines::default();
    first.line(0, &format!("MODULE {name}"));
    write(&mut first, program, &files);
    first.blank();
    start::data(&mut first, program);
    first.blank();
    let within_deg = start_within_deg(&program.plan.job);
    start::main(&mut first, &routines, within_deg);
    start::checks(&mut first, within_deg, program.joint_3);
    if shares.is_empty() {
        write_all(&mut first, &routines);
    }
    first.line(0, "ENDMODULE");

    let mut texts = vec![first.text()];
    for (index, share) in shares.iter().enumerate() {
        let mut module = Lines::default();
        module.line(0, &format!("MODULE {}", module_part(&name, index + 1)));
        write_part(&mut module, &files, index + 1);
        write_all(&mut module, share);
        module.line(0, "ENDMODULE");
        texts.push(module.text());
    }
    let named = files.into_iter().zip(texts);
    named.map(|(name, text)| ProgramFile { name, text }).collect()
}

/// Text of a module that contains only the checks before the first motion, with the largest distance from the start \[°\].
pub(crate) fn checks(within_deg: f64, joint_3: Joint3) -> String {
    let mut lines = Lines::default();
    lines.line(0, "MODULE checks");
    start::checks(&mut lines, within_deg, joint_3);
    lines.line(0, "ENDMODULE");
    lines.text()
}

fn write_all(lines: &mut Lines, routines: &[Routine]) {
    for routine in routines {
        lines.blank();
        routine.write(lines);
    }
}

/// Routines in groups of no more targets than a module takes.
fn split_into_modules(routines: &[Routine]) -> Vec<&[Routine]> {
    let mut groups = Vec::new();
    let (mut from, mut targets) = (0, 0);
    for (index, routine) in routines.iter().enumerate() {
        if targets + routine.targets() > MOST_TARGETS && index > from {
            groups.extend(routines.get(from..index));
            (from, targets) = (index, 0);
        }
        targets += routine.targets();
    }
    groups.extend(routines.get(from..));
    groups
}

/// Notes at the head of every module.
const OWN: [&str; 2] = [
    "Units: mm, degrees, kg, kg*m^2; times after \\T in seconds at the plan's own speed, divided by the share of the run.",
    "Joints are the robot's own, 1 to 6; no external axes; no work object: MoveAbsJ needs none.",
];

/// Writes the head of the module with `main`.
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

/// Writes the head of a further module.
pub fn write_part(lines: &mut Lines, files: &[String], part: usize) {
    let first = files.first().map_or("", String::as_str);
    let (number, count) = (part + 1, files.len());
    lines.comment(
        1,
        &format!("Module {number} of {count}. It needs the others; {first} has main and says what this is."),
    );
}

/// Lines of a module.
#[derive(Debug, Default)]
pub struct Lines {
    text: String,
}

impl Lines {
    /// Appends a line, indented by a number of steps.
    pub fn line(&mut self, steps: usize, line: &str) {
        for _ in 0..steps {
            self.text.push_str("  ");
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// An empty line.
    pub fn blank(&mut self) {
        self.text.push('\n');
    }

    /// A sentence as a comment, as many lines as it needs; further lines are set off.
    pub fn comment(&mut self, steps: usize, sentence: &str) {
        let prefix = format!("{}!", "  ".repeat(steps));
        self.text.push_str(&wrapped(&prefix, [sentence]));
    }

    /// Returns all lines.
    pub fn text(self) -> String {
        self.text
    }
}

/// A number with at most that many decimals, without zeros at its end.
pub fn number(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The share of the plan's speed that the program states.
pub const SHARE: &str = "pwShare";

/// The largest share of the speed that the program takes.
pub const MOST: &str = "pwShareMost";

/// The share of the speed of a run.
pub const RUNNING: &str = "pwRunning";

/// Prefix of all names that the program defines.
pub const PREFIX: &str = "pw";

/// Names of modules and data that controllers have already, and that of the routine that is started.
const OF_THE_CONTROLLER: [&str; 8] = ["main", "user", "base", "reg1", "reg2", "reg3", "reg4", "reg5"];

/// The name of the module with `main`.
pub fn module(program: &str) -> String {
    let lower = program.to_lowercase();
    let is_the_controllers = OF_THE_CONTROLLER.contains(&lower.as_str());
    if is_taken(program) || is_the_controllers || lower.starts_with(PREFIX) {
        return format!("m_{program}");
    }
    program.to_owned()
}

/// The name of a further module.
pub fn module_part(module: &str, part: usize) -> String {
    format!("{module}_{part}")
}

/// The name of the file of a module, 0 the one with `main`.
pub fn file(module: &str, part: usize) -> String {
    match part {
        0 => format!("{module}.mod"),
        _ => format!("{}.mod", module_part(module, part)),
    }
}

/// Names of routines, each once.
#[derive(Debug, Default)]
pub struct Routines {
    taken: HashSet<String>,
}

impl Routines {
    /// A name after a kind of segment and the number of its plate, counted from 1.
    pub fn name(&mut self, kind: Option<SegmentKind>, number: usize) -> String {
        let word = match kind {
            Some(SegmentKind::Depart) => "Depart",
            Some(SegmentKind::Approach) => "Approach",
            Some(SegmentKind::Wash) => "Wash",
            Some(SegmentKind::Retreat) => "Retreat",
            Some(SegmentKind::Transit) => "Transit",
            Some(SegmentKind::Return) => "Return",
            None => "Motion",
        };
        let first = format!("{PREFIX}{word}{number}");
        let mut name = first.clone();
        let mut again = 1_u32;
        while !self.taken.insert(name.clone()) {
            again += 1;
            name = format!("{first}_{again}");
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn writes_numbers_without_trailing_zeros() {
        let told = [150.0, 0.25, -1e-9, 1e-9, 100.0, 12.3456789].map(|value| number(value, 6));
        assert_eq!(told, ["150", "0.25", "0", "0", "100", "12.345679"]);
        assert_eq!(number(100.0, 0), "100");
    }

    #[test]
    fn names_are_free_and_unique() {
        let names = ["kitchen", "Task", "main", "pwTool", "Fine", "movel", "pose"].map(module);
        assert_eq!(
            names,
            ["kitchen", "m_Task", "m_main", "m_pwTool", "m_Fine", "m_movel", "m_pose"]
        );
        let mut routines = Routines::default();
        let kinds = [
            Some(SegmentKind::Wash),
            Some(SegmentKind::Wash),
            Some(SegmentKind::Return),
            None,
        ];
        assert_eq!(
            kinds.map(|kind| routines.name(kind, 3)),
            ["pwWash3", "pwWash3_2", "pwReturn3", "pwMotion3"]
        );
    }
}
