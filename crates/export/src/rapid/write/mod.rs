//! A program in the words of RAPID: modules, each with its head as comments.
//!
//! Lines of a module: ASCII, line feeds, no blanks at the end.
//!
//! Names in a module: unique, no keywords, 32 characters at most.

mod motion;
mod start;

use crate::comment::wrapped;
use crate::dialect::start_within_deg;
use crate::maker_joints::Joint3;
use crate::program::{Program, ProgramFile};
use crate::rapid::is_taken;
use crate::rapid::write::motion::{Routine, routines};
use platewash_kinematics::words::fixed;

/// Most targets of a module; more go to modules of their own.
const MOST_TARGETS: usize = 4000;

/// The modules of a program, the one with `main` first.
pub fn modules(program: &Program<'_>) -> Vec<ProgramFile> {
    let name = module(&program.name);
    let routines = routines(program, MOST_TARGETS);
    let groups = split_into_modules(&routines);
    let (beside_main, parts) = match &groups[..] {
        [all] => (*all, &[][..]),
        parts => (&[][..], parts),
    };
    let files: Vec<String> = (0..=parts.len()).map(|index| file(&name, index)).collect();
    let text = |routines: &[Routine]| routines.iter().map(|routine| &*routine.text).collect::<String>();
    let first = format!(
        "MODULE {name}\n{}\n{}{}{}ENDMODULE\n",
        head(program, &files),
        start::data_and_main(program, &routines),
        start::checks(start_within_deg(&program.plan.job), program.joint_3),
        text(beside_main)
    );
    let further = (1..).zip(parts).map(|(part, routines)| {
        let (name, head) = (module_part(&name, part), head_of_part(&files, part));
        format!("MODULE {name}\n{head}{}ENDMODULE\n", text(routines))
    });
    let named = files.iter().zip([first].into_iter().chain(further));
    named
        .map(|(name, text)| ProgramFile {
            name: name.clone(),
            text,
        })
        .collect()
}

/// Text of a module that contains only the checks before the first motion, with the largest distance from the start \[°\].
pub(crate) fn checks(within_deg: f64, joint_3: Joint3) -> String {
    format!("MODULE checks\n{}ENDMODULE\n", start::checks(within_deg, joint_3))
}

/// Routines in groups of no more targets than a module takes.
fn split_into_modules(routines: &[Routine]) -> Vec<&[Routine]> {
    let mut groups = Vec::new();
    let (mut from, mut targets) = (0, 0);
    for (index, routine) in routines.iter().enumerate() {
        if targets + routine.targets > MOST_TARGETS && index > from {
            groups.extend(routines.get(from..index));
            (from, targets) = (index, 0);
        }
        targets += routine.targets;
    }
    groups.extend(routines.get(from..));
    groups
}

/// Notes at the head of every module.
const OWN: [&str; 2] = [
    "Units: mm, degrees, kg, kg*m^2; times after \\T in seconds at the plan's own speed, divided by the share of the run.",
    "Joints are the robot's own, 1 to 6; no external axes; no work object: MoveAbsJ needs none.",
];

/// The head of the module with `main`.
fn head(program: &Program<'_>, files: &[String]) -> String {
    let slower = format!(
        "To run it slower, lower {SHARE} below: 0.1 is a tenth of the plan's speed. It takes {} at most.",
        program.speed_share
    );
    let (count, all) = (files.len(), files.join(", "));
    let several = (count > 1).then(|| format!("The program is {count} modules; load them all into one task: {all}."));
    let own = [""].into_iter().chain(OWN).chain([&*slower]).chain(several.as_deref());
    wrapped("  !", program.header.iter().map(String::as_str).chain(own))
}

/// The head of a further module.
fn head_of_part(files: &[String], part: usize) -> String {
    let first = files.first().map_or("", String::as_str);
    let (number, count) = (part + 1, files.len());
    let head = format!("Module {number} of {count}. It needs the others; {first} has main and says what this is.");
    wrapped("  !", [&*head])
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rapid::write::motion::free_name;
    use std::collections::HashSet;

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
        let mut taken = HashSet::new();
        let words = ["Wash", "Wash", "Return", "Motion"];
        assert_eq!(
            words.map(|word| free_name(&mut taken, word, 3)),
            ["pwWash3", "pwWash3_2", "pwReturn3", "pwMotion3"]
        );
    }
}
