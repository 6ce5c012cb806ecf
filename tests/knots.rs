//! The motions of the shipped scenarios, knot by knot: times, positions and speeds to the last bit.
//!
//! `tests/golden/knots.json` holds the first 16 digits of the SHA-256 of each motion. A change that only moves or renames code leaves
//! it as it is. Where a change is meant to change what is planned:
//!
//!     cargo test --release --test main knots -- --ignored      writes it
//!
//! `PLATEWASH_THOROUGH=1` compares all seeds.

use crate::shipped::{SEED, planned};
use platewash::motion::plan::Knots;
use platewash::scenario::{Program, SHIPPED};
use platewash::{Scenario, paper, plan};
use platewash_fixtures::is_thorough;
use rayon::prelude::*;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Seeds of each scenario.
const SEEDS: u64 = 12;

/// Seeds that are compared after every change.
const FIRST: u64 = 3;

/// What stands in place of a hash where a layout cannot be washed.
const UNWASHABLE: &str = "unwashable";

/// By scenario, a motion a seed.
type Hashes = BTreeMap<String, Vec<String>>;

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden/knots.json")
}

fn hashes(seeds: u64) -> Hashes {
    let of = |name: &str| {
        let seeds: Vec<_> = (1..=own(name, seeds)).collect();
        let of_seed = |seed| motion(name, seed).map_or_else(|| UNWASHABLE.to_owned(), |knots| hash(&knots));
        seeds.into_par_iter().map(of_seed).collect()
    };
    SHIPPED.iter().map(|s| (s.name.to_owned(), of(s.name))).collect()
}

/// How many of some seeds give layouts of their own: where plates are listed, every seed has the same one.
fn own(name: &str, seeds: u64) -> u64 {
    if Scenario::load(name).unwrap().lists_plates() {
        1
    } else {
        seeds
    }
}

/// The motion; `None` where the layout cannot be washed, which is no failure of a program that says so.
fn motion(name: &str, seed: u64) -> Option<Knots> {
    let scenario = Scenario {
        seed,
        ..Scenario::load(name).unwrap()
    };
    match scenario.job.program {
        Program::Certified if seed == SEED => Some(planned(name).1.knots.clone()),
        Program::Certified => match plan(&scenario.job().unwrap()) {
            Ok(planned) => Some(planned.plan.knots),
            Err(error) => {
                assert!(error.infeasibility().is_some(), "{name}, seed {seed}: {error}");
                None
            }
        },
        Program::Paper => Some(Knots::from(
            &paper::run(&scenario.paper_job().unwrap()).unwrap().planned,
        )),
    }
}

/// Of the bytes of t, then q, then q̇, little-endian.
fn hash(motion: &Knots) -> String {
    let joints = motion.q_rad.iter().chain(&motion.qd_rad_s).flatten();
    let mut hash = Sha256::new();
    for number in motion.t_s.iter().chain(joints) {
        hash.update(number.to_le_bytes());
    }
    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
#[ignore = "writes the golden file"]
fn write() {
    std::fs::write(file(), serde_json::to_string_pretty(&hashes(SEEDS)).unwrap() + "\n").unwrap();
}

#[test]
fn the_shipped_scenarios_move_as_committed() {
    let mut committed: Hashes = serde_json::from_str(&std::fs::read_to_string(file()).unwrap()).unwrap();
    assert_eq!(committed.len(), SHIPPED.len());
    let seeds = if is_thorough() { SEEDS } else { FIRST };
    for (name, motions) in &mut committed {
        assert_eq!(motions.len() as u64, own(name, SEEDS), "{name}");
        motions.truncate(seeds as usize);
    }
    assert_eq!(committed, hashes(seeds));
}
