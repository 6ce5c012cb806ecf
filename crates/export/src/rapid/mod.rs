//! RAPID, the language of ABB's controllers.
//!
//! | concept | module |
//! | --- | --- |
//! | a job that can be handed over in it | `accepts` |
//! | a program's text | `write` |
//! | modules into data and procedures; what a program does | `parse`, `read` |
//! | joint targets, zones and tools; zones and speeds by name; names that are taken | `values`, `zone`, `names` |

mod accepts;
mod names;
mod parse;
mod read;
mod values;
mod write;
mod zone;

use crate::dialect::{Dialect, Points, ReadError};
use crate::file::ProgramFile;
use crate::program::Program;
use crate::reading::Reading;
use crate::refusal::Refusal;
use platewash_kinematics::RobotModel;
use platewash_workcell::job::JobTerms;

/// Shortest time between two points \[s\].
const LEAST_S: f64 = 0.01;

/// What names of files end with, in small letters.
const ENDINGS: [&str; 5] = [".mod", ".modx", ".prg", ".sys", ".sysx"];

/// RAPID, the language of ABB's controllers.
#[derive(Debug)]
pub struct Rapid;

impl Dialect for Rapid {
    fn name(&self) -> &'static str {
        "rapid"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        let name = file.name.to_ascii_lowercase();
        ENDINGS.iter().any(|ending| name.ends_with(ending)) || begins_a_module(&file.text)
    }

    fn points(&self) -> Points {
        Points::Chords { least_s: LEAST_S }
    }

    fn assumptions(&self) -> &'static [&'static str] {
        &[
            "Between two targets the controller moves evenly and straight in the joints; it rounds targets in a zone by a parabola that \
             begins at the zone's edge, and a zone reaches no farther than half way to the next target.",
            "The controller keeps the time of every \\T, also where it is as short as the nearest two points.",
            "The controller's tool0 is the mounting frame of the plan's arm: origin at the flange, z out of it.",
            "The task has no external axes, and no other program moves the arm.",
            "Nobody has run this program on a controller or in RobotStudio.",
        ]
    }

    fn accepts(&self, job: &JobTerms, arm: &RobotModel) -> Result<(), Refusal> {
        accepts::accepts(job, arm)
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        write::modules(program)
    }

    fn read(&self, files: &[ProgramFile], _: &RobotModel) -> Result<Reading, ReadError> {
        read::reading(files)
    }
}

/// Whether the first word outside of comments and the file's header is `MODULE`.
fn begins_a_module(text: &str) -> bool {
    let outside = |line: &&str| {
        let line = line.trim_start();
        !line.is_empty() && !line.starts_with('!')
    };
    let first = text.lines().find(outside).unwrap_or_default().trim_start();
    first.starts_with("%%%") || first.get(..7).is_some_and(|word| word.eq_ignore_ascii_case("MODULE "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modules_are_known_by_name_or_text() {
        let is_in = |name: &str, text: &str| {
            let (name, text) = (name.to_owned(), text.to_owned());
            Rapid.is_in(&ProgramFile { name, text })
        };
        assert!(is_in("Wash.MOD", "") && is_in("wash.sysx", ""));
        assert!(is_in("wash.txt", "\n! a note\n  Module wash\n"));
        assert!(is_in("wash.txt", "%%%\n  VERSION:1\n%%%\n"));
        assert!(!is_in("wash.txt", "") && !is_in("wash.script", "def wash():\n  MODULE = 1\n"));
        assert!(!is_in("wash.yaml", "é: MODULE a"));
    }
}
