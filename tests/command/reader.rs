//! A reader of standard output that leaves, as `head` does.

use super::served::PATIENCE;
use super::*;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

fn start(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_platewash"));
    let command = command.args(arguments).current_dir(folder);
    command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap()
}

/// Reads some lines and leaves.
fn head(child: &mut Child, lines: usize) -> Vec<String> {
    let reader = BufReader::new(child.stdout.take().unwrap());
    reader.lines().take(lines).map(Result::unwrap).collect()
}

#[track_caller]
fn code(mut child: Child) -> i32 {
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code().unwrap();
        }
        if begin.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("it goes on though nobody reads");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A hundred thousand layouts take hours.
#[test]
fn a_sweep_ends_when_its_reader_leaves() {
    let folder = folder();
    let mut child = start(folder.path(), &["sweep", "--seeds", "1..100000"]);
    let lines = head(&mut child, 2);
    assert!(
        lines[0].starts_with("seed,") && lines[1].starts_with("1,proved"),
        "{lines:?}"
    );
    assert_eq!(code(child), 0);
}

/// And ends with the verdict of all rows.
#[test]
fn a_sweep_that_writes_a_file_finishes_it() {
    let folder = folder();
    let dir = folder.path();
    let far = kitchen(dir, &[("region = \"appendix\"", "positions_m = [[0.8, 0.0]]")]);
    let arguments = [
        "sweep",
        "--seeds",
        "1..3",
        "--out",
        "s",
        "--scenario",
        far.to_str().unwrap(),
    ];
    let mut child = start(dir, &arguments);
    head(&mut child, 0);
    assert_eq!(code(child), 3);
    let table = std::fs::read_to_string(dir.join("s/sweep.csv")).unwrap();
    assert_eq!(table.lines().count(), 4, "{table}");
}

#[test]
fn verbs_that_write_files_finish_them_and_end_with_their_verdict() {
    let folder = folder();
    let dir = folder.path();
    let case = |line: &[&str], expected: i32, written: &[&str]| {
        let arguments = [line, &["--out", "o"]].concat();
        let mut child = start(dir, &arguments);
        head(&mut child, 0);
        assert_eq!(code(child), expected, "{line:?}");
        assert_eq!(names(&dir.join("o")), written, "{line:?}");
    };
    case(&["plan"], 0, &["plan.json", "trajectory.csv"]);
    std::fs::rename(dir.join("o/plan.json"), dir.join("plan.json")).unwrap();
    std::fs::remove_dir_all(dir.join("o")).unwrap();
    let tune = [
        "tune",
        "plan.json",
        "--law",
        "pd",
        "--frequencies",
        "15",
        "--dampings",
        "1",
    ];
    case(&tune, 4, &["tune.csv"]);
    std::fs::remove_dir_all(dir.join("o")).unwrap();
    let simulated = ["simulated.csv", "simulation.json", "simulation.txt"];
    case(
        &["simulate", "plan.json", "--law", "pd", "--frequency", "15"],
        4,
        &simulated,
    );
    std::fs::remove_dir_all(dir.join("o")).unwrap();
    let far = kitchen(dir, &[("region = \"appendix\"", "positions_m = [[0.8, 0.0]]")]);
    case(
        &["run", "--scenario", far.to_str().unwrap()],
        3,
        &["report.json", "report.txt"],
    );
}

#[test]
fn fk_prints_poses_until_the_reader_leaves() {
    let folder = folder();
    std::fs::write(folder.path().join("many.txt"), "0 0 0 0 0 0\n".repeat(100_000)).unwrap();
    let mut child = start(folder.path(), &["fk", "--deg", "--file", "many.txt"]);
    let lines = head(&mut child, 1);
    assert!(lines[0].starts_with("q, deg"), "{lines:?}");
    assert_eq!(code(child), 0);
}
