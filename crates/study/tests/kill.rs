//! A process that is killed loses no row, and a large study needs little memory.

use platewash_study::{Journal, Row, RowMaker, RowWithPlan, Study, export, run};
use platewash_workcell::cancel::CancelToken;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
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
fn empty(study: &Study, index: u64) -> RowWithPlan {
    let address = study.row(index).unwrap();
    let text = format!(
        "{{\"schema\":2,\"index\":{index},\"key\":\"{}\",\"scenario\":\"kitchen\",\"axes\":{},\"outcome\":\"not_found\",\"place\":{{}}}}",
        address.key,
        serde_json::to_string(&address.axes).unwrap()
    );
    serde_json::from_str::<Row>(&text).unwrap().into()
}

fn child_on(folder: &Path, name: &str) -> Command {
    let mut child = Command::new(std::env::current_exe().unwrap());
    child
        .args(["--ignored", "--exact", &format!("kill::{name}")])
        .env(FOLDER, folder)
        .stdout(Stdio::null());
    child
}

/// Kills a child at so many moments, drawn from a fixed seed, `least` to `most` \[ms\] after its start.
fn kill_at_random(folder: &Path, name: &str, times: usize, [least, most]: [u64; 2]) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for _ in 0..times {
        // Knuth's MMIX: any spread of moments does.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let mut child = child_on(folder, name).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(least + (state >> 33) % (most - least)));
        child.kill().unwrap();
        child.wait().unwrap();
    }
}

fn work(folder: &Path, study: &Study, pause: Duration) {
    let mut journal = Journal::open(folder, study).unwrap();
    let make = |index, _: &CancelToken| {
        std::thread::sleep(pause);
        Ok(Some(empty(study, index)))
    };
    run(&mut journal, &CancelToken::new(), make, |_| ()).unwrap();
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
    work(Path::new(&folder), &study(400), Duration::from_millis(10));
}

#[test]
fn a_killed_study_resumes_with_every_row_once() {
    let whole = tempfile::tempdir().unwrap();
    work(whole.path(), &study(400), Duration::ZERO);
    let folder = tempfile::tempdir().unwrap();
    let mut kept = 0;
    for more in [3_u64, 41, 120] {
        let mut child = child_on(folder.path(), "child").spawn().unwrap();
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

#[test]
#[ignore = "the process that is killed: the tests start it"]
fn slow_child() {
    let folder = std::env::var_os(FOLDER).unwrap();
    work(Path::new(&folder), &study(2000), Duration::from_millis(2));
}

#[test]
fn a_study_killed_at_any_moment_has_every_row_once() {
    let [whole, folder] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    work(whole.path(), &study(2000), Duration::ZERO);
    kill_at_random(folder.path(), "slow_child", 20, [1, 60]);
    let journal = Journal::open(folder.path(), &study(2000)).unwrap();
    let done = journal.done();
    assert!(done > 0 && done < 2000, "{done} rows");
    drop(journal);
    work(folder.path(), &study(2000), Duration::ZERO);
    assert_eq!(exported(folder.path()), exported(whole.path()));
}

/// A shell lets no file grow beyond some kilobytes, as a full disk would.
#[cfg(unix)]
#[test]
fn a_full_disk_ends_the_study_with_whole_rows_and_it_resumes() {
    let [whole, folder] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    work(whole.path(), &study(400), Duration::ZERO);
    let full = Command::new("sh")
        .args([
            "-c",
            "trap '' XFSZ; ulimit -f 16; exec \"$0\" --ignored --exact --nocapture kill::child",
        ])
        .arg(std::env::current_exe().unwrap())
        .env(FOLDER, folder.path())
        .stdout(Stdio::null())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&full.stderr);
    assert!(
        !full.status.success() && told.contains("rows.jsonl") && told.contains("cannot be written"),
        "{told}"
    );
    let kept = std::fs::read(folder.path().join("rows.jsonl")).unwrap();
    assert!(kept.ends_with(b"\n") && !kept.is_empty(), "{} bytes", kept.len());
    let before = kept.iter().filter(|byte| **byte == b'\n').count() as u64;
    let journal = Journal::open(folder.path(), &study(400)).unwrap();
    assert!(journal.done() == before && before < 400, "{before} rows");
    drop(journal);
    work(folder.path(), &study(400), Duration::ZERO);
    assert_eq!(exported(folder.path()), exported(whole.path()));
}

/// The rows of a planner that plans.
fn real_work(folder: &Path) {
    let study = Arc::new(study(120));
    let mut journal = Journal::open(folder, &study).unwrap();
    let maker = RowMaker::new(study.clone());
    run(
        &mut journal,
        &CancelToken::new(),
        |index, cancel| maker.row(index, cancel),
        |_| (),
    )
    .unwrap();
}

#[test]
#[ignore = "the process that is killed: the test below starts it"]
fn real_child() {
    real_work(Path::new(&std::env::var_os(FOLDER).unwrap()));
}

/// By hand: `cargo test --release -p platewash-study --test study -- --ignored --exact --nocapture kill::real_rows`.
#[test]
#[ignore = "by hand: it plans for a minute or two"]
#[allow(clippy::print_stdout)]
fn real_rows() {
    let [whole, folder] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let began = std::time::Instant::now();
    let mut child = child_on(folder.path(), "real_child").spawn().unwrap();
    let is_there = || std::fs::metadata(folder.path().join("rows.jsonl")).is_ok_and(|file| file.len() > 0);
    while !is_there() {
        std::thread::sleep(Duration::from_millis(1));
    }
    println!("first row on disk after {:?}", began.elapsed());
    child.kill().unwrap();
    child.wait().unwrap();
    kill_at_random(folder.path(), "real_child", 20, [50, 2000]);
    let done = Journal::open(folder.path(), &study(120)).unwrap().done();
    real_work(folder.path());
    real_work(whole.path());
    assert_eq!(exported(folder.path()), exported(whole.path()));
    println!("killed 21 times, {done} of 120 rows by then: the same bytes");
}

/// By hand: `cargo test --release -p platewash-study --test study -- --ignored --exact --nocapture kill::measures_time_and_memory_of_100000_rows`.
#[test]
#[ignore = "by hand: it measures"]
#[allow(clippy::print_stdout)]
fn measures_time_and_memory_of_100000_rows() {
    let folder = tempfile::tempdir().unwrap();
    let began = std::time::Instant::now();
    work(folder.path(), &study(100_000), Duration::ZERO);
    let took = began.elapsed();
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find(|line| line.starts_with("VmHWM"));
    println!("100000 rows in {took:?}, {}", peak.unwrap_or("no VmHWM here"));
}
