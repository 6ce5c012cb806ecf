//! The output folder shows the results of one run, whatever ends a run and whoever else writes there.
#![cfg(unix)]

use super::served::{command, signal, spawn};
use super::*;
use std::fs;
use std::process::Child;
use std::time::Duration;

/// Kills of runs at different moments.
const KILLS: u64 = 40;

/// The scenario whose plates, and so all files, depend on the seed: one plate, soon done.
fn scenario(dir: &Path) -> String {
    let fewer = [("count = 4", "count = 1")];
    spiral(dir, &fewer).to_str().unwrap().to_owned()
}

fn run(dir: &Path, scenario: &str, seed: u64) -> Child {
    let seed = seed.to_string();
    let line = [
        "run",
        "--scenario",
        scenario,
        "--seed",
        &seed,
        "--quiet",
        "--threads",
        "1",
    ];
    spawn(&mut command(dir, &line))
}

/// The seeds of a folder's results; nothing of what is not there.
fn seeds(out: &Path) -> Vec<u64> {
    let read = |name: &str| fs::read_to_string(out.join(name)).ok();
    let json = |name: &str| read(name).map(|text| serde_json::from_str::<Value>(&text).unwrap());
    let of_plan = json("plan.json").map(|plan| plan["job"]["seed"].as_u64().unwrap());
    let of_report = json("report.json").map(|report| report["seed"].as_u64().unwrap());
    let of_text = read("report.txt").map(|text| {
        let after = text.split(", seed ").nth(1).unwrap();
        after.split(',').next().unwrap().parse().unwrap()
    });
    let of_certificate = json("certificate.json").map(|certificate| {
        let proved = certificate["hash"]["stated"].as_str().unwrap().to_owned();
        let plan = json("plan.json").unwrap();
        assert_eq!(
            plan["hash"],
            proved.as_str(),
            "a certificate stands beside another plan"
        );
        plan["job"]["seed"].as_u64().unwrap()
    });
    [of_plan, of_report, of_text, of_certificate]
        .into_iter()
        .flatten()
        .collect()
}

#[track_caller]
fn shows_one_run(out: &Path) {
    let seeds = seeds(out);
    assert!(seeds.windows(2).all(|pair| pair[0] == pair[1]), "{seeds:?}");
}

fn leftovers(out: &Path) -> usize {
    names(out).iter().filter(|name| name.starts_with(".platewash-")).count()
}

#[test]
fn a_killed_run_leaves_the_results_of_one_run() {
    let folder = folder();
    let dir = folder.path();
    let (scenario, out) = (scenario(dir), dir.join("out"));
    let begin = std::time::Instant::now();
    assert!(run(dir, &scenario, 1).wait().unwrap().success());
    let lasts = begin.elapsed();
    fs::write(out.join("mine.txt"), "mine").unwrap();
    for kill in 0..KILLS {
        let mut child = run(dir, &scenario, 2 + kill % 2);
        // The second half of a run writes; the last moments count most.
        let share = 0.5 + 0.6 * kill as f64 / KILLS as f64;
        std::thread::sleep(Duration::from_secs_f64(share * lasts.as_secs_f64()));
        child.kill().unwrap();
        child.wait().unwrap();
        shows_one_run(&out);
    }
    assert!(run(dir, &scenario, 5).wait().unwrap().success());
    assert!(!seeds(&out).is_empty() && seeds(&out).iter().all(|seed| *seed == 5));
    assert_eq!(leftovers(&out), 0, "{:?}", names(&out));
    assert_eq!(fs::read_to_string(out.join("mine.txt")).unwrap(), "mine");
}

#[test]
fn four_runs_at_once_leave_the_results_of_one() {
    let folder = folder();
    let dir = folder.path();
    let (scenario, out) = (scenario(dir), dir.join("out"));
    let children: Vec<_> = (1..=4).map(|seed| run(dir, &scenario, seed)).collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    shows_one_run(&out);
    assert_eq!((seeds(&out).len(), leftovers(&out)), (4, 0), "{:?}", names(&out));
}

#[test]
fn termination_is_answered_as_ctrl_c_is() {
    let folder = folder();
    let line = ["sweep", "--seeds", "1..100000", "--threads", "1", "--out", "s"];
    let child = spawn(&mut command(folder.path(), &line));
    std::thread::sleep(Duration::from_millis(500));
    signal(&child, 15);
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&output.stderr).ends_with("interrupted\n"));
}

#[test]
fn a_name_that_is_too_long_is_refused_before_planning() {
    let folder = folder();
    let long = (100..200).map(|k: i32| k.to_string()).collect::<String>();
    let line = ["run", "--scenario", "kitchen", "--out", &long];
    platewash(folder.path(), &line).refused(2, &["cannot be written", "File name too long"]);
    assert_eq!(names(folder.path()), Vec::<String>::new());
}
