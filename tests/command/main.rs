//! The command as a person or a script meets it: results, exit codes, messages, files.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

mod against;
mod align;
mod answers;
mod arms;
mod cells;
mod compare;
mod descriptions;
mod dry_run;
mod edit;
mod exit_codes;
mod export;
mod figures;
mod files;
mod golden;
mod held_joints;
mod hostile_names;
mod ignored;
mod infeasible;
mod interrupt;
mod limits;
mod messages;
mod one_run;
mod other_arms;
mod page;
mod prove_motion;
mod reader;
mod recover;
mod remedies;
mod scenarios;
mod served;
mod simulate;
mod study;
mod suggest;
mod tool_mount;
mod turns;
mod units;
mod verbs;
mod verify;
mod view;

#[path = "../support/linkage.rs"]
mod linkage;
#[path = "../support/wide.rs"]
mod wide;

use serde_json::Value;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

struct CommandOutput {
    code: i32,
    stdout: String,
    stderr: String,
}

impl CommandOutput {
    fn of(output: Output) -> Self {
        let Output { status, stdout, stderr } = output;
        Self {
            code: status.code().unwrap(),
            stdout: String::from_utf8(stdout).unwrap(),
            stderr: String::from_utf8(stderr).unwrap(),
        }
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|e| panic!("{e}: {}", self.stdout))
    }

    /// One clear message: the exit code, `error:` once, every fragment in it, nothing said twice, and nothing on standard
    /// output.
    #[track_caller]
    fn refused(&self, code: i32, fragments: &[&str]) {
        assert_eq!(self.code, code, "stderr: {}", self.stderr);
        assert_eq!(self.stderr.matches("error:").count(), 1, "{}", self.stderr);
        assert!(self.stdout.is_empty(), "{}", self.stdout);
        assert_eq!(repetition(&self.stderr), None, "{}", self.stderr);
        for fragment in fragments {
            assert!(self.stderr.contains(fragment), "no '{fragment}' in: {}", self.stderr);
        }
    }

    #[track_caller]
    fn done(self) -> Self {
        assert_eq!(self.code, 0, "stderr: {}", self.stderr);
        self
    }
}

/// A long fragment that a message, the hints on usage apart, has twice.
fn repetition(message: &str) -> Option<String> {
    const LONG: usize = 28;
    let message = message.split("Usage:").next().unwrap_or_default();
    let letters: Vec<char> = message.chars().collect();
    let mut seen = std::collections::BTreeSet::new();
    letters
        .windows(LONG)
        .find(|w| !seen.insert(w.to_vec()))
        .map(|w| w.iter().collect())
}

fn platewash(folder: &Path, arguments: &[&str]) -> CommandOutput {
    platewash_os(folder, &arguments.iter().map(OsStr::new).collect::<Vec<_>>())
}

fn platewash_os(folder: &Path, arguments: &[&OsStr]) -> CommandOutput {
    let mut command = Command::new(env!("CARGO_BIN_EXE_platewash"));
    CommandOutput::of(command.args(arguments).current_dir(folder).output().unwrap())
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// A folder with the plan of the kitchen with one plate in `out`: what is done with it costs a quarter.
fn planned() -> TempDir {
    let folder = folder();
    let one = kitchen(folder.path(), &[("count = 4", "count = 1")]);
    platewash(folder.path(), &["plan", "--quiet", "--scenario", one.to_str().unwrap()]).done();
    std::fs::remove_file(one).unwrap();
    folder
}

/// What is in a folder, but for the page, which is there where the build under test has its bundle: `page.rs` asks for it.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "page.html")
        .collect();
    names.sort();
    names
}

/// The shipped scenario with one line replaced (the replacement must take effect).
fn scenario(folder: &Path, from: &str, to: &str) -> PathBuf {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/paper-appendix.toml")).unwrap();
    assert!(text.contains(from), "no '{from}' in the shipped scenario");
    let path = folder.join("case.toml");
    std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
    path
}

/// The kitchen with some fragments replaced (each must take effect).
fn kitchen(folder: &Path, changes: &[(&str, &str)]) -> PathBuf {
    replaced(folder, "kitchen", changes)
}

/// The kitchen whose wash path is stated and whose contact is not promised, with some fragments replaced (each must take effect).
fn spiral(folder: &Path, changes: &[(&str, &str)]) -> PathBuf {
    replaced(folder, "kitchen-spiral", changes)
}

fn replaced(folder: &Path, shipped: &str, changes: &[(&str, &str)]) -> PathBuf {
    let mut text = std::fs::read_to_string(format!("{}/scenarios/{shipped}.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "no '{from}' in {shipped}");
        text = text.replacen(from, to, 1);
    }
    let path = folder.join("case.toml");
    std::fs::write(&path, text).unwrap();
    path
}
