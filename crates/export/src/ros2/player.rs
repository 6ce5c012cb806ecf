//! The script that sends a goal: always the same, it says nothing of a plan.

use super::node::Fault;
use crate::file::ProgramFile;

/// Its name.
pub(super) const NAME: &str = "play.py";

/// Its text.
pub(super) const TEXT: &str = include_str!("play.py");

/// Whether a file is the script, by its name.
pub(super) fn is_it(file: &ProgramFile) -> bool {
    file.name == NAME
}

/// Refuses a script that is not the one that belongs to the goals.
pub(super) fn check(file: &ProgramFile) -> Result<(), Fault> {
    if file.text == TEXT {
        return Ok(());
    }
    let lines = || file.text.lines().zip(TEXT.lines());
    let other = lines().position(|(found, expected)| found != expected);
    let line = other.unwrap_or_else(|| lines().count()) + 1;
    let reason = "expected the player as this version writes it; found another line: nothing is known of what it sends";
    Err(Fault::new(line, reason))
}
