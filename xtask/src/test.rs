//! `cargo xtask test`: every test in Rust, in Python, of the page and of the playground.

use crate::step::Step;
use crate::steps::{all, beside};
use crate::{browser, command, page, programs, python, web, wheel};
use anyhow::{Result, bail};
use std::time::Instant;

/// A part of the tests that can be run alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// The tests in Rust.
    Rust,
    /// The tests in Python, of the finished command and the finished wheel.
    Python,
    /// The page and the playground: their tests, and in a browser what they show.
    Browser,
}

/// Whether the tests in a browser are run, which need one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BrowserTests {
    /// They are, and fail where there is no browser.
    Run,
    /// They are left out, as was asked for.
    LeftOut,
}

impl Part {
    /// The part of that name.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "rust" => Ok(Self::Rust),
            "python" => Ok(Self::Python),
            "browser" => Ok(Self::Browser),
            "lint" | "site" => bail!("'{name}' is a part of `cargo xtask check`: cargo xtask check --only {name}"),
            other => bail!("unknown part '{other}'"),
        }
    }
}

/// Runs all tests or one part of them.
pub fn run(only: Option<Part>, in_browser: BrowserTests) -> Result<()> {
    let start = Instant::now();
    match only {
        None => whole(in_browser)?,
        Some(Part::Rust) => all(&[page::make, programs::tested])?,
        Some(Part::Python) => all(&[page::make, command::build, wheel::install, python::tests])?,
        Some(Part::Browser) => {
            all(&[page::make, command::build])?;
            pages(in_browser)?;
        }
    }
    println!("\nAll tests passed in {:.0} s.", start.elapsed().as_secs_f64());
    Ok(())
}

/// Runs all tests.
///
/// It first looks for Python, so that it does not fail after a quarter of an hour without it. The page is made before crates are
/// compiled, so that all have it. Once the command is built, pages are looked at; once the wheel is, the tests in Python begin. The
/// module of the playground and the tests in Rust are compiled meanwhile.
fn whole(in_browser: BrowserTests) -> Result<()> {
    python::check()?;
    // The step that needs them waits for the end of this, and tells what goes wrong.
    std::thread::spawn(python::environment);
    all(&[page::make, command::build])?;
    let pages = match in_browser {
        BrowserTests::Run => || pages(BrowserTests::Run),
        BrowserTests::LeftOut => || pages(BrowserTests::LeftOut),
    };
    beside(&[pages], || {
        wheel::install()?;
        beside(&[python::tests], || all(&[web::built, programs::tested]))
    })
}

/// Runs the tests of the page and of the playground.
fn pages(in_browser: BrowserTests) -> Result<()> {
    page::tested()?;
    match in_browser {
        BrowserTests::Run => all(&[browser::pages, web::tested, browser::playground]),
        BrowserTests::LeftOut => {
            println!("\n==> tests in a browser: LEFT OUT, as was asked for");
            web::tested()
        }
    }
}

/// Writes the pages that are made from the program: their tests write before they compare.
pub fn docs() -> Result<()> {
    for (package, suite, test) in [
        ("platewash-scenario", "scenario", "the_committed_page_is_current"),
        ("platewash", "main", "the_types_of_the_page_are_those_of_rust"),
    ] {
        let line = ["test", "--release", "-p", package, "--test", suite, test];
        Step::cargo("pages", &line).with("PLATEWASH_WRITE_DOCS", "1").run()?;
    }
    Ok(())
}
