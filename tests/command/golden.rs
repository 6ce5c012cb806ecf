//! The bytes of what the command writes, to the last digit: the same in every build and on every machine.
//!
//! `tests/golden/outputs.json` holds the SHA-256 of every file. These tests compare it with the output of the build under test
//! (of `cargo test`: a debug build; in `cargo xtask test`: a build with the checks of a debug build),
//! `tests/python/test_release_writes_the_same.py` with a release build's. Where a change is meant to change what is planned:
//!
//!     cargo test --test command golden -- --ignored      writes it

use super::*;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Scenario and seed.
const RUNS: [(&str, u64); 6] = [
    ("kitchen", 1),
    ("kitchen-spiral", 1),
    ("kitchen-roomy", 3),
    ("kitchen-rim", 5),
    ("paper-appendix", 1),
    ("paper-text", 4),
];

type Hashes = BTreeMap<String, BTreeMap<String, String>>;

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden/outputs.json")
}

fn hashes() -> Hashes {
    RUNS.iter()
        .map(|(scenario, seed)| {
            let folder = folder();
            let seed = seed.to_string();
            platewash(folder.path(), &["run", "--scenario", scenario, "--seed", &seed]).done();
            let out = folder.path().join("out");
            let files = names(&out).into_iter().map(|name| {
                let bytes = std::fs::read(out.join(&name)).unwrap();
                let hash: String = Sha256::digest(&bytes)
                    .iter()
                    .map(|byte| format!("{byte:02x}"))
                    .collect();
                (name, hash)
            });
            (format!("{scenario} {seed}"), files.collect())
        })
        .collect()
}

#[test]
#[ignore = "writes the golden file"]
fn write() {
    std::fs::write(file(), serde_json::to_string_pretty(&hashes()).unwrap() + "\n").unwrap();
}

#[test]
fn the_build_under_test_writes_the_committed_bytes() {
    let committed: Hashes = serde_json::from_str(&std::fs::read_to_string(file()).unwrap()).unwrap();
    assert_eq!(committed, hashes());
}
