//! The test programs of all crates: compiled together, then run from a queue, the long ones first.
//!
//! `cargo test` runs one program after the other. Most end with one slow test, during which the other core is idle.

use crate::command;
use crate::step::Step;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::collections::{HashSet, VecDeque};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Targets whose tests take longest, by the name of their crate and their own. They run first, so that no core is idle at the end.
const LONGEST: [&str; 10] = [
    "platewash command",
    "platewash main",
    "platewash-certificate certificate",
    "platewash-server server",
    "platewash-export platewash_export",
    "platewash-bodies bodies",
    "platewash-simulator simulator",
    "platewash-kinematics kinematics",
    "platewash-planner planner",
    "platewash-scenario scenario",
];

/// One compiled test program.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Program {
    /// Names of the crate and of the target.
    name: String,
    file: PathBuf,
    /// The crate's folder, in which its tests run.
    folder: PathBuf,
}

/// Compiles the tests of all crates after the command, and runs them; then those in the documentation.
///
/// They use the release profile and the command's features, so that each library is compiled once for all that runs.
///
/// # Errors
/// Programs that do not compile, or that compile libraries of the command once more; else all programs with a test that fails, after the
/// others have run.
pub fn tested() -> Result<()> {
    let of_command = parsed(&command::messages()?)?;
    let all = ["test", "--release", "--workspace"];
    // Without examples: the only one is that of the extension, and would have pyo3 built once more, for another interpreter.
    let tests = ["--no-run", "--tests", "--message-format", "json-render-diagnostics"];
    let of_tests = parsed(&Step::cargo("compiling the tests", &[&all[..], &tests].concat()).output()?)?;
    let twice = compiled_twice(&of_command, &of_tests);
    if !twice.is_empty() {
        bail!(
            "compiled once more for the tests: {}\n(the tests ask other features of these crates, or of what they use: ask for them in \
             Cargo.toml's [workspace.dependencies], too)",
            twice.join(", ")
        );
    }
    run(queue(&of_tests)?)?;
    Step::cargo("tests in the documentation", &[&all[..], &["--doc"]].concat()).run()
}

/// Cargo's messages, one a line.
fn parsed(messages: &str) -> Result<Vec<Value>> {
    let lines = messages.lines().filter(|line| line.starts_with('{'));
    lines
        .map(|line| serde_json::from_str(line).with_context(|| format!("cargo's message {line}")))
        .collect()
}

/// Libraries that the first build has and the second compiles anew.
fn compiled_twice<'a>(first: &'a [Value], second: &'a [Value]) -> Vec<&'a str> {
    let library = |message: &'a Value| {
        let is_library = message["reason"] == "compiler-artifact" && message["profile"]["test"] == false;
        let name = is_library.then(|| message["target"]["name"].as_str()).flatten()?;
        let kinds = message["target"]["kind"].as_array()?;
        let id = message["package_id"].as_str()?;
        // What build scripts use is compiled for them alone, without optimization.
        let level = message["profile"]["opt_level"].as_str()?;
        kinds.iter().any(|kind| kind == "lib").then_some((id, name, level))
    };
    let built: HashSet<_> = first.iter().filter_map(library).collect();
    let anew = second
        .iter()
        .filter(|message| message["fresh"] == false)
        .filter_map(library);
    anew.filter(|library| built.contains(library))
        .map(|(_, name, _)| name)
        .collect()
}

/// The test programs that cargo's messages name, the long ones first.
fn queue(messages: &[Value]) -> Result<Vec<Program>> {
    let mut programs: Vec<Program> = messages.iter().filter_map(program).collect();
    if programs.is_empty() {
        bail!("cargo names no test program");
    }
    let rank = |program: &Program| LONGEST.iter().position(|name| *name == program.name);
    programs.sort_by_key(|program| rank(program).unwrap_or(LONGEST.len()));
    Ok(programs)
}

/// The test program that a message of cargo names.
fn program(message: &Value) -> Option<Program> {
    if message["profile"]["test"] != true {
        return None;
    }
    let folder = Path::new(message["manifest_path"].as_str()?).parent()?.to_owned();
    // An id ends with `#name@version`, or with `/name#version` where the folder has the crate's name.
    let id = message["package_id"].as_str()?;
    let (place, rest) = id.rsplit_once('#')?;
    let package = match rest.split_once('@') {
        Some((name, _)) => name,
        None => place.rsplit('/').next()?,
    };
    let target = message["target"]["name"].as_str()?;
    Some(Program {
        name: format!("{package} {target}"),
        file: message["executable"].as_str()?.into(),
        folder,
    })
}

/// Runs as many programs at a time as there are cores.
fn run(programs: Vec<Program>) -> Result<()> {
    println!("\n==> {} test programs", programs.len());
    let start = Instant::now();
    let left = Mutex::new(VecDeque::from(programs));
    let failed = Mutex::new(Vec::new());
    let next = || left.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(program) = next() {
                    if let Err(error) = program.run() {
                        println!("    {}: {error:#}", program.name);
                        failed.lock().unwrap_or_else(PoisonError::into_inner).push(program.name);
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
    if !failed.is_empty() {
        bail!("tests failed: {}; what they print is above", failed.join(", "));
    }
    println!("    test programs passed in {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

impl Program {
    /// Runs the program, and prints its result, or all that it says where a test fails.
    fn run(&self) -> Result<()> {
        let start = Instant::now();
        let output = Command::new(&self.file)
            .current_dir(&self.folder)
            .env("CARGO_MANIFEST_DIR", &self.folder)
            .output()
            .with_context(|| self.file.display().to_string())?;
        let said = String::from_utf8_lossy(&output.stdout);
        if !output.status.success() {
            bail!("{}\n{said}\n{}", output.status, String::from_utf8_lossy(&output.stderr));
        }
        let result = said.lines().rfind(|line| line.starts_with("test result: "));
        let result = result.context("the program ends without a test result")?;
        println!("    {}, {:.1} s: {result}", self.name, start.elapsed().as_secs_f64());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::collect;
    use platewash_bundler::root;

    const MESSAGES: &str = r#"
{"reason":"compiler-artifact","package_id":"path+file:///here/crates/keys#platewash-keys@0.1.0","manifest_path":"/here/crates/keys/Cargo.toml","target":{"name":"platewash_keys"},"profile":{"test":false},"executable":null}
{"reason":"compiler-artifact","package_id":"path+file:///here/crates/study#platewash-study@0.1.0","manifest_path":"/here/crates/study/Cargo.toml","target":{"name":"study"},"profile":{"test":true},"executable":"/here/target/study-1"}
{"reason":"compiler-artifact","package_id":"path+file:///here/platewash#0.1.0","manifest_path":"/here/platewash/Cargo.toml","target":{"name":"platewash"},"profile":{"test":false},"executable":"/here/target/platewash"}
{"reason":"compiler-artifact","package_id":"path+file:///here/platewash#0.1.0","manifest_path":"/here/platewash/Cargo.toml","target":{"name":"main"},"profile":{"test":true},"executable":"/here/target/main-1"}
{"reason":"build-finished","success":true}
"#;

    #[test]
    fn test_programs_are_those_of_cargos_messages_the_long_ones_first() {
        let found = queue(&parsed(MESSAGES).unwrap()).unwrap();
        let names: Vec<_> = found.iter().map(|program| program.name.as_str()).collect();
        assert_eq!(names, ["platewash main", "platewash-study study"]);
        assert_eq!(found[1].file, Path::new("/here/target/study-1"));
        assert_eq!(found[1].folder, Path::new("/here/crates/study"));
        assert!(queue(&[]).is_err());
        assert!(parsed("{").is_err());
    }

    #[test]
    fn libraries_that_are_compiled_twice_are_named() {
        let library = |name: &str, level: &str, fresh: bool| {
            serde_json::json!({
                "reason": "compiler-artifact", "package_id": format!("index#{name}@1.0.0"), "fresh": fresh,
                "target": { "name": name, "kind": ["lib"] }, "profile": { "test": false, "opt_level": level },
            })
        };
        let command = [
            library("serde", "3", false),
            library("toml", "1", true),
            library("bundler", "0", false),
        ];
        let tests = [
            ("serde", "3", true),
            ("toml", "1", false),
            ("bundler", "3", false),
            ("proptest", "3", false),
        ];
        let tests = tests.map(|(name, level, fresh)| library(name, level, fresh));
        assert_eq!(compiled_twice(&command, &tests), ["toml"]);
    }

    #[test]
    fn a_program_that_fails_is_named_after_all_have_run() {
        let folder = std::env::temp_dir();
        let program = |name: &str, file: &str| Program {
            name: name.to_owned(),
            file: file.into(),
            folder: folder.clone(),
        };
        let error = run(vec![program("a", "no such program"), program("b", "neither is this")]).unwrap_err();
        let said = error.to_string();
        assert!(
            said.contains("tests failed: ") && said.contains('a') && said.contains('b'),
            "{said}"
        );
    }

    /// Cargo runs no test of a file that its program does not name.
    #[test]
    fn every_test_file_belongs_to_a_test_program() {
        let crates = std::fs::read_dir(root().join("crates")).unwrap();
        let folders = crates.map(|entry| entry.unwrap().path().join("tests"));
        let folders: Vec<_> = folders
            .chain([root().join("tests")])
            .filter(|folder| folder.join("main.rs").is_file())
            .collect();
        assert!(folders.len() > 5, "{folders:?}");
        for folder in folders {
            let main = std::fs::read_to_string(folder.join("main.rs")).unwrap();
            let manifest = std::fs::read_to_string(folder.with_file_name("Cargo.toml")).unwrap();
            for entry in std::fs::read_dir(&folder).unwrap() {
                let name = entry.unwrap().file_name().into_string().unwrap();
                let Some(module) = name.strip_suffix(".rs") else {
                    continue;
                };
                let named = main.contains(&format!("mod {module};")) || manifest.contains(&format!("\"tests/{name}\""));
                assert!(named, "{name} belongs to no program of {}", folder.display());
            }
        }
    }

    /// Cargo compiles no test of a library with `test = false`.
    #[test]
    fn libraries_that_are_not_tested_have_no_tests_of_their_own() {
        let members = ["scenarios", "urdf", "benches/problems"].map(|name| root().join(name));
        let crates = std::fs::read_dir(root().join("crates")).unwrap();
        let folders = crates.map(|entry| entry.unwrap().path()).chain(members);
        let is_untested = |folder: &PathBuf| {
            let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap();
            let library = manifest.split("\n[").find(|section| section.starts_with("lib]"));
            library.is_some_and(|library| library.contains("\ntest = false"))
        };
        let mut files = Vec::new();
        for folder in folders.filter(is_untested) {
            let sources = folder.join("src");
            let sources = if sources.is_dir() { "src" } else { "lib.rs" };
            collect(&folder, sources.into(), &mut files).unwrap();
            for file in files.drain(..) {
                let text = std::fs::read_to_string(folder.join(&file)).unwrap();
                assert!(!text.contains("#[test]"), "{} in {}", file.display(), folder.display());
            }
        }
    }
}
