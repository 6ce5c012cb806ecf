//! The certified job `kitchen`, stage by stage and whole, on one core.
//!
//!     cargo bench -p platewash-benches --bench cycle
#![allow(missing_docs)]

use criterion::Criterion;
use platewash_benches::stages::{Stage, Stages};
use std::error::Error;
use std::time::Duration;

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let mut criterion = Criterion::default().configure_from_args();
    let stages = Stages::new("kitchen")?;
    let mut group = criterion.benchmark_group("kitchen");
    group.sample_size(20).measurement_time(Duration::from_secs(4));
    for (stage, name) in Stage::ALL {
        // Beforehand once, so that an error ends the benchmark.
        stages.run(stage)?;
        group.bench_function(name, |b| b.iter(|| stages.run(stage)));
    }
    group.finish();
    criterion.final_summary();
    Ok(())
}
