//! The bytes of what `run` writes for every shipped scenario, to the last digit: the same in every build, on every machine and for
//! every number of threads.
//!
//! `tests/golden/outputs.json` holds the SHA-256 of every file; `tests/programs.rs` has the same for robot programs. Where a change is
//! meant to change what is planned:
//!
//!     cargo test --release --test command golden -- --ignored      writes it

use super::*;
use platewash::kinematics::sha256_hex;
use platewash::scenario::SHIPPED;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// SHA-256 of each file, by scenario and file name.
type Hashes = BTreeMap<String, BTreeMap<String, String>>;

/// Numbers of threads; the scenarios take turns with them.
const THREADS: [&str; 3] = ["1", "2", "8"];
/// The scenario that is run with each of them.
const IN_DEPTH: &str = "kitchen-rim";

fn golden() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden/outputs.json")
}

fn scenarios() -> Vec<String> {
    let mut names: Vec<_> = SHIPPED.iter().map(|shipped| shipped.name.to_owned()).collect();
    names.sort();
    names
}

/// The files that a run of a scenario with its own seed writes.
fn hashes_of(scenario: &str, threads: &str) -> BTreeMap<String, String> {
    let folder = folder();
    platewash(folder.path(), &["run", "--scenario", scenario, "--threads", threads]).done();
    let out = folder.path().join("out");
    let hash = |name: String| {
        let bytes = std::fs::read(out.join(&name)).unwrap();
        (name, sha256_hex(&bytes))
    };
    names(&out).into_iter().map(hash).collect()
}

fn hashes() -> Hashes {
    let of = |(number, scenario): (usize, &String)| {
        let threads = THREADS[number % THREADS.len()];
        (scenario.clone(), hashes_of(scenario, threads))
    };
    scenarios().par_iter().enumerate().map(of).collect()
}

fn committed() -> Hashes {
    serde_json::from_str(&std::fs::read_to_string(golden()).unwrap()).unwrap()
}

#[test]
#[ignore = "writes the golden file"]
fn write() {
    std::fs::write(golden(), serde_json::to_string_pretty(&hashes()).unwrap() + "\n").unwrap();
}

#[test]
fn every_shipped_scenario_writes_the_committed_bytes() {
    assert_eq!(committed(), hashes());
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    for threads in THREADS {
        assert_eq!(committed()[IN_DEPTH], hashes_of(IN_DEPTH, threads), "{threads} threads");
    }
}
