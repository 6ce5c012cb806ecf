//! A program in the words of RAPID: modules, each with its head as comments.
//!
//! Lines of a module: ASCII, line feeds, no blanks at the end.

mod motion;
pub(crate) mod names;
mod number;
mod start;

use crate::comment::wrapped;
use crate::dialect::start_within::start_within_deg;
use crate::joint_3::Joint3;
use crate::program::{Program, ProgramFile};
use crate::rapid::write::motion::{Routine, routines};
use crate::rapid::write::names::{SHARE, file, module, module_part};

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
