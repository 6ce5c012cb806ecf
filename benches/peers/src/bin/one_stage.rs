//! A stage of the certified job `kitchen` a number of times, for an instruction counter, after the same preparation
//! whatever the number: the difference of two runs is what the stage costs.
//!
//!     valgrind --tool=callgrind target/release/one_stage verify 1
//!     valgrind --tool=callgrind target/release/one_stage verify 2
//!
//! The words are those of the benchmark `job`.

use platewash_problems::stages::{Stage, Stages};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let mut words = std::env::args().skip(1);
    let word = words.next().unwrap_or_default();
    let count: usize = words.next().ok_or("a stage and a number")?.parse()?;
    let named = Stage::ALL.into_iter().find(|(_, name)| *name == word);
    let (stage, _) = named.ok_or_else(|| {
        let names = Stage::ALL.map(|(_, name)| format!("'{name}'"));
        format!("no stage '{word}': one of {}", names.join(", "))
    })?;
    let stages = Stages::new("kitchen")?;
    (0..count).try_for_each(|_| stages.run(stage))
}
