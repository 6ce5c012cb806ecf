//! `cargo xtask check`: what must hold besides the tests before a change goes in.

use crate::step::Step;
use crate::steps::{all, beside};
use crate::test::BrowserTests;
use crate::{benches, browser, command, ledger, packages, page, python, site, wheel};
use anyhow::{Result, bail};
use std::time::Instant;

/// A part of the checks that can be run alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Format, clippy and the documentation; the types of the page.
    Lint,
    /// The types of the Python package, as three checkers see them.
    Types,
    /// What the crates and the source package hold, and the wheel with nothing beside it.
    Packages,
    /// The website of the site::documentation, in a browser, too.
    Site,
    /// Each benchmark once.
    Benchmarks,
    /// The instruction counts.
    Ledger,
}

impl Part {
    /// The part of that name.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "lint" => Ok(Self::Lint),
            "types" => Ok(Self::Types),
            "packages" => Ok(Self::Packages),
            "site" => Ok(Self::Site),
            "benchmarks" => Ok(Self::Benchmarks),
            "ledger" => Ok(Self::Ledger),
            "rust" | "python" | "browser" => {
                bail!("'{name}' is a part of `cargo xtask test`: cargo xtask test --only {name}")
            }
            other => bail!("unknown part '{other}'"),
        }
    }
}

/// Runs all checks or one part of them.
pub fn run(only: Option<Part>, in_browser: BrowserTests) -> Result<()> {
    let start = Instant::now();
    match only {
        None => whole(in_browser)?,
        Some(Part::Lint) => all(&[page::make, format, clippy, site::documentation, page::types])?,
        Some(Part::Types) => all(&[page::make, wheel::install, python::types])?,
        Some(Part::Packages) => all(&[
            page::make,
            command::build,
            wheel::install,
            packages::complete,
            wheel::package,
        ])?,
        Some(Part::Site) => {
            site::make()?;
            read(in_browser)?;
        }
        Some(Part::Benchmarks) => all(&[page::make, benches::once])?,
        Some(Part::Ledger) => all(&[page::make, command::build, ledger::check])?,
    }
    println!("\nAll checks passed in {:.0} s.", start.elapsed().as_secs_f64());
    Ok(())
}

/// Runs all checks: those that compile in one row, the others beside them.
fn whole(in_browser: BrowserTests) -> Result<()> {
    python::check()?;
    all(&[page::make, format, command::build, wheel::install])?;
    let others = [
        page::types,
        page::again,
        python::types,
        packages::complete,
        wheel::package,
        ledger::check,
    ];
    beside(&others, || all(&[clippy, site::documentation, benches::once]))?;
    site::built()?;
    read(in_browser)
}

fn read(in_browser: BrowserTests) -> Result<()> {
    if in_browser == BrowserTests::LeftOut {
        println!("\n==> website in a browser: LEFT OUT, as was asked for");
        return Ok(());
    }
    browser::read_site()
}

fn format() -> Result<()> {
    Step::cargo("format", &["fmt", "--all", "--", "--check"]).run()
}

/// Runs clippy over everything, and over the library without what the command needs.
fn clippy() -> Result<()> {
    let warnings = ["--", "-D", "warnings"];
    let everything = ["clippy", "--release", "--workspace", "--all-targets"];
    let library = [
        "clippy",
        "--release",
        "--package",
        "platewash",
        "--lib",
        "--no-default-features",
    ];
    for (title, line) in [
        ("clippy", &everything[..]),
        ("clippy, library without the command", &library),
    ] {
        wheel::with_its_settings(Step::cargo(title, &[line, &warnings].concat())).run()?;
    }
    Ok(())
}
