//! RAPID, the language of ABB's controllers.
//!
//! | concept | module |
//! | --- | --- |
//! | a job that can be handed over in it | `accepts` |
//! | a program's text | `write` |
//! | modules into data and procedures, joint targets, zones and tools; the motion of a program | `parse`; `read` |
//! | zones and speeds by name; names that are taken | `names` |

mod accepts;
mod names;
mod parse;
mod read;
mod write;

use crate::dialect::language::{Dialect, Points};
use crate::joint_3::Joint3;
use crate::maker_joints;
use crate::program::{Program, ProgramFile};
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use platewash_kinematics::RobotModel;
use platewash_motion_proof::ReadError;
use platewash_workcell::job::JobTerms;

/// Shortest time between two points \[s\].
const LEAST_S: f64 = 0.01;

/// Endings of file names, in small letters.
const ENDINGS: [&str; 5] = [".mod", ".modx", ".prg", ".sys", ".sysx"];

/// RAPID, the language of ABB's controllers.
#[derive(Debug)]
pub struct Rapid;

impl Dialect for Rapid {
    fn name(&self) -> &'static str {
        "rapid"
    }

    fn is_in(&self, file: &ProgramFile) -> bool {
        ENDINGS.iter().any(|ending| file.ends_in(ending)) || begins_a_module(&file.text)
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

    fn has_maker_joints(&self) -> bool {
        true
    }

    fn accepts(&self, job: &JobTerms, arm: &RobotModel) -> Result<(), Refusal> {
        accepts::accepts(job, arm)
    }

    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile> {
        write::modules(program)
    }

    fn read(&self, files: &[ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError> {
        read::reading(files, count_of_joint_3(files, arm)?)
    }
}

/// The count of axis 3 that a program's head states, or that is known of the arm.
fn count_of_joint_3(files: &[ProgramFile], arm: &RobotModel) -> Result<Joint3, ReadError> {
    let stated = ExportSettings::stated(files, ExportSettings::default()).and_then(|settings| settings.joint_3);
    let name = files.first().map_or("(no file)", |file| &file.name);
    maker_joints::check(&Rapid, arm, stated).map_err(|refusal| {
        let line = ExportSettings {
            joint_3: Some(Joint3::WithJoint2),
            ..ExportSettings::default()
        };
        let line = line.lines().pop().unwrap_or_default();
        ReadError::at(
            name,
            1,
            format!("expected a line such as \"{line}\" at the head, found none. {refusal}"),
        )
    })?;
    Ok(stated.unwrap_or_default())
}

/// Checks that the first word outside of comments and the file's header is `MODULE`.
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
