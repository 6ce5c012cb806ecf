//! Work and input without end: refused, soon and by name.

use super::*;
use std::time::{Duration, Instant};

#[track_caller]
fn soon(ran: impl FnOnce() -> CommandOutput) -> CommandOutput {
    let start = Instant::now();
    let ran = ran();
    assert!(start.elapsed() < Duration::from_secs(300), "{:?}", start.elapsed());
    ran
}

#[test]
fn refuses_endless_work() {
    let folder = folder();
    let dir = folder.path();
    let ik = ["ik", "--position", "0.3", "0", "0.3", "--rpy-deg", "0", "0", "0"];
    let restarts = [&ik[..], &["--restarts", "1000000000"]].concat();
    soon(|| platewash(dir, &restarts)).refused(2, &["--restarts", "10000", "1000000000"]);
    soon(|| platewash(dir, &["reproduce", "--draws", "10000000"])).refused(2, &["--draws", "1000000"]);
    soon(|| platewash(dir, &["reproduce", "--layouts", "10001"])).refused(2, &["--layouts", "10000"]);
    soon(|| platewash(dir, &["run", "--dt", "1e-6"])).refused(2, &["--dt", "1000000 rows", "give at least"]);
    let positions: Vec<_> = (0..1000).map(|k| format!("[{}, 0.3]", k as f64 * 1e-3)).collect();
    let positions = format!("positions_m = [{}]", positions.join(", "));
    let file = scenario(dir, "region = \"appendix\"", &positions);
    let file = file.to_str().unwrap();
    for verb in ["run", "plan", "validate"] {
        soon(|| platewash(dir, &[verb, "--scenario", file])).refused(2, &["1000 plates", "wash.points"]);
    }
    soon(|| platewash(dir, &["layout", "--scenario", file])).done();
    assert_eq!(names(dir), ["case.toml"]);
}

/// JSON's numbers are doubles: above 2⁵³ − 1 two seeds could have one plan file.
#[test]
fn every_verb_rejects_seeds_beyond_the_exact_integers_of_json() {
    let folder = folder();
    let dir = folder.path();
    let largest = "9007199254740991 (2^53 − 1)";
    platewash(dir, &["layout", "--seed", "9007199254740991"]).done();
    for seed in ["9007199254740992", "9007199254740993", "-1", "18446744073709551616"] {
        platewash(dir, &["layout", "--seed", seed]).refused(2, &["--seed", "from 0 to", largest]);
        let seeds = format!("{seed}..{seed}");
        platewash(dir, &["sweep", "--seeds", &seeds]).refused(2, &["--seeds", "FIRST..LAST", largest]);
        std::fs::write(
            dir.join("case.toml"),
            format!("seed = {seed}\n[layout]\nregion = \"text\"\n"),
        )
        .unwrap();
        platewash(dir, &["layout", "--scenario", "case.toml"]).refused(2, &["case.toml"]);
    }
    std::fs::write(
        dir.join("case.toml"),
        "seed = 9007199254740992\n[layout]\nregion = \"text\"\n",
    )
    .unwrap();
    let told = ["case.toml", "line 1", "seed must be", largest, "found 9007199254740992"];
    platewash(dir, &["layout", "--scenario", "case.toml"]).refused(2, &told);
}

#[test]
fn more_configurations_than_a_hundred_thousand_are_refused() {
    let folder = folder();
    std::fs::write(folder.path().join("many.txt"), "0 0 0 0 0 0\n".repeat(100_001)).unwrap();
    let many = ["fk", "--deg", "--file", "many.txt"];
    soon(|| platewash(folder.path(), &many)).refused(2, &["many.txt, line 100001", "100000"]);
}

/// `/dev/zero` never ends, and opening a pipe waits for its writer.
#[cfg(target_os = "linux")]
#[test]
fn rejects_devices_and_pipes_as_input() {
    let folder = folder();
    let dir = folder.path();
    assert!(Command::new("mkfifo").arg(dir.join("pipe")).status().unwrap().success());
    std::fs::write(dir.join("arm.urdf"), platewash::kinematics::irb120::IRB120_URDF).unwrap();
    for file in ["/dev/zero", "pipe", "."] {
        let cases: [&[&str]; 4] = [
            &["run", "--scenario", file],
            &["run", "--urdf", file],
            &["run", "--urdf", "arm.urdf", "--srdf", file],
            &["fk", "--deg", "--file", file],
        ];
        for arguments in cases {
            soon(|| platewash(dir, arguments)).refused(2, &[file, "not a regular file"]);
        }
    }
}
