//! Names in a module: unique, no keywords, 32 characters at most.

use crate::rapid::names::is_taken;
use std::collections::HashSet;

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

/// A name that no routine before has, after a kind of segment and the number of its plate, counted from 1.
pub fn free_name(taken: &mut HashSet<String>, word: &str, number: usize) -> String {
    let first = format!("{PREFIX}{word}{number}");
    let mut name = first.clone();
    let mut again = 1_u32;
    while !taken.insert(name.clone()) {
        again += 1;
        name = format!("{first}_{again}");
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

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
