//! The benchmarks, and a test that they measure.

use crate::step::Step;
use anyhow::{Result, bail};

/// What must be among the benchmarks at the root: the IK loop, and the certified job's stages.
const WANTED: [&str; 10] = [
    "ik_warm, through the wrist singularity/platewash `solve_path`/solved 100.0 %",
    "ik_warm, through the wrist singularity/platewash `solve`/solved 100.0 %",
    "ik_warm, away from it/platewash `solve`/solved 100.0 %",
    "ik_nearest/platewash `nearest`/solved 100.0 %",
    "ik_cold/platewash `solve`/solved 100.0 %",
    "ik_batch/platewash `batch::solve`/solved 100.0 %",
    "kitchen/plan, from home to home",
    "kitchen/prove",
    "plant/semi-implicit Euler",
    "kitchen executed/computed_torque",
];

/// Runs the benchmarks of the root package.
pub fn run(arguments: &[String]) -> Result<()> {
    let arguments = arguments.iter().map(String::as_str);
    let line: Vec<&str> = ["bench", "--"].into_iter().chain(arguments).collect();
    Step::cargo("benchmarks", &line).run()
}

/// Runs each benchmark once, without measuring for long; fails unless all that are wanted are among them.
pub fn once() -> Result<()> {
    // In the release profile, and with the features that the extension asks for, the libraries are those of the tests.
    let line = [
        "bench",
        "--profile",
        "release",
        "-p",
        "platewash",
        "-p",
        "pyplatewash",
        "--",
        "--test",
    ];
    let output = Step::cargo("benchmarks, once each", &line).output()?;
    let ran = ran(&output);
    if let Some(missing) = WANTED.iter().find(|wanted| !ran.contains(*wanted)) {
        bail!("`cargo bench` has no benchmark '{missing}' that ends well; it has: {ran:?}");
    }
    println!("    {} benchmarks", ran.len());
    Ok(())
}

/// The benchmarks that criterion ran to their end.
fn ran(output: &str) -> Vec<&str> {
    let lines: Vec<&str> = output.lines().map(str::trim).collect();
    let pairs = lines.windows(2).filter(|pair| pair[1] == "Success");
    pairs.filter_map(|pair| pair[0].strip_prefix("Testing ")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_only_successful_benchmarks() {
        let output = "Testing ik/a b\nSuccess\n\nTesting job/c\nTesting job/d\nSuccess\nrunning 0 tests\n";
        assert_eq!(ran(output), ["ik/a b", "job/d"]);
        assert!(ran("running 38 tests\n\ntest result: ok. 0 passed; 0 failed; 38 ignored; 0 measured").is_empty());
    }
}
