//! What a study's row costs beyond planning and proving it: `kitchen`, by `run` on one thread, beside `plan` and `prove` of the same layouts, in turns.
//!
//!     cargo bench --bench study
#![allow(missing_docs)]
// What it measures is its output.
#![allow(clippy::print_stdout)]

use platewash::certificate::prove_with;
use platewash::planner::{Watch, plan_with};
use platewash::study::{Journal, RowMaker, Study, run};
use platewash::{CancelToken, Scenario, WashJob};
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Layouts of a pair of measurements.
const LAYOUTS: u64 = 4;
/// Pairs.
const PAIRS: usize = 7;

fn main() -> Result<(), Box<dyn Error>> {
    // One thread, whatever the machine has.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let once = std::env::args().any(|word| word == "--test");
    let wanted: Vec<_> = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with("--"))
        .collect();
    if !wanted.is_empty() && !wanted.iter().any(|word| "study/kitchen".contains(word.as_str())) {
        return Ok(());
    }
    let (study, jobs) = (study()?, jobs()?);
    let mut ratios = Vec::new();
    let mut rows_s = Vec::new();
    // Beforehand once, so that nothing is measured cold.
    rows(&study)?;
    for pair in 0..if once { 1 } else { PAIRS } {
        let (alone_s, rows_taken_s) = if pair % 2 == 0 {
            let alone_s = alone(&jobs)?;
            (alone_s, rows(&study)?)
        } else {
            let taken_s = rows(&study)?;
            (alone(&jobs)?, taken_s)
        };
        ratios.push(alone_s / rows_taken_s);
        rows_s.push(LAYOUTS as f64 / rows_taken_s);
    }
    if once {
        println!("Testing study/kitchen\nSuccess");
        return Ok(());
    }
    ratios.sort_unstable_by(f64::total_cmp);
    rows_s.sort_unstable_by(f64::total_cmp);
    println!(
        "study/kitchen: {:.2} rows/s (median); over plan and prove of the same layouts: median {:.3} of {PAIRS} pairs, from {:.3} to {:.3}",
        rows_s[PAIRS / 2],
        ratios[PAIRS / 2],
        ratios[0],
        ratios[PAIRS - 1]
    );
    Ok(())
}

fn study() -> Result<Arc<Study>, Box<dyn Error>> {
    let head = "format = \"platewash-study/1\"\nname = \"overhead\"\nscenario = \"kitchen\"\n";
    let text = format!("{head}[[axis]]\nkey = \"seed\"\nseeds = \"1..{LAYOUTS}\"\n");
    Ok(Arc::new(Study::parse(&text, "overhead.toml", Path::new(""))?))
}

fn jobs() -> Result<Vec<WashJob>, Box<dyn Error>> {
    let kitchen = Scenario::load("kitchen")?;
    let job = |seed| {
        let scenario = Scenario {
            seed,
            ..kitchen.clone()
        };
        Ok(scenario.job()?)
    };
    (1..=LAYOUTS).map(job).collect()
}

/// All layouts planned and proved \[s\].
fn alone(jobs: &[WashJob]) -> Result<f64, Box<dyn Error>> {
    let (began, cancel) = (Instant::now(), CancelToken::new());
    for job in jobs {
        let planned = plan_with(job, &Watch::silent(&cancel))?;
        black_box(prove_with(&planned.plan, job.arm(), &cancel)?);
    }
    Ok(began.elapsed().as_secs_f64())
}

/// The same as rows of a study, from an empty folder to a finished one \[s\].
fn rows(study: &Arc<Study>) -> Result<f64, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let (began, cancel) = (Instant::now(), CancelToken::new());
    let mut journal = Journal::open(folder.path(), study)?;
    let maker = RowMaker::new(study.clone());
    run(&mut journal, &cancel, |index, cancel| maker.row(index, cancel), |_| ())?;
    Ok(began.elapsed().as_secs_f64())
}
