//! A process that is killed loses no row, and a large study needs little memory.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use platewash_study::{Journal, Row, Study, export, run};
use platewash_workcell::cancel::CancelToken;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Where the child keeps its rows.
const FOLDER: &str = "PLATEWASH_TEST_STUDY";

fn study(seeds: u64) -> Study {
    let text = format!(
        "format = \"platewash-study/1\"\nname = \"kill\"\nscenario = \"kitchen\"\n[[axis]]\nkey = \"seed\"\nseeds = \"1..{seeds}\"\n"
    );
    Study::parse(&text, "kill.toml", Path::new("")).unwrap()
}

/// A row of a planner that does nothing.
fn empty(study: &Study, index: u64) -> Row {
    let address = study.row(index).unwrap();
    let text = format!(
        "{{\"schema\":1,\"index\":{index},\"key\":\"{}\",\"scenario\":\"kitchen\",\"axes\":{},\"outcome\":\"not_found\",\"place\":{{}}}}",
        address.key,
        serde_json::to_string(&address.axes).unwrap()
    );
    serde_json::from_str(&text).unwrap()
}

fn work(folder: &Path, study: &Study, pause: Duration) {
    let mut journal = Journal::open(folder, study, "kill.toml").unwrap();
    let make = |index, _: &CancelToken| {
        std::thread::sleep(pause);
        Ok(Some(empty(study, index)))
    };
    run(study, &mut journal, &CancelToken::new(), make, |_| ()).unwrap();
}

fn exported(folder: &Path) -> Vec<u8> {
    let mut bytes = Vec::new();
    export(folder, &mut bytes, Path::new("bytes")).unwrap();
    bytes
}

#[test]
#[ignore = "the process that is killed: the test below starts it"]
fn child() {
    let folder = std::env::var_os(FOLDER).unwrap();
    work(Path::new(&folder), &study(400), Duration::from_millis(2));
}

#[test]
fn a_study_that_is_killed_goes_on_and_has_every_row_once() {
    let whole = tempfile::tempdir().unwrap();
    work(whole.path(), &study(400), Duration::ZERO);
    let folder = tempfile::tempdir().unwrap();
    let mut kept = 0;
    for more in [3_u64, 41, 120] {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--ignored", "--exact", "child"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        let rows = || {
            let text = std::fs::read(folder.path().join("rows.jsonl")).unwrap_or_default();
            text.iter().filter(|byte| **byte == b'\n').count() as u64
        };
        while rows() < kept + more && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(rows() >= kept + more && rows() < 400, "killed with {} rows", rows());
        kept = rows();
    }
    work(folder.path(), &study(400), Duration::ZERO);
    assert_eq!(exported(folder.path()), exported(whole.path()));
}

/// By hand: `cargo test --release -p platewash-study --test kill -- --ignored --exact --nocapture many`.
#[test]
#[ignore = "by hand: it measures"]
#[allow(clippy::print_stdout)]
fn many() {
    let folder = tempfile::tempdir().unwrap();
    let began = std::time::Instant::now();
    work(folder.path(), &study(100_000), Duration::ZERO);
    let took = began.elapsed();
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find(|line| line.starts_with("VmHWM"));
    println!("100000 rows in {took:?}, {}", peak.unwrap_or("no VmHWM here"));
}
