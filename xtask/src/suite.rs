//! Everything that must pass, in order.

use crate::step::Step;
use crate::{python, wheel};
use anyhow::{Result, bail};
use std::time::Instant;

/// The crates under test: all but the benchmarks, which alone need the solvers that others wrote.
const CRATES: [&str; 3] = ["--workspace", "--exclude", "platewash-benches"];
/// The same without the Python extension, whose tests are Python's.
const RUST_CRATES: [&str; 2] = ["--exclude", "pyplatewash"];
/// With this, pyo3 asks no interpreter: the parts in Rust need none.
const NO_PYTHON: (&str, &str) = ("PYO3_NO_PYTHON", "1");

/// One thing that must pass.
type Check = fn() -> Result<()>;

/// A part of the suite that can be run alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Format, clippy and the documentation.
    Lint,
    /// The tests in Rust.
    Rust,
    /// The tests in Python, of the finished command and the finished wheel.
    Python,
}

impl Part {
    /// The part of that name.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "lint" => Ok(Self::Lint),
            "rust" => Ok(Self::Rust),
            "python" => Ok(Self::Python),
            other => bail!("unknown part '{other}'"),
        }
    }
}

/// Runs the whole suite or one part of it, up to the first failure.
pub fn run(only: Option<Part>) -> Result<()> {
    let start = Instant::now();
    let steps: [(Part, Check); 8] = [
        (Part::Lint, format),
        (Part::Lint, clippy),
        (Part::Rust, tests),
        (Part::Lint, documentation),
        (Part::Python, release),
        (Part::Python, wheel::install),
        (Part::Python, wheel::package),
        (Part::Python, python::tests),
    ];
    let mut passed = 0;
    for (_, step) in steps.iter().filter(|(part, _)| only.is_none_or(|only| only == *part)) {
        step()?;
        passed += 1;
    }
    println!("\nAll {passed} steps passed in {:.0} s.", start.elapsed().as_secs_f64());
    Ok(())
}

/// Runs the benchmarks.
pub fn bench(arguments: &[String]) -> Result<()> {
    let arguments = arguments.iter().map(String::as_str);
    let line: Vec<&str> = ["bench", "-p", "platewash-benches", "--"]
        .into_iter()
        .chain(arguments)
        .collect();
    Step::cargo("benchmarks", &line).run()
}

/// Writes the pages that are made from the program: their tests write before they compare.
pub fn docs() -> Result<()> {
    Step::cargo(
        "pages",
        &["test", "-p", "platewash-planner", "the_committed_page_is_current"],
    )
    .with("PLATEWASH_WRITE_DOCS", "1")
    .run()
}

fn format() -> Result<()> {
    Step::cargo("format", &["fmt", "--all", "--", "--check"]).run()
}

fn clippy() -> Result<()> {
    let line = [&["clippy"], &CRATES[..], &["--all-targets", "--", "-D", "warnings"]].concat();
    Step::cargo("clippy", &line).with(NO_PYTHON.0, NO_PYTHON.1).run()
}

fn tests() -> Result<()> {
    Step::cargo("tests", &[&["test"], &CRATES[..], &RUST_CRATES[..]].concat()).run()
}

fn documentation() -> Result<()> {
    Step::cargo(
        "documentation",
        &[&["doc"], &CRATES[..], &RUST_CRATES[..], &["--no-deps"]].concat(),
    )
    .with("RUSTDOCFLAGS", "-D warnings")
    .run()
}

fn release() -> Result<()> {
    // Named beside it, the extension has the command's dependencies built as it needs them, too: once for both.
    let line = [
        "build",
        "--release",
        "-p",
        "platewash",
        "-p",
        "pyplatewash",
        "--bin",
        "platewash",
    ];
    Step::cargo("release build", &line).run()
}
