//! A program in the words of RAPID.

mod header;
mod line;
mod motion;
mod names;
mod start;
mod tool;

use crate::file::ProgramFile;
use crate::program::Program;
use line::Lines;
use motion::{Routine, routines};

pub(super) use names::{MOST, RUNNING, SHARE};

/// Most targets of a module; more go to modules of their own.
const MOST_TARGETS: usize = 4000;

/// The modules of a program, the one with `main` first.
pub fn modules(program: &Program<'_>) -> Vec<ProgramFile> {
    let name = names::module(&program.name);
    let routines = routines(program, MOST_TARGETS);
    let targets: usize = routines.iter().map(Routine::targets).sum();
    let shares = if targets <= MOST_TARGETS {
        Vec::new()
    } else {
        shared_out(&routines)
    };
    let files: Vec<String> = (0..=shares.len()).map(|index| names::file(&name, index)).collect();

    let mut first = Lines::default();
    first.line(0, &format!("MODULE {name}"));
    header::write(&mut first, program, &files);
    first.blank();
    start::data(&mut first, program);
    first.blank();
    start::main(&mut first, &routines);
    start::checks(&mut first);
    if shares.is_empty() {
        write_all(&mut first, &routines);
    }
    first.line(0, "ENDMODULE");

    let mut texts = vec![first.text()];
    for (index, share) in shares.iter().enumerate() {
        let mut module = Lines::default();
        module.line(0, &format!("MODULE {}", names::module_part(&name, index + 1)));
        header::write_part(&mut module, &files, index + 1);
        write_all(&mut module, share);
        module.line(0, "ENDMODULE");
        texts.push(module.text());
    }
    let named = files.into_iter().zip(texts);
    named.map(|(name, text)| ProgramFile { name, text }).collect()
}

/// A module with the checks before the first motion alone.
pub(super) fn checks() -> String {
    let mut lines = Lines::default();
    lines.line(0, "MODULE checks");
    start::checks(&mut lines);
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
fn shared_out(routines: &[Routine]) -> Vec<&[Routine]> {
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
