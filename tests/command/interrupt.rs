//! Ctrl-C in the middle of long work.
#![cfg(unix)]

use super::served::{PATIENCE, command, interrupt, spawn};
use super::*;
use std::io::{BufRead, BufReader, Read};
use std::process::Child;
use std::time::{Duration, Instant};

/// The exit code and what was said on standard error.
#[track_caller]
fn end(mut child: Child) -> (Option<i32>, String) {
    let begin = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begin.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("it goes on though it was interrupted");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    (child.wait().unwrap().code(), said)
}

/// A hundred thousand layouts take hours on one thread; the header tells that the work has begun.
#[test]
fn an_interrupted_sweep_writes_nothing() {
    let folder = folder();
    let line = ["sweep", "--seeds", "1..100000", "--threads", "1", "--out", "s"];
    let mut child = spawn(&mut command(folder.path(), &line));
    let mut rows = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(rows.next().unwrap().unwrap().starts_with("seed,"));
    interrupt(&child);
    let rest = std::thread::spawn(move || rows.map(Result::unwrap).collect::<Vec<_>>());
    assert_eq!(end(child), (Some(130), "interrupted\n".to_owned()));
    // Rows that were done are whole.
    assert!(rest.join().unwrap().iter().all(|row| row.ends_with('"')));
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_interrupted_measurement_writes_nothing() {
    let folder = folder();
    for draws in ["1000000", "500"] {
        let line = [
            "reproduce",
            "--layouts",
            "10000",
            "--draws",
            draws,
            "--out",
            "r",
            "--quiet",
        ];
        let child = spawn(&mut command(folder.path(), &line));
        std::thread::sleep(Duration::from_secs(1));
        interrupt(&child);
        assert_eq!(end(child), (Some(130), "interrupted\n".to_owned()));
    }
    assert!(names(folder.path()).is_empty());
}

/// A run of the paper's program with as many waypoints as are taken on.
#[test]
fn an_interrupted_run_keeps_earlier_files() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["run", "--scenario", "paper-appendix", "--quiet"]).done();
    let out = dir.join("out");
    let before = |name: &str| std::fs::read(out.join(name)).unwrap();
    let files: Vec<_> = names(&out).into_iter().map(|name| (before(&name), name)).collect();
    let many = scenario(dir, "points = 55", "points = 49000");
    let child = spawn(&mut command(
        dir,
        &["run", "--quiet", "--scenario", many.to_str().unwrap()],
    ));
    std::thread::sleep(Duration::from_secs(1));
    interrupt(&child);
    assert_eq!(end(child), (Some(130), "interrupted\n".to_owned()));
    assert_eq!(names(&out).len(), files.len());
    for (bytes, name) in files {
        assert_eq!(before(&name), bytes, "{name}");
    }
}
