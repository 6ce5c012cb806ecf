//! Everything that must pass: in order, and side by side where that saves time.

use crate::{benches, browser, packages, page, python, site, web, wheel};
use anyhow::{Result, anyhow, bail};
use platewash_bundler::{Step, target};
use std::path::PathBuf;
use std::time::Instant;

/// The crates under test.
///
/// Every step uses the release profile and the same features, so that each crate is compiled once for the checks of clippy and the
/// documentation, and once for all that runs: tests, benchmarks, command and wheel.
const CRATES: [&str; 2] = ["--release", "--workspace"];
/// With this, pyo3 asks no interpreter: the parts in Rust need none.
const NO_PYTHON: (&str, &str) = ("PYO3_NO_PYTHON", "1");
/// Largest command \[bytes\].
const LARGEST: u64 = 24_000_000;

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
    /// The page and the playground: types, tests, and in a browser what they show.
    Browser,
    /// The website of the documentation, in a browser, too.
    Site,
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
            "lint" => Ok(Self::Lint),
            "rust" => Ok(Self::Rust),
            "python" => Ok(Self::Python),
            "browser" => Ok(Self::Browser),
            "site" => Ok(Self::Site),
            other => bail!("unknown part '{other}'"),
        }
    }
}

/// Runs the whole suite or one part of it, each up to the first failure.
///
/// The whole suite first looks for Python, so that it does not fail after half an hour without it. The page is made before crates are
/// compiled, so that all have it. The Python packages are fetched while crates compile.
pub fn run(only: Option<Part>, in_browser: BrowserTests) -> Result<()> {
    let start = Instant::now();
    let (in_browser, site_in_browser): (Check, Check) = match in_browser {
        BrowserTests::Run => (browser::tests, browser::read_site),
        BrowserTests::LeftOut => (left_out, left_out),
    };
    match only {
        None => whole(in_browser, site_in_browser)?,
        Some(Part::Lint) => all(&LINT)?,
        Some(Part::Rust) => all(&RUST)?,
        Some(Part::Python) => all(&[page::make, release_alone, wheel::install]).and_then(|()| all(&PYTHON))?,
        Some(Part::Browser) => all(&[
            page::make,
            release_alone,
            page::tested,
            page::again,
            web::tested,
            in_browser,
        ])?,
        Some(Part::Site) => all(&[site::make, site_in_browser])?,
    }
    println!("\nAll steps passed in {:.0} s.", start.elapsed().as_secs_f64());
    Ok(())
}

const LINT: [Check; 3] = [format, clippy, documentation];
const RUST: [Check; 3] = [page::make, tests, benches::once];
/// With the wheel installed.
const PYTHON: [Check; 3] = [wheel::package, packages::tested, python::tests];

fn all(steps: &[Check]) -> Result<()> {
    steps.iter().try_for_each(|step| step())
}

/// Runs steps, and others beside them: crates that compile alone, and tests that wait, leave a core idle.
fn beside(others: &[Check], steps: &[Check]) -> Result<()> {
    std::thread::scope(|scope| {
        let others = scope.spawn(|| all(others));
        let done = all(steps);
        let others = others.join().map_err(|_| anyhow!("a panic"))?;
        done.and(others)
    })
}

fn whole(in_browser: Check, site_in_browser: Check) -> Result<()> {
    python::check()?;
    // The step that needs them waits for the end of this, and tells what goes wrong.
    std::thread::spawn(python::environment);
    page::make()?;
    let compiled = [&LINT[..], &RUST, &[release]].concat();
    beside(&[page::tested, page::again, web::built], &compiled)?;
    wheel::install()?;
    beside(&[web::tested, in_browser, site::built, site_in_browser], &PYTHON)
}

fn left_out() -> Result<()> {
    println!("\n==> tests in a browser: LEFT OUT, as was asked for");
    Ok(())
}

/// Writes the pages that are made from the program: their tests write before they compare.
pub fn docs() -> Result<()> {
    Step::cargo(
        "pages",
        &[
            "test",
            "--release",
            "-p",
            "platewash-scenario",
            "the_committed_page_is_current",
        ],
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

/// Makes rustdoc's pages.
pub fn documentation() -> Result<()> {
    let line = [&["doc"], &CRATES[..], &["--no-deps"]].concat();
    Step::cargo("documentation", &line)
        .with("RUSTDOCFLAGS", "-D warnings")
        .with(NO_PYTHON.0, NO_PYTHON.1)
        .run()
}

fn tests() -> Result<()> {
    let line = [&["test"], &CRATES[..]].concat();
    Step::cargo("tests", &line).with(NO_PYTHON.0, NO_PYTHON.1).run()
}

/// The release build of the command after the tests, which have built it: nothing is left to compile.
fn release() -> Result<()> {
    let messages = command()?;
    let compiled = compiled_anew(&messages);
    if !compiled.is_empty() {
        bail!(
            "compiled again for the command: {}\n(the tests ask other features of these crates, or of what they use: ask for them in \
             Cargo.toml's [workspace.dependencies], too)",
            compiled.join(", ")
        );
    }
    Ok(())
}

/// The release build of the command, before anything else is built.
fn release_alone() -> Result<()> {
    command().map(drop)
}

/// The release build of the command, no larger than wanted; cargo's messages.
fn command() -> Result<String> {
    // Named beside it, the extension has the command's dependencies built with the features that it needs, too.
    let line = [
        "build",
        "--release",
        "-p",
        "platewash",
        "-p",
        "pyplatewash",
        "--bin",
        "platewash",
        "--message-format",
        "json-render-diagnostics",
    ];
    let messages = Step::cargo("release build", &line).output()?;
    wheel::no_larger(&program(), LARGEST)?;
    Ok(messages)
}

/// The command, where the release build puts it.
pub fn program() -> PathBuf {
    let name = format!("platewash{}", std::env::consts::EXE_SUFFIX);
    target().join("release").join(name)
}

/// The crates that a build had to compile, by cargo's messages.
fn compiled_anew(messages: &str) -> Vec<&str> {
    let compiled = |line: &&str| line.contains(r#""reason":"compiler-artifact""#) && line.contains(r#""fresh":false"#);
    let compiled = messages.lines().filter(compiled);
    compiled
        .filter_map(|line| line.split_once(r#""package_id":""#)?.1.split('"').next())
        .filter_map(|id| id.rsplit('/').next())
        .collect()
}

#[cfg(test)]
mod tests {
    use platewash_bundler::root;

    /// Cargo runs no test of a file that its program does not name.
    #[test]
    fn every_test_file_belongs_to_a_test_program() {
        let crates = std::fs::read_dir(root().join("crates")).unwrap();
        let folders = crates.map(|entry| entry.unwrap().path().join("tests"));
        let folders: Vec<_> = folders
            .chain([root().join("tests")])
            .filter(|folder| folder.join("main.rs").is_file())
            .collect();
        assert!(folders.len() > 5, "{folders:?}");
        for folder in folders {
            let main = std::fs::read_to_string(folder.join("main.rs")).unwrap();
            let manifest = std::fs::read_to_string(folder.with_file_name("Cargo.toml")).unwrap();
            for entry in std::fs::read_dir(&folder).unwrap() {
                let name = entry.unwrap().file_name().into_string().unwrap();
                let Some(module) = name.strip_suffix(".rs") else {
                    continue;
                };
                let named = main.contains(&format!("mod {module};")) || manifest.contains(&format!("\"tests/{name}\""));
                assert!(named, "{name} belongs to no program of {}", folder.display());
            }
        }
    }

    #[test]
    fn crates_that_are_built_twice_are_named() {
        let messages = [
            r#"{"reason":"compiler-artifact","package_id":"registry+https://index#nalgebra@0.35.0","fresh":true}"#,
            r#"{"reason":"compiler-artifact","package_id":"registry+https://index#serde@1.0.229","fresh":false}"#,
            r#"{"reason":"compiler-artifact","package_id":"path+file:///here#platewash@0.1.0","fresh":false}"#,
            r#"{"reason":"build-finished","success":true}"#,
        ];
        assert_eq!(
            super::compiled_anew(&messages.join("\n")),
            ["index#serde@1.0.229", "here#platewash@0.1.0"]
        );
    }
}
