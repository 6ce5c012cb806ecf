//! The Python wheel: built from the checkout for the tests, and from its source package as a user would.

use crate::python;
use crate::step::{Step, target};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

/// Largest wheel \[bytes\].
const LARGEST: u64 = 6_000_000;

/// Builds the wheel as `pip install .` does, installs it in a fresh environment and in that of the tests.
///
/// The Rust build is cargo's in the same target folder, so that what the release build made is not made again.
pub fn install() -> Result<()> {
    let tests = python::environment()?;
    let wheel = build(&tests, ".", &target())?;
    fresh(&wheel)?;
    let line = ["install", "--no-deps", "--force-reinstall", &text(&wheel)];
    pip("wheel among the tests", &tests, &line).run()
}

/// Makes the source package, and from it, outside the checkout and with a target folder of its own, the wheel.
pub fn package() -> Result<()> {
    let tests = python::environment()?;
    let folder = emptied("package")?;
    let line = ["-m", "maturin", "sdist", "--out", &text(&folder)];
    Step::program("source package", &tests, &line).run()?;
    let source = only_file(&folder, "gz")?;
    let outside = std::env::temp_dir().join(format!("platewash-package-{}", std::process::id()));
    let done = build(&tests, &text(&source), &outside).and_then(|wheel| fresh(&wheel));
    // What is left behind is temporary anyway.
    let _ = std::fs::remove_dir_all(&outside);
    done
}

/// The wheel of a project folder or source package.
fn build(python: &Path, source: &str, cargo_target: &Path) -> Result<PathBuf> {
    let folder = emptied("wheels")?;
    let line = ["wheel", "--no-deps", "--wheel-dir", &text(&folder), source];
    pip("wheel", python, &line)
        .with("CARGO_TARGET_DIR", cargo_target)
        .run()?;
    let wheel = only_file(&folder, "whl")?;
    let bytes = std::fs::metadata(&wheel)?.len();
    if bytes > LARGEST {
        bail!("{} has {bytes} bytes; at most {LARGEST} are wanted", wheel.display());
    }
    println!("    {bytes} bytes");
    Ok(wheel)
}

/// The wheel in an environment where nothing else is, and the README's example in it.
fn fresh(wheel: &Path) -> Result<()> {
    let folder = target().join("fresh");
    let line = ["-m", "venv", "--clear", &text(&folder)];
    Step::program("fresh environment", python::base(), &line).run()?;
    let python = python::interpreter(&folder);
    pip("wheel in it", &python, &["install", &text(wheel)]).run()?;
    let line = ["-I", "tests/python/readme_example.py"];
    Step::program("README's example in it", &python, &line).run()
}

/// A call of an interpreter's pip.
fn pip(title: &'static str, python: &Path, arguments: &[&str]) -> Step {
    let line = [&["-m", "pip", "--quiet", "--disable-pip-version-check"], arguments].concat();
    Step::program(title, python, &line)
}

/// A folder of the target folder, without what was in it.
fn emptied(name: &str) -> Result<PathBuf> {
    let folder = target().join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    }
    Ok(folder)
}

/// The one file with that extension in a folder.
fn only_file(folder: &Path, extension: &str) -> Result<PathBuf> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut found = entries.filter_map(|entry| Some(entry.ok()?.path()));
    match found.find(|path| path.extension().is_some_and(|found| found == extension)) {
        Some(path) => Ok(path),
        None => bail!("no .{extension} file in {}", folder.display()),
    }
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
